"""The detection of holes in drawn images, the plane of the net, and the merging of sightings."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.algorithms.inspection.hole_chart import HoleChart
from uwsim.algorithms.inspection.hole_detector import HoleDetector
from uwsim.algorithms.inspection.net_plane import fit_net
from uwsim.base.geometry import Intrinsics
from uwsim.base.rng import stream

LENS = Intrinsics(width=240, height=180, fx=156.0, fy=156.0, cx=119.5, cy=89.5)
DISTANCE, MESH, TWINE = 1.4, 0.1, 0.02
"""The distance of the net, the side of its meshes and the width of a twine [m]."""
DETECTOR = HoleDetector(
    intrinsics=LENS, mesh_side=MESH, threshold=2.5, min_radius=0.085, max_radius=0.4
)


def draw_net(*holes: tuple[float, float, float], contrast: float = 30.0) -> np.ndarray:
    """Draw a net with holes at places x, y on it, with their radii [m], in noise of 1.5 levels."""
    v, u = np.mgrid[: LENS.height, : LENS.width]
    x, y = (u - LENS.cx) * DISTANCE / LENS.fx, (v - LENS.cy) * DISTANCE / LENS.fy
    is_twine = (np.abs(np.remainder(x, MESH) - MESH / 2.0) < TWINE / 2.0) | (
        np.abs(np.remainder(y, MESH) - MESH / 2.0) < TWINE / 2.0
    )
    for hole_x, hole_y, radius in holes:
        is_twine &= np.hypot(x - hole_x, y - hole_y) > radius
    grey = np.where(is_twine, 120.0 - contrast, 120.0)
    grey = grey + 1.5 * stream(0, "net").standard_normal(grey.shape)
    return np.repeat(np.clip(np.rint(grey), 0, 255).astype(np.uint8)[..., None], 3, axis=2)


def test_a_whole_net_has_no_hole() -> None:
    assert DETECTOR.detect(draw_net(), DISTANCE) == []


@pytest.mark.parametrize("radius", [0.15, 0.25])
def test_a_hole_is_found_where_it_is(radius: float) -> None:
    (gap,) = DETECTOR.detect(draw_net((0.3, -0.2, radius)), DISTANCE)
    x, y = (gap.u - LENS.cx) * DISTANCE / LENS.fx, (gap.v - LENS.cy) * DISTANCE / LENS.fy
    assert math.hypot(x - 0.3, y + 0.2) < 0.1
    assert radius - 0.02 < gap.radius < radius + MESH


def test_a_hole_at_the_border_and_a_net_that_is_not_seen_are_left_out() -> None:
    assert DETECTOR.detect(draw_net((1.05, 0.0, 0.2)), DISTANCE) == []
    assert DETECTOR.detect(draw_net((0.3, -0.2, 0.2), contrast=0.0), DISTANCE) == []


def test_the_net_is_the_line_of_most_hits() -> None:
    starboard = np.linspace(-0.6, 0.6, 13)
    hits = np.stack([1.5 + 0.2 * starboard, starboard], axis=1)
    hits[4, 0] = 1.9  # something behind the net
    plane = fit_net(hits)
    assert plane is not None
    assert (plane.distance, plane.slope) == (pytest.approx(1.5), pytest.approx(0.2))
    assert fit_net(hits[:3]) is None


def test_sightings_near_each_other_are_one_hole_that_is_reported_when_seen_often() -> None:
    chart = HoleChart(0.4, 3)
    for x in (1.0, 1.1, 1.2):
        chart.add(np.array([x, 0.0, 2.0]))
    chart.add(np.array([3.0, 0.0, 2.0]))
    assert chart.places() == pytest.approx(np.array([[1.1, 0.0, 2.0]]))
