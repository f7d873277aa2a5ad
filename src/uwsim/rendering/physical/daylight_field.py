r"""Daylight under a level water surface: irradiance over depth, and the light of open water.

The sun's light is refracted (:math:`\sin\theta_w = \sin\theta / n`) and reflected in part (Fresnel,
unpolarised); the sky is isotropic. At depth :math:`z` a level surface receives

.. math::
    E_d = E_0\, [(1 - s)\, T(\theta) + s\, T_{sky}]\, e^{-K_d z}, \quad
    K_d = \frac{1}{\mu} \sqrt{a^2 + (0.473 \mu - 0.218)\, a b}

with the share :math:`s` of the sky and the mean cosine :math:`\mu` of the light below the surface
(J. T. O. Kirk, *Limnol. Oceanogr.* 29, 350 (1984); 0.256 for a sun at the zenith). The sun's beam,
which casts shadows, is the part that keeps its direction in the delta-Eddington sense (J. H.
Joseph, W. J. Wiscombe and J. A. Weinman, *J. Atmos. Sci.* 33, 2452 (1976)): with the share
:math:`f = g^2` of scattering that counts as none,

.. math::
    c^* = a + (1 - f) b, \quad b^* = (1 - f) b, \quad p^* = \mathrm{HG}(g / (1 + g)), \quad
    E_b = E_0 (1 - s)\, T\, e^{-c^* z / \mu_w}

The rest of :math:`E_d` is diffuse, even over the upper hemisphere. Of :math:`E_d` the share

.. math:: R = \frac{x}{1 + x}, \quad x = (0.975 - 0.629 \mu)\, b_b / a

comes up from below. Kirk's reflectance is x; the denominator keeps it below 1 where absorption is
small, and is nearer to the path tracer of the tests.

A camera at depth :math:`z` that looks into open water in direction :math:`v` (upward component
:math:`v_z`) receives the light that is scattered once along its ray, in units in which a white
surface in the irradiance 1 has the radiance 1:

.. math::
    B(v) = b^* \left[ \frac{\pi E_b}{\mu_w}\, p^*(\Theta)\, F(c^* - c^* v_z / \mu_w) +
        (q E_{diff} + (1 - q) E_{up})\, F(c^* - K_d v_z) \right] + L_s\, e^{-c^* l}

with :math:`F(\kappa) = (1 - e^{-\kappa l}) / \kappa` over the way :math:`l` to the surface
(infinite for rays that go down), the share :math:`q` of :math:`p^*` in the upper hemisphere, and
the sky :math:`L_s` in Snell's window. Light from above is stronger than from below, so B is
brighter above than below. All of this is for particles; the molecules of the water add the same
terms with their scattering :math:`b_w`, :math:`q = 1/2` and the phase function
:math:`3 (1 + p \cos^2\Theta) / (4 \pi (3 + p))`, :math:`p = 0.84` (A. Morel, in *Optical Aspects of
Oceanography*, 1974). In the clearest water most of the light that comes back is theirs.

Not modelled: waves, the image and the aureole of the sun, polarisation, walls and floor that shade
the open water.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ...base.geometry import Array
from ...base.numerics.elementwise import exp
from ...base.numerics.linear import product
from ...optics import HenyeyGreenstein, Medium
from .physical_water import Daylight, PhysicalWater

REFRACTIVE_INDEX = 1.34
"""The refractive index of water."""
DIFFUSE_COSINE = 0.859
"""The mean cosine of the light of an even sky below the surface."""
KIRK_SLOPE, KIRK_OFFSET = 0.473, 0.218
"""The coefficients of Kirk's G(mu) = 0.473 mu - 0.218."""
REFLECTANCE_OFFSET, REFLECTANCE_SLOPE = 0.975, 0.629
"""The coefficients of Kirk's irradiance reflectance (0.975 - 0.629 mu) bb / a of deep water."""
MIN_ELEVATION = math.radians(1.0)
"""The least elevation of the sun in the formulas [rad]."""
WINDOW_COSINE = math.sqrt(1.0 - 1.0 / REFRACTIVE_INDEX**2)
"""The cosine at the rim of Snell's window, 48.3 degrees from the zenith."""
WINDOW_SOFTNESS = 0.05
"""The half width of the rim of Snell's window, as a cosine."""
MOLECULAR_POLARISATION = 0.84
"""The degree of polarisation at 90 degrees of light that molecules scatter [1]."""
HEMISPHERE_WIDTH = 0.1
"""The squared width, as a cosine, of the change of the scattered share q at the horizon."""
MAX_EXPONENT = 60.0
MAX_LENGTH = 1e9
"""The greatest way of light [m]; longer ones are set to it."""
N_SKY_ANGLES = 64


