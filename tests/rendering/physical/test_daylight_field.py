"""Daylight under water: Fresnel, Snell, Kirk, and the light of open water by an integrator."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from uwsim.base.geometry import Array
from uwsim.errors import BadSetting, SeveralErrors
from uwsim.optics import HenyeyGreenstein, Medium, find_water
from uwsim.rendering.physical.daylight_field import (
    REFRACTIVE_INDEX,
    compute_light_field,
    compute_open_water,
    compute_scaled_attenuation,
    compute_sky_transmittance,
    compute_transmittance,
)
from uwsim.rendering.physical.physical_water import Daylight, PhysicalWater

MEDIUM = find_water("jerlov-1C")
ZENITH = Daylight(elevation=math.pi / 2, sky_share=0.0)


def open_water(water: PhysicalWater, depth: float, up: float, rate: float = 1.0) -> Array:
    """Return the light of open water in the x-z plane, (3,)."""
    direction = np.array([[math.sqrt(1.0 - up * up), 0.0, up]])
    return compute_open_water(water, depth, direction, rate)[0]


def test_the_surface_transmits_as_fresnel_has_it() -> None:
    n = REFRACTIVE_INDEX
    assert compute_transmittance(1.0) == pytest.approx(1.0 - ((n - 1.0) / (n + 1.0)) ** 2)
    brewster = math.atan(n)
    reflection = 0.5 * ((1.0 - n * n) / (1.0 + n * n)) ** 2  # only one polarisation
    assert compute_transmittance(math.cos(brewster)) == pytest.approx(1.0 - reflection)
    assert compute_sky_transmittance() == pytest.approx(0.934, abs=0.003)  # 6.6 % is reflected


@pytest.mark.parametrize("elevation", [0.2, 0.7, 1.4])
def test_the_sun_is_refracted_as_snell_has_it(elevation: float) -> None:
    field = compute_light_field(MEDIUM, Daylight(elevation=elevation, azimuth=0.5))
    sine = math.hypot(*field.towards_sun[:2])
    assert sine == pytest.approx(math.cos(elevation) / REFRACTIVE_INDEX)
    assert math.atan2(field.towards_sun[1], field.towards_sun[0]) == pytest.approx(0.5)


def test_the_diffuse_attenuation_is_that_of_kirk_for_a_sun_at_the_zenith() -> None:
    field = compute_light_field(MEDIUM, ZENITH)
    np.testing.assert_allclose(field.diffuse_attenuation, MEDIUM.diffuse_attenuation, rtol=0.002)


def test_daylight_decreases_with_depth_and_none_is_negative() -> None:
    field = compute_light_field(MEDIUM, Daylight())
    totals = []
    for depth in (0.0, 1.0, 5.0, 20.0, 100.0):
        beam, diffuse = field.compute_irradiance(depth)
        assert beam.min() >= 0.0
        assert diffuse.min() >= 0.0
        totals.append(beam + diffuse)
    assert (np.diff(np.array(totals), axis=0) < 0.0).all()
    assert totals[2][0] < 0.25 * totals[2][1]  # red is lost first


def test_molecules_make_clear_water_blue() -> None:
    """Half of the molecular scattering goes backwards, 2 % of that of particles."""
    water = find_water("jerlov-I")
    particles = replace(water, molecular_scattering=())
    molecules = water.molecular_scattering[2]
    assert water.backscattering[2] == pytest.approx(0.5 * molecules, rel=0.01)
    field = compute_light_field(water, ZENITH)
    assert 0.02 < field.reflectance[2] < 0.05  # clear ocean at 450 nm: some 4 %
    down, particles_down = (
        open_water(PhysicalWater(medium=medium, daylight=ZENITH), 5.0, -1.0)
        for medium in (water, particles)
    )
    beam, diffuse = field.compute_irradiance(5.0)
    assert down[2] == pytest.approx(field.reflectance[2] * (beam + diffuse)[2], rel=0.35)
    assert down[2] > 10.0 * particles_down[2]
    assert down[2] > 3.0 * down[1]


@pytest.mark.parametrize("up", [-1.0, -0.3, 0.0, 0.2, 0.6])
def test_the_light_of_open_water_is_the_integral_along_the_ray(up: float) -> None:
    """Below Snell's window, and without the light of the mirror above."""
    daylight, depth = Daylight(azimuth=0.0), 6.0
    medium = Medium(absorption=(0.3, 0.1, 0.05), scattering=(0.2, 0.3, 0.4))
    water = PhysicalWater(medium=medium, daylight=daylight)
    field = compute_light_field(medium, daylight)
    g, channel = medium.phase_function.mean_cosine, 1
    phase = HenyeyGreenstein(g / (1.0 + g))
    scattering = (1.0 - g * g) * medium.scattering[channel]
    attenuation = compute_scaled_attenuation(medium)[channel]
    direction = np.array([math.sqrt(1.0 - up * up), 0.0, up])
    cosine = float(direction @ field.towards_sun)
    beam, diffuse = (value[channel] for value in field.compute_irradiance(depth))
    sun = math.pi * beam / field.towards_sun[2]
    sun *= float(phase.compute_density(math.acos(cosine)))
    upper = 0.5 + (0.5 - phase.backscatter_ratio) * up / math.sqrt(up * up + 0.1)
    sky = upper * diffuse + (1.0 - upper) * field.reflectance[channel] * (beam + diffuse)

    def source(t: float) -> float:
        rise = up * t
        light = sun * math.exp(field.beam_attenuation[channel] * rise)
        light += sky * math.exp(field.diffuse_attenuation[channel] * rise)
        return scattering * light * math.exp(-attenuation * t)

    length = depth / up if up > 0.0 else 200.0
    expected = quad(source, 0.0, length, limit=200)[0]
    if up > 0.0:
        mirror = field.reflectance[channel] * field.total[channel]
        expected += mirror * math.exp(-attenuation * length)
    assert open_water(water, depth, up)[channel] == pytest.approx(expected, rel=1e-6)


