"""The light of a lamp: how bright, where, and through how much water."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.rendering.models import ball, placed, plate
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.rendering.lights.lamp import MAX_HALF_ANGLE, Lamp
from uwsim.rendering.physical.view import ViewContents
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Light, Water, apply_water

DARK = Light(rate=0.0)
DRY = Water(fog=0.0, attenuation=(0.0, 0.0, 0.0), colour=(0.0, 0.0, 0.0))
HERE = Pose.identity()
CAMERA = Intrinsics.from_fovy(160, 120, np.radians(50.0), near=0.1, far=100.0)
COLOUR = frozenset({"colour"})
GREY = (0.8, 0.6, 0.4)


def lamp(
    position: tuple[float, float, float] = (0.0, 0.0, 0.0),
    rpy: tuple[float, float, float] = (0.0, 0.0, 0.0),
    **numbers: object,
) -> Lamp:
    given = {"half_angle": math.radians(60.0), "softness": 0.1} | numbers
    return Lamp(world_from_lamp=Pose.from_rpy(position, rpy), **given)  # type: ignore[arg-type]


def rendered(
    renderer: Renderer, *lamps: Lamp, water: Water = DRY, light: Light = DARK
) -> np.ndarray:
    """What the camera at the origin sees, (h, w, 3), 0..1."""
    image = renderer.draw(
        HERE, CAMERA, water, light, targets=COLOUR, contents=ViewContents(lamps=lamps)
    )
    assert image.colour is not None
    return image.colour / 255.0


def points_on(depth: float) -> np.ndarray:
    """Where the pixels' rays meet the plane z = -depth, (h w, 3) [m]."""
    return CAMERA.rays().reshape(-1, 3) * depth


@pytest.mark.parametrize("distance", [0.8, 1.5, 3.0])
def test_a_plate_that_faces_the_lamp_is_as_bright_as_the_law_says(
    renderer: Renderer, distance: float
) -> None:
    renderer.place(renderer.add(plate(40.0, 40.0, GREY), 1), placed(z=-distance))
    bright = lamp(colour=(1.0, 0.9, 0.5), intensity=0.7)
    centre = rendered(renderer, bright)[59:61, 79:81].mean(axis=(0, 1))
    law = np.array(GREY) * [1.0, 0.9, 0.5] * 0.7 / distance**2
    assert centre == pytest.approx(np.minimum(law, 1.0), abs=1.0 / 255.0)


@pytest.mark.parametrize(
    "given",
    [
        {},
        {"position": (0.7, -0.4, 0.3), "rpy": (0.3, -0.4, 1.0)},
        {"half_angle": 0.3, "softness": 1.0, "position": (0.0, 0.2, 0.0)},
    ],
    ids=["at the camera", "aside and turned", "narrow and soft"],
)
def test_every_pixel_follows_the_law_through_the_water(
    renderer: Renderer, given: dict[str, object]
) -> None:
    water = Water(fog=0.1, attenuation=(0.5, 0.2, 0.1))
    renderer.place(renderer.add(plate(60.0, 60.0, GREY), 1), placed(z=-2.0))
    bright = lamp(intensity=3.0, **given)  # type: ignore[arg-type]
    points = points_on(2.0)
    facing = np.tile([0.0, 0.0, 1.0], (len(points), 1))
    lit = np.array(GREY) * bright.light(points, facing, water.attenuation)
    dark = water.scale_by_light(DARK)
    law = apply_water(lit, np.linalg.norm(points, axis=1), points[:, 2], dark)
    seen = rendered(renderer, bright, water=water).reshape(-1, 3)
    assert np.abs(seen - np.clip(law, 0.0, 1.0)).max() <= 1.01 / 255.0
    assert np.ptp(law) > 0.1


def test_the_water_takes_its_share_on_the_lamps_way_too(renderer: Renderer) -> None:
    renderer.place(renderer.add(plate(40.0, 40.0), 1), placed(z=-1.0))
    water = Water(fog=0.0, attenuation=(0.6, 0.3, 0.0), colour=(0.0, 0.0, 0.0))
    far = lamp((0.0, 0.0, 1.0), intensity=2.0)  # 2 m from the plate, the camera 1 m
    centre = rendered(renderer, far, water=water)[60, 80]
    law = 2.0 / 4.0 * np.exp(-np.array([0.6, 0.3, 0.0]) * (2.0 + 2.0 * 1.0))
    assert centre == pytest.approx(law, abs=1.0 / 255.0)


