"""The smallest rectangle: against brute force over all angles, and by its symmetries."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from uwsim.benchmark.metrics.min_area_rectangle import (
    convex_hull,
    match_corners,
    min_area_rectangle,
)

clouds = arrays.arrays(np.float64, (8, 2), elements=st.integers(0, 300).map(float))


def area(corners: np.ndarray) -> float:
    return float(np.linalg.norm(corners[1] - corners[0]) * np.linalg.norm(corners[3] - corners[0]))


def test_an_upright_rectangle_is_named_from_the_top_left_clockwise() -> None:
    points = np.array([[30.0, 40.0], [10.0, 20.0], [30.0, 20.0], [10.0, 40.0], [20.0, 30.0]])
    assert min_area_rectangle(points).tolist() == [[10, 20], [30, 20], [30, 40], [10, 40]]


@given(clouds)
def test_no_angle_gives_a_smaller_rectangle_and_all_points_lie_inside(points: np.ndarray) -> None:
    corners = min_area_rectangle(points)
    for degrees in range(0, 90):
        cos, sin = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
        turned = points @ np.array([[cos, -sin], [sin, cos]])
        assert area(corners) <= float(np.prod(np.ptp(turned, axis=0))) + 1e-6
    assume(area(corners) > 1.0)
    right, down = corners[1] - corners[0], corners[3] - corners[0]
    assert abs(float(right @ down)) < 1e-6 * area(corners)
    for side in (right, down):
        along = (points - corners[0]) @ side / (side @ side)
        assert along.min() > -1e-6
        assert along.max() < 1 + 1e-6


@given(clouds)
def test_nw_lies_up_and_left_whatever_the_angle(points: np.ndarray) -> None:
    nw, ne, se, sw = min_area_rectangle(points)
    assert ne[0] - nw[0] >= abs(ne[1] - nw[1]) - 1e-6  # the top side leans by 45 degrees at most
    assert se[1] - ne[1] >= abs(se[0] - ne[0]) - 1e-6
    assert nw + se == pytest.approx(ne + sw, abs=1e-6)


@given(clouds, st.permutations(range(8)))
def test_the_order_of_the_points_does_not_matter(points: np.ndarray, order: list[int]) -> None:
    assert min_area_rectangle(points[order]).tolist() == min_area_rectangle(points).tolist()


def test_where_two_rectangles_tie_the_upright_one_is_taken() -> None:
    far = 1.0 + np.sqrt(2.0)
    octagon = np.array(
        [[a * x, b * y] for x, y in ((1, far), (far, 1)) for a in (-1, 1) for b in (-1, 1)]
    )
    diamond = np.array([[10, 0], [20, 10], [10, 20], [0, 10.0]])
    upright = far * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    assert min_area_rectangle(octagon) == pytest.approx(upright)
    tilted = min_area_rectangle(diamond)
    assert tilted == pytest.approx(np.array([[0, 10], [10, 0], [20, 10], [10, 20.0]]))


@pytest.mark.parametrize("points", [[[5.0, 6.0]] * 3, [[0.0, 0.0], [4.0, 0.0], [2.0, 0.0]]])
def test_points_without_area_have_a_rectangle_too(points: list[list[float]]) -> None:
    corners = min_area_rectangle(np.array(points))
    assert area(corners) == 0.0
    assert corners[:, 0].min() == min(x for x, _ in points)
    assert corners[:, 0].max() == max(x for x, _ in points)


def test_the_hull_leaves_out_what_lies_inside_or_on_an_edge() -> None:
    square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]
    assert set(convex_hull([*square, (1.0, 0.0), (1.0, 1.0), (2.0, 1.0)])) == set(square)


@given(st.integers(0, 3), st.booleans())
def test_corners_once_around_are_ordered_like_named_ones(start: int, backwards: bool) -> None:
    named = np.array([[0.0, 0.0], [9.0, 1.0], [9.0, 4.0], [0.0, 5.0]])
    shift = np.array([100.0, 50.0])
    around = np.roll(named[::-1] if backwards else named, start, axis=0) + shift
    order, ordered = match_corners(around, named)
    assert ordered.tolist() == (named + shift).tolist()
    assert around[order].tolist() == ordered.tolist()
