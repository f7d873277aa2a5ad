"""Where along a path a point is, against dense sampling."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from uwsim.base.numerics.polyline import Polyline, round_corners

place = st.tuples(*[st.floats(-3.0, 3.0)] * 3)


@settings(max_examples=60)
@given(st.lists(place, min_size=2, max_size=5), place, st.integers(0, 10))
def test_no_place_on_a_segment_is_nearer_than_the_nearest(
    points: list[tuple[float, float, float]], point: tuple[float, float, float], which: int
) -> None:
    line = Polyline(np.array(points))
    segment = which % line.n_segments
    distance, along = line.find_nearest(segment, np.array(point))
    first, second = np.array(points[segment]), np.array(points[segment + 1])
    on_it = first + np.linspace(0.0, 1.0, 201)[:, None] * (second - first)
    sampled = np.linalg.norm(on_it - np.array(point), axis=1).min()
    length = float(np.linalg.norm(second - first))
    assert sampled - length / 400.0 - 1e-9 <= distance <= sampled + 1e-9
    before = sum(np.linalg.norm(np.diff(np.array(points[: segment + 1]), axis=0), axis=1))
    assert before - 1e-9 <= along <= before + length + 1e-9


def test_a_3_4_5_triangle() -> None:
    line = Polyline(np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 0.0, 3.0]]))
    assert (line.n_segments, line.length) == (2, 7.0)
    assert line.find_nearest(0, np.array([1.0, 2.0, 0.0])) == (2.0, 1.0)
    assert line.find_nearest(0, np.array([8.0, 3.0, 0.0])) == (5.0, 4.0)
    assert line.find_nearest(1, np.array([4.0, 1.0, 2.0])) == (1.0, 6.0)


def test_a_point_alone_is_a_line_of_length_0() -> None:
    line = Polyline(np.array([[1.0, 1.0, 1.0]]))
    assert (line.n_segments, line.length) == (1, 0.0)
    assert line.find_nearest(0, np.array([1.0, 4.0, 5.0])) == pytest.approx((5.0, 0.0))


def test_a_right_angle_becomes_a_quarter_of_a_circle() -> None:
    points = round_corners(np.array([[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], [4.0, 5.0, 1.0]]), 2.0, 0.01)
    arc = points[1:-1]
    np.testing.assert_allclose(np.hypot(arc[:, 0] - 2.0, arc[:, 1] - 2.0), 2.0, atol=1e-12)
    np.testing.assert_allclose(arc[[0, -1]], [[2.0, 0.0, 1.0], [4.0, 2.0, 1.0]], atol=1e-12)
    assert Polyline(points).length == pytest.approx(5.0 + np.pi, abs=1e-4)
    assert Polyline(points).length <= 5.0 + np.pi


def test_an_arc_is_as_large_as_half_the_shorter_side_allows() -> None:
    points = round_corners(np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 1.0, 0.0]]), 2.0, 0.1)
    np.testing.assert_allclose(points[[1, -2]], [[3.5, 0.0, 0.0], [4.0, 0.5, 0.0]], atol=1e-12)


@pytest.mark.parametrize("end", [(2.0, 0.0, 0.0), (0.5, 0.0, 0.0)])
def test_a_straight_path_and_one_that_turns_back_keep_their_corner(
    end: tuple[float, float, float],
) -> None:
    points = np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), end])
    np.testing.assert_array_equal(round_corners(points, 1.0, 0.1), points)


def test_positions_and_directions_along_a_path() -> None:
    line = Polyline(np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 0.0, 3.0]]))
    np.testing.assert_array_equal(line.position(5.0), [4.0, 0.0, 1.0])
    np.testing.assert_array_equal(line.position(-1.0), [0.0, 0.0, 0.0])
    np.testing.assert_array_equal(line.position(9.0), [4.0, 0.0, 3.0])
    np.testing.assert_array_equal(line.direction(1), [0.0, 0.0, 1.0])
    assert line.follow(0, np.array([4.2, 0.0, 1.0])) == (1, pytest.approx(0.2), 5.0)
    assert line.follow(0, np.array([3.0, 1.0, 0.0])) == (0, 1.0, 3.0)
