"""The shadows that lamps make, and when their maps are drawn anew."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.rendering.models import ball, block, placed, plate
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.rendering.lights.lamp import Lamp
from uwsim.rendering.physical.view import ViewContents
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Light, Water

DARK = Light(rate=0.0)
DRY = Water(fog=0.0, attenuation=(0.0, 0.0, 0.0), colour=(0.0, 0.0, 0.0))
CAMERA = Intrinsics.from_fovy(160, 120, np.radians(60.0), near=0.1, far=100.0)
EYE = Pose.from_rpy((0.0, -3.0, 3.0), (math.radians(45.0), 0.0, 0.0))


def lamp(x: float = 0.0, y: float = 0.0, **numbers: object) -> Lamp:
    """A lamp 2 m above the floor that shines straight down."""
    given = {"half_angle": math.radians(50.0), "intensity": 3.0} | numbers
    return Lamp(world_from_lamp=Pose.from_rpy((x, y, 2.0), (0.0, 0.0, 0.0)), **given)  # type: ignore[arg-type]


def rendered(renderer: Renderer, *lamps: Lamp, **how: object) -> np.ndarray:
    image = renderer.draw(
        EYE, CAMERA, DRY, DARK, targets={"colour"}, contents=ViewContents(lamps=lamps), **how
    )  # type: ignore[arg-type]
    assert image.colour is not None
    return image.colour[..., 0].astype(float)


def at(image: np.ndarray, x: float, y: float) -> float:
    """The image's value at a point of the floor [m]."""
    u, v = CAMERA.project(EYE.inverse().transform(np.array([[x, y, 0.0]])))[0]
    return float(image[round(v), round(u)])


@pytest.fixture
def stage(renderer: Renderer) -> Renderer:
    """A floor at z = 0 and a box 0.4 m wide at z = 1."""
    renderer.place(renderer.add(plate(20.0, 20.0, (0.9, 0.9, 0.9)), 1), placed())
    renderer.place(renderer.add(block((0.4, 0.4, 0.2)), 2), placed(z=1.0))
    return renderer


def test_in_the_shadow_of_a_box_there_is_no_light(stage: Renderer) -> None:
    lit = rendered(stage, lamp(casts_shadow=False))
    dark = rendered(stage, lamp())
    # Its upper edge, at z = 1.1, throws the shadow's edge to 0.2 * 2 / 0.9 = 0.444 m.
    for x in (-0.38, -0.3, 0.3, 0.38):
        assert at(dark, x, 0.3) == 0.0, x
        assert at(lit, x, 0.3) > 100.0, x
    for x in (-0.52, 0.52, 0.8, -0.8):
        assert at(dark, x, 0.3) == at(lit, x, 0.3) > 50.0, x


def test_each_of_four_lamps_has_its_own_shadow(stage: Renderer) -> None:
    places = [(-0.6, 0.0), (0.6, 0.0), (0.0, -0.6), (0.0, 0.6)]
    lamps = [lamp(x, y, intensity=0.9) for x, y in places]
    together = rendered(stage, *lamps)
    alone_of = [rendered(stage, each) for each in lamps]
    assert np.abs(together - np.minimum(sum(alone_of), 255.0)).max() <= 2.5
    for n, (x, y) in enumerate(places):
        assert at(alone_of[n], -x, -y) == 0.0  # as far again beyond the box
        others = sum(at(each, -x, -y) for k, each in enumerate(alone_of) if k != n)
        assert others > 50.0
        assert at(together, -x, -y) == pytest.approx(others, abs=2.0)


def test_what_a_lamp_shines_on_has_no_acne(renderer: Renderer) -> None:
    renderer.place(renderer.add(plate(20.0, 20.0), 1), placed())
    renderer.place(renderer.add(ball(0.4), 2), placed(x=0.5, z=0.4))
    renderer.place(renderer.add(block((0.5, 0.5, 0.3)), 3), placed(x=-0.6, z=0.15))
    aside = Lamp(world_from_lamp=EYE, half_angle=math.radians(45.0), intensity=9.0)
    bare = Lamp(
        world_from_lamp=EYE, half_angle=math.radians(45.0), intensity=9.0, casts_shadow=False
    )
    change = rendered(renderer, bare) - rendered(
        renderer, aside
    )  # all that is seen from there is lit
    assert (change > 8.0).mean() < 0.004


