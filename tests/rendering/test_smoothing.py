"""The mean of squares of pixels, by which edges become smooth."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.rendering.smoothing import mean_of_squares


@pytest.mark.parametrize("bits", [np.uint8, np.uint16])
@pytest.mark.parametrize("edge", [1, 2, 3])
def test_each_pixel_is_the_mean_of_its_square_halves_up(bits: type, edge: int) -> None:
    most = np.iinfo(bits).max
    large = np.random.default_rng(1).integers(0, most, (4 * edge, 5 * edge, 3), bits, endpoint=True)
    large[:edge, :edge] = most
    small = mean_of_squares(large, edge)
    squares = large.reshape(4, edge, 5, edge, 3).astype(float)
    assert small.dtype == bits
    assert np.array_equal(small, np.floor(squares.mean(axis=(1, 3)) + 0.5))
    assert (small[0, 0] == most).all()


def test_a_half_is_rounded_up() -> None:
    large = np.array([[[1], [2]], [[2], [1]]], np.uint8)
    assert mean_of_squares(large, 2).tolist() == [[[2]]]
