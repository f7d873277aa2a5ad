"""Images of bodies that the surface mirrors, from below and from above."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.rendering.models import block, placed
from tests.rendering.physical.photographs import camera_of
from tests.rendering.surface.seas import CLEAR_WATER, OVERCAST, look, make_waves, take, water_of
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.rendering.physical.moving_surface import MovingSurface
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.surface.mirror_view import find_mirror_view


@pytest.mark.parametrize("has_waves", [False, True])
def test_the_mirror_sees_a_point_where_the_camera_sees_its_image(has_waves: bool) -> None:
    pose = Pose.from_rpy((1.0, -2.0, -1.5), (1.9, 0.2, 0.7))
    lens = Intrinsics(width=641, height=479, fx=400.0, fy=410.0, cx=300.0, cy=250.0, skew=3.0)
    surface_height = 0.3
    mirror_pose, mirror_lens = find_mirror_view(
        pose, lens, surface_height, 100.0, has_waves=has_waves
    )
    assert mirror_lens.width == (161 if has_waves else 321)
    assert np.linalg.det(mirror_pose.rotation) == pytest.approx(1.0)
    inside = np.array([[0.5, -0.3, -6.0], [-1.0, 0.8, -4.0]])  # of the image, camera frame
    images = pose.transform(inside)
    points = images * [1.0, 1.0, -1.0] + [0.0, 0.0, 2.0 * surface_height]
    seen = lens.project(inside)
    mirrored = mirror_lens.project(mirror_pose.inverse().transform(points))
    scale = np.array([mirror_lens.width / lens.width, mirror_lens.height / lens.height])
    expected = (seen + 0.5) * scale - 0.5
    expected[:, 1] = mirror_lens.height - 1.0 - expected[:, 1]
    np.testing.assert_allclose(mirrored, expected, atol=1e-9)


def test_total_reflection_shows_the_wall_of_a_tank(renderer: Renderer) -> None:
    """A white wall below a level surface: as bright as directly, over a way as long."""
    renderer.clear()
    renderer.place(renderer.add(block((0.02, 60.0, 4.0)), 1), placed(x=6.0, z=-3.0))
    lens = camera_of(400.0, 401, 401)
    pose = look((0.0, 0.0, -1.0), (6.0, 0.0, -1.0))
    water = water_of(CLEAR_WATER, OVERCAST)
    image = take(renderer, water, pose, lens)[..., 1]
    heights = np.array([-1.3, -1.5, -1.8])  # of points of the wall; their images are at -heights
    direct = 200 - np.round(400.0 * (heights + 1.0) / 6.0).astype(int)
    mirrored = 200 - np.round(400.0 * (-heights + 1.0) / 6.0).astype(int)
    np.testing.assert_allclose(image[mirrored, 200], image[direct, 200], rtol=0.05)
    without = take(renderer, replace(water, has_mirror=False), pose, lens)[..., 1]
    assert (without[mirrored, 200] < 0.8 * image[mirrored, 200]).all()


def test_a_body_outside_the_picture_is_mirrored_from_above(renderer: Renderer) -> None:
    """A white board above the edge of the image, over the level sea."""
    renderer.clear()
    renderer.place(renderer.add(block((30.0, 30.0, 0.1)), 1), placed(x=15.0, z=4.0))
    pose = look((0.0, 0.0, 2.0), (6.0, 0.0, 0.0))
    lens = camera_of(600.0, 201, 201)
    water = water_of(CLEAR_WATER, OVERCAST)
    image = take(renderer, water, pose, lens)[100, 100, 1]
    without = take(renderer, replace(water, has_mirror=False), pose, lens)[100, 100, 1]
    assert image < 0.9 * without  # the lower side of the board instead of the sky


def test_waves_shift_the_mirrored_image(renderer: Renderer) -> None:
    renderer.clear()
    renderer.place(renderer.add(block((0.02, 3.0, 4.0)), 1), placed(x=6.0, z=-3.0))
    pose, lens = look((0.0, 0.0, -3.0), (6.0, 0.0, -1.0)), camera_of(200.0, 201, 201)
    water = water_of(CLEAR_WATER, OVERCAST)
    surfaces = [MovingSurface(time=t, waves=make_waves(0.2)) for t in (1.0, 1.5)]
    images = [take(renderer, water, pose, lens, surface) for surface in surfaces]
    assert np.abs(images[0] - images[1]).mean() > 0.005
    assert math.isfinite(float(images[0].sum()))
    assert np.array_equal(images[0], take(renderer, water, pose, lens, surfaces[0]))
