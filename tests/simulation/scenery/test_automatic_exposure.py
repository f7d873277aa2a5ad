"""The automatic exposure: boards and veils keep below full scale, and dark scenes are dark."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.devices.lamp import LampSpec
from uwsim.optics import WATERS, Lamp, compute_full_field, compute_lamp_veil, find_water
from uwsim.rendering.physical.daylight_field import compute_light_field, compute_open_water
from uwsim.rendering.physical.physical_water import Daylight, PhysicalWater
from uwsim.simulation.scenery.automatic_exposure import LightSources, compute_exposure

NIGHT = Daylight(irradiance=0.0)
HEADLIGHT = LampSpec(name="lamp", relative_to="base_link", intensity=40.0)


def make_water(name: str, daylight: Daylight) -> PhysicalWater:
    """Return a named water in a light."""
    return PhysicalWater(medium=find_water(name), daylight=daylight)


@pytest.mark.parametrize("name", WATERS)
def test_the_veil_of_a_headlight_at_night_is_below_full_scale(name: str) -> None:
    water = make_water(name, NIGHT)
    exposure = compute_exposure(water, 5.0, 1.0, LightSources(lamps=(HEADLIGHT,)))
    lamp = Lamp(
        position=(0.3, 0.0, 0.0),
        direction=(0.0, 0.0, 1.0),
        intensity=(40.0, 40.0, 40.0),
        half_angle=math.radians(30.0),
        softness=0.2,
    )
    rays = np.array([[x, 0.0, 1.0] for x in np.linspace(-0.5, 0.5, 21)])
    rays /= np.linalg.norm(rays, axis=1)[:, None]
    veil = compute_lamp_veil(water.medium, lamp, (0.0, 0.0, 0.0), rays, np.full(21, 20.0))
    assert exposure * math.pi * veil.max() < 0.75


def test_clear_water_at_night_is_exposed_for_a_board_at_4_m() -> None:
    water = make_water("clear", NIGHT)
    exposure = compute_exposure(water, 5.0, 1.0, LightSources(lamps=(HEADLIGHT,)))
    board = 40.0 / 16.0 * compute_full_field(water.medium, 8.0).max()
    assert exposure * board == pytest.approx(0.7, rel=0.01)


@pytest.mark.parametrize("name", WATERS)
def test_open_water_by_day_is_below_full_scale(name: str) -> None:
    water = make_water(name, Daylight(elevation=0.3))
    exposure = compute_exposure(water, 4.0, 1.0, LightSources())
    beam, diffuse = compute_light_field(water.medium, water.daylight).compute_irradiance(4.0)
    level = compute_open_water(water, 4.0, np.array([[1.0, 0.0, 0.0]]), 1.0)
    assert exposure * max((beam + diffuse).max(), level.max()) <= 0.7 + 1e-9


def test_a_night_without_light_is_dark() -> None:
    assert compute_exposure(make_water("tank", NIGHT), 5.0, 1.0, LightSources()) == 1.0


@pytest.mark.parametrize(
    ("sources", "light"),
    [
        (LightSources(has_laser=True), 1.0),
        (LightSources(has_projector_lamp=True), 1.0 / 16.0),
    ],
)
def test_a_projector_at_night_is_exposed_for_its_light(sources: LightSources, light: float) -> None:
    water = make_water("tank", NIGHT)
    loss = compute_full_field(water.medium, 8.0).max()
    assert compute_exposure(water, 5.0, 1.0, sources) == pytest.approx(0.7 / (light * loss))


def test_a_dim_lamp_does_not_change_the_exposure_by_day() -> None:
    water = make_water("pool", Daylight())
    lamps = LightSources(lamps=(LampSpec(name="lamp", relative_to="base_link", intensity=0.1),))
    exposures = [compute_exposure(water, 2.0, 1.0, sources) for sources in (LightSources(), lamps)]
    assert exposures[0] == exposures[1]
