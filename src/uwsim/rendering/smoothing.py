"""Smooth edges by supersampling: each pixel is the mean of several pixels of a larger image."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..base.numerics.jit import njit

Pixels = npt.NDArray[np.uint8] | npt.NDArray[np.uint16]


def find_means(
    pixels: Pixels | npt.NDArray[np.float32], edge: int
) -> Pixels | npt.NDArray[np.float32]:
    """Return the mean of each square of pixels, of numbers or of light."""
    if pixels.dtype == np.uint8:
        return mean_of_squares(pixels.view(np.uint8), edge)
    if pixels.dtype == np.uint16:
        return mean_of_squares(pixels.view(np.uint16), edge)
    light = np.zeros_like(pixels[::edge, ::edge], dtype=np.float32)
    for row in range(edge):
        for column in range(edge):
            light += pixels[row::edge, column::edge]
    means: npt.NDArray[np.float32] = light * np.float32(1.0 / edge**2)
    return means


@njit
def mean_of_squares(pixels: Pixels, edge: int) -> Pixels:
    """Return the mean colour of each square of pixels, rounded to nearest, halves up.

    Args:
        pixels: the image, (h, w, channels), of 8 or 16 bits.
        edge: the edge of a square, which divides h and w [px].

    Returns:
        The means, (h / edge, w / edge, channels), with as many bits.
    """
    height, width, channels = pixels.shape[0] // edge, pixels.shape[1] // edge, pixels.shape[2]
    means = np.empty((height, width, channels), pixels.dtype)
    number = np.uint32(edge * edge)
    for row in range(height):
        for column in range(width):
            for channel in range(channels):
                total = number // np.uint32(2)
                for i in range(edge):
                    for j in range(edge):
                        total += np.uint32(pixels[row * edge + i, column * edge + j, channel])
                means[row, column, channel] = total // number
    return means
