"""Daylight in deep water, against a Monte-Carlo tracer: Kd, reflectance, beam and nadir radiance.

The bounds are the errors that ``docs/water-optics.md`` states. The light is that of the sun alone.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

from tests.optics.ocean_tracer import OceanLight, trace_ocean
from tests.optics.path_tracer import tabulate
from uwsim.optics import FournierForand, Medium
from uwsim.rendering.physical.daylight_field import (
    LightField,
    compute_light_field,
    compute_open_water,
)
from uwsim.rendering.physical.physical_water import Daylight, PhysicalWater

CASES = [(90, 0.3), (90, 0.6), (90, 0.85), (50, 0.6), (50, 0.85), (50, 0.95), (20, 0.6), (20, 0.85)]
"""The elevation of the sun [deg] and the single-scattering albedo."""
N_PATHS = 60_000


@cache
def make_case(elevation: int, albedo: float) -> tuple[PhysicalWater, LightField, OceanLight]:
    """Return the water, its field and the traced light at 0, 0.5, 1 and 2 / Kd."""
    medium = Medium(absorption=(1.0 - albedo,) * 3, scattering=(albedo,) * 3)
    daylight = Daylight(elevation=math.radians(elevation), azimuth=0.0, sky_share=0.0)
    field = compute_light_field(medium, daylight)
    light = trace_ocean(
        tabulate(FournierForand()),
        attenuation=1.0,
        albedo=albedo,
        cosine=float(field.towards_sun[2]),
        depths=np.array([1e-3, 0.5, 1.0, 2.0]) / field.diffuse_attenuation[0],
        n_paths=N_PATHS,
        seed=7,
    )
    return PhysicalWater(medium=medium, daylight=daylight, has_surface=True), field, light


def test_water_that_scatters_nothing_has_the_law_of_beer() -> None:
    depths = np.array([0.1, 0.5, 1.0, 2.0])
    light = trace_ocean(
        tabulate(FournierForand()),
        attenuation=1.0,
        albedo=0.0,
        cosine=0.8,
        depths=depths,
        n_paths=200_000,
        seed=3,
    )
    assert light.downward == pytest.approx(np.exp(-depths / 0.8), abs=0.004)
    assert light.upward.max() == light.nadir.max() == 0.0


def test_water_that_absorbs_little_loses_little_light_inside() -> None:
    """The light that goes down less the light that comes up is nearly the same at all depths."""
    light = trace_ocean(
        tabulate(FournierForand()),
        attenuation=1.0,
        albedo=0.999,
        cosine=1.0,
        depths=np.array([0.5, 1.0, 2.0, 4.0]),
        n_paths=5_000,
        seed=5,
    )
    net_flux = light.downward - light.upward
    assert net_flux == pytest.approx(np.full(4, net_flux[0]), rel=0.12)


@pytest.mark.parametrize(("elevation", "albedo"), CASES)
def test_the_diffuse_attenuation_of_kirk_is_up_to_a_third_too_large(
    elevation: int, albedo: float
) -> None:
    """It is the mean down to 1 % of the light; near the surface light decreases more slowly."""
    _, field, light = make_case(elevation, albedo)
    depths = np.array([0.5, 1.0, 2.0]) / field.diffuse_attenuation[0]
    traced = np.log(light.downward[0] / light.downward[1:]) / depths
    ratio = field.diffuse_attenuation[0] / traced
    bound = {0.3: 0.04, 0.6: 0.12, 0.85: 0.31, 0.95: 0.32}[albedo]
    assert (ratio > 0.97).all()
    assert (ratio < 1.0 + bound).all()


@pytest.mark.parametrize(("elevation", "albedo"), CASES)
def test_the_reflectance_is_within_a_quarter(elevation: int, albedo: float) -> None:
    _, field, light = make_case(elevation, albedo)
    traced = float(light.upward[0] / light.downward[0])
    assert field.reflectance[0] == pytest.approx(traced, rel=0.25, abs=6e-4)


@pytest.mark.parametrize(("elevation", "albedo"), CASES)
def test_the_radiance_straight_below_is_within_half(elevation: int, albedo: float) -> None:
    water, field, light = make_case(elevation, albedo)
    depth = 0.5 / float(field.diffuse_attenuation[0])
    radiance = compute_open_water(water, depth, np.array([[0.0, 0.0, -1.0]]), 1.0)[0, 0]
    assert radiance / field.total[0] == pytest.approx(float(light.nadir[1]), rel=0.5)


@pytest.mark.parametrize(("elevation", "albedo"), CASES)
def test_the_beam_is_the_light_within_20_degrees(elevation: int, albedo: float) -> None:
    """The light that casts shadows: to a depth of 1 / Kd within a quarter."""
    _, field, light = make_case(elevation, albedo)
    for index, depth in enumerate(np.array([1e-3, 0.5, 1.0]) / field.diffuse_attenuation[0]):
        beam, _ = field.compute_irradiance(float(depth))
        assert beam[0] / field.total[0] == pytest.approx(float(light.beam[index]), rel=0.25)