@dataclass(frozen=True, eq=False)
class LightField:
    """The daylight in a medium as a function of depth; arrays are per channel, (3,)."""

    towards_sun: Array
    """The unit vector towards the refracted sun, in W, (3,)."""
    beam: Array
    """The irradiance of a level surface by the sun just below the water's surface, (3,)."""
    beam_attenuation: Array
    """The attenuation of the beam over depth, c* / mu_w [1/m], (3,)."""
    total: Array
    """The irradiance of a level surface by sun and sky just below the water's surface, (3,)."""
    diffuse_attenuation: Array
    """The attenuation Kd of the total over depth [1/m], (3,)."""
    reflectance: Array
    """The upward irradiance as a share of the downward one, (3,)."""

    def compute_irradiance(self, depth: float) -> tuple[Array, Array]:
        """Compute the irradiance of a level surface by the beam, and by diffuse light from above.

        Args:
            depth: the depth below the surface [m]; negative depths count as 0.
        """
        z = max(depth, 0.0)
        total = self.total * exp(-self.diffuse_attenuation * z)
        beam = np.minimum(self.beam * exp(-self.beam_attenuation * z), total)
        return beam, total - beam


@lru_cache(maxsize=16)
def compute_light_field(medium: Medium, daylight: Daylight) -> LightField:
    """Compute the daylight in a medium; the arrays are shared, do not change them."""
    elevation = max(daylight.elevation, MIN_ELEVATION)
    sine = math.cos(elevation) / REFRACTIVE_INDEX  # of the refracted angle from the zenith
    cosine = math.sqrt(1.0 - sine * sine)
    beam = (
        daylight.irradiance
        * (1.0 - daylight.sky_share)
        * compute_transmittance(math.sin(elevation))
    )
    sky = daylight.irradiance * daylight.sky_share * compute_sky_transmittance()
    mean_cosine = (beam * cosine + sky * DIFFUSE_COSINE) / (beam + sky) if beam + sky else cosine
    a, b = np.array(medium.absorption), np.array(medium.scattering)
    factor = KIRK_SLOPE * mean_cosine - KIRK_OFFSET
    upwelling = (REFLECTANCE_OFFSET - REFLECTANCE_SLOPE * mean_cosine) * medium.backscattering
    return LightField(
        towards_sun=np.array(
            [sine * math.cos(daylight.azimuth), sine * math.sin(daylight.azimuth), cosine]
        ),
        beam=np.full(len(a), beam),
        beam_attenuation=compute_scaled_attenuation(medium) / cosine,
        total=np.full(len(a), beam + sky),
        diffuse_attenuation=np.sqrt(a * a + factor * a * b) / mean_cosine,
        reflectance=upwelling / np.maximum(a + upwelling, np.finfo(np.float64).tiny),
    )


def compute_scaled_attenuation(medium: Medium) -> Array:
    """Compute c* = a + (1 - g^2) (b - b_w) + b_w [1/m], (3,)."""
    _, scattering = scale_scattering(medium)
    attenuation: Array = np.array(medium.absorption) + scattering + medium.molecules
    return attenuation


def scale_scattering(medium: Medium) -> tuple[HenyeyGreenstein, Array]:
    """Return p* of the particles, and compute their b* = (1 - g^2) (b - b_w) [1/m], (3,)."""
    g = medium.phase_function.mean_cosine
    particles = np.array(medium.scattering) - medium.molecules
    return HenyeyGreenstein(g / (1.0 + g)), (1.0 - g * g) * particles


def compute_transmittance(cosine: float) -> float:
    """Compute the share of unpolarised light that enters water, from the cosine of incidence."""
    refracted_cosine = math.sqrt(1.0 - (1.0 - cosine * cosine) / REFRACTIVE_INDEX**2)
    amplitude_s = (cosine - REFRACTIVE_INDEX * refracted_cosine) / (
        cosine + REFRACTIVE_INDEX * refracted_cosine
    )
    amplitude_p = (refracted_cosine - REFRACTIVE_INDEX * cosine) / (
        refracted_cosine + REFRACTIVE_INDEX * cosine
    )
    return 1.0 - 0.5 * (amplitude_s * amplitude_s + amplitude_p * amplitude_p)


