"""Grey as the original makes it."""

from __future__ import annotations

import numpy as np

from uwsim.rendering.grey import grey_truncated


def test_each_term_is_truncated_before_the_sum() -> None:
    rgb = np.random.default_rng(0).integers(0, 256, (64, 64, 3), dtype=np.uint8)
    red, green, blue = (rgb[..., i].astype(float) for i in range(3))
    expected = np.trunc(0.2989 * red) + np.trunc(0.5870 * green) + np.trunc(0.1140 * blue)
    assert np.array_equal(grey_truncated(rgb), expected)


def test_white_is_254_and_black_is_0() -> None:
    assert grey_truncated(np.full((1, 1, 3), 255, np.uint8))[0, 0] == 254
    assert grey_truncated(np.zeros((1, 1, 3), np.uint8))[0, 0] == 0
