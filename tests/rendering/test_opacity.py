"""What is seen through: blended with what is behind it, in the order of distance."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.rendering.models import plate
from uwsim.assets import paint_model
from uwsim.assets.images import PixelImage
from uwsim.assets.mesh import Model, Texture
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.rendering.lights.lamp import Lamp
from uwsim.rendering.physical.view import ViewContents
from uwsim.rendering.renderer import RenderedImage, Renderer
from uwsim.rendering.water import Light, Water

EYE = Pose.from_rpy((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))  # looks along -z
LENS = Intrinsics.from_fovy(64, 48, 0.8)
AIR = Water(fog=0.0, attenuation=(0.0, 0.0, 0.0), colour=(0.0, 0.0, 0.0))
NO_SHADOW = Light(shadows=False)
RED, GREEN = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)


def at(depth: float, aside: float = 0.0) -> np.ndarray:
    return Pose.from_rpy((aside, 0.0, -depth), (0.0, 0.0, 0.0)).matrix


def look(renderer: Renderer, **arguments: object) -> RenderedImage:
    given = {"water": AIR, "light": NO_SHADOW} | arguments
    return renderer.draw(EYE, LENS, **given)  # type: ignore[arg-type]


def middle(image: RenderedImage) -> np.ndarray:
    assert image.colour is not None
    return image.colour[24, 32].astype(float)


def of_one(model: Model, **arguments: object) -> np.ndarray:
    """The middle pixel where nothing but the model is seen, 2 m away."""
    renderer = Renderer()
    renderer.place(renderer.add(model, 1), at(2.0))
    colour = middle(look(renderer, **arguments))
    renderer.close()
    return colour


@pytest.mark.parametrize("opacity", [0.25, 0.6])
@pytest.mark.parametrize("store", ["uint8", "linear16"])
def test_a_pane_lets_through_what_its_opacity_leaves(
    renderer: Renderer, opacity: float, store: str
) -> None:
    renderer.place(renderer.add(plate(4, 4, GREEN), 1), at(3.0))
    pane = paint_model(plate(4, 4), (*RED, opacity))
    renderer.place(renderer.add(pane, 2), at(2.0))
    front, back = of_one(plate(4, 4, RED)), of_one(plate(4, 4, GREEN))
    scale = 1.0 if store == "uint8" else 257.0
    found = middle(look(renderer, colour=store))[:3] / scale
    assert found == pytest.approx(opacity * front + (1.0 - opacity) * back, abs=1.5)


def test_panes_are_seen_in_their_order_however_they_were_added(renderer: Renderer) -> None:
    near, far = paint_model(plate(4, 4), (*RED, 0.5)), paint_model(plate(4, 4), (*GREEN, 0.5))
    renderer.place(renderer.add(near, 1), at(2.0))
    renderer.place(renderer.add(far, 2), at(3.0))
    red, green = of_one(plate(4, 4, RED)), of_one(plate(4, 4, GREEN))
    assert middle(look(renderer)) == pytest.approx(0.5 * red + 0.25 * green, abs=2.0)


def test_what_is_behind_water_shows_through_a_pane_with_its_own_fog(renderer: Renderer) -> None:
    murky = replace(AIR, fog=0.5, fog_colour=(0.1, 0.2, 0.9))
    renderer.place(renderer.add(paint_model(plate(4, 4), (*RED, 0.5)), 1), at(1.0))
    nothing = np.array(murky.fog_colour) * 255.0
    red = middle(look(renderer, water=murky)) * 2.0 - nothing
    t = np.exp(-(0.5**2))
    assert red == pytest.approx(t * of_one(plate(4, 4, RED)) + (1.0 - t) * nothing, abs=3.0)


def test_a_pane_is_what_a_range_finder_meets_first(renderer: Renderer) -> None:
    renderer.place(renderer.add(plate(4, 4, GREEN), 1), at(3.0))
    renderer.place(renderer.add(paint_model(plate(4, 4), (*RED, 0.3)), 2), at(2.0))
    for targets in ({"range", "ids"}, {"colour", "range", "ids"}):
        image = look(renderer, targets=targets)
        assert image.ids is not None
        assert image.range is not None
        assert image.ids[24, 32] == 2
        assert image.range[24, 32] == pytest.approx(2.0, abs=0.01)


@pytest.mark.parametrize("target", ["colour", "range", "ids"])
def test_an_image_of_one_kind_alone_may_show_a_pane(renderer: Renderer, target: str) -> None:
    renderer.place(renderer.add(plate(4, 4, GREEN), 1), at(3.0))
    renderer.place(renderer.add(paint_model(plate(4, 4), (*RED, 0.3)), 2), at(2.0))
    alone = getattr(look(renderer, targets={target}), target)
    together = getattr(look(renderer), target)
    assert np.array_equal(alone, together)


def test_a_pane_behind_a_wall_is_not_seen(renderer: Renderer) -> None:
    renderer.place(renderer.add(plate(4, 4, GREEN), 1), at(2.0))
    renderer.place(renderer.add(paint_model(plate(4, 4), (*RED, 0.5)), 2), at(3.0))
    assert middle(look(renderer)) == pytest.approx(of_one(plate(4, 4, GREEN)))


def test_what_is_wholly_clear_is_not_there_for_the_eye(renderer: Renderer) -> None:
    renderer.place(renderer.add(plate(4, 4, GREEN), 1), at(3.0))
    renderer.place(renderer.add(paint_model(plate(4, 4), (*RED, 0.0)), 2), at(2.0))
    assert middle(look(renderer)) == pytest.approx(of_one(plate(4, 4, GREEN)))


def test_glass_casts_no_shadow(renderer: Renderer) -> None:
    def lit(model: Model) -> np.ndarray:
        own = Renderer()
        own.place(own.add(plate(4, 4), 1), at(3.0))
        own.place(own.add(model, 2), at(1.5, aside=1.0))
        lamp = Lamp(
            world_from_lamp=Pose.from_rpy((2.0, 0.0, 0.0), (0.0, 0.6, 0.0)),
            half_angle=0.6, intensity=3.0,
        )  # fmt: skip
        colour = middle(look(own, light=Light(rate=0.1), contents=ViewContents(lamps=[lamp])))
        own.close()
        return colour

    clear = lit(paint_model(plate(1, 1), (*RED, 0.5)))
    assert clear == pytest.approx(lit(paint_model(plate(0.001, 0.001), (*RED, 1.0))), abs=1.0)
    assert lit(paint_model(plate(1, 1), (*RED, 1.0))).sum() < 0.8 * clear.sum()


def test_the_next_image_knows_nothing_of_the_glass_in_the_last(renderer: Renderer) -> None:
    handle = renderer.add(paint_model(plate(4, 4), (*RED, 0.5)), 1)
    renderer.place(handle, at(2.0))
    look(renderer)
    renderer.remove(handle)
    renderer.place(renderer.add(plate(4, 4, GREEN), 2), at(2.0))
    image = look(renderer)
    assert middle(image) == pytest.approx(of_one(plate(4, 4, GREEN)))
    assert image.ids is not None
    assert image.ids[24, 32] == 2


def test_paint_takes_the_place_of_a_meshs_colour_and_tints_its_texture() -> None:
    checks = Texture(name="half", image=PixelImage(np.full((4, 4, 3), 128, np.uint8)))
    model = paint_model(plate(1, 1, (0.2, 0.9, 0.2), texture=checks), (1.0, 0.5, 0.0, 1.0))
    assert model.meshes[0].colour == (1.0, 0.5, 0.0)
    assert model.meshes[0].texture is checks
    whole, half = (
        of_one(plate(4, 4, (1.0, 0.5, 0.0))),
        of_one(paint_model(plate(4, 4, texture=checks), (1.0, 0.5, 0.0, 1.0))),
    )
    assert half == pytest.approx(whole * 128 / 255, abs=8.0)  # the glint is not tinted


def test_the_same_paint_is_the_same_model() -> None:
    bare = plate(1, 1)
    assert paint_model(bare, (1.0, 0.0, 0.0, 1.0)) is paint_model(bare, (1.0, 0.0, 0.0, 1.0))
