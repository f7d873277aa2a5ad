"""Surfaces with holes: nets keep their threads at a distance, and shadows have their holes."""

from __future__ import annotations

import numpy as np
import pytest

from tests.rendering.lights.test_sun_shadow import look_from
from tests.rendering.materials.test_materials import with_material
from tests.rendering.models import placed, plate
from tests.rendering.physical.photographs import camera_of
from uwsim.assets.images import PixelImage
from uwsim.assets.mesh import Material, Texture
from uwsim.base.geometry import Pose
from uwsim.rendering.lights.lamp import Lamp
from uwsim.rendering.materials.masked_levels import compute_masked_levels, find_solid_share
from uwsim.rendering.physical.view import ViewContents
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Light, Water

CUTOFF = 128


def net_pixels(side: int, mesh: int, thread: int) -> np.ndarray:
    """Return a square net: threads of a width, a mesh apart [px]."""
    index = np.arange(side) % mesh < thread
    pixels = np.zeros((side, side, 4), np.uint8)
    pixels[..., :3] = 200
    pixels[index[:, None] | index[None, :]] = (90, 120, 80, 255)
    return pixels


def random_pixels(side: int, share: float) -> np.ndarray:
    pixels = np.zeros((side, side, 4), np.uint8)
    pixels[np.random.default_rng(4).random((side, side)) < share] = (90, 120, 80, 255)
    return pixels


def net(pixels: np.ndarray, repeats: int = 1) -> object:
    texture = Texture(name=f"net{pixels.shape}", image=PixelImage(pixels))
    model = plate(2.0, 2.0, texture=texture, two_sided=True)
    uvs = model.meshes[0].uvs * np.float32(repeats)
    return with_material(model, Material(alpha_cutoff=CUTOFF / 255.0), uvs=uvs)


@pytest.mark.parametrize("share", [0.05, 0.15, 0.3, 0.6])
def test_levels_keep_the_share_that_is_not_a_hole(share: float) -> None:
    pixels = random_pixels(256, share)
    levels = compute_masked_levels(pixels, CUTOFF)
    exact = find_solid_share(pixels[..., 3], CUTOFF)
    assert len(levels) >= 3
    assert [level.shape[0] for level in levels[:3]] == [128, 64, 32]
    for level in levels:
        assert find_solid_share(level[..., 3], CUTOFF) == pytest.approx(exact, rel=0.2)


def test_levels_of_thin_threads_end_before_they_vanish_or_close() -> None:
    pixels = net_pixels(256, mesh=32, thread=4)
    levels = compute_masked_levels(pixels, CUTOFF)
    assert 2 <= len(levels) <= 4
    exact = find_solid_share(pixels[..., 3], CUTOFF)
    for level in levels:
        assert find_solid_share(level[..., 3], CUTOFF) == pytest.approx(exact, rel=0.2)


def test_colours_of_threads_are_not_mixed_with_those_of_holes() -> None:
    for level in compute_masked_levels(net_pixels(64, mesh=16, thread=2), CUTOFF):
        threads = level[level[..., 3] >= CUTOFF]
        assert np.abs(threads[:, :3].astype(int) - (90, 120, 80)).max() <= 1


def test_a_far_net_covers_its_share_of_the_image(renderer: Renderer) -> None:
    pixels = net_pixels(128, mesh=16, thread=2)
    share = find_solid_share(pixels[..., 3], CUTOFF)
    renderer.clear()
    renderer.place(renderer.add(net(pixels, repeats=4), 1), np.eye(4))
    for distance in (2.0, 6.0, 14.0):
        eye = look_from(np.array([0.0, -0.01, distance]), np.zeros(3))
        image = renderer.draw(eye, camera_of(300.0, 320, 240), Water(), Light(), targets={"ids"})
        assert image.ids is not None
        area = min(320.0, 600.0 / distance) * min(240.0, 600.0 / distance)
        assert image.ids.sum() / area == pytest.approx(share, rel=0.3), distance


@pytest.mark.parametrize("is_lamp", [False, True])
def test_shadows_of_a_net_have_its_holes(renderer: Renderer, is_lamp: bool) -> None:
    pixels = np.full((8, 8, 4), 255, np.uint8)
    pixels[:, :4, 3] = 0  # the half towards -x
    lamp = Lamp(world_from_lamp=Pose(np.array([0.2, -0.3, 4.0]), np.eye(3)), half_angle=1.0)
    eye = look_from(np.array([0.0, -6.0, 3.0]), np.array([0.0, 0.0, 0.0]))
    floors = []
    for model, x in ((net(pixels), 0.0), (plate(1.0, 2.0, two_sided=True), 0.5), (None, 0.0)):
        renderer.clear()
        renderer.place(renderer.add(plate(12.0, 12.0), 1), np.eye(4))
        if model is not None:
            renderer.place(renderer.add(model, 2), placed(x=x, z=0.7))
        image = renderer.draw(
            eye, camera_of(160.0, 160, 120), Water(fog=0.0), Light(shadows=not is_lamp),
            contents=ViewContents(lamps=(lamp,) if is_lamp else ()),
        )  # fmt: skip
        assert image.colour is not None
        assert image.ids is not None
        floors.append(np.where(image.ids == 1, image.colour[..., 0].astype(int), -1))
    masked, half, bare = floors
    both = (masked >= 0) & (half >= 0)
    assert (np.abs(masked - half)[both] > 8).mean() < 0.01
    assert (np.abs(bare - half)[both] > 8).mean() > 0.02  # there is a shadow
