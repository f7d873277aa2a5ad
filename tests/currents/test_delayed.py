"""A delayed current: its time counts from its beginning, in whole nanoseconds."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.currents import DelayedCurrent, SceneContext, UwsimSinusoidSpec
from uwsim.currents.delayed import round_to_nanoseconds

RANDOM = np.random.default_rng(4)


@pytest.mark.parametrize(
    "times",
    [
        RANDOM.uniform(-10.0, 1e3, 2000),
        RANDOM.integers(0, 10**6, 2000) / 1024.0,  # some lie in the middle of two nanoseconds
        RANDOM.integers(0, 10**7, 2000) / 3072.0 - RANDOM.integers(0, 1000, 2000) / 6000.0,
        (2.0 * RANDOM.integers(0, 10**6, 2000) + 1.0) * 0.5e-9,
        RANDOM.uniform(0.0, 1e8, 2000),
    ],
    ids=["any", "binary", "thirds", "middles", "years"],
)
def test_a_time_is_rounded_as_python_rounds_it(times: np.ndarray) -> None:
    assert [round_to_nanoseconds(time) for time in times.tolist()] == [
        round(time, 9) for time in times.tolist()
    ]


def test_it_flows_from_its_delay_on_at_its_own_time() -> None:
    swell = UwsimSinusoidSpec(speed=0.2, speed_variation=0.1, speed_period=3.0).bind(
        SceneContext(stream=lambda _: np.random.default_rng(0))
    )
    late, points = DelayedCurrent(swell, start=10.0, delay=2.0, offset=0.5), np.zeros((2, 3))
    assert not late.velocity(points, 11.999).any()
    assert late.velocity(points, 13.0).tolist() == swell.velocity(points, 3.5).tolist()
    assert late.acceleration(points, 13.0).tolist() == swell.acceleration(points, 3.5).tolist()
