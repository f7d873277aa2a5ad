r"""Acoustic backscatter of surfaces by material and angle of incidence.

The backscattering cross section of a square metre at the angle of incidence :math:`\theta`,
measured from the surface normal,

.. math::

    \sigma(\theta) = \frac{R^2}{8 \pi s^2 \cos^4\theta} \exp\left(-\frac{\tan^2\theta}{2 s^2}\right)
                     + 10^{\mu / 10} \cos^2\theta ,

is the sum of a specular and a diffuse term. The first describes specular reflection from facets
with the reflection coefficient :math:`R` and Gaussian slopes of the root mean square :math:`s`; the
second is Lambert's law with the backscattering strength :math:`\mu` [dB]. The generic seafloor
acoustic backscatter model has the same two terms (G. Lamarche, X. Lurton et al., *Quantitative
characterisation of seafloor substrate and bedforms using advanced processing of multibeam
backscatter*, Continental Shelf Research 31, 2011). In this model the cross section of a large
sphere of radius a is :math:`R^2 a^2 / 4` (for small :math:`s`), and the echo of a large plate at
the distance h equals that of its image source at the distance 2 h (for any :math:`s`).

The reflection coefficients of seabeds follow from the densities and sound speeds of APL-UW (*High-
frequency ocean environmental acoustic models handbook*, TR 9407, 1994, table 2); strengths and
slopes are typical values. Not modelled: dependence on frequency, penetration of the seabed,
resonance of thin walls.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

MaterialName = Literal[
    "clay", "silt", "fineSand", "sand", "coarseSand", "gravel", "cobble", "rock",
    "concrete", "wood", "steel", "smoothSteel", "waterSurface",
]  # fmt: skip


@dataclass(frozen=True)
class Material:
    """The acoustic properties of a surface."""

    reflection: float
    """The amplitude reflection coefficient at normal incidence, R [1]."""
    slope: float
    """The root mean square slope of the surface's facets, s [1]."""
    strength: float
    """The backscattering strength of the diffuse (Lambert) term for a square metre, mu [dB]."""


MATERIALS: dict[MaterialName, Material] = {
    "clay": Material(0.06, 0.10, -38.0),
    "silt": Material(0.06, 0.10, -35.0),
    "fineSand": Material(0.23, 0.12, -31.0),
    "sand": Material(0.37, 0.15, -27.0),
    "coarseSand": Material(0.47, 0.18, -25.0),
    "gravel": Material(0.54, 0.22, -22.0),
    "cobble": Material(0.64, 0.30, -19.0),
    "rock": Material(0.72, 0.35, -17.0),
    "concrete": Material(0.68, 0.12, -25.0),
    "wood": Material(0.35, 0.15, -28.0),
    "steel": Material(0.94, 0.12, -24.0),
    "smoothSteel": Material(0.94, 0.06, -35.0),
    "waterSurface": Material(1.00, 0.20, -25.0),
}
"""The materials, of medium roughness, in the order of `MaterialName`."""

assert tuple(MATERIALS) == get_args(MaterialName)
