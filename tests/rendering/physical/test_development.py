"""Whole images through physical water: against numpy, and what the water does not change."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.rendering.models import ball, block, placed, plate
from tests.rendering.physical.photographs import AT_ORIGIN, SHADOWLESS, FloatArray
from tests.rendering.physical.reference import compose
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.optics import Lamp as OpticalLamp
from uwsim.optics import compute_lamp_veil, find_water
from uwsim.rendering.lights.lamp import Lamp
from uwsim.rendering.physical.daylight_field import compute_open_water
from uwsim.rendering.physical.physical_water import Daylight, PhysicalWater
from uwsim.rendering.physical.view import ViewContents
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Light, Water

CAMERA = Intrinsics.from_fovy(320, 240, math.radians(50.0), near=0.05, far=200.0)
LAMP = Lamp(
    world_from_lamp=Pose.from_rpy((0.4, 0.1, 0.0), (0.0, 0.1, 0.0)),
    half_angle=math.radians(35.0),
    softness=0.6,
    intensity=3.0,
    colour=(1.0, 0.9, 0.8),
    casts_shadow=False,
)
WATER = PhysicalWater(medium=find_water("jerlov-III"), exposure=1.5)


def show_scene(renderer: Renderer) -> None:
    """Show a ball and a block before a slanted floor, and open water above it."""
    slant = Pose.from_rpy((0.0, -0.8, -4.0), (-1.2, 0.0, 0.0)).matrix
    renderer.place(renderer.add(plate(60.0, 60.0, (0.7, 0.7, 0.6)), 1), slant)
    renderer.place(renderer.add(ball(0.4, (0.9, 0.3, 0.2)), 2), placed(x=-0.5, z=-2.5))
    renderer.place(renderer.add(block((0.5, 0.5, 0.5), (0.9, 0.9, 0.9)), 3), placed(x=0.7, z=-3.5))


@pytest.mark.parametrize("lamps", [(), (LAMP,)], ids=["sun", "sun and lamp"])
def test_the_shaders_agree_with_numpy_to_a_grey_level(
    renderer: Renderer, lamps: tuple[Lamp, ...]
) -> None:
    show_scene(renderer)
    image = renderer.draw(
        AT_ORIGIN,
        CAMERA,
        Water(physical_water=WATER),
        SHADOWLESS,
        contents=ViewContents(lamps=lamps),
    )
    radiance = read_radiance(renderer)
    assert image.colour is not None
    assert image.range is not None
    rays = CAMERA.rays() / CAMERA.ray_lengths[..., None]
    open_water = compute_open_water(WATER, 0.0, rays.reshape(-1, 3), 1.0).reshape(rays.shape)
    veil = np.zeros_like(rays)
    for lamp in lamps:
        optical = OpticalLamp(
            position=tuple(lamp.world_from_lamp.position.tolist()),
            direction=tuple((-lamp.world_from_lamp.rotation[:, 2]).tolist()),
            intensity=tuple(math.pi * lamp.intensity * channel for channel in lamp.colour),
            half_angle=lamp.half_angle,
            softness=lamp.softness,
        )
        veil += compute_lamp_veil(WATER.medium, optical, (0.0, 0.0, 0.0), rays, image.range)
    expected = compose(WATER, CAMERA, radiance, image.range.astype(float), open_water, veil)
    difference = np.abs(image.colour - 255.0 * expected)
    assert difference.mean() < 1.0  # pyramids are not exact Gaussians
    assert np.percentile(difference, 99) < 3.0


def read_radiance(renderer: Renderer) -> FloatArray:
    """Return the radiance of the surfaces that the renderer has drawn last, (h, w, 3)."""
    key = (CAMERA.width, CAMERA.height), frozenset({"colour", "range", "ids"}), "radiance"
    with renderer._context:
        data = renderer._targets[key].radiance.read()
    pixels = np.frombuffer(data, np.float32)
    return pixels.reshape(CAMERA.height, CAMERA.width, 4)[..., :3].astype(float)


def test_the_water_changes_neither_range_nor_ids(renderer: Renderer) -> None:
    show_scene(renderer)
    fog = renderer.draw(AT_ORIGIN, CAMERA, Water(), SHADOWLESS)
    physical = renderer.draw(
        AT_ORIGIN,
        CAMERA,
        Water(physical_water=WATER),
        SHADOWLESS,
        contents=ViewContents(lamps=(LAMP,)),
    )
    assert np.array_equal(fog.range, physical.range)
    assert np.array_equal(fog.ids, physical.ids)
    assert (fog.image_model, physical.image_model) == ("uwsim", "physical")


def test_equal_views_have_equal_bytes(renderer: Renderer) -> None:
    show_scene(renderer)
    water = Water(physical_water=WATER)
    first, second = (
        renderer.draw(
            AT_ORIGIN,
            CAMERA,
            water,
            Light(),
            targets={"colour"},
            contents=ViewContents(lamps=(LAMP,)),
        ).colour
        for _ in range(2)
    )
    renderer.draw(AT_ORIGIN, CAMERA, Water(), Light(), targets={"colour"})
    other = Renderer()
    show_scene(other)
    third = other.draw(
        AT_ORIGIN, CAMERA, water, Light(), targets={"colour"}, contents=ViewContents(lamps=(LAMP,))
    ).colour
    other.close()
    assert np.array_equal(first, second)
    assert np.array_equal(first, third)


def test_fog_images_are_the_same_after_physical_ones(renderer: Renderer) -> None:
    show_scene(renderer)
    before = renderer.draw(AT_ORIGIN, CAMERA, Water(), Light(), targets={"colour"}).colour
    renderer.draw(
        AT_ORIGIN,
        CAMERA,
        Water(physical_water=WATER),
        Light(),
        contents=ViewContents(lamps=(LAMP,)),
    )
    after = renderer.draw(AT_ORIGIN, CAMERA, Water(), Light(), targets={"colour"}).colour
    assert np.array_equal(before, after)


def test_the_light_rate_scales_daylight_and_not_lamps(renderer: Renderer) -> None:
    show_scene(renderer)
    night = Light(rate=0.0, shadows=False)
    water = Water(physical_water=WATER)
    dark = renderer.draw(AT_ORIGIN, CAMERA, water, night, targets={"colour"}).colour
    lit = renderer.draw(
        AT_ORIGIN, CAMERA, water, night, targets={"colour"}, contents=ViewContents(lamps=(LAMP,))
    ).colour
    assert dark is not None
    assert lit is not None
    assert dark.max() == 0
    assert lit.max() > 50


def test_the_veil_is_brighter_on_the_side_of_the_lamp(renderer: Renderer) -> None:
    water = Water(physical_water=replace(WATER, daylight=Daylight(irradiance=0.0)))
    image = renderer.draw(
        AT_ORIGIN, CAMERA, water, Light(), targets={"colour"}, contents=ViewContents(lamps=(LAMP,))
    )
    assert image.colour is not None
    row = image.colour[120].sum(axis=1).astype(int)
    assert row[300] > 2 * row[100]


@pytest.mark.parametrize("option", ["has_blur", "has_lamp_veil"])
def test_blur_and_veil_can_be_switched_off(renderer: Renderer, option: str) -> None:
    show_scene(renderer)
    images = [
        renderer.draw(
            AT_ORIGIN,
            CAMERA,
            Water(physical_water=water),
            SHADOWLESS,
            targets={"colour"},
            contents=ViewContents(lamps=(LAMP,)),
        ).colour
        for water in (WATER, replace(WATER, **{option: False}))
    ]
    assert not np.array_equal(images[0], images[1])


def test_linear_values_are_the_decoded_stored_ones(renderer: Renderer) -> None:
    show_scene(renderer)
    stored, linear = (
        renderer.draw(
            AT_ORIGIN, CAMERA, Water(physical_water=replace(WATER, transfer=transfer)), SHADOWLESS,
            targets={"colour"}, colour="linear16",
        ).colour[..., :3] / 65535.0
        for transfer in ("srgb", "linear")
    )  # fmt: skip
    decoded = np.where(stored > 0.04045, ((stored + 0.055) / 1.055) ** 2.4, stored / 12.92)
    assert decoded == pytest.approx(linear, abs=2e-4)
