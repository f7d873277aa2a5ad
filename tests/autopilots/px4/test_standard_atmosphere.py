"""Tests of the pressure that PX4's barometer measures."""

from __future__ import annotations

import pytest

from uwsim.autopilots.px4 import air_pressure, air_temperature


@pytest.mark.parametrize(
    ("altitude", "pressure", "temperature"),
    [
        (0.0, 101325.0, 15.0),
        (1000.0, 89874.6, 8.5),
        (-1000.0, 113929.0, 21.5),
        (11000.0, 22632.0, -56.5),
    ],
)
def test_the_pressure_is_that_of_the_tables_of_the_standard_atmosphere(
    altitude, pressure, temperature
):
    assert air_pressure(altitude) == pytest.approx(pressure, rel=2e-5)
    assert air_temperature(altitude) == pytest.approx(temperature)


def test_a_metre_of_depth_raises_the_pressure_by_twelve_pascals():
    assert air_pressure(-1.0) - air_pressure(0.0) == pytest.approx(12.013, abs=0.002)
