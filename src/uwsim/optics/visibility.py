r"""How far one sees in water: conversions of its coefficients to quantities of users.

================  ==============================================================================
quantity          formula
================  ==============================================================================
fog density       :math:`\sqrt{-\ln M(\psi, d_0)} / d_0` of UWSim's law; :math:`\sqrt{c / d_0}` for
                  the sharpest detail
visual range      :math:`4.8 / c` of a black target, seen horizontally, c in the green (J. R. V.
                  Zaneveld and W. S. Pegau, *Opt. Express* 11, 2997 (2003)); :math:`-\ln C / c` for
                  the contrast threshold :math:`C`
Secchi depth      :math:`8.69 / (c + K_d)` (R. W. Preisendorfer, *Limnol. Oceanogr.* 31, 909 (1986))
own-lamp range    the range from which on the contrast of white and black is below a threshold
================  ==============================================================================

One water has no single fog density: it depends on the distance and on the scale of the detail.
Give both with the number. Not modelled: the observer, the camera's noise, the slope of the sun.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ..base.numerics.elementwise import log
from ..errors import BadSetting
from .lamp_light import Lamp, compute_lamp_veil, compute_target_radiance
from .medium import Medium
from .phase_function import FloatArray, PhaseFunction
from .transmission import compute_direct, compute_modulation_transfer

BLACK_TARGET_FACTOR = 4.8
"""The attenuation lengths at which a black target vanishes for a diver."""
SECCHI_FACTOR = 8.69
"""Preisendorfer's constant of the Secchi disc; published values are 8 to 9.6."""
WHITE_ALBEDO = 0.9
BLACK_ALBEDO = 0.05
MIN_RANGE = 0.05
"""The smallest range that is searched [m]."""
MAX_RANGE = 200.0
"""The greatest range that is searched [m]."""
N_RANGES = 400
N_BISECTIONS = 40


def find_feature_frequency(width: float, distance: float) -> float:
    """Return the frequency of a feature [cycles/rad]: half a cycle is its width.

    Args:
        width: the width of the feature [m].
        distance: its range [m].
    """
    return distance / (2.0 * width)


def compute_transfer(
    water: Medium, distance: npt.ArrayLike, frequency: float | None = None
) -> FloatArray:
    """Compute the fraction of contrast that is left of a detail, (..., n).

    Args:
        water: the water, of n channels.
        distance: the ranges [m], (...).
        frequency: the frequency of the detail [cycles/rad]; None is the sharpest detail, exp(-c R).
    """
    if frequency is None:
        return compute_direct(water, distance)
    return compute_modulation_transfer(water, frequency, distance)


def compute_fog_density(
    water: Medium, distance: float, frequency: float | None = None
) -> FloatArray:
    """Compute the density of UWSim's fog that leaves as much contrast at a distance [1/m], (n,).

    Args:
        water: the water, of n channels.
        distance: the distance d0 at which both agree [m].
        frequency: the frequency of the detail [cycles/rad]; None is the sharpest detail.
    """
    density: FloatArray = np.sqrt(-log(compute_transfer(water, distance, frequency))) / distance
    return density


def find_attenuation_of_fog(density: float, distance: float) -> float:
    """Return the beam attenuation [1/m] that acts on sharp detail at a distance as a fog does."""
    return density * density * distance


def find_attenuation_of_contrast(
    transfer: float,
    distance: float,
    *,
    albedo: float,
    phase_function: PhaseFunction,
    frequency: float | None = None,
) -> float:
    """Find the beam attenuation [1/m] that leaves a fraction of the contrast of a detail.

    Args:
        transfer: the share, above 0 and at most 1.
        distance: the range [m].
        albedo: the single-scattering albedo b/c of the water, below 1.
        phase_function: the phase function of the water.
        frequency: the frequency of the detail [cycles/rad]; None is the sharpest detail.

    Raises:
        BadSetting: the share is not above 0 and at most 1, or the albedo not from 0 to below 1.
    """
    if not (0.0 < transfer <= 1.0 and 0.0 <= albedo < 1.0):
        raise BadSetting(
            f"The share of contrast is {transfer:g} and b/c {albedo:g}; expected a share above 0 "
            "and at most 1, and b/c from 0 to below 1."
        )
    low = 0.0
    high = -math.log(transfer) / (distance * (1.0 - albedo))  # all scattered light arrives
    for _ in range(N_BISECTIONS):
        middle = 0.5 * (low + high)
        water = Medium(
            absorption=((1.0 - albedo) * middle,),
            scattering=(albedo * middle,),
            phase_function=phase_function,
        )
        if float(compute_transfer(water, distance, frequency)[0]) > transfer:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def compute_visual_range(water: Medium, contrast: float | None = None) -> FloatArray:
    """Compute the range at which a target vanishes, seen horizontally in daylight [m], (n,).

    Args:
        water: the water, of n channels.
        contrast: the smallest visible contrast; None is a diver who sees a black target.
    """
    factor = BLACK_TARGET_FACTOR if contrast is None else -math.log(contrast)
    return factor * water.attenuation_length


