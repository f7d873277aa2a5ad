"""Images of the surface: Snell's window, Fresnel's formulas, the water line, the horizon."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.rendering.models import block, placed, plate
from tests.rendering.physical.photographs import camera_of
from tests.rendering.surface.seas import (
    BLACK_WATER,
    CLEAR_WATER,
    OVERCAST,
    look,
    make_waves,
    project,
    take,
    water_of,
)
from uwsim.rendering.caustics.ripples import Ripples
from uwsim.rendering.physical.daylight_field import REFRACTIVE_INDEX
from uwsim.rendering.physical.moving_surface import MovingSurface
from uwsim.rendering.physical.physical_water import Daylight
from uwsim.rendering.physical.view import ViewContents
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.surface import wave_grids
from uwsim.rendering.surface.sky import compute_sky
from uwsim.rendering.water import Light, Water


def fresnel(incidence: float) -> float:
    """Return the reflectance of water for unpolarised light from air [1]."""
    refracted = math.asin(math.sin(incidence) / REFRACTIVE_INDEX)
    s = math.sin(incidence - refracted) / math.sin(incidence + refracted)
    p = math.tan(incidence - refracted) / math.tan(incidence + refracted)
    return 0.5 * (s * s + p * p)


def test_snells_window_has_its_radius(renderer: Renderer) -> None:
    lens = camera_of(300.0, 801, 801)
    image = take(
        renderer,
        water_of(CLEAR_WATER, OVERCAST),
        look((0.0, 0.0, -5.0), (0.0, 0.0, 0.0)),
        lens,
    )
    for profile in (image[400, 400:, 1], image[400:, 400, 1], image[400, 400::-1, 1]):
        radius = float(np.flatnonzero(profile > 0.01 * profile[0]).max()) + 0.5
        angle = math.degrees(math.atan(radius / 300.0))
        assert abs(angle - math.degrees(math.asin(1.0 / REFRACTIVE_INDEX))) < 0.5


@pytest.mark.parametrize("degrees", [20.0, 45.0, 60.0, 75.0, 85.0])
def test_level_water_reflects_the_sky_by_fresnels_formulas(
    renderer: Renderer, degrees: float
) -> None:
    angle = math.radians(degrees)
    pose = look((0.0, 0.0, 2.0), (math.sin(angle), 0.0, 2.0 - math.cos(angle)))
    image = take(renderer, water_of(BLACK_WATER, OVERCAST), pose, camera_of(400.0, 41, 41))
    mirrored = np.array([[math.sin(angle), 0.0, math.cos(angle)]])
    sky = compute_sky(OVERCAST).compute_radiance(mirrored)[0]
    np.testing.assert_allclose(image[20, 20], fresnel(angle) * sky, rtol=0.02)


@pytest.mark.parametrize("degrees", [5.0, 20.0, 35.0, 45.0])
def test_the_sky_in_snells_window_is_transmitted_by_fresnels_formulas(
    renderer: Renderer, degrees: float
) -> None:
    angle = math.radians(degrees)
    pose = look((0.0, 0.0, -2.0), (math.sin(angle), 0.0, -2.0 + math.cos(angle)))
    image = take(renderer, water_of(CLEAR_WATER, OVERCAST), pose, camera_of(400.0, 41, 41))
    air_angle = math.asin(REFRACTIVE_INDEX * math.sin(angle))
    direction = np.array([[math.sin(air_angle), 0.0, math.cos(air_angle)]])
    sky = compute_sky(OVERCAST).compute_radiance(direction)[0]
    expected = REFRACTIVE_INDEX**2 * (1.0 - fresnel(air_angle)) * sky
    np.testing.assert_allclose(image[20, 20], expected, rtol=0.02)


@pytest.mark.parametrize("time", [1.5, 4.0, 6.5, 9.0])
def test_the_water_line_on_a_wall_is_at_the_elevation_of_the_waves(
    renderer: Renderer, time: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(wave_grids, "FOAM_THRESHOLD", 1e9)  # foam is as bright as the wall
    waves = make_waves(0.6, period=3.0)
    renderer.clear()
    renderer.place(renderer.add(block((0.02, 40.0, 20.0)), 1), placed(x=6.0))
    pose, lens = look((0.0, 0.0, 3.0), (6.0, 0.0, 0.0)), camera_of(500.0, 601, 401)
    surface = MovingSurface(time=time, waves=waves)
    image = take(renderer, water_of(BLACK_WATER, OVERCAST), pose, lens, surface)[..., 1]
    y = np.linspace(-2.5, 2.5, 41)
    wall = np.stack([np.full_like(y, 5.99), y], axis=1)
    places = np.column_stack([wall, waves.elevation(wall, time)])
    # Below the still surface the wall has the light under water.
    crests = places[places[:, 2] > 0.02]
    assert len(crests) > 8
    for u, v in project(pose, lens, crests):
        column = image[:, round(u)]
        line = float(np.flatnonzero(column < 0.75 * column[:20].mean()).min()) - 0.5
        assert abs(line - v) < 2.0  # 2.7 cm; the grid leaves out waves below 0.8 m


def test_a_camera_at_the_water_line_sees_air_above_and_water_below(renderer: Renderer) -> None:
    renderer.clear()
    pose, lens = look((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)), camera_of(200.0, 101, 101)
    image = take(renderer, water_of(BLACK_WATER, OVERCAST), pose, lens)
    assert image[10:48, :, 1].min() > 0.3
    assert image[53:, :, 1].max() < 0.05


def test_the_contrast_at_the_visibility_is_two_percent(renderer: Renderer) -> None:
    renderer.clear()
    wall = renderer.add(block((1.0, 400.0, 60.0), (0.0, 0.0, 0.0)), 1)
    renderer.place(wall, placed(x=500.5))
    lens = replace(camera_of(500.0, 601, 101), far=2000.0)
    water = water_of(BLACK_WATER, OVERCAST, visibility=500.0)
    image = take(renderer, water, look((0.0, 0.0, 5.0), (1.0, 0.0, 5.0)), lens)
    horizon, target = image[48, 20, 1], image[48, 300, 1]
    assert 1.0 - target / horizon == pytest.approx(0.02, abs=0.004)


@pytest.mark.parametrize("depth", [-2.0, 0.05, 3.0])
def test_the_same_surface_gives_the_same_bytes(renderer: Renderer, depth: float) -> None:
    surface = MovingSurface(time=3.0, waves=make_waves(0.5), seed=4)
    water = replace(water_of(BLACK_WATER, Daylight()), ripples=Ripples())
    pose, lens = look((0.0, 0.0, -depth), (5.0, 1.0, 0.2)), camera_of(150.0, 160, 120)
    first = take(renderer, water, pose, lens, surface)
    take(renderer, water, look((50.0, 0.0, 2.0), (55.0, 1.0, 0.2)), lens, surface)
    other = Renderer()
    assert np.array_equal(take(renderer, water, pose, lens, surface), first)
    assert np.array_equal(take(other, water, pose, lens, surface), first)
    other.close()


def test_range_and_ids_ignore_the_surface(renderer: Renderer) -> None:
    renderer.clear()
    renderer.place(renderer.add(plate(40.0, 40.0), 7), placed(z=-3.0))
    lens = camera_of(150.0, 160, 120)
    pose = look((0.0, 0.0, 4.0), (3.0, 0.0, -3.0))
    images = [
        renderer.draw(
            pose,
            lens,
            Water(physical_water=water),
            Light(),
            contents=ViewContents(surface=MovingSurface(time=1.0, waves=make_waves(0.5))),
        )
        for water in (
            water_of(BLACK_WATER, OVERCAST),
            replace(water_of(BLACK_WATER, OVERCAST), has_surface=False),
        )
    ]
    assert np.array_equal(images[0].range, images[1].range)
    assert np.array_equal(images[0].ids, images[1].ids)
    assert not np.array_equal(images[0].colour, images[1].colour)
