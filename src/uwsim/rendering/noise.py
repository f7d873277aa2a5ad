r"""Noise of a camera: independent Gaussian noise in every channel of every pixel, stored as 8 bit.

For each image, one 64-bit key is drawn from the camera's random generator. Three of the four 16-bit
words of splitmix64(key + i) are the indices, in a table of quantiles of the normal distribution, of
the noise of pixel i. So the noise of an image depends on its key alone.

All grey levels are equally noisy; a camera with a response has shot noise (`uwsim.cameras`).
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..base.numerics.jit import njit
from ..cameras.noise_words import GOLDEN_GAMMA, fill_words, frame_key, gaussian_quantiles


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
        fill_words(counter, numbers)
        counter += np.uint64(width) * GOLDEN_GAMMA
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
