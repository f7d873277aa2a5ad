"""The original's current: its function, its harmonics, its chance."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.special import jv

from uwsim.base.rng import stream
from uwsim.currents import (
    ConstantSpec,
    Current,
    DelayedCurrent,
    SceneContext,
    TotalCurrent,
    UwsimSinusoidSpec,
)

ORIGIN = np.zeros((1, 3))


def context(seed: int = 0) -> SceneContext:
    return SceneContext(stream=lambda name: stream(seed, name))


def released(speed: float = 0.2, **other: float) -> UwsimSinusoidSpec:
    """Return the direction of the original's trackingBenchmarkauto, steady and without noise."""
    values: dict[str, float] = {"phi_variation": 0.7, "phi_period": 30.0, **other}
    return UwsimSinusoidSpec(speed=speed, **values)


def at(current: Current, time: float) -> np.ndarray:
    return current.velocity(ORIGIN, time)[0]


def test_along_y_of_the_file_at_first_then_towards_minus_x() -> None:
    current = released(theta=math.pi / 2, theta_variation=0.0).bind(context())
    assert at(current, 0.0) == pytest.approx([0.0, 0.2, 0.0], abs=1e-15)
    quarter = at(current, 7.5)  # phi = 0.7
    assert quarter == pytest.approx([-0.2 * math.sin(0.7), 0.2 * math.cos(0.7), 0.0], abs=1e-15)


def test_theta_counts_from_z() -> None:
    assert at(UwsimSinusoidSpec(speed=0.3, theta=0.0).bind(context()), 1.0) == pytest.approx(
        [0.0, 0.0, 0.3]
    )


def test_it_turns_by_two_pi_and_not_by_twice_3_14() -> None:
    current = UwsimSinusoidSpec(speed=0.0, speed_variation=1.0, speed_period=4.0).bind(context())
    assert at(current, 2.0) == pytest.approx([0.0, 0.0, 0.0], abs=1e-15)
    assert at(current, 400_001.0)[1] == pytest.approx(1.0, abs=1e-9)


def test_its_harmonics_are_those_of_jacobi_and_anger() -> None:
    n = 3000
    current = released().bind(context())
    v = np.array([at(current, 30.0 * k / n) for k in range(n)])  # one period
    across, along = np.fft.rfft(v[:, 0]) / n, np.fft.rfft(v[:, 1]) / n
    assert along[0].real == pytest.approx(0.17624, abs=5e-6)
    assert 2 * abs(along[2]) == pytest.approx(0.02351, abs=5e-6)
    assert 2 * abs(across[1]) == pytest.approx(0.13160, abs=5e-6)
    assert 2 * abs(across[3]) == pytest.approx(0.00277, abs=5e-6)
    assert np.sqrt(np.mean(v[:, 0] ** 2)) == pytest.approx(0.09307, abs=5e-6)
    for k in range(6):
        expected = (1 if k == 0 else 2) * 0.2 * jv(k, 0.7)
        here, other = (along, across) if k % 2 == 0 else (across, along)
        assert (1 if k == 0 else 2) * abs(here[k]) == pytest.approx(expected, abs=1e-12)
        assert abs(other[k]) < 1e-12


def test_random_factors_are_held_for_a_sixtieth_of_a_second() -> None:
    current = UwsimSinusoidSpec(speed=1.0, random=0.1).bind(context())
    speeds = [np.linalg.norm(at(current, k * 0.002)) for k in range(501)]
    changes = [k for k in range(1, 501) if speeds[k] != speeds[k - 1]]
    assert changes == [math.ceil(j / 60.0 / 0.002 - 1e-9) for j in range(1, 61)]


def test_random_factors_stay_within_their_width_and_fill_it() -> None:
    current = UwsimSinusoidSpec(speed=1.0, random=0.1).bind(context())
    speeds = np.array([np.linalg.norm(at(current, k / 60.0)) for k in range(6000)])
    assert 0.9 <= speeds.min() < 0.901
    assert 1.099 < speeds.max() <= 1.1
    assert np.std(speeds) == pytest.approx(0.1 / math.sqrt(3.0), rel=0.02)


def test_it_answers_the_same_in_any_order() -> None:
    spec = released(random=0.05)
    times = [59.3, 0.0, 33.1, 33.1, 1.7]
    forward = {t: at(spec.bind(context()), t).tolist() for t in times}
    current = spec.bind(context())
    assert {t: at(current, t).tolist() for t in times} == forward


def test_another_seed_is_another_water() -> None:
    spec = released(random=0.05)
    assert at(spec.bind(context(1)), 3.0).tolist() != at(spec.bind(context(2)), 3.0).tolist()


def test_its_acceleration_is_the_derivative_of_its_velocity() -> None:
    spec = UwsimSinusoidSpec(
        speed=0.2, speed_variation=0.03, speed_period=4.0, theta=1.2, theta_variation=0.3,
        theta_period=5.0, phi=0.4, phi_variation=0.7, phi_period=30.0,
    )  # fmt: skip
    current = spec.bind(context())
    for time in (0.5, 2.0, 11.3):
        numeric = Current.acceleration(current, ORIGIN, time)
        assert current.acceleration(ORIGIN, time) == pytest.approx(numeric, abs=1e-7)


def test_every_point_has_the_same_water_and_may_be_written_to() -> None:
    current = released().bind(context())
    v = current.velocity(np.arange(60.0).reshape(20, 3), 4.0)
    assert v.shape == (20, 3)
    assert (v == v[0]).all()
    v[:] = 9.0
    assert current.velocity(ORIGIN, 4.0)[0, 0] != 9.0


def test_a_level_gives_the_same_numbers_alone_and_late_in_a_sweep() -> None:
    alone, late = (
        DelayedCurrent(released(random=0.01).bind(context()), start=began, delay=2.0)
        for began in (0.0, 1204.002)
    )
    for k in range(0, 60_000, 37):
        assert at(alone, k * 0.002).tolist() == at(late, (k + 602_001) * 0.002).tolist()


def test_a_late_current_is_still_until_it_begins() -> None:
    late = DelayedCurrent(released().bind(context()), start=10.0, delay=2.0)
    assert at(late, 11.998).tolist() == [0.0, 0.0, 0.0]
    assert late.acceleration(ORIGIN, 11.998).tolist() == [[0.0, 0.0, 0.0]]
    assert at(late, 12.0).tolist() == at(released().bind(context()), 2.0).tolist()


def test_a_current_without_speed_is_still_water_and_one_that_changes_is_not() -> None:
    none, some = (released(speed, theta=1.0).bind(context()) for speed in (0.0, 0.2))
    late = DelayedCurrent(none, start=1.0, delay=2.0)
    for still in (none, late, TotalCurrent([none, late])):
        assert still.is_still
    for moving in (some, TotalCurrent([none, some])):
        assert not moving.is_still
        assert not moving.is_steady
    assert not released(0.0, speed_variation=0.1).bind(context()).is_still
    assert ConstantSpec(velocity=(0.0, 0.0, 0.0)).bind(context()).is_still
    assert not ConstantSpec(velocity=(0.0, 0.0, -0.1)).bind(context()).is_still
