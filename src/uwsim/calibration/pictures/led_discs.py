r"""The light of an LED within discs around it.

The irradiance of the camera by light from a disc is the sum of the radiance over its solid angle,
times the cosine of the angle :math:`\alpha` to the optical axis. A pixel of a camera with the focal
length :math:`f` [pixels] has the solid angle :math:`\cos^3\alpha / f^2`, so that its weight is
:math:`\cos^4\alpha`. Pictures are taken as proportional to radiance: correct vignetting first.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...errors import BadSetting
from ...optics.phase_function import FloatArray
from .linear_picture import LinearPicture

HALF_ANGLES = tuple(math.radians(angle) for angle in (0.25, 0.5, 1.0, 2.0, 5.0, 10.0))
"""The half-angles of the discs [rad]."""
BRIGHT_SHARE = 0.01
"""The share of the brightest pixels, whose centroid is the LED."""
MIN_BRIGHT_PIXELS = 4


@dataclass(frozen=True)
class Sum:
    """A sum over pixels, with its standard deviation."""

    value: float
    error: float


def find_led(picture: LinearPicture) -> tuple[float, float]:
    """Find the centre of an LED: the centroid of the brightest 1 % of the pixels.

    Returns:
        The column and the row [pixels].
    """
    values = np.where(picture.is_valid, picture.values, picture.values.max())
    n_bright = max(int(BRIGHT_SHARE * values.size), MIN_BRIGHT_PIXELS)
    threshold = float(np.partition(values.ravel(), -n_bright)[-n_bright])
    weights = np.maximum(values - max(threshold, 0.0), 0.0)
    total = float(weights.sum())
    if not total > 0.0:
        raise BadSetting("no light of an LED: all pixels are dark.")
    # Squared weights prefer the core to the halo.
    weights = weights * weights
    rows, columns = np.indices(values.shape)
    total = float(weights.sum())
    return float((weights * columns).sum()) / total, float((weights * rows).sum()) / total


def sum_discs(
    picture: LinearPicture,
    centre: tuple[float, float],
    focal_length: float,
    half_angles: Sequence[float] = HALF_ANGLES,
) -> list[Sum | None]:
    """Sum the light of discs around a point.

    Args:
        picture: the picture.
        centre: the column and the row of the point [pixels].
        focal_length: the focal length in the water [pixels].
        half_angles: the half-angles of the discs [rad].

    Returns:
        The sum of each disc; None if it leaves the picture or has a saturated pixel.
    """
    rows, columns = np.indices(picture.values.shape)
    x, y = columns - centre[0], rows - centre[1]
    radii = np.hypot(x, y)
    cosines = focal_length / np.sqrt(focal_length**2 + radii * radii)
    weights = (cosines * cosines) ** 2
    height, width = picture.values.shape
    margin = min(centre[0], centre[1], width - 1 - centre[0], height - 1 - centre[1])
    sums: list[Sum | None] = []
    for half_angle in half_angles:
        radius = focal_length * math.tan(half_angle)
        mask: FloatArray = np.clip(radius - radii + 0.5, 0.0, 1.0) * weights
        if radius > margin + 0.5 or not picture.is_valid[mask > 0.0].all():
            sums.append(None)
            continue
        variance = float((mask * mask * picture.variances).sum())
        black_error = float((mask * picture.black_errors).sum())
        value = float((mask * picture.values).sum())
        sums.append(Sum(value, math.hypot(math.sqrt(variance), black_error)))
    return sums
