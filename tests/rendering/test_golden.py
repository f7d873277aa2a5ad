"""Images as they were when somebody looked at them and found them right.

Mesa versions and graphics cards differ in the last bit of a shade and in which of two surfaces
owns a pixel on their edge. So an image passes when its mean difference is below half a grey
level and fewer than 1 % of its pixels differ by more than 3 levels. A wrong exponent, a swapped
channel, a mirrored row or a lost shadow fails both. ``UWSIM_DRAW_GOLDEN=1`` draws them anew:
look at them before they are committed.
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tests.rendering.models import ball, block, placed, plate
from uwsim.assets.images import PixelImage
from uwsim.assets.mesh import Texture
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Light, Water

GOLDEN = Path(__file__).parent / "golden"
CAMERA = Intrinsics.from_fovy(160, 120, np.radians(60.0), near=0.1, far=100.0)
EYE = Pose.from_rpy((0.0, -2.4, -2.8), (1.05, 0.0, 0.0))


def floor_image() -> Texture:
    """Tiles with dark joints and a red corner, so that mirroring shows."""
    pixels = np.full((128, 128, 3), 200, np.uint8)
    pixels[::16] = pixels[:, ::16] = 60
    pixels[:48, :48, 1:] //= 3
    return Texture(name="tiles", image=PixelImage(pixels))


def furnish(renderer: Renderer) -> None:
    """A tiled floor 4 m down, a box on it, a ball and a slab above it."""
    turned = Pose.from_rpy((0.3, 0.0, -3.1), (0.2, 0.3, 0.5)).matrix
    renderer.place(renderer.add(plate(8.0, 8.0, texture=floor_image()), 1), placed(z=-4.0))
    renderer.place(renderer.add(block((0.5, 0.3, 0.3), (1.0, 0.45, 0.1)), 2), placed(-0.7, z=-3.85))
    renderer.place(renderer.add(ball(0.25, (0.9, 0.9, 0.3)), 3), placed(-0.5, 0.7, -3.2))
    renderer.place(renderer.add(block((0.9, 0.2, 0.1), (0.3, 0.7, 0.4)), 4), turned)


VIEWS = {
    "clear-water": (Water(fog=0.0), Light()),
    "foggy-dusk": (Water(fog=0.35, fog_colour=(0.0, 0.2, 0.2)), Light(sun="dusk")),
    "dim-and-green": (
        Water(fog=0.05, colour=(0.02, 0.25, 0.12), attenuation=(0.3, 0.05, 0.12)),
        Light(rate=0.6, sun="cloudy"),
    ),
}


@pytest.mark.parametrize("name", VIEWS)
def test_the_image_is_still_the_one_that_was_looked_at(renderer: Renderer, name: str) -> None:
    furnish(renderer)
    colour = renderer.draw(EYE, CAMERA, *VIEWS[name], targets={"colour"}).colour
    assert colour is not None
    file = GOLDEN / f"{name}.png"
    if os.environ.get("UWSIM_DRAW_GOLDEN"):
        Image.fromarray(colour).save(file)
    difference = np.abs(colour.astype(int) - np.asarray(Image.open(file)))
    assert difference.mean() < 0.5
    assert (difference.max(axis=2) > 3).mean() < 0.01
