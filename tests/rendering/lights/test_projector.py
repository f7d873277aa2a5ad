"""A projected pattern is where geometry puts it, but in shadow, and dimmed by the water."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.rendering.models import block, placed, plate
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.rendering.lights.projector import Projector
from uwsim.rendering.physical.view import ViewContents
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Light, Water

DARK = Light(rate=0.0)
DRY = Water(fog=0.0, attenuation=(0.0, 0.0, 0.0), colour=(0.0, 0.0, 0.0))
CAMERA = Intrinsics.from_fovy(160, 120, np.radians(60.0), near=0.1, far=100.0)
EYE = Pose.from_rpy((0.0, -3.0, 3.0), (math.radians(45.0), 0.0, 0.0))
ABOVE = Pose.from_rpy((0.0, 0.0, 2.0), (0.0, 0.0, 0.0))
FOVY = math.radians(60.0)
REACH = 2.0 * math.tan(FOVY / 2.0)  # of the pattern on the floor, half its height [m]


def pattern(colour: tuple[int, int, int, int]) -> np.ndarray:
    """The upper left quarter in a colour, the rest transparent; twice as wide as high."""
    pixels = np.zeros((64, 128, 4), np.uint8)
    pixels[:32, :64] = colour
    return pixels


def projector(colour: tuple[int, int, int, int] = (255, 0, 0, 255), **how: object) -> Projector:
    given = {"world_from_projector": ABOVE, "is_laser": True, "pattern": pattern(colour)} | how
    return Projector(fovy=FOVY, **given)  # type: ignore[arg-type]


def rendered(renderer: Renderer, one: Projector | None, water: Water = DRY) -> np.ndarray:
    image = renderer.draw(
        EYE, CAMERA, water, DARK, targets={"colour"}, contents=ViewContents(projector=one)
    )
    assert image.colour is not None
    return image.colour.astype(float)


def at(image: np.ndarray, x: float, y: float) -> list[float]:
    """The image's value at a point of the floor [m]."""
    u, v = CAMERA.project(EYE.inverse().transform(np.array([[x, y, 0.0]])))[0]
    colour: list[float] = image[round(v), round(u)].tolist()
    return colour


@pytest.fixture
def floor(renderer: Renderer) -> Renderer:
    """A floor at z = 0."""
    renderer.place(renderer.add(plate(20.0, 20.0, (0.5, 0.5, 0.5)), 1), placed())
    return renderer


def test_the_pattern_is_as_wide_as_its_image_and_the_right_way_up(floor: Renderer) -> None:
    """Looking down, up in the image is +y and right +x; the image is twice as wide as high."""
    image = rendered(floor, projector())
    assert at(image, -0.1, 0.1) == at(image, -0.8, 0.9) == [255.0, 0.0, 0.0]
    for x, y in ((0.1, 0.1), (-0.1, -0.1), (0.1, -0.1), (-0.1, 1.04 * REACH)):
        assert at(image, x, y) == [0.0, 0.0, 0.0], (x, y)
    assert at(image, -1.4, 0.4) == [255.0, 0.0, 0.0]  # beyond the reach along y


def test_what_is_behind_a_box_is_in_its_shadow(floor: Renderer) -> None:
    """Its upper edge at z = 1.1 throws its shadow's edge to 0.2 * 2 / 0.9 = 0.444 m."""
    floor.place(floor.add(block((0.4, 0.4, 0.2)), 2), placed(z=1.0))
    image = rendered(floor, projector())
    assert at(image, -0.38, 0.42) == [0.0, 0.0, 0.0]
    assert at(image, -0.5, 0.6) == [255.0, 0.0, 0.0]


@pytest.mark.parametrize("colour", [(0, 0, 0, 255), (255, 255, 255, 255), (255, 0, 0, 100)])
def test_black_white_and_transparent_pixels_of_a_laser_draw_nothing(
    floor: Renderer, colour: tuple[int, int, int, int]
) -> None:
    assert at(rendered(floor, projector(colour)), -0.3, 0.3) == [0.0, 0.0, 0.0]


def test_water_dims_a_laser_on_its_way_to_the_surface_and_back(floor: Renderer) -> None:
    water = Water(fog=0.0, attenuation=(0.1, 0.1, 0.1), colour=(0.0, 0.0, 0.0))
    x, y = -0.3, 0.3
    there = math.dist((x, y, 0.0), ABOVE.position)
    back = math.dist((x, y, 0.0), EYE.position)
    wanted = 255.0 * math.exp(-0.1 * there - 0.2 * back)  # the camera's way counts twice: water.py
    assert at(rendered(floor, projector(), water), x, y)[0] == pytest.approx(wanted, abs=2.5)


def test_a_lamp_lights_with_the_square_of_the_distance(floor: Renderer) -> None:
    one = projector((255, 255, 255, 255), is_laser=False)
    x, y = -0.3, 0.3
    far = math.dist((x, y, 0.0), ABOVE.position)
    wanted = 255.0 * 0.5 * (2.0 / far) / far**2
    assert at(rendered(floor, one), x, y) == pytest.approx([wanted] * 3, abs=2.0)


def test_without_a_projector_an_image_is_as_before(floor: Renderer) -> None:
    before = rendered(floor, None)
    rendered(floor, projector())
    assert np.array_equal(rendered(floor, None), before)


@pytest.mark.parametrize("sides", [(120, 160), (333, 77)])
def test_the_axis_of_a_projector_goes_through_the_middle_of_its_pattern(
    sides: tuple[int, int],
) -> None:
    pattern = np.zeros((*sides, 4), np.uint8)
    lens = Projector(
        world_from_projector=Pose.identity(), fovy=0.9, pattern=pattern, is_laser=True
    ).pinhole
    assert lens.pixel(0.0, 0.0, -3.0) == ((lens.width - 1) / 2, (lens.height - 1) / 2)
