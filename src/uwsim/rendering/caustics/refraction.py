r"""The refraction of the sun's beam at a sloped surface, and its linear form.

A ray in the direction :math:`i` meets the surface with the unit normal
:math:`m = (-s_x, -s_y, 1) / \sqrt{1 + s^2}`. With :math:`\cos\theta = -i \cdot m` and
:math:`\cos\theta_w = \sqrt{1 - (1 - \cos^2\theta) / n^2}` it continues in the direction

.. math:: t = \frac{1}{n}\, i + \left(\frac{\cos\theta}{n} - \cos\theta_w\right) m

(Snell's law). The drift :math:`u(s) = t_{xy} / (-t_z)` is its horizontal way for each metre of
depth. A level surface has :math:`u(0)`, and small slopes have :math:`u(0) + M s`. With the sun at
the zenith, :math:`M = (n - 1)/n`: so a crest of the height :math:`a` and the wave number :math:`k`
focuses in the depth :math:`n / ((n - 1) a k^2)`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ...base.numerics.jit import njit
from ..physical.daylight_field import MIN_ELEVATION, REFRACTIVE_INDEX
from ..physical.physical_water import Daylight

SUN_RADIUS = math.radians(0.2666)
"""The angular radius of the sun [rad]."""
STEP = 1e-5
"""The step of slopes and angles for derivatives."""


@dataclass(frozen=True, eq=False)
class Beam:
    """The sun's beam at the surface."""

    towards_sun: Array
    """The unit vector towards the sun in air, in W, (3,)."""
    level_drift: Array
    """The drift u(0) below a level surface, (2,) [1]."""
    slope_matrix: Array
    """The derivative M of the drift by the slopes, (2, 2) [1]."""
    disc_covariance: Array
    """The covariance of the drift by the sun's disc, (2, 2) [1]."""


def make_beam(daylight: Daylight) -> Beam:
    """Return the beam of a sun."""
    elevation, azimuth = max(daylight.elevation, MIN_ELEVATION), daylight.azimuth
    sun = _find_direction(elevation, azimuth)
    drift = compute_drift(sun, 0.0, 0.0)
    matrix = np.stack(
        [
            (compute_drift(sun, STEP, 0.0) - compute_drift(sun, -STEP, 0.0)) / (2.0 * STEP),
            (compute_drift(sun, 0.0, STEP) - compute_drift(sun, 0.0, -STEP)) / (2.0 * STEP),
        ],
        axis=1,
    )
    lower_drift, higher_drift = (
        compute_drift(_find_direction(elevation + side * STEP, azimuth), 0.0, 0.0)
        for side in (-1.0, 1.0)
    )
    radial = (higher_drift - lower_drift) / (2.0 * STEP)
    # A turn of the azimuth by an angle moves the sun by that angle times the cosine.
    tangential = np.array([-drift[1], drift[0]]) / max(math.cos(elevation), STEP)
    if math.cos(elevation) < STEP:
        tangential = np.array([-radial[1], radial[0]])
    covariance = (
        0.25 * SUN_RADIUS**2 * (np.outer(radial, radial) + np.outer(tangential, tangential))
    )
    return Beam(sun, drift, matrix, covariance)


def _find_direction(elevation: float, azimuth: float) -> Array:
    cosine = math.cos(elevation)
    return np.array([cosine * math.cos(azimuth), cosine * math.sin(azimuth), math.sin(elevation)])


def compute_drift(towards_sun: Array, slope_x: float, slope_y: float) -> Array:
    """Compute the horizontal way of refracted sunlight for each metre of depth, (2,)."""
    sun = tuple(towards_sun.tolist())
    x, y, _ = refract(sun, slope_x, slope_y, REFRACTIVE_INDEX, 1.0)
    return np.array([x, y])


@njit
def refract(
    sun: Sequence[float], slope_x: float, slope_y: float, index: float, unit: float
) -> tuple[float, float, float]:
    """Refract the sun's beam at a slope; return the drift along x and y, and the light that enters.

    All arguments have one type, single or double precision, which is that of the results.

    Args:
        sun: the unit vector towards the sun, of three numbers; z is above 0.
        slope_x: the slope of the surface along x.
        slope_y: the slope of the surface along y.
        index: the refractive index.
        unit: the number 1.

    Returns:
        The drift along x and y [1], and twice the light that enters through a unit of horizontal
        area over that on a surface across the beam [1].
    """
    zero = unit - unit
    scale = unit / np.sqrt(unit + slope_x * slope_x + slope_y * slope_y)
    projected_area = max(sun[2] - sun[0] * slope_x - sun[1] * slope_y, zero)
    cosine = projected_area * scale
    refracted_cosine = np.sqrt(unit - (unit - cosine * cosine) / (index * index))
    along_normal = (cosine / index - refracted_cosine) * scale
    down = unit / (sun[2] / index - along_normal)
    amplitude_s = (cosine - index * refracted_cosine) / (cosine + index * refracted_cosine)
    amplitude_p = (refracted_cosine - index * cosine) / (refracted_cosine + index * cosine)
    entering_light = unit + unit - amplitude_s * amplitude_s - amplitude_p * amplitude_p
    return (
        (-sun[0] / index - along_normal * slope_x) * down,
        (-sun[1] / index - along_normal * slope_y) * down,
        projected_area * entering_light,
    )
