"""EOS-80 against the check values of UNESCO's technical paper 44."""

from __future__ import annotations

import pytest

from uwsim.scene.seawater import sea_water_density


@pytest.mark.parametrize(
    ("salinity", "temperature", "density"),
    [(0.0, 5.0, 999.96675), (35.0, 5.0, 1027.67547), (35.0, 25.0, 1023.34306)],
)
def test_the_density_is_that_of_unescos_check_values(
    salinity: float, temperature: float, density: float
) -> None:
    assert sea_water_density(temperature, salinity) == pytest.approx(density, abs=1e-5)