def test_outside_its_cone_and_behind_it_there_is_no_light(renderer: Renderer) -> None:
    renderer.place(renderer.add(plate(40.0, 40.0), 1), placed(z=-2.0))
    narrow = rendered(renderer, lamp(half_angle=math.radians(10.0), softness=0.0, intensity=3.0))
    angle = np.arctan(np.linalg.norm(CAMERA.rays()[..., :2], axis=2))
    inside = angle < math.radians(10.0)
    assert narrow[inside & (angle < math.radians(9.5))].min() > 0.5
    assert narrow[~inside & (angle > math.radians(10.5))].max() == 0.0
    assert rendered(renderer, lamp(rpy=(math.pi, 0.0, 0.0), intensity=9.0)).max() == 0.0


def test_what_turns_its_back_to_the_lamp_stays_dark(renderer: Renderer) -> None:
    renderer.place(renderer.add(ball(0.5), 1), placed(z=-2.0))
    behind = lamp((0.0, 0.0, -5.0), (math.pi, 0.0, 0.0), intensity=9.0, casts_shadow=False)
    assert rendered(renderer, behind)[45:75, 65:95].max() == 0.0


def test_the_back_of_a_two_sided_plate_is_lit_as_a_front(renderer: Renderer) -> None:
    images = []
    for roll in (0.0, np.pi):
        handle = renderer.add(plate(9.0, 9.0, GREY, two_sided=True), 1)
        renderer.place(handle, Pose.from_rpy((0.0, 0.0, -2.0), (roll, 0.0, 0.0)).matrix)
        images.append(rendered(renderer, lamp((0.3, 0.0, 0.0), intensity=3.0)))
        renderer.remove(handle)
    assert images[0] == pytest.approx(images[1], abs=1.01 / 255.0)
    assert images[0][60, 80].min() > 0.2


def test_the_light_of_four_lamps_adds_up(renderer: Renderer) -> None:
    renderer.place(renderer.add(plate(40.0, 40.0), 1), placed(z=-2.0))
    lamps = [lamp((x, 0.1, 0.0), intensity=0.5 + 0.2 * x) for x in (-0.6, -0.2, 0.2, 0.6)]
    alone = sum(rendered(renderer, each) for each in lamps)
    assert np.abs(rendered(renderer, *lamps) - alone).max() <= 2.5 / 255.0
    with pytest.raises(ValueError, match="5 lamps are more than 4"):
        rendered(renderer, *lamps, lamps[0])


def test_a_lamp_adds_to_the_suns_light(renderer: Renderer) -> None:
    renderer.place(renderer.add(plate(40.0, 40.0, GREY), 1), placed(z=-2.0))
    day, night = Light(), DARK
    added = rendered(renderer, lamp(), light=day) - rendered(renderer, light=day)
    assert added == pytest.approx(rendered(renderer, lamp(), light=night), abs=1.6 / 255.0)


def test_without_lamps_the_bytes_are_those_before_a_lamp_shone(renderer: Renderer) -> None:
    renderer.place(renderer.add(plate(9.0, 9.0, GREY), 1), placed(z=-3.0))
    renderer.place(renderer.add(ball(0.4, (0.9, 0.4, 0.2)), 2), placed(z=-2.0))
    before = renderer.draw(HERE, CAMERA, Water(), Light(), colour="linear16").colour
    shone = renderer.draw(
        HERE, CAMERA, Water(), Light(), colour="linear16", contents=ViewContents(lamps=[lamp()])
    ).colour
    after = renderer.draw(HERE, CAMERA, Water(), Light(), colour="linear16").colour
    assert np.array_equal(before, after)  # type: ignore[arg-type]
    assert not np.array_equal(before, shone)  # type: ignore[arg-type]


def test_range_and_ids_do_not_depend_on_lamps(renderer: Renderer) -> None:
    renderer.place(renderer.add(ball(0.4), 2), placed(z=-2.0))
    with_lamp = renderer.draw(HERE, CAMERA, DRY, DARK, contents=ViewContents(lamps=[lamp()]))
    without = renderer.draw(
        HERE, CAMERA, DRY, DARK, targets={"range", "ids"}, contents=ViewContents(lamps=[lamp()])
    )
    assert np.array_equal(with_lamp.range, without.range)  # type: ignore[arg-type]
    assert np.array_equal(with_lamp.ids, without.ids)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "wrong",
    [
        {"half_angle": 0.0},
        {"half_angle": MAX_HALF_ANGLE + 0.01},
        {"softness": 1.1},
        {"intensity": -1.0},
    ],
)
def test_a_lamp_that_cannot_be_is_refused(wrong: dict[str, object]) -> None:
    with pytest.raises(ValueError, match=r"is not in|is no such"):
        lamp(**wrong)  # type: ignore[arg-type]
