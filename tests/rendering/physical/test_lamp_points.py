"""Lamps that the camera sees: a point of light with its halo, against the Monte-Carlo tables."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.optics.reference_tables import PHASES, read_rows, values_of
from tests.rendering.models import block, placed
from tests.rendering.physical.photographs import AT_ORIGIN, FloatArray, camera_of, photograph
from uwsim.base.geometry import Pose
from uwsim.optics import Medium, find_water
from uwsim.rendering.lights.lamp import Lamp
from uwsim.rendering.physical.physical_water import Daylight, PhysicalWater
from uwsim.rendering.physical.view import ViewContents
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Light, Water

ANGLES = (0.25, 0.5, 1.0, 2.0, 5.0, 10.0)
"""The half-angles of the apertures [degrees]."""
TOLERANCES = {0.5: 0.02, 1.0: 0.02, 2.0: 0.03, 4.0: 0.06}
"""The largest relative error at each optical depth; the formula of small sources has up to 13 %."""
LAMP = Lamp(
    world_from_lamp=Pose(np.array([0.0, 0.0, -1.0]), np.eye(3)),
    half_angle=math.pi,
    softness=0.0,
    intensity=1.0 / math.pi,
    casts_shadow=False,
)
CAMERA = camera_of(600.0, 801, 601)
NIGHT = Daylight(irradiance=0.0)


def light_of(renderer: Renderer, water: PhysicalWater) -> FloatArray:
    """Return the radiance of each pixel from three exposures, each where it is not saturated."""
    light = np.zeros((CAMERA.height, CAMERA.width, 3))
    for exposure in (1e-6, 1e-3, 0.3):
        image = photograph(renderer, replace(water, exposure=exposure), CAMERA, (LAMP,))
        light = np.where(image * exposure < 0.95, image, light)
    return light


@pytest.mark.parametrize("depths", [(0.5, 1.0, 2.0), (4.0, 4.0, 4.0)], ids=["to 2", "4"])
@pytest.mark.parametrize(("name", "albedo"), [("FF", 0.6), ("FF", 0.85), ("HG", 0.85)])
def test_a_small_lamp_has_the_tabled_light_in_each_aperture(
    renderer: Renderer, name: str, albedo: float, depths: tuple[float, float, float]
) -> None:
    scattering = tuple(albedo * depth for depth in depths)
    medium = Medium.from_beam_attenuation(depths, scattering, PHASES[name])
    light = light_of(renderer, PhysicalWater(medium=medium, transfer="linear", daylight=NIGHT))
    lengths = CAMERA.ray_lengths
    angles = np.degrees(np.arccos(1.0 / lengths))
    fluxes = light * (1.0 / (lengths**3 * CAMERA.fx * CAMERA.fy))[..., None]
    for channel, depth in enumerate(depths):
        row = next(
            row
            for row in read_rows("led")
            if (row["phase"], float(row["albedo"]), float(row["optical_depth"]))
            == (name, albedo, depth)
        )
        shares = [fluxes[angles <= angle, channel].sum() for angle in ANGLES]
        tabled_shares = values_of(row, ANGLES, "P ")
        np.testing.assert_allclose(shares, tabled_shares, rtol=TOLERANCES[depth])


@pytest.mark.parametrize("is_hidden", [False, True])
def test_a_lamp_behind_a_body_is_not_visible(renderer: Renderer, is_hidden: bool) -> None:
    distance = -0.5 if is_hidden else -1.5
    renderer.place(renderer.add(block((0.2, 0.2, 0.2), (0.0, 0.0, 0.0)), 1), placed(z=distance))
    water = PhysicalWater(medium=find_water("clear"), daylight=NIGHT, exposure=1e-3)
    image = photograph(renderer, replace(water, transfer="linear"), CAMERA, (LAMP,))
    assert (image[300, 400].max() > 100.0) == (not is_hidden)


def test_a_lamp_that_shines_away_is_not_visible(renderer: Renderer) -> None:
    lamp = replace(LAMP, half_angle=0.5)  # along -z, as the camera looks
    water = PhysicalWater(
        medium=find_water("clear"), daylight=NIGHT, exposure=1e-3, transfer="linear"
    )
    assert photograph(renderer, water, CAMERA, (lamp,))[300, 400].max() < 1.0


def test_a_visible_lamp_changes_neither_range_nor_ids(renderer: Renderer) -> None:
    renderer.place(renderer.add(block((0.5, 0.5, 0.5)), 7), placed(z=-2.0))
    water = Water(physical_water=PhysicalWater(medium=find_water("pool"), daylight=NIGHT))
    images = [
        renderer.draw(AT_ORIGIN, CAMERA, water, Light(), contents=ViewContents(lamps=lamps))
        for lamps in ((), (LAMP,))
    ]
    assert np.array_equal(images[0].range, images[1].range)
    assert np.array_equal(images[0].ids, images[1].ids)
    assert not np.array_equal(images[0].colour, images[1].colour)