def compute_secchi_depth(water: Medium) -> FloatArray:
    """Compute the depth at which a white disc vanishes, seen from above [m], (n,)."""
    total = water.beam_attenuation + water.diffuse_attenuation
    is_empty = total == 0.0
    depths = SECCHI_FACTOR / np.where(is_empty, 1.0, total)
    return np.where(is_empty, math.inf, depths)


def compute_lamp_contrast(water: Medium, lamp: Lamp, distance: npt.ArrayLike) -> FloatArray:
    """Compute the contrast of white and black planes in the light of a lamp, (..., n).

    The camera is at the origin and looks along z, across the planes; the contrast is that of
    Michelson at the centre of the image, (W - K) / (W + K), with albedos of 0.9 and 0.05. It is 0
    where the lamp does not light the centre.

    Args:
        water: the water, of n channels.
        lamp: the lamp, in the frame of the camera.
        distance: the ranges of the planes [m], (...).
    """
    ranges = np.asarray(distance, dtype=np.float64)
    ray = np.array([0.0, 0.0, 1.0])
    points = ranges[..., None] * ray
    normals = np.broadcast_to(-ray, points.shape)
    camera = (0.0, 0.0, 0.0)
    signal = compute_target_radiance(water, lamp, points, normals, camera)
    veil = compute_lamp_veil(water, lamp, camera, np.broadcast_to(ray, points.shape), ranges)
    total = (WHITE_ALBEDO + BLACK_ALBEDO) * signal + 2.0 * veil
    is_dark = total <= 0.0
    contrast = (WHITE_ALBEDO - BLACK_ALBEDO) * signal / np.where(is_dark, 1.0, total)
    return np.where(is_dark, 0.0, contrast)


def compute_lamp_range(water: Medium, lamp: Lamp, min_contrast: float) -> FloatArray:
    """Compute the range beyond which the contrast in a lamp's light is below a threshold.

    The range is between 0.05 and 200 m: 0 if the contrast is nowhere high enough, infinite if it
    still is at 200 m.

    Args:
        water: the water, of n channels.
        lamp: the lamp, in the frame of the camera, which looks along z.
        min_contrast: the smallest contrast that is sufficient.

    Returns:
        The ranges [m], (n,).
    """
    ratio = (MAX_RANGE / MIN_RANGE) ** (1.0 / (N_RANGES - 1))
    ranges = MIN_RANGE * ratio ** np.arange(N_RANGES)
    contrasts = compute_lamp_contrast(water, lamp, ranges)  # (n_ranges, n)
    results = []
    for channel in range(water.n_channels):
        indices = np.flatnonzero(contrasts[:, channel] >= min_contrast)
        if not len(indices):
            results.append(0.0)
        elif indices[-1] == N_RANGES - 1:
            results.append(math.inf)
        else:
            low, high = float(ranges[indices[-1]]), float(ranges[indices[-1] + 1])
            results.append(_bisect_range(water, lamp, min_contrast, channel, (low, high)))
    return np.array(results)


def _bisect_range(
    water: Medium, lamp: Lamp, min_contrast: float, channel: int, limits: tuple[float, float]
) -> float:
    """Find the range between two limits at which the contrast passes the threshold."""
    low, high = limits
    for _ in range(N_BISECTIONS):
        middle = 0.5 * (low + high)
        if float(compute_lamp_contrast(water, lamp, middle)[channel]) >= min_contrast:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)
