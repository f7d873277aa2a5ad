"""Absorption and speed of sound against published values."""

from __future__ import annotations

import pytest

from uwsim.acoustics import absorption, sound_speed


@pytest.mark.parametrize(
    ("kilohertz", "decibels_per_km"),
    [
        (10, 0.956),
        (25, 4.96),
        (50, 15.3),
        (100, 33.4),
        (200, 54),
        (450, 109),
        (900, 299),
        (1200, 494),
    ],
)
def test_absorption_in_the_sea_is_that_of_francois_and_garrison(
    kilohertz: float, decibels_per_km: float
) -> None:
    found = absorption(1e3 * kilohertz, temperature=10, salinity=35, depth=50)
    assert 1e3 * found == pytest.approx(decibels_per_km, rel=0.01)


@pytest.mark.parametrize(("kilohertz", "decibels_per_km"), [(25, 0.16), (900, 210)])
def test_fresh_water_takes_what_pure_water_takes(kilohertz: float, decibels_per_km: float) -> None:
    found = absorption(1e3 * kilohertz, temperature=15, salinity=0, depth=0)
    assert 1e3 * found == pytest.approx(decibels_per_km, rel=0.03)


def test_absorption_does_not_jump_where_its_coefficients_change() -> None:
    cold, warm = (
        absorption(1e6, temperature=20 + step, salinity=0, depth=0) for step in (-1e-9, 1e-9)
    )
    assert warm == pytest.approx(cold, rel=2e-3)


def test_the_speed_of_sound_is_the_published_check_value_of_mackenzie() -> None:
    assert sound_speed(temperature=25, salinity=35, depth=1000) == pytest.approx(1550.744, abs=5e-4)
    assert sound_speed(temperature=10, salinity=35, depth=0) == pytest.approx(1489.803, abs=5e-4)


def test_sound_in_a_tank_of_fresh_water_is_slower() -> None:
    assert sound_speed(temperature=15, salinity=0, depth=10) == pytest.approx(1465, abs=1)
