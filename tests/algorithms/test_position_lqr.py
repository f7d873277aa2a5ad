"""The gains of position-lqr are held against SciPy, and its behaviour against the velocity loop."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.linalg import solve_discrete_are

import uwsim
from uwsim.algorithms.position_lqr import PositionLQR, compute_gains
from uwsim.errors import BadSetting


@pytest.mark.parametrize(
    ("lag", "dt", "integral_weight", "input_weight"),
    [(0.25, 0.05, 0.3, 0.2), (1.0, 0.1, 0.05, 2.0), (0.1, 0.02, 1.0, 0.05)],
)
def test_the_gains_solve_the_riccati_equation(
    lag: float, dt: float, integral_weight: float, input_weight: float
) -> None:
    decay = math.exp(-dt / lag)
    a = np.array([[1.0, dt, 0.0], [0.0, 1.0, -lag * (1.0 - decay)], [0.0, 0.0, decay]])
    b = np.array([[0.0], [-(dt - lag * (1.0 - decay))], [1.0 - decay]])
    r = np.array([[input_weight]])
    p = solve_discrete_are(a, b, np.diag([integral_weight, 1.0, 0.0]), r)
    expected = np.linalg.solve(r + b.T @ p @ b, b.T @ p @ a)[0]
    gains = compute_gains(lag, dt, integral_weight, input_weight)
    assert gains == pytest.approx((-expected[0], -expected[1], expected[2]), rel=1e-9)


def test_a_weight_of_0_is_an_error() -> None:
    with pytest.raises(BadSetting, match="input_weight"):
        PositionLQR.check_parameters({"input_weight": 0.0})


def test_the_integral_removes_a_steady_current() -> None:
    offsets = [
        uwsim.bench(
            "station-keeping", algorithm=f"position-{name}", seeds=(1,), levels={"current": [0.3]}
        ).rows[0][1]
        for name in ("p", "lqr")
    ]
    assert offsets[1] < 0.3 * offsets[0]
