"""Tides: periods, ellipses, spring and neap."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.base.rng import stream
from uwsim.currents import ConstituentSpec, Current, SceneContext, Tidal, TidalSpec

HOUR = 3600.0
DAY = 24.0 * HOUR
ORIGIN = np.zeros((1, 3))


def tide(*constituents: ConstituentSpec, start: float = 0.0) -> Tidal:
    context = SceneContext(stream=lambda name: stream(0, name))
    return TidalSpec(constituents=constituents, start=start).bind(context)


def at(current: Tidal, time: float) -> np.ndarray:
    return current.velocity(ORIGIN, time)[0]


@pytest.mark.parametrize(
    ("name", "hours"), [("M2", 12.4206), ("S2", 12.0), ("K1", 23.934), ("O1", 25.819)]
)
def test_the_constituents_have_their_periods(name: str, hours: float) -> None:
    each = ConstituentSpec(name=name, semi_major=0.4, semi_minor=0.1)  # type: ignore[arg-type]
    assert each.period / HOUR == pytest.approx(hours, abs=6e-4)
    current = tide(each)
    assert at(current, 1234.0 + each.period) == pytest.approx(at(current, 1234.0), abs=1e-12)
    assert at(current, each.period / 2) == pytest.approx([-0.4, 0.0, 0.0], abs=1e-12)


def test_the_velocity_draws_the_ellipse() -> None:
    each = ConstituentSpec(name="S2", semi_major=0.4, semi_minor=0.1, inclination=0.6, phase=0.9)
    current = tide(each)
    v = np.array([at(current, t) for t in np.linspace(0.0, 12 * HOUR, 721)])
    along = v[:, 0] * math.cos(0.6) + v[:, 1] * math.sin(0.6)
    across = -v[:, 0] * math.sin(0.6) + v[:, 1] * math.cos(0.6)
    assert (along / 0.4) ** 2 + (across / 0.1) ** 2 == pytest.approx(np.ones(721))
    assert (v[:, 2] == 0.0).all()
    lag = 0.9 / each.angular_rate
    assert at(current, lag) == pytest.approx([0.4 * math.cos(0.6), 0.4 * math.sin(0.6), 0.0])


@pytest.mark.parametrize(("semi_minor", "sense"), [(0.1, 1.0), (-0.1, -1.0)])
def test_the_sign_of_the_minor_axis_is_the_sense_of_turning(
    semi_minor: float, sense: float
) -> None:
    current = tide(ConstituentSpec(name="M2", semi_major=0.4, semi_minor=semi_minor))
    (x0, y0, _), (x1, y1, _) = at(current, 0.0), at(current, HOUR)
    assert math.copysign(1.0, x0 * y1 - y0 * x1) == sense


def test_spring_comes_back_after_14_77_days() -> None:
    moon = ConstituentSpec(name="M2", semi_major=0.4)
    sun = ConstituentSpec(name="S2", semi_major=0.15)
    current = tide(moon, sun)
    times = np.arange(0.0, 30.0 * DAY, 600.0)
    speeds = np.abs([at(current, t)[0] for t in times])

    def highest(day: float) -> float:
        near = np.abs(times - day * DAY) < 0.6 * DAY
        return float(speeds[near].max())

    spring = math.tau / (sun.angular_rate - moon.angular_rate) / DAY
    assert spring == pytest.approx(14.77, abs=0.005)
    assert highest(spring) == pytest.approx(0.55, abs=0.005)
    assert highest(spring / 2.0) == pytest.approx(0.25, abs=0.01)


def test_a_simulation_may_begin_at_any_time_of_the_tide() -> None:
    each = ConstituentSpec(name="K1", semi_major=0.4, semi_minor=0.2)
    assert at(tide(each, start=5000.0), 77.0).tolist() == at(tide(each), 5077.0).tolist()


def test_its_acceleration_is_the_derivative_of_its_velocity() -> None:
    each = ConstituentSpec(name="M2", semi_major=0.4, semi_minor=-0.1, inclination=0.6, phase=0.9)
    current = tide(each)
    h = 60.0
    slope = (at(current, 7000.0 + h) - at(current, 7000.0 - h)) / (2.0 * h)
    assert current.acceleration(ORIGIN, 7000.0)[0] == pytest.approx(slope, rel=1e-4)
    assert isinstance(current, Current)