def test_open_water_is_brighter_above_than_below_and_darker_with_depth() -> None:
    water = PhysicalWater(medium=MEDIUM)
    values = [open_water(water, 8.0, up)[1] for up in (1.0, 0.5, 0.0, -0.5, -1.0)]
    assert values == sorted(values, reverse=True)
    assert open_water(water, 20.0, 0.0)[1] < 0.5 * open_water(water, 8.0, 0.0)[1]


def test_snells_window_is_97_degrees_wide() -> None:
    clear = PhysicalWater(medium=find_water("clear"))
    angles = np.radians(np.arange(30.0, 60.0, 0.5))
    values = [open_water(clear, 2.0, math.cos(angle))[2] for angle in angles.tolist()]
    steepest = angles[int(np.argmin(np.diff(values)))]
    assert 2.0 * math.degrees(steepest) == pytest.approx(97.0, abs=3.0)


def test_the_light_rate_scales_open_water() -> None:
    water = PhysicalWater(medium=MEDIUM)
    np.testing.assert_allclose(
        open_water(water, 5.0, 0.1, 0.25), 0.25 * open_water(water, 5.0, 0.1)
    )
    isotropic = replace(water, isotropic_radiance=(0.1, 0.2, 0.3))
    np.testing.assert_allclose(open_water(isotropic, 5.0, -0.7), (0.1, 0.2, 0.3))


def test_all_errors_of_daylight_are_reported() -> None:
    with pytest.raises(
        SeveralErrors, match=r"elevation of the sun is 2 (?s:.)*share of the sky is 3"
    ):
        Daylight(elevation=2.0, sky_share=3.0)
    with pytest.raises(BadSetting, match="has 1 channels; expected 3"):
        PhysicalWater(medium=Medium(absorption=(0.1,), scattering=(0.1,)))