@lru_cache(maxsize=1)
def compute_sky_transmittance() -> float:
    """Compute the share of an isotropic sky's irradiance that enters water."""
    squares = (np.arange(N_SKY_ANGLES) + 0.5) / N_SKY_ANGLES  # equal shares of irradiance
    return math.fsum(compute_transmittance(math.sqrt(x)) for x in squares.tolist()) / N_SKY_ANGLES


def compute_open_water(water: PhysicalWater, depth: float, directions: Array, rate: float) -> Array:
    """Compute the radiance B of open water, in units of a white surface in the irradiance 1.

    Args:
        water: the water and its light.
        depth: the depth of the camera below the surface [m]; negative depths count as 0.
        directions: the unit directions of the camera's rays in W, (n, 3).
        rate: the light rate, a factor on daylight.

    Returns:
        The radiance, (n, 3).
    """
    if water.isotropic_radiance is not None:
        return np.tile(rate * np.array(water.isotropic_radiance), (len(directions), 1))
    medium, field = water.medium, compute_light_field(water.medium, water.daylight)
    z = max(depth, 0.0)
    phase, scattering = scale_scattering(medium)
    attenuation = compute_scaled_attenuation(medium)
    beam, diffuse = field.compute_irradiance(z)
    sun_cosine = field.towards_sun[2]
    up = directions[:, 2:]  # (n, 1)
    length = np.where(up > 0.0, z / np.maximum(up, 1e-6), np.inf)
    cosine = product(directions, field.towards_sun)[:, None]
    molecules = medium.molecules
    beam_part = beam * (math.pi / sun_cosine)
    beam_part = beam_part * (scattering * _evaluate(phase, cosine) + molecules * _molecular(cosine))
    beam_part = beam_part * _integrate(attenuation * (1.0 - up / sun_cosine), length)
    upper = 0.5 + (0.5 - phase.backscatter_ratio) * up / np.sqrt(up * up + HEMISPHERE_WIDTH)
    upward = field.reflectance * (beam + diffuse)
    diffuse_part = scattering * (upper * diffuse + (1.0 - upper) * upward)
    diffuse_part = diffuse_part + molecules * (0.5 * (diffuse + upward))
    diffuse_part = diffuse_part * _integrate(attenuation - field.diffuse_attenuation * up, length)
    scattered_light: Array = rate * (beam_part + diffuse_part)
    if water.has_surface:
        return scattered_light
    surface = _compute_surface_radiance(water.daylight, field, up)
    surface = np.where(up > 0.0, surface * exp(-np.minimum(attenuation * length, 700.0)), 0.0)
    radiance: Array = rate * (beam_part + diffuse_part + surface)
    return radiance


def compute_window_radiance(daylight: Daylight) -> float:
    """Compute the radiance of the sky in Snell's window, just below the surface."""
    transmittance = compute_sky_transmittance() * REFRACTIVE_INDEX**2
    return daylight.irradiance * daylight.sky_share * transmittance


def _compute_surface_radiance(daylight: Daylight, field: LightField, up: Array) -> Array:
    """Compute the radiance of the surface from below: the sky in Snell's window, else a mirror."""
    sky = compute_window_radiance(daylight)
    share = np.clip((up - WINDOW_COSINE) / (2.0 * WINDOW_SOFTNESS) + 0.5, 0.0, 1.0)
    share = share * share * (3.0 - 2.0 * share)
    radiance: Array = share * sky + (1.0 - share) * field.reflectance * field.total
    return radiance


def _evaluate(phase: HenyeyGreenstein, cosine: Array) -> Array:
    g = phase.asymmetry
    root = np.sqrt(1.0 + g * g - 2.0 * g * np.clip(cosine, -1.0, 1.0))
    density: Array = (1.0 - g * g) / (4.0 * math.pi * root * root * root)
    return density


def _molecular(cosine: Array) -> Array:
    p = MOLECULAR_POLARISATION
    density: Array = 3.0 * (1.0 + p * cosine * cosine) / (4.0 * math.pi * (3.0 + p))
    return density


def _integrate(rate: Array, length: Array) -> Array:
    """Compute the integral of exp(-rate t) for t from 0 to a length, which may be infinite."""
    x = np.clip(rate * np.minimum(length, MAX_LENGTH), -MAX_EXPONENT, MAX_EXPONENT)
    is_small = np.abs(x) < 1e-4
    divisor = np.where(is_small, 1.0, rate)
    short_integral = np.minimum(length, MAX_LENGTH) * (1.0 - 0.5 * x)
    integral: Array = np.where(is_small, short_integral, (1.0 - exp(-x)) / divisor)
    return integral
