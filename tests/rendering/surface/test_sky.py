from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.rendering.physical.physical_water import Daylight
from uwsim.rendering.surface.sky import LUMINANCE, compute_sky


def directions_of_grid(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Return directions of the upper hemisphere by equal angles, and their solid angles."""
    polar = (np.arange(n) + 0.5) * (0.5 * math.pi / n)
    azimuth = (np.arange(2 * n) + 0.5) * (math.pi / n)
    theta, phi = np.meshgrid(polar, azimuth, indexing="ij")
    directions = np.stack(
        [np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], axis=-1
    )
    solid_angles = np.sin(theta) * (0.5 * math.pi / n) * (math.pi / n)
    return directions.reshape(-1, 3), solid_angles.ravel()


@pytest.mark.parametrize("elevation", [0.1, 0.5, 0.9, 1.5])
@pytest.mark.parametrize("share", [0.1, 0.3, 0.65, 1.0])
def test_the_luminance_of_the_sky_on_a_level_surface_is_its_share(
    elevation: float, share: float
) -> None:
    sky = compute_sky(Daylight(elevation=elevation, azimuth=0.7, irradiance=2.0, sky_share=share))
    directions, solid_angles = directions_of_grid(200)
    radiance = sky.compute_radiance(directions) @ LUMINANCE
    irradiance = float((radiance * directions[:, 2] * solid_angles).sum()) / math.pi
    assert irradiance == pytest.approx(2.0 * share, rel=0.003)


@pytest.mark.parametrize("elevation", [0.3, 0.9])
def test_sun_and_sky_together_are_white(elevation: float) -> None:
    sky = compute_sky(Daylight(elevation=elevation, irradiance=1.5, sky_share=0.3))
    total = sky.irradiance + math.sin(elevation) * sky.sun_irradiance
    np.testing.assert_allclose(total, 1.5, rtol=1e-9)
    assert sky.irradiance[2] > sky.irradiance[0]


def test_an_overcast_sky_is_three_times_as_bright_at_the_zenith_as_at_the_horizon() -> None:
    sky = compute_sky(Daylight(sky_share=1.0))
    zenith, horizon = sky.compute_radiance(np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]))
    np.testing.assert_allclose(zenith / horizon, 3.0, rtol=0.01)


def test_a_clear_sky_is_brightest_around_the_sun() -> None:
    sky = compute_sky(Daylight(elevation=0.6, azimuth=1.0, sky_share=0.2))
    directions, _ = directions_of_grid(60)
    luminance = sky.compute_radiance(directions) @ LUMINANCE
    assert float(directions[np.argmax(luminance)] @ sky.towards_sun) > math.cos(0.1)
