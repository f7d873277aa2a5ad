r"""The radiance of the sky, from clear to overcast.

The distribution of luminance is that of the CIE general sky (CIE S 011, ISO 15469:2004): type 12,
a clear sky with low turbidity, and type 1, an overcast sky, mixed by the share of the sky in the
irradiance. At the angle :math:`Z` from the zenith and :math:`\chi` from the sun,

.. math::
    l = \left(1 + a\, e^{b / \cos Z}\right)
        \left(1 + c \left(e^{d \chi} - e^{d \pi / 2}\right) + e \cos^2 \chi\right)

The hue of the clear sky is that of CIE daylight (D. B. Judd, D. L. MacAdam and G. Wyszecki,
*J. Opt. Soc. Am.* 54, 1031 (1964)), from 20000 K at the zenith to 6500 K at the horizon; overcast
skies are white. Radiance is scaled so that the luminance of a level surface under the sky is the
share of the sky in `Daylight.irradiance`. The sun has the rest of each channel, so sun and sky
together are white, as `daylight_field` assumes.

Not modelled: clouds, the colour of the setting sun, polarisation, light that the sea reflects.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ...base.geometry import Array
from ...base.numerics.elementwise import arccos, exp
from ...base.numerics.linear import product
from ..physical.physical_water import Daylight

CLEAR_SKY = (-1.0, -0.32, 10.0, -3.0, 0.45)
"""The coefficients a to e of the CIE sky of type 12."""
OVERCAST_SKY = (4.0, -0.7, 0.0, -1.0, 0.0)
"""The coefficients a to e of the CIE sky of type 1."""
CLEAR_SHARE = 0.3
"""The share of the sky in the irradiance up to which it is clear [1]."""
ZENITH_MIRED, HORIZON_MIRED = 50.0, 154.0
"""The inverse colour temperatures of a clear sky [1e6/K]."""
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
"""The shares of red, green and blue in luminance (ITU-R BT.709)."""
SRGB_FROM_XYZ = np.array(
    [[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]]
)
"""The matrix of IEC 61966-2-1, (3, 3)."""
MIN_COSINE = 0.01
"""The least cosine of the zenith angle in the formula; below it the sky is that of the horizon."""
N_HEIGHTS, N_AZIMUTHS = 128, 128
"""The numbers of angles of the integral over the sky."""


@dataclass(frozen=True, eq=False)
class Sky:
    """The radiance of a sky, in units in which a white surface in the irradiance 1 has 1."""

    towards_sun: Array
    """The unit vector towards the sun above the water, in W, (3,)."""
    overcast_share: float
    """The share of the overcast sky in the mixture [1]."""
    level: float
    """The factor on the relative distribution of radiance."""
    irradiance: Array
    """The irradiance of a level surface by the sky, (3,)."""
    sun_irradiance: Array
    """The irradiance of a surface that faces the sun, by the sun, (3,)."""

    def compute_radiance(self, directions: Array) -> Array:
        """Compute the radiance without the sun's disc.

        Args:
            directions: unit vectors in W, (n, 3); below the horizon the value is that above.

        Returns:
            The radiance, (n, 3).
        """
        return self.level * _compute_distribution(directions, self.towards_sun, self.overcast_share)


@lru_cache(maxsize=16)
def compute_sky(daylight: Daylight) -> Sky:
    """Compute the sky of a daylight; the arrays are shared, do not change them."""
    elevation = max(daylight.elevation, math.radians(1.0))
    horizontal_part = math.cos(elevation)
    towards_sun = np.array(
        [
            horizontal_part * math.cos(daylight.azimuth),
            horizontal_part * math.sin(daylight.azimuth),
            math.sin(elevation),
        ]
    )
    share = min(max((daylight.sky_share - CLEAR_SHARE) / (1.0 - CLEAR_SHARE), 0.0), 1.0)
    directions, weights = _make_quadrature()
    distribution = _compute_distribution(directions, towards_sun, share)
    irradiance = product(weights, distribution)  # (3,)
    sky_light = daylight.irradiance * daylight.sky_share
    level = sky_light / float(product(irradiance, LUMINANCE[:, None])[0])
    sky_irradiance = level * irradiance
    sun = np.maximum(daylight.irradiance - sky_irradiance, 0.0)
    if daylight.sky_share >= 1.0:
        sun = np.zeros(3)
    return Sky(
        towards_sun=towards_sun,
        overcast_share=share,
        level=level,
        irradiance=sky_irradiance,
        sun_irradiance=sun / math.sin(elevation),
    )


def compute_sky_levels(sky: Sky) -> tuple[float, float]:
    """Compute the factors on the formulas of the clear and of the overcast sky in the radiance."""
    share = sky.overcast_share
    sun_angle = math.acos(min(max(float(sky.towards_sun[2]), -1.0), 1.0))
    clear_level = sky.level * (1.0 - share) / _integrate_clear(round(sun_angle, 12))
    return clear_level, sky.level * share / _integrate_overcast()


def _compute_distribution(directions: Array, towards_sun: Array, overcast_share: float) -> Array:
    """Compute the relative radiance, whose clear and overcast parts have the irradiance 1."""
    cosine = np.maximum(directions[:, 2], MIN_COSINE)
    angle = arccos(np.clip(product(directions, towards_sun), -1.0, 1.0))
    sun_angle = math.acos(min(max(float(towards_sun[2]), -1.0), 1.0))
    hue = _compute_hue(HORIZON_MIRED + (ZENITH_MIRED - HORIZON_MIRED) * np.sqrt(cosine))
    clear_sky = _compute_gradation(cosine, CLEAR_SKY) * _compute_indicatrix(angle, CLEAR_SKY)
    clear_sky /= _integrate_clear(round(sun_angle, 12))
    overcast_sky = _compute_gradation(cosine, OVERCAST_SKY) / _integrate_overcast()
    radiance: Array = (1.0 - overcast_share) * clear_sky[:, None] * hue
    radiance += overcast_share * overcast_sky[:, None]
    return radiance


def _compute_gradation(cosine: Array, coefficients: tuple[float, ...]) -> Array:
    a, b = coefficients[:2]
    gradation: Array = 1.0 + a * exp(b / cosine)
    return gradation


def _compute_indicatrix(angle: Array, coefficients: tuple[float, ...]) -> Array:
    c, d, e = coefficients[2:]
    cosine = np.cos(angle)
    indicatrix: Array = (
        1.0 + c * (exp(d * angle) - math.exp(0.5 * d * math.pi)) + e * cosine * cosine
    )
    return indicatrix


def _compute_hue(inverse_temperature: Array) -> Array:
    """Compute linear sRGB of CIE daylight with the luminance 1, from 1e6 over the temperature."""
    t = inverse_temperature * 1e-3  # 1000 K over the temperature
    warm_x = 0.244063 + t * (0.09911 + t * (2.9678 - t * 4.6070))  # up to 7000 K
    cold_x = 0.237040 + t * (0.24748 + t * (1.9018 - t * 2.0064))
    x = np.where(inverse_temperature > 1e6 / 7000.0, warm_x, cold_x)
    y = -3.0 * x * x + 2.87 * x - 0.275
    xyz = np.stack([x / y, np.ones_like(x), (1.0 - x - y) / y], axis=-1)
    hue = np.maximum(product(xyz, SRGB_FROM_XYZ.T), 0.0)
    unit: Array = hue / product(hue, LUMINANCE[:, None])
    return unit


@lru_cache(maxsize=1)
def _make_quadrature() -> tuple[Array, Array]:
    """Return directions over the upper hemisphere, (n, 3), and weights, (n,).

    The weighted sum of radiance is the irradiance of a level surface, in units of a white surface.
    """
    # Squares of the cosine: equal steps are equal shares of the irradiance.
    squares = (np.arange(N_HEIGHTS) + 0.5) / N_HEIGHTS
    cosines = np.sqrt(squares)[:, None]
    sines = np.sqrt(1.0 - squares)[:, None]
    azimuths = 2.0 * math.pi * (np.arange(N_AZIMUTHS) + 0.5)[None, :] / N_AZIMUTHS
    directions = np.stack(
        [sines * np.cos(azimuths), sines * np.sin(azimuths), cosines + 0.0 * azimuths], axis=-1
    )
    n = N_HEIGHTS * N_AZIMUTHS
    return directions.reshape(-1, 3), np.full(n, 1.0 / n)


@lru_cache(maxsize=64)
def _integrate_clear(sun_angle: float) -> float:
    directions, weights = _make_quadrature()
    towards_sun = np.array([math.sin(sun_angle), 0.0, math.cos(sun_angle)])
    angle = arccos(np.clip(product(directions, towards_sun), -1.0, 1.0))
    cosine = np.maximum(directions[:, 2], MIN_COSINE)
    values = _compute_gradation(cosine, CLEAR_SKY) * _compute_indicatrix(angle, CLEAR_SKY)
    return math.fsum((weights * values).tolist())


@lru_cache(maxsize=1)
def _integrate_overcast() -> float:
    directions, weights = _make_quadrature()
    values = _compute_gradation(np.maximum(directions[:, 2], MIN_COSINE), OVERCAST_SKY)
    return math.fsum((weights * values).tolist())
