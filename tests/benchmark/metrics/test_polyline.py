"""Where along a path a point is, against dense sampling."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from uwsim.benchmark.metrics.polyline import Polyline

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
