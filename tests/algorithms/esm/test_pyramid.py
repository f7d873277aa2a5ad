from __future__ import annotations

import numpy as np
import pytest

from uwsim.algorithms.esm.homography import warp
from uwsim.algorithms.esm.pyramid import halve, level_from_image, pyramid, to_grey


def test_grey_is_luma() -> None:
    rgb = np.array([[[255, 0, 0], [0, 255, 0], [0, 0, 255], [10, 20, 30]]], np.uint8)
    assert to_grey(rgb)[0] == pytest.approx([76.245, 149.685, 29.07, 18.15], abs=1e-4)


def test_grey_of_a_grey_image_is_itself() -> None:
    mono = np.arange(12, dtype=np.uint8).reshape(3, 4)
    assert to_grey(mono).dtype == np.float32
    assert (to_grey(mono) == mono).all()


def test_a_ramp_is_the_same_ramp_where_a_level_lies_in_its_image() -> None:
    u, v = np.meshgrid(np.arange(40), np.arange(30))
    half = halve((3.0 * u - 2.0 * v).astype(np.float32))
    u, v = np.meshgrid(np.arange(20), np.arange(15))
    points = warp(level_from_image(-1), np.stack([u.ravel(), v.ravel()], axis=1))
    expected = (points @ [3.0, -2.0]).reshape(15, 20)
    assert half[1:-1, 1:-1] == pytest.approx(expected[1:-1, 1:-1], abs=1e-4)


def test_halving_keeps_the_mean_and_quarters_white_noise_or_better() -> None:
    rng = np.random.Generator(np.random.Philox(1))
    noise = (100.0 + 8.0 * rng.standard_normal((200, 300))).astype(np.float32)
    half = halve(noise)
    assert half.mean() == pytest.approx(100.0, abs=0.2)
    assert half.std() == pytest.approx(8.0 * 20 / 64, rel=0.03)  # (1 9 9 1)/64 summed is 20/64


def test_odd_sizes_lose_their_last_row_and_column() -> None:
    assert halve(np.zeros((7, 9), np.float32)).shape == (3, 4)


def test_a_pyramid_ends_before_it_vanishes() -> None:
    assert [i.shape for i in pyramid(np.zeros((9, 40), np.float32), 6)] == [
        (9, 40),
        (4, 20),
        (2, 10),
    ]
