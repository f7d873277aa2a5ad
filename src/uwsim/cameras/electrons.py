r"""The random numbers of electrons, which depend on a key and the place of the pixel alone.

*Normal law.* With the mean :math:`\lambda` of the Poisson number, the read noise :math:`r` and
:math:`\sigma^2 = \lambda + r^2`, the sum of both has the skewness :math:`\lambda / \sigma^3`. It is

.. math:: e = \lambda + \sigma (1 - \gamma^2 / 36) z + \lambda (z^2 - 1) / (6 \sigma^2),
    \qquad \gamma = \lambda / \sigma^3

for a normal number :math:`z`: the expansion of Cornish and Fisher (1938) to the skewness. Mean and
variance are exact to 1e-4, and the skewness to 5 %. The law holds for a read noise of at least
`EXACT_LIMIT`, where the excess kurtosis that it lacks is at most 0.25.

*Exact law.* With less read noise, means below `INVERSION_LIMIT` get a Poisson number by inversion
of its distribution (Devroye 1986, X.3.3) plus the read noise; others the normal law.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ..base.numerics.jit import njit
from .noise_words import GOLDEN_GAMMA, Words, fill_words

EXACT_LIMIT = 1.0
"""The read noise from which electrons have the normal law at every mean [e-]."""
INVERSION_LIMIT = 30.0
"""The mean from which electrons have the normal law without read noise [e-]."""
SECOND_WORD = np.uint64(0xD1B54A32D192ED03)
"""The offset of the key of a second word of each pixel."""
UNIT_21 = 1.0 / 2097152.0

Floats = npt.NDArray[np.float32]
Numbers = npt.NDArray[np.uint16]


@njit
def draw_numbers(
    light: Floats, falloff: Floats, parameters: Floats, key: np.uint64, quantiles: Floats,
    numbers: Numbers,
) -> None:  # fmt: skip
    """Write the digital numbers of light by the normal law.

    Args:
        light: the light of each pixel, (h, w, channels of light).
        falloff: the vignetting, (h, w) [1].
        parameters: the electrons of the light 1, of the dark current, of the read noise and of the
            full well; the gain [DN/e-]; the black level [DN]; 1 with noise, else 0.
        key: the key of the image.
        quantiles: the table of normal numbers.
        numbers: the digital numbers, (h, w, channels), which are written.
    """
    height, width, channels = numbers.shape
    stride = light.shape[2]
    scale, dark_electrons, read_noise, full_well = (
        parameters[0],
        parameters[1],
        parameters[2],
        parameters[3],
    )
    gain, black, has_noise = parameters[4], parameters[5], parameters[6]
    unit, zero, half, top = np.float32(1), np.float32(0), np.float32(0.5), np.float32(4095)
    epsilon, sixth, share = np.float32(1e-12), np.float32(1 / 6), np.float32(1 / 36)
    read_variance = read_noise * read_noise
    words = np.empty(width, np.uint64)
    # Row by row, in separate loops: the compiler vectorises those without tables.
    deviations, means = (
        np.zeros(channels * width, np.float32),
        np.zeros(channels * width, np.float32),
    )
    counter = key
    for row in range(height):
        light_row, falloff_row = light[row].reshape(-1), falloff[row]
        numbers_row = numbers[row].reshape(-1)
        if has_noise > zero:
            fill_words(counter, words)
            counter += np.uint64(width) * GOLDEN_GAMMA
            look_up_deviations(words, quantiles, channels, deviations)
        if channels == 3 and stride == 3:
            for column in range(width):
                factor = scale * falloff_row[column]
                for channel in range(3):
                    means[3 * column + channel] = light_row[3 * column + channel] * factor
        else:
            for column in range(width):
                factor = scale * falloff_row[column]
                for channel in range(channels):
                    means[channels * column + channel] = (
                        light_row[stride * column + channel] * factor
                    )
        for index in range(channels * width):
            mean = max(means[index], zero) + dark_electrons
            electrons = mean
            if has_noise > zero:
                z = deviations[index]
                variance = mean + read_variance + epsilon
                inverse = unit / variance
                ratio = mean * inverse
                gamma = ratio * ratio * inverse
                electrons += np.sqrt(variance) * (unit - share * gamma) * z
                electrons += sixth * ratio * (z * z - unit)
            number = min(electrons, full_well) * gain + black + half
            numbers_row[index] = np.uint16(np.int32(max(min(number, top), zero)))


@njit
def look_up_deviations(words: Words, quantiles: Floats, channels: int, deviations: Floats) -> None:
    """Write the normal numbers of a row, (channels * n,), by words of 16 bit each."""
    mask = np.uint64(0xFFFF)
    if channels == 3:
        for column in range(len(words)):
            word = words[column]
            deviations[3 * column] = quantiles[word & mask]
            deviations[3 * column + 1] = quantiles[(word >> np.uint64(16)) & mask]
            deviations[3 * column + 2] = quantiles[(word >> np.uint64(32)) & mask]
    else:
        for column in range(len(words)):
            deviations[column] = quantiles[words[column] & mask]


@njit
def draw_rare_numbers(
    light: Floats, falloff: Floats, parameters: Floats, key: np.uint64, quantiles: Floats,
    numbers: Numbers,
) -> None:  # fmt: skip
    """Write the digital numbers of light by the exact law; see `draw_numbers`."""
    height, width, channels = numbers.shape
    scale, dark_electrons, read_noise, full_well = (
        parameters[0],
        parameters[1],
        parameters[2],
        parameters[3],
    )
    gain, black = parameters[4], parameters[5]
    words, second_words = np.empty(width, np.uint64), np.empty(width, np.uint64)
    counter = key
    for row in range(height):
        fill_words(counter, words)
        fill_words(counter + SECOND_WORD, second_words)
        counter += np.uint64(width) * GOLDEN_GAMMA
        for column in range(width):
            factor = scale * falloff[row, column]
            for channel in range(channels):
                mean = max(light[row, column, channel] * factor, np.float32(0)) + dark_electrons
                shift = np.uint64(16 * channel)
                z = quantiles[(second_words[column] >> shift) & np.uint64(0xFFFF)]
                if mean < np.float32(INVERSION_LIMIT):
                    bits = (words[column] >> np.uint64(21 * channel)) & np.uint64(0x1FFFFF)
                    count = invert_poisson((float(bits) + 0.5) * UNIT_21, float(mean))
                    electrons = min(np.float32(count), full_well) + read_noise * z
                else:
                    y = quantiles[(words[column] >> shift) & np.uint64(0xFFFF)]
                    shot = np.sqrt(mean) * y + (y * y - np.float32(1)) * np.float32(1 / 6)
                    electrons = min(mean + shot, full_well) + read_noise * z
                number = electrons * gain + black + np.float32(0.5)
                number = max(min(number, np.float32(4095)), np.float32(0))
                numbers[row, column, channel] = np.uint16(np.int32(number))


@njit
def invert_poisson(share: float, mean: float) -> int:
    """Return the least number whose cumulative Poisson probability exceeds a share, 0..1."""
    probability = math.exp(-mean)
    total, count = probability, 0
    while total < share and count < 200:
        count += 1
        probability *= mean / count
        total += probability
    return count
