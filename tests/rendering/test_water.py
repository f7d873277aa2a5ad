"""The water law: limits of the reference, and the shader against the reference."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.rendering.models import placed, plate
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import (
    AMBIENT_SHARE,
    SPECULAR_BRIGHTNESS,
    SUN_COLOURS,
    Light,
    Water,
    apply_water,
    clip_distance,
    submerged_path_share,
    sun_direction,
)
from uwsim.scene.ocean_state import OceanStateSpec

CLEAR = Water(fog=0.0, attenuation=(0.0, 0.0, 0.0))
CAMERA = Intrinsics.from_fovy(64, 48, np.radians(50.0), near=0.05)
DOWN = Pose.from_rpy((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def test_without_attenuation_and_fog_the_image_is_dry() -> None:
    lit = np.random.default_rng(0).random((5, 7, 3))
    at_the_surface = np.zeros((5, 7))
    seen = apply_water(lit, np.full((5, 7), 9.0), at_the_surface, CLEAR)
    assert np.allclose(seen, lit)


def test_at_infinite_distance_only_the_fog_is_left() -> None:
    water = Water(fog=0.4, fog_colour=(0.1, 0.2, 0.3), colour=(0.4, 0.5, 0.6))
    seen = apply_water(np.ones((1, 3)), np.array([np.inf]), np.array([-1.0]), water)
    assert np.allclose(seen, (0.1, 0.2, 0.3))
    nearly = apply_water(np.ones((1, 3)), np.array([1e4]), np.array([-1.0]), water)
    assert np.allclose(seen, nearly)


def test_at_infinite_distance_without_fog_the_water_colour_is_left() -> None:
    water = Water(fog=0.0, fog_colour=(0.1, 0.2, 0.3), colour=(0.4, 0.5, 0.6))
    seen = apply_water(np.ones((1, 3)), np.array([np.inf]), np.array([-1.0]), water)
    assert np.allclose(seen, (0.4, 0.5, 0.6))
    nearly = apply_water(np.ones((1, 3)), np.array([1e4]), np.array([-1.0]), water)
    assert np.allclose(seen, nearly)


@pytest.mark.parametrize("fog", [0.3, 1.05, 1.1])
def test_visibility_falls_as_the_paper_says(fog: float) -> None:
    water = replace(CLEAR, fog=fog)
    distance, z = np.array([1.36]), np.zeros(1)
    white = apply_water(np.ones((1, 3)), distance, z, water)
    black = apply_water(np.zeros((1, 3)), distance, z, water)
    assert np.allclose(1.0 - (white - black), 1.0 - np.exp(-((fog * 1.36) ** 2)))


def test_the_originals_fog_distance_is_shorter_by_twice_the_near_plane() -> None:
    usual = Intrinsics.from_fovy(320, 240, np.radians(50.0))
    assert clip_distance(np.array([1.0]), usual) == pytest.approx(1.00018 - 0.360, abs=1e-4)


def sunlit(colour: np.ndarray, normal: np.ndarray, eye: np.ndarray, light: Light) -> np.ndarray:
    """The dry colour of compatibility 3.9, written down a second time."""
    sun = sun_direction(light.sun)
    facing = (normal * sun).sum(-1, keepdims=True)
    mirrored = 2.0 * facing * normal - sun
    glint = np.maximum((mirrored * eye).sum(-1, keepdims=True), 0.0) ** 2 * (facing > 0.0)
    diffuse = np.array(SUN_COLOURS[light.sun]) * np.maximum(facing, 0.0)
    return light.rate * (AMBIENT_SHARE * colour + diffuse * colour + SPECULAR_BRIGHTNESS * glint)


@pytest.mark.parametrize("fog_distance", ["ray", "clip"])
@pytest.mark.parametrize("fog", [0.0, 0.1, 0.5, 1.3])
@pytest.mark.parametrize("distance", [0.2, 0.7, 1.36, 3.0, 5.0])
def test_a_grey_plate_matches_the_formula_in_every_channel(
    renderer: Renderer, distance: float, fog: float, fog_distance: str
) -> None:
    water = Water(
        fog=fog,
        attenuation=(0.35, 0.11, 0.05) if fog < 0.5 else (0.015, 0.0075, 0.005),
        colour=(0.02, 0.2, 0.3),
        surface_height=3.0,
        fog_distance=fog_distance,
    )
    light = Light(sun="dusk", rate=0.9)
    grey = renderer.add(plate(50.0, 50.0, (0.5, 0.5, 0.5)), 1)
    renderer.place(grey, placed(z=-distance))
    image = renderer.draw(DOWN, CAMERA, water, light)
    rays = CAMERA.rays()
    points = rays * distance
    reach = np.linalg.norm(points, axis=2)
    assert image.range == pytest.approx(reach, rel=1e-4)
    normal = np.broadcast_to([0.0, 0.0, 1.0], points.shape)
    dry = sunlit(np.array(0.5), normal, -rays / np.linalg.norm(rays, axis=2, keepdims=True), light)
    planar = np.full(reach.shape, distance)
    fog_range = clip_distance(planar, CAMERA) if fog_distance == "clip" else None
    wet = apply_water(dry, reach, points[..., 2], water.scale_by_light(light), fog_range=fog_range)
    assert image.colour is not None
    assert np.abs(image.colour - 255.0 * wet).max() <= 1.0


@pytest.mark.parametrize("height", [5.0, 1.0, -2.0, -7.0])  # of the surface, the eye is at 0
def test_where_there_is_air_only_the_way_under_the_surface_counts(
    renderer: Renderer, height: float
) -> None:
    water = Water(
        fog=0.15, fog_colour=(0.1, 0.2, 0.4), attenuation=(0.05, 0.03, 0.01),
        colour=(0.02, 0.2, 0.3), surface_height=height, has_air=True,
    )  # fmt: skip
    light = Light()
    renderer.place(renderer.add(plate(50.0, 50.0, (0.5, 0.5, 0.5)), 1), placed(z=-4.0))
    image = renderer.draw(DOWN, CAMERA, water, light)
    rays = CAMERA.rays()
    points = rays * 4.0
    normal = np.broadcast_to([0.0, 0.0, 1.0], points.shape)
    dry = sunlit(np.array(0.5), normal, -rays / np.linalg.norm(rays, axis=2, keepdims=True), light)
    share = submerged_path_share(points[..., 2], 0.0, water)
    expected = {5.0: 1.0, 1.0: 1.0, -2.0: 0.5, -7.0: 0.0}[height]
    assert share == pytest.approx(np.full(share.shape, expected))
    way = np.linalg.norm(points, axis=2) * share
    wet = apply_water(dry, way, points[..., 2], water)
    assert image.colour is not None
    assert np.abs(image.colour - 255.0 * wet).max() <= 1.0


def test_attenuation_and_fog_at_nought_give_the_dry_image(renderer: Renderer) -> None:
    grey = renderer.add(plate(50.0, 50.0, (0.25, 0.5, 0.75)), 1)
    renderer.place(grey, placed(z=-4.0))
    image = renderer.draw(DOWN, CAMERA, CLEAR, Light(), targets={"colour"})
    rays = CAMERA.rays() / np.linalg.norm(CAMERA.rays(), axis=2, keepdims=True)
    normal = np.broadcast_to([0.0, 0.0, 1.0], rays.shape)
    dry = sunlit(np.array([0.25, 0.5, 0.75]), normal, -rays, Light())
    # UWSim's law scatters 0.001 of the water's colour into every metre of depth even then.
    assert image.colour is not None
    assert np.abs(image.colour - 255.0 * dry).max() <= 1.0


@pytest.mark.parametrize("fog", [0.0, 0.4])
def test_pixels_that_hit_nothing_take_the_colour_of_infinity(
    renderer: Renderer, fog: float
) -> None:
    water = Water(fog=fog, fog_colour=(0.2, 0.4, 0.6), colour=(0.8, 0.6, 0.4))
    image = renderer.draw(DOWN, CAMERA, water, Light())
    colour = (51, 102, 153) if fog else (204, 153, 102)
    assert image.colour is not None
    assert image.range is not None
    assert image.ids is not None
    assert (image.colour == colour).all()
    assert np.isposinf(image.range).all()
    assert np.isposinf(image.depth).all()
    assert (image.ids == 0).all()


def test_thick_fog_meets_the_background_without_a_seam(renderer: Renderer) -> None:
    far = renderer.add(plate(20.0, 400.0), 1)
    renderer.place(far, placed(x=10.0, z=-60.0))
    image = renderer.draw(DOWN, CAMERA, Water(fog=0.2), Light())
    assert image.ids is not None
    assert image.colour is not None
    assert set(np.unique(image.ids)) == {0, 1}
    assert len(np.unique(image.colour.reshape(-1, 3), axis=0)) == 1


@pytest.mark.parametrize("fog", [0.0, 0.3])
@pytest.mark.parametrize("rate", [0.0, 0.25, 2.0])
def test_water_and_fog_follow_the_light(renderer: Renderer, rate: float, fog: float) -> None:
    """Where there is a surface and where there is none: all is as bright as the light."""
    water = Water(fog=fog, fog_colour=(0.1, 0.3, 0.3), colour=(0.05, 0.2, 0.1), surface_height=9.0)
    renderer.place(renderer.add(plate(2.0, 2.0, (0.2, 0.3, 0.2)), 1), placed(z=-3.0))
    usual, found = (
        renderer.draw(DOWN, CAMERA, water, Light(rate=q), colour="linear16") for q in (1.0, rate)
    )
    assert usual.colour is not None
    assert found.colour is not None
    assert set(np.unique(np.isinf(usual.range))) == {False, True}  # type: ignore[arg-type]
    expected = rate * usual.colour[..., :3].astype(float)
    np.testing.assert_allclose(found.colour[..., :3], expected, atol=4.0)


def test_the_original_has_bright_fog_at_night() -> None:
    ocean, night = OceanStateSpec(), Light(rate=0.0)
    assert Water.from_ocean_state(ocean).scale_by_light(night).fog_colour == (0.0, 0.0, 0.0)
    assert Water.from_ocean_state(ocean).scale_by_light(Light()) == Water.from_ocean_state(ocean)
    original = Water.from_ocean_state(ocean, frozenset({"fog-light"}))
    assert original.scale_by_light(night) == original
