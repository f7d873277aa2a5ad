from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm

from tests.algorithms.textures import rectangle
from uwsim.algorithms.esm.homography import (
    exponential,
    homography_between,
    is_convex,
    normalize_determinant,
    warp,
)

QUAD = rectangle(0.0, 0.0, 2.0, 2.0)
coordinates = st.lists(st.floats(-1.5, 1.5), min_size=8, max_size=8)


def generators() -> np.ndarray:
    """The eight matrices A_i of sl(3), (8, 3, 3), as `exponential` orders them."""
    a = np.zeros((8, 3, 3))
    a[0, 0, 2] = a[1, 1, 2] = a[2, 0, 1] = a[3, 1, 0] = a[6, 2, 0] = a[7, 2, 1] = 1.0
    a[4] = np.diag([1.0, -1.0, 0.0])
    a[5] = np.diag([1.0, 1.0, -2.0]) / 3.0
    return a


@given(coordinates)
def test_the_exponential_is_that_of_the_sum_of_generators(x: list[float]) -> None:
    expected = expm(np.tensordot(np.array(x), generators(), axes=1))
    assert exponential(np.array(x)) == pytest.approx(expected, rel=1e-11, abs=1e-11)


@given(coordinates)
def test_a_step_keeps_the_determinant_at_one(x: list[float]) -> None:
    assert np.linalg.det(exponential(np.array(x))) == pytest.approx(1.0, abs=1e-9)


def test_the_generators_span_the_traceless_matrices() -> None:
    a = generators()
    assert np.trace(a, axis1=1, axis2=2) == pytest.approx(np.zeros(8))
    assert np.linalg.matrix_rank(a.reshape(8, 9)) == 8


@pytest.mark.parametrize(
    ("index", "motion"),
    [
        (0, lambda u, v: (1, 0)),
        (1, lambda u, v: (0, 1)),
        (2, lambda u, v: (v, 0)),
        (3, lambda u, v: (0, u)),
        (4, lambda u, v: (u, -v)),
        (5, lambda u, v: (u, v)),
        (6, lambda u, v: (-u * u, -u * v)),
        (7, lambda u, v: (-u * v, -v * v)),
    ],
)
def test_each_generator_moves_points_as_the_jacobian_says(index: int, motion) -> None:
    point = np.array([[0.3, -0.7]])
    x = np.zeros(8)
    x[index] = 1e-6
    moved = (warp(exponential(x), point) - point)[0] / 1e-6
    assert moved == pytest.approx(np.array(motion(0.3, -0.7), dtype=float), abs=1e-5)


@given(st.lists(st.floats(-0.4, 0.4), min_size=8, max_size=8))
def test_a_homography_between_quads_sends_corner_to_corner(offsets: list[float]) -> None:
    target = QUAD + np.array(offsets).reshape(4, 2)
    homography = homography_between(QUAD, target)
    assert warp(homography, QUAD) == pytest.approx(target, abs=1e-9)
    assert np.linalg.det(homography) == pytest.approx(1.0)


def test_scaling_to_determinant_one_does_not_move_points() -> None:
    homography = 7.0 * homography_between(QUAD, QUAD + 0.1 * QUAD[::-1])
    assert warp(normalize_determinant(homography), QUAD) == pytest.approx(warp(homography, QUAD))


def test_convex_is_both_ways_round_but_neither_crossed_nor_flat_nor_bent_in() -> None:
    assert is_convex(QUAD)
    assert is_convex(QUAD[::-1])
    assert not is_convex(QUAD[[0, 2, 1, 3]])
    assert not is_convex(QUAD * [1.0, 0.0])
    bent = QUAD.copy()
    bent[0] = [0.5, 0.5]
    assert not is_convex(bent)
    assert not is_convex(QUAD * np.nan)
