r"""A linear picture from exposures: numbers that are proportional to the light of one second.

The numbers of a file are made linear, the mean of the dark frames is subtracted, and the result is
divided by the exposure time. A pixel takes its number from the longest exposure in which no frame
saturates it. So the core of an LED comes from a short exposure and its halo from a long one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from ...errors import BadSetting
from ...optics.phase_function import FloatArray
from .frames import FrameMean

SATURATION = 0.98
"""The share of the full scale from which a pixel counts as saturated."""
BLACK_LEVEL_ERROR = 1e-5
"""The standard deviation of the black level after subtraction of the dark frames, of full scale."""

Encoding = Literal["linear", "srgb"]


@dataclass(frozen=True, eq=False)
class Exposure:
    """The frames of one exposure time."""

    time: float
    """The exposure time, of any unit that is the same for all exposures."""
    frames: FrameMean
    """The frames."""
    dark_frames: FrameMean | None
    """The frames without light; None if the files have no black level."""


@dataclass(frozen=True, eq=False)
class LinearPicture:
    """A linear picture in one channel."""

    values: FloatArray
    """The light of each pixel, (rows, columns)."""
    variances: FloatArray
    """The variance of each number by noise."""
    black_errors: FloatArray
    """The standard deviation of each number by the black level, alike in the whole picture."""
    is_valid: npt.NDArray[np.bool_]
    """The mask that is true for pixels that are not saturated in every exposure."""


def combine_exposures(
    exposures: Sequence[Exposure], *, plane: int, full_scale: float, encoding: Encoding
) -> LinearPicture:
    """Combine exposures of the same view to a linear picture of one plane.

    Args:
        exposures: the exposures.
        plane: the index of the colour plane.
        full_scale: the number of a file at which the sensor is saturated.
        encoding: the encoding of the files' numbers.

    Raises:
        BadSetting: the exposures differ in size or lack the plane.
    """
    shapes = {
        frames.values.shape for e in exposures for frames in (e.frames, e.dark_frames) if frames
    }
    if len(shapes) != 1:
        sizes = ", ".join(sorted(map(str, shapes)))
        raise BadSetting(f"exposures and dark frames have the sizes {sizes}; expected one size.")
    [(rows, columns, n_planes)] = shapes
    if plane >= n_planes:
        raise BadSetting(f"the pictures have {n_planes} planes; plane {plane} does not exist.")
    values, variances = np.zeros((rows, columns)), np.zeros((rows, columns))
    black_errors, is_valid = np.zeros((rows, columns)), np.zeros((rows, columns), dtype=bool)
    for exposure in sorted(exposures, key=lambda entry: entry.time):
        light, variance = linearise(exposure.frames, plane, full_scale, encoding)
        if exposure.dark_frames is not None:
            dark_light, dark_variance = linearise(exposure.dark_frames, plane, full_scale, encoding)
            light, variance = light - dark_light, variance + dark_variance
        is_usable = exposure.frames.peaks[..., plane] < SATURATION * full_scale
        values = np.where(is_usable, light / exposure.time, values)
        variances = np.where(is_usable, variance / exposure.time**2, variances)
        black_errors = np.where(is_usable, BLACK_LEVEL_ERROR / exposure.time, black_errors)
        is_valid |= is_usable
    return LinearPicture(values, variances, black_errors, is_valid)


def linearise(
    frames: FrameMean, plane: int, full_scale: float, encoding: Encoding
) -> tuple[FloatArray, FloatArray]:
    """Return the light of each pixel as a share of full scale, and its variance by noise."""
    shares = frames.values[..., plane] / full_scale
    variances = frames.variances[..., plane] / full_scale**2
    if encoding == "linear":
        return shares, variances
    # IEC 61966-2-1.
    bases = (np.maximum(shares, 0.04045) + 0.055) / 1.055
    light = np.where(shares <= 0.04045, shares / 12.92, bases**2.4)
    slopes = np.where(shares <= 0.04045, 1.0 / 12.92, 2.4 / 1.055 * bases**1.4)
    return light, variances * slopes**2
