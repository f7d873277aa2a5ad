"""Camera noise: its moments, its independence, and that it comes from the key alone."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.base.rng import stream
from uwsim.rendering.noise import add_noise, frame_key, gaussian_quantiles

GREY = np.full((240, 320, 4), 30000, np.uint16)
LEVEL = 30000 / 257.0  # in 8-bit steps
N = 240 * 320


def noisy(seed: int, std: float = 0.05) -> np.ndarray:
    return add_noise(GREY, std, stream(seed, "camera/noise")).astype(float) - LEVEL


def test_the_table_has_mean_nought_and_variance_one() -> None:
    table = gaussian_quantiles().astype(float)
    assert table.mean() == pytest.approx(0.0, abs=1e-7)
    assert table.var() == pytest.approx(1.0, abs=1e-6)
    assert np.all(np.diff(table) >= 0.0)


@pytest.mark.parametrize("std", [0.005, 0.02, 0.05])
def test_mean_and_spread_are_as_asked(std: float) -> None:
    noise = noisy(1, std)
    spread = np.sqrt((255.0 * std) ** 2 + 1.0 / 12.0)  # storing 8 bits adds its own
    assert noise.mean() == pytest.approx(0.0, abs=4.0 * spread / np.sqrt(3 * N))
    assert noise.std() == pytest.approx(spread, rel=4.0 / np.sqrt(6 * N))


def test_the_noise_is_gaussian() -> None:
    noise = noisy(2) / noisy(2).std()
    assert (noise**3).mean() == pytest.approx(0.0, abs=4.0 * np.sqrt(6.0 / (3 * N)))
    assert (noise**4).mean() == pytest.approx(3.0, abs=4.0 * np.sqrt(24.0 / (3 * N)))


def correlation(a: np.ndarray, b: np.ndarray) -> float:
    return float(np.corrcoef(a.ravel(), b.ravel())[0, 1])


@pytest.mark.parametrize(("one", "other"), [(0, 1), (0, 2), (1, 2)])
def test_channels_are_independent(one: int, other: int) -> None:
    noise = noisy(3)
    assert abs(correlation(noise[..., one], noise[..., other])) < 4.0 / np.sqrt(N)


@pytest.mark.parametrize("shift", [(0, 1), (1, 0), (1, 1), (0, 2), (7, 3)])
def test_neighbours_are_independent(shift: tuple[int, int]) -> None:
    noise = noisy(4)
    moved = np.roll(noise, shift, axis=(0, 1))
    for channel in range(3):
        assert abs(correlation(noise[..., channel], moved[..., channel])) < 4.0 / np.sqrt(N)


def test_frames_are_independent() -> None:
    rng = stream(5, "camera/noise")
    first = add_noise(GREY, 0.05, rng).astype(float)
    second = add_noise(GREY, 0.05, rng).astype(float)
    assert abs(correlation(first, second)) < 4.0 / np.sqrt(3 * N)


def test_equal_streams_give_equal_bytes() -> None:
    assert np.array_equal(noisy(6), noisy(6))
    assert not np.array_equal(noisy(6), noisy(7))


def test_one_number_is_drawn_for_each_frame_however_large() -> None:
    drawn, skipped = stream(8, "camera/noise"), stream(8, "camera/noise")
    add_noise(GREY, 0.05, drawn)
    frame_key(skipped)
    assert drawn.integers(2**63) == skipped.integers(2**63)


def test_black_and_white_clip_instead_of_wrapping() -> None:
    black = add_noise(np.zeros((50, 50, 4), np.uint16), 0.02, stream(9, "n"))
    white = add_noise(np.full((50, 50, 4), 65535, np.uint16), 0.02, stream(9, "n"))
    assert black.max() < 30
    assert white.min() > 225
    assert (black == 0).mean() == pytest.approx(0.5, abs=0.06)


def test_without_noise_the_image_is_rounded_to_nearest() -> None:
    ramp = np.arange(65536, dtype=np.uint16).reshape(256, 256)
    image = add_noise(np.repeat(ramp[..., None], 4, axis=2), 0.0, stream(10, "n"))
    assert np.array_equal(image[..., 1], np.floor(ramp / 257.0 + 0.5).astype(np.uint8))