def test_a_round_body_under_a_lamp_has_no_acne(renderer: Renderer) -> None:
    renderer.place(renderer.add(ball(0.5), 1), placed(*EYE.transform(np.array([[0, 0, -1.5]]))[0]))
    images = [
        rendered(
            renderer,
            Lamp(world_from_lamp=EYE, half_angle=0.4, intensity=9.0, casts_shadow=casts),
        )
        for casts in (True, False)
    ]
    assert images[1].max() > 100.0
    assert (np.abs(images[0] - images[1]) > 4.0).sum() <= 1


@pytest.mark.parametrize("height", [0.1, 0.3])
def test_grazing_light_has_no_acne(renderer: Renderer, height: float) -> None:
    renderer.place(renderer.add(plate(20.0, 20.0), 1), placed())
    low = Pose.from_rpy((0.0, -1.0, height), (math.radians(80.0), 0.0, 0.0))
    images = [
        rendered(
            renderer,
            Lamp(world_from_lamp=low, half_angle=1.2, intensity=9.0, casts_shadow=casts),
        )
        for casts in (True, False)
    ]
    assert images[1].max() > 100.0
    assert np.abs(images[0] - images[1]).max() <= 1.0


def test_terrain_and_great_things_cast_lamplight_shadows(renderer: Renderer) -> None:
    renderer.place(renderer.add(plate(20.0, 20.0), 1), placed())
    renderer.place(renderer.add(block((12.0, 12.0, 0.1)), 2), placed(y=6.5, z=1.0))
    assert at(rendered(renderer, lamp()), 0.0, 1.2) == 0.0


def test_a_lamps_own_housing_does_not_shade_it(stage: Renderer) -> None:
    alone = rendered(stage, lamp())
    stage.place(stage.add(plate(0.3, 0.3, two_sided=True), 3), placed(z=1.95))
    assert at(rendered(stage, lamp()), 0.6, 0.6) == at(alone, 0.6, 0.6) > 50.0


def test_hidden_ids_cast_no_lamplight_shadow(stage: Renderer) -> None:
    hidden = rendered(stage, lamp(), hidden_ids=frozenset({2}))
    assert at(hidden, 0.3, 0.3) > 100.0
    assert at(rendered(stage, lamp()), 0.3, 0.3) == 0.0


def test_a_map_is_drawn_anew_only_when_something_moved(stage: Renderer) -> None:
    body = stage.add(ball(0.1), 3)
    lamps = [lamp(), lamp(0.5)]

    def maps_drawn(*shining: Lamp) -> int:
        light = stage._artificial_light
        before = 0 if light._lamps is None else light._lamps.n_drawn
        rendered(stage, *shining)
        assert light._lamps is not None
        return light._lamps.n_drawn - before

    assert maps_drawn(*lamps) == 2
    assert maps_drawn(*lamps) == 0  # another camera of the same tick
    assert maps_drawn(lamps[0], lamp(0.6)) == 1
    stage.place(body, placed(x=0.1))
    assert maps_drawn(lamps[0], lamp(0.6)) == 2
    assert maps_drawn(lamps[0], lamp(0.6, intensity=1.0, colour=(1.0, 0.0, 0.0))) == 0


def test_the_shadow_follows_lamp_and_box(stage: Renderer) -> None:
    first = rendered(stage, lamp())
    assert not np.array_equal(first, rendered(stage, lamp(0.3)))
    body = stage.add(ball(0.2), 3)
    stage.place(body, placed(x=0.6, z=0.8))
    assert not np.array_equal(first, rendered(stage, lamp()))
    stage.remove(body)
    assert np.array_equal(first, rendered(stage, lamp()))


def test_an_image_of_lamps_that_do_not_move_is_drawn_once(
    stage: Renderer, monkeypatch: pytest.MonkeyPatch
) -> None:
    images = [rendered(stage, lamp()) for _ in range(2)]  # the second image is stored
    with monkeypatch.context() as patch:
        patch.setattr(stage, "_issue_draw_calls", None)
        images.append(rendered(stage, lamp()))
    for image in images[1:]:
        np.testing.assert_array_equal(image, images[0])
    assert (rendered(stage, lamp(x=0.2)) != images[0]).any()
    assert (rendered(stage, lamp(intensity=2.0)) != images[0]).any()
