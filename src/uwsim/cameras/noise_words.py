"""Random words and normal quantiles for the noise of images, one word for a pixel.

The word of pixel i of an image is splitmix64(key + i), so the noise of an image depends on the key
of the image alone, and not on the processor or the order of the pixels.
"""

from __future__ import annotations

from functools import cache
from statistics import NormalDist

import numpy as np
import numpy.typing as npt

from ..base.numerics.jit import njit

GOLDEN_GAMMA = np.uint64(0x9E3779B97F4A7C15)
MIX_1 = np.uint64(0xBF58476D1CE4E5B9)
MIX_2 = np.uint64(0x94D049BB133111EB)

Words = npt.NDArray[np.uint64]


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


@njit
def fill_words(counter: np.uint64, words: Words) -> None:
    """Write the words of the pixels after a counter, which is the key plus i golden gammas."""
    for index in range(len(words)):
        z = counter + np.uint64(index + 1) * GOLDEN_GAMMA
        z = (z ^ (z >> np.uint64(30))) * MIX_1
        z = (z ^ (z >> np.uint64(27))) * MIX_2
        words[index] = z ^ (z >> np.uint64(31))


@njit
def draw_gaussians(
    key: np.uint64, size: int, quantiles: npt.NDArray[np.float32]
) -> npt.NDArray[np.float32]:
    """Return independent values of N(0, 1) for the three channels of pixels, (size, 3)."""
    mask, numbers = np.uint64(0xFFFF), np.empty(size, np.uint64)
    fill_words(key, numbers)
    values = np.empty((size, 3), np.float32)
    for i in range(size):
        for channel in range(3):
            values[i, channel] = quantiles[(numbers[i] >> np.uint64(16 * channel)) & mask]
    return values
