"""The bundled REMUS 100 turns as the equations that Prestero's thesis published."""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.physics.water_models import bundled
from uwsim.physics.hydrodynamics.hydrodynamics import install

M, W, B, ZG = 299.0 / 9.81, 299.0, 306.0, 0.0196
IXX, IYY, IZZ = 0.177, 3.45, 3.45
MASS = np.array(
    [
        [M + 0.93, 0.0, 0.0, 0.0, M * ZG, 0.0],
        [0.0, M + 35.5, 0.0, -M * ZG, 0.0, -1.93],
        [0.0, 0.0, M + 35.5, 0.0, 1.93, 0.0],
        [0.0, -M * ZG, 0.0, IXX + 0.0704, 0.0, 0.0],
        [M * ZG, 0.0, 1.93, 0.0, IYY + 4.88, 0.0],
        [0.0, -1.93, 0.0, 0.0, 0.0, IZZ + 4.88],
    ]
)


def published(state: np.ndarray, rudder: float, planes: float) -> np.ndarray:
    """The rate of (u v w p q r x y z phi theta psi), with the thesis's totals."""
    u, v, w, p, q, r, _, _, _, phi, theta, psi = state
    s1, c1, s2, c2 = math.sin(phi), math.cos(phi), math.sin(theta), math.cos(theta)
    s3, c3 = math.sin(psi), math.cos(psi)
    # fmt: off
    forces = [
        -(W - B) * s2 - 1.62 * u * abs(u) + (-35.5 - M) * w * q - 1.93 * q**2
        + (35.5 + M) * v * r - 1.93 * r**2 - M * ZG * p * r + 3.86,
        (W - B) * c2 * s1 - 1310.0 * v * abs(v) + 0.632 * r * abs(r) - 28.6 * u * v
        + (35.5 + M) * w * p + (5.22 - M) * u * r - M * ZG * q * r + 1.93 * p * q
        + 9.64 * u**2 * rudder,
        (W - B) * c2 * c1 - 1310.0 * w * abs(w) - 0.632 * q * abs(q) - 28.6 * u * w
        + (-5.22 + M) * u * q + (-35.5 - M) * v * p + M * ZG * (p**2 + q**2) + 1.93 * r * p
        - 9.64 * u**2 * planes,
        -ZG * W * c2 * s1 - 0.13 * p * abs(p) - (IZZ - IYY) * q * r - M * ZG * w * p
        + M * ZG * u * r - 0.543,
        -ZG * W * s2 + 3.18 * w * abs(w) - 188.0 * q * abs(q) + (4.86 - (IXX - IZZ)) * r * p
        + M * ZG * v * r - M * ZG * w * q - 2.0 * u * q + 24.0 * u * w - 1.93 * v * p
        - 6.15 * u**2 * planes,
        -3.18 * v * abs(v) - 94.0 * r * abs(r) - 24.0 * u * v + (-4.86 - (IYY - IXX)) * p * q
        - 1.93 * w * p - 2.0 * u * r - 6.15 * u**2 * rudder,
    ]
    places = [
        c3 * c2 * u + (c3 * s2 * s1 - s3 * c1) * v + (s3 * s1 + c3 * c1 * s2) * w,
        s3 * c2 * u + (c1 * c3 + s1 * s2 * s3) * v + (c1 * s2 * s3 - c3 * s1) * w,
        -s2 * u + c2 * s1 * v + c1 * c2 * w,
        p + s1 * s2 / c2 * q + c1 * s2 / c2 * r,
        c1 * q - s1 * r,
        s1 / c2 * q + c1 / c2 * r,
    ]
    # fmt: on
    return np.concatenate([np.linalg.solve(MASS, forces), places])


def radius(places: np.ndarray) -> float:
    """Of the circle through places (n, 2), by least squares [m]."""
    sides = np.column_stack([2.0 * places, np.ones(len(places))])
    x, y, rest = np.linalg.lstsq(sides, (places**2).sum(axis=1), rcond=None)[0]
    return math.sqrt(rest + x * x + y * y)


@pytest.mark.parametrize("rudder", [-0.07, 0.14])
def test_the_remus_turns_with_the_radius_of_the_published_equations(rudder: float) -> None:
    planes = -0.03
    start = np.zeros(12)
    start[0] = 1.54
    times = np.arange(0.0, 60.0, 0.5)
    solved = solve_ivp(
        lambda _, state: published(state, rudder, planes), (0.0, 60.0), start, "DOP853",
        times, rtol=1e-8,
    ).y.T  # fmt: skip
    model, _ = bundled("remus100")
    water, data = install(model), mujoco.MjData(model)
    data.qvel[0] = 1.54
    water.set_thrusters(data, [1.0])
    for name, angle in (
        ("upper_rudder", rudder), ("lower_rudder", rudder),
        ("port_plane", planes), ("starboard_plane", planes),
    ):  # fmt: skip
        water.turn_fin(data, name, angle)
    ours = []
    for _ in times:
        ours.append([data.qpos[0], -data.qpos[1], -data.qpos[2]])
        water.step(data, 250)
    places = np.array(ours)
    late = times > 30.0
    expected = radius(solved[late, 6:8])
    assert 5.0 < expected < 60.0
    assert radius(places[late, :2]) == pytest.approx(expected, rel=0.02)
    # a rudder that pushes the stern to starboard turns the bow to port
    assert places[10, 1] * rudder < 0.0
