r"""Noise of a camera: independent Gaussian noise in every channel of every pixel, stored as 8 bit.

For each image, one 64-bit key is drawn from the camera's random generator. Three of the four 16-bit
words of splitmix64(key + i) are the indices, in a table of quantiles of the normal distribution, of
the noise of pixel i. So the noise of an image depends on its key alone.

Not modelled: shot noise (all grey levels are equally noisy), fixed-pattern noise.
"""

from __future__ import annotations

from functools import cache
from statistics import NormalDist

import numpy as np
import numpy.typing as npt

from ..base.numerics.jit import njit

_GOLDEN_GAMMA = np.uint64(0x9E3779B97F4A7C15)
_MIX_1 = np.uint64(0xBF58476D1CE4E5B9)
_MIX_2 = np.uint64(0x94D049BB133111EB)


@cache
def gaussian_quantiles() -> npt.NDArray[np.float32]:
    """Return 65536 equally likely values of N(0, 1), ascending, with a variance of exactly one."""
    normal = NormalDist()
    upper_half = np.array([normal.inv_cdf((i + 0.5) / 65536.0) for i in range(32768, 65536)])
    values = np.concatenate([-upper_half[::-1], upper_half])
    quantiles: npt.NDArray[np.float32] = (values / values.std()).astype(np.float32)
    return quantiles


def frame_key(rng: np.random.Generator) -> int:
    """Draw the random key of one image.

    It is drawn also for an image that nothing reads, so that later images have the same noise.
    """
    return int(rng.integers(2**63))


def add_noise(
    colour16: npt.NDArray[np.uint16], std: float, rng: np.random.Generator
) -> npt.NDArray[np.uint8]:
    """Add N(0, std) to every channel and store 8 bits, rounded to nearest and clipped.

    Args:
        colour16: the colours as `Renderer.draw` returns them for ``linear16``, (h, w, 4), 0..65535.
        std: the standard deviation, as a fraction of full scale (0.02 is 5.1 grey levels).
        rng: the camera's generator; exactly one number is drawn.

    Returns:
        The image, (h, w, 3).
    """
    return _store(
        colour16, np.float32(255.0 * std), np.uint64(frame_key(rng)), gaussian_quantiles()
    )


@njit
def _store(
    colour16: npt.NDArray[np.uint16],
    levels: np.float32,
    key: np.uint64,
    quantiles: npt.NDArray[np.float32],
) -> npt.NDArray[np.uint8]:
    height, width, _ = colour16.shape
    image = np.empty((height, width, 3), np.uint8)
    scale, half = np.float32(1.0 / 257.0), np.float32(0.5)
    mask = np.uint64(0xFFFF)
    # Row by row, in separate loops: the compiler vectorises the first and the last.
    numbers, deviations = np.empty(width, np.uint64), np.empty(3 * width, np.float32)
    counter = key
    for row in range(height):
        for column in range(width):
            z = counter + np.uint64(column + 1) * _GOLDEN_GAMMA
            z = (z ^ (z >> np.uint64(30))) * _MIX_1
            z = (z ^ (z >> np.uint64(27))) * _MIX_2
            numbers[column] = z ^ (z >> np.uint64(31))
        counter += np.uint64(width) * _GOLDEN_GAMMA
        for column in range(width):
            z = numbers[column]
            deviations[3 * column] = quantiles[z & mask]
            deviations[3 * column + 1] = quantiles[(z >> np.uint64(16)) & mask]
            deviations[3 * column + 2] = quantiles[(z >> np.uint64(32)) & mask]
        linear_row, stored_row = colour16[row].reshape(-1), image[row].reshape(-1)
        for column in range(width):
            for channel in range(3):
                index = 3 * column + channel
                value = np.float32(linear_row[4 * column + channel]) * scale
                value = value + levels * deviations[index] + half
                stored_row[index] = np.uint8(max(min(value, np.float32(255.0)), np.float32(0.0)))
    return image
