r"""The reflectance of rough surfaces under even light, as a table for the shaders.

A surface with a finish reflects the light of a direction :math:`l` towards the camera :math:`v` by

.. math::
    \pi f = C (1 - m) (1 - E(n \cdot v)) + \pi D G F, \quad
    D = \frac{\alpha^2}{\pi ((n \cdot h)^2 (\alpha^2 - 1) + 1)^2}, \quad
    G = \frac{1/2}{n_l \sqrt{n_v^2 (1 - \alpha^2) + \alpha^2} +
        n_v \sqrt{n_l^2 (1 - \alpha^2) + \alpha^2}}

with the albedo :math:`C`, the share of metal :math:`m`, :math:`\alpha` the square of the roughness,
:math:`h` between l and v, :math:`n_l = n \cdot l`, :math:`n_v = n \cdot v`. D is the distribution
of microfacets of T. S. Trowbridge and K. P. Reitz (*J. Opt. Soc. Am.* 65, 531 (1975)), "GGX" of B.
Walter, S. R. Marschner, H. Li and K. E. Torrance (*EGSR* 2007); G is Smith's joint shadowing (E.
Heitz, *J. Comput. Graph. Tech.* 3(2), 48 (2014)). F is Fresnel's reflectance at :math:`v \cdot h`:
of a dielectric of the index 1.5 against water (0.0032 at normal incidence; 0.04 above the surface,
against air) and for metals C. Schlick's :math:`C + (1 - C) (1 - v \cdot h)^5` (*Comput. Graph.
Forum* 13, 233 (1994)), times :math:`1 + C (1 / E - 1)` for the light that microfacets reflect
several times (E. Turquin, "Practical multiple scattering compensation for microfacet models",
2019). Schlick's formula would be twice too bright for a dielectric in water at 70 degrees.

The table has the share :math:`E(n_v, \alpha)` that microfacets reflect of even light: of a mirror
(F = 1), of a dielectric in water, and of one in air. The light that they let through is what
Lambert's surface below reflects, so that no surface reflects more than it receives.

Not modelled: images of surroundings in polished surfaces, anisotropy, coats of varnish.
"""

from __future__ import annotations

import math
from functools import lru_cache

import moderngl
import numpy as np
import numpy.typing as npt

from ...base.geometry import Array

SURFACE_INDEX = 1.5
"""The refractive index of dielectrics."""
WATER_INDEX = 1.34
"""The refractive index of water."""
MIN_ROUGHNESS = 0.08
"""The least roughness; a smoother surface would need a highlight smaller than the sun's image."""
TABLE_SIZE = 32, 32
"""The numbers of cosines and of roughnesses in the table."""
MIN_COSINE = 1e-3
"""The least cosine of the direction of view."""
N_SAMPLES, LATTICE_STEP = 2584, 1597
"""The number of samples of the microfacets, and the step of their lattice: Fibonacci numbers."""


def compute_fresnel(cosine: Array, index: float) -> Array:
    """Compute the reflectance of a dielectric for unpolarised light.

    Args:
        cosine: the cosine of incidence, any shape.
        index: the refractive index relative to the medium, above 1.
    """
    g = np.sqrt(index * index - 1.0 + cosine * cosine)
    ratio = (g - cosine) / (g + cosine)
    second = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0)
    reflectance: Array = 0.5 * ratio * ratio * (1.0 + second * second)
    return reflectance


@lru_cache(maxsize=1)
def compute_table() -> npt.NDArray[np.float32]:
    """Compute the table of reflectances, (roughness, cosine, 4): mirror, in water, in air, 1.

    Cosines and roughnesses are evenly spaced from 0 to 1. The integral over the microfacets is a
    sum over equal shares of their projected area.
    """
    n_cosines, n_roughnesses = TABLE_SIZE
    table = np.ones((n_roughnesses, n_cosines, 4), np.float32)
    for row in range(n_roughnesses):
        roughness = max(row / (n_roughnesses - 1.0), MIN_ROUGHNESS)
        for column in range(n_cosines):
            table[row, column, :3] = compute_even_reflectance(
                max(column / (n_cosines - 1.0), MIN_COSINE), roughness
            )
    return table


def compute_even_reflectance(cosine: float, roughness: float) -> tuple[float, float, float]:
    """Compute E for a mirror, a dielectric in water and one in air.

    Args:
        cosine: the cosine between normal and camera.
        roughness: the roughness.
    """
    square = roughness**4
    heights, turns = _find_samples()
    facet_cosine = np.sqrt((1.0 - heights) / (1.0 + (square - 1.0) * heights))
    facet_sine = np.sqrt(np.maximum(1.0 - facet_cosine * facet_cosine, 0.0))
    view_sine = math.sqrt(1.0 - cosine * cosine)
    incidence = view_sine * facet_sine * turns + cosine * facet_cosine
    light_cosine = 2.0 * incidence * facet_cosine - cosine
    is_valid = (light_cosine > 0.0) & (incidence > 0.0)
    n_l = np.where(is_valid, light_cosine, 1.0)
    joint = 0.5 / (
        n_l * math.sqrt(cosine * cosine * (1.0 - square) + square)
        + cosine * np.sqrt(n_l * n_l * (1.0 - square) + square)
    )
    shares = np.where(is_valid, 4.0 * joint * n_l * incidence / facet_cosine, 0.0)
    angle = np.clip(incidence, 0.0, 1.0)
    water_reflectance = compute_fresnel(angle, SURFACE_INDEX / WATER_INDEX)
    air_reflectance = compute_fresnel(angle, SURFACE_INDEX)
    return (
        min(float(shares.mean()), 1.0),
        min(float((shares * water_reflectance).mean()), 1.0),
        min(float((shares * air_reflectance).mean()), 1.0),
    )


@lru_cache(maxsize=1)
def _find_samples() -> tuple[Array, Array]:
    """Return shares of the microfacets, and cosines of their azimuth, (n,) each."""
    numbers = np.arange(N_SAMPLES)
    azimuths = (numbers * LATTICE_STEP % N_SAMPLES + 0.5) / N_SAMPLES
    turns = np.array([math.cos(math.pi * azimuth) for azimuth in azimuths.tolist()])
    return (numbers + 0.5) / N_SAMPLES, turns


def create_table(context: moderngl.Context) -> moderngl.Texture:
    """Return the table on the GPU, in half precision."""
    pixels = compute_table().astype(np.float16)
    texture = context.texture(TABLE_SIZE, 4, pixels.tobytes(), dtype="f2")
    texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
    texture.repeat_x = texture.repeat_y = False
    return texture
