"""The sun's shadow: where it falls, where it does not, and when it is redrawn."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest

from tests.rendering.models import ball, block, placed, plate
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Light, Water, sun_direction

CAMERA = Intrinsics.from_fovy(160, 120, np.radians(70.0), near=0.1, far=100.0)
CLEAR = Water(fog=0.0, attenuation=(0.0, 0.0, 0.0))


def brightness(renderer: Renderer, eye: Pose, light: Light) -> np.ndarray:
    colour = renderer.draw(eye, CAMERA, CLEAR, light, targets={"colour"}).colour
    assert colour is not None
    return colour[..., 0].astype(float)


def look_from(point: np.ndarray, target: np.ndarray) -> Pose:
    back = (point - target) / np.linalg.norm(point - target)
    right = np.cross([0.0, 0.0, 1.0], back)
    right /= np.linalg.norm(right)
    return Pose(point, np.stack([right, np.cross(back, right), back], axis=1))


@pytest.mark.parametrize("sun", ["clear", "dusk", "cloudy"])
def test_the_shadow_falls_opposite_the_sun(renderer: Renderer, sun: str) -> None:
    renderer.place(renderer.add(plate(60.0, 60.0, (0.8, 0.8, 0.8)), 1), placed())
    renderer.place(renderer.add(ball(0.2), 2), placed(z=1.0))
    towards = sun_direction(sun)
    foot = np.array([0.0, 0.0, 1.0]) - towards / towards[2]  # on the floor
    eye = look_from(foot + np.array([0.3, 0.2, 4.0]), foot)
    light = Light(sun=sun)
    change = brightness(renderer, eye, Light(sun=sun, shadows=False)) - brightness(
        renderer, eye, light
    )
    u, v = CAMERA.project(eye.inverse().transform(foot[None]))[0]
    assert change[round(v), round(u)] > 50.0
    aside = CAMERA.project(eye.inverse().transform(foot[None] + [[0.6, -0.6, 0.0]]))[0]
    assert change[round(aside[1]), round(aside[0])] == 0.0


def test_shadows_for_people_are_soft_and_have_the_hue_of_the_water(renderer: Renderer) -> None:
    renderer.place(renderer.add(plate(60.0, 60.0, (0.8, 0.8, 0.8)), 1), placed())
    renderer.place(renderer.add(block((0.8, 0.8, 0.02)), 2), placed(z=1.0))
    towards = sun_direction("clear")
    edge = np.array([0.4, 0.0, 1.0]) - towards / towards[2]  # of the shadow on the floor
    eye = look_from(edge + np.array([0.02, 0.02, 0.15]), edge)
    steps, shade = [], []  # from a pixel to the next; colour of the darkest
    for light in (Light(), Light(is_polished=True)):
        colour = renderer.draw(eye, CAMERA, CLEAR, light, targets={"colour"}).colour
        assert colour is not None
        red = colour[..., 0].astype(float)
        steps.append(np.abs(np.diff(red, axis=1)).max())
        shade.append(colour[np.unravel_index(red.argmin(), red.shape)].astype(float))
    assert 2.0 * steps[1] < steps[0]
    plain, blue = shade
    assert plain[2] == pytest.approx(plain[0], abs=1.0)
    assert blue[2] > 1.3 * blue[0]  # the colour of the water is (0, 0.05, 0.3)


def test_what_is_wet_gleams_for_people_where_it_mirrors_the_sun_and_there_alone(
    renderer: Renderer,
) -> None:
    renderer.place(renderer.add(plate(60.0, 60.0, (0.3, 0.3, 0.3)), 1), placed())
    mirrored = sun_direction("clear") * [-1.0, -1.0, 1.0]
    gains = []
    for direction in (mirrored, sun_direction("clear")):
        eye = look_from(3.0 * direction, np.zeros(3))
        plain, polished = (
            brightness(renderer, eye, Light(shadows=False, is_polished=on)) for on in (False, True)
        )
        gains.append(polished[60, 80] - plain[60, 80])
    assert gains[0] > 25.0
    assert gains[1] <= 0.0


@pytest.mark.parametrize("light", [Light(), Light(is_polished=True)])
def test_a_lit_body_has_no_acne(renderer: Renderer, light: Light) -> None:
    renderer.place(renderer.add(block((1.0, 0.6, 0.4)), 1), placed())
    renderer.place(renderer.add(ball(0.4), 2), placed(x=2.0))
    towards = sun_direction("clear")
    for target in (np.zeros(3), np.array([2.0, 0.0, 0.0])):
        eye = look_from(target + 2.0 * towards, target)  # all that is seen from the sun is lit
        dry = brightness(renderer, eye, replace(light, shadows=False))
        change = dry - brightness(renderer, eye, light)
        assert (change > 8.0).mean() < 0.002


def test_a_shadow_begins_at_the_foot_of_what_casts_it(renderer: Renderer) -> None:
    renderer.place(renderer.add(plate(60.0, 60.0, (0.8, 0.8, 0.8)), 1), placed())
    renderer.place(renderer.add(block((0.3, 0.3, 0.3)), 2), placed(z=0.15))
    away = -sun_direction("clear") * [1.0, 1.0, 0.0]
    away /= np.abs(away).max()
    points = np.array([0.15 * away + d * away for d in (0.02, 0.05, 0.1)])
    eye = look_from(np.array([0.2, -1.5, 1.5]), points[0])
    change = brightness(renderer, eye, Light(shadows=False)) - brightness(renderer, eye, Light())
    for u, v in CAMERA.project(eye.inverse().transform(points)):
        assert change[round(v), round(u)] > 30.0


def test_terrain_casts_no_shadow(renderer: Renderer) -> None:
    renderer.place(renderer.add(plate(60.0, 60.0), 1), placed())
    renderer.place(renderer.add(block((12.0, 12.0, 1.0)), 2), placed(z=6.0))
    eye = look_from(np.array([0.0, -1.0, 3.0]), np.zeros(3))
    assert np.array_equal(
        brightness(renderer, eye, Light()), brightness(renderer, eye, Light(shadows=False))
    )


def test_the_shadow_follows_what_moves(renderer: Renderer) -> None:
    renderer.place(renderer.add(plate(60.0, 60.0), 1), placed())
    body = renderer.add(ball(0.3), 2)
    eye = look_from(np.array([0.1, -1.0, 3.0]), np.zeros(3))
    shadows = []
    for x in (0.0, 0.4, 0.0):
        renderer.place(body, placed(x=x, y=1.0, z=1.0))
        shadows.append(brightness(renderer, eye, Light()))
    assert not np.array_equal(shadows[0], shadows[1])
    assert np.array_equal(shadows[0], shadows[2])


@pytest.mark.parametrize("sun", ["clear", "dusk"])
@pytest.mark.parametrize("yaw", [0.0, 0.7, 2.5])
def test_a_caster_that_is_left_out_throws_no_shadow_into_the_image(
    renderer: Renderer, monkeypatch: pytest.MonkeyPatch, sun: str, yaw: float
) -> None:
    """Images with all casters drawn, and with those that can be seen to matter."""
    renderer.place(renderer.add(plate(30.0, 30.0, (0.8, 0.8, 0.8)), 1), placed())
    random = np.random.default_rng(5)
    for x, y, z in random.uniform([-4.0, -4.0, 0.3], [4.0, 4.0, 2.5], (14, 3)):
        renderer.place(renderer.add(ball(0.25), 2), placed(x, y, z))
    eye = Pose.from_rpy((0.5, 0.3, 3.0), (0.5, 0.2, yaw))
    spared = brightness(renderer, eye, Light(sun=sun))
    n_drawn: list[int] = []

    def everything(instances, casters, seen, *_: object) -> np.ndarray:  # type: ignore[no-untyped-def]
        n_drawn.append(len(casters))
        return np.ones((len(seen), len(casters)), bool)

    monkeypatch.setattr("uwsim.rendering.renderer.find_shadow_pairs", everything)
    renderer.place(renderer.add(ball(0.01), 3), placed(z=-5.0))  # below the floor: a new drawing
    whole = brightness(renderer, eye, Light(sun=sun))
    assert n_drawn == [15]
    # the maps differ in size, so edges may differ by a texel
    assert (np.abs(whole - spared) > 12.0).mean() < 0.006
    bare = brightness(renderer, eye, Light(sun=sun, shadows=False))
    assert (np.abs(bare - whole) > 12.0).mean() > 0.01


def test_a_vehicle_whose_shadow_is_elsewhere_is_left_out(renderer: Renderer) -> None:
    renderer.place(renderer.add(plate(30.0, 30.0), 1), placed())
    above = renderer.add(ball(0.3), 2)
    down = Pose.from_rpy((0.0, 0.0, 3.0), (0.0, 0.0, 0.0))
    towards = sun_direction("clear")
    shadow = renderer._shadow
    for offset, is_needed in ((np.zeros(3), True), (np.array([6.0, 0.0, 0.0]), False)):
        place = 2.9 / towards[2] * towards + offset  # its shadow falls to offset, about
        renderer.place(above, placed(*place))
        before = shadow.texture_from_world
        brightness(renderer, down, Light())
        assert (shadow.texture_from_world is not before) == is_needed


def draw_around(renderer: Renderer, places: Mapping[int, tuple[float, float, float]]) -> np.ndarray:
    """The view of four balls at the corners of a floor, with more of them between."""
    for handle, place in places.items():
        renderer.place(handle, placed(*place))
    return brightness(renderer, look_from(np.array([0.1, -1.0, 9.0]), np.zeros(3)), Light())


@pytest.fixture
def crowd(renderer: Renderer) -> dict[int, tuple[float, float, float]]:
    """A floor, four balls at its corners, and four between; the handles of these and places."""
    renderer.place(renderer.add(plate(30.0, 30.0, (0.8, 0.8, 0.8)), 1), placed())
    for x, y in ((-2.5, -2.5), (2.5, -2.5), (-2.5, 2.5), (2.5, 2.5)):
        renderer.place(renderer.add(ball(0.3), 2), placed(x, y, 1.0))
    places = [(-0.9, 0.4, 0.5), (0.2, -0.7, 0.6), (0.9, 0.9, 0.4), (0.0, 0.3, 0.7)]
    return {renderer.add(ball(0.2), 3 + i): place for i, place in enumerate(places)}


def test_only_casters_that_moved_are_drawn_again(
    renderer: Renderer, crowd: dict[int, tuple[float, float, float]]
) -> None:
    shadow, mover = renderer._shadow, min(crowd)
    n_drawn, images = [], []
    for x in (-0.9, -0.8, -0.7, -0.6, -0.6):
        before = shadow.n_drawn
        images.append(draw_around(renderer, crowd | {mover: (x, 0.4, 0.5)}))
        n_drawn.append(shadow.n_drawn - before)
    assert n_drawn == [8, 8, 1, 1, 0]
    assert not np.array_equal(images[2], images[3])


def test_casters_that_come_to_rest_are_drawn_no_more(
    renderer: Renderer, crowd: dict[int, tuple[float, float, float]]
) -> None:
    shadow, mover = renderer._shadow, min(crowd)
    n_drawn = []
    for step in range(6):
        falling = {h: (x, y, z - 0.01 * min(step, 2)) for h, (x, y, z) in crowd.items()}
        x, y, z = crowd[mover]
        before = shadow.n_drawn
        draw_around(renderer, falling | {mover: (x + 0.05 * step, y, z)})
        n_drawn.append(shadow.n_drawn - before)
    assert n_drawn == [8, 8, 4, 8, 1, 1]


def test_a_map_of_which_a_part_is_kept_is_the_map_drawn_as_a_whole(
    renderer: Renderer, crowd: dict[int, tuple[float, float, float]]
) -> None:
    random = np.random.default_rng(2)
    for step in range(8):
        for handle in crowd:
            if random.random() < 0.4:
                x, y, z = crowd[handle]
                crowd[handle] = x + 0.02 * random.normal(), y + 0.02 * random.normal(), z
        kept = draw_around(renderer, crowd)
        renderer.remove(renderer.add(ball(0.1), 9))  # all is drawn anew
        assert np.array_equal(draw_around(renderer, crowd), kept), step
