r"""The resistance curve of a tow: linear and quadratic damping along one axis.

A body is pulled along a rail by a constant force F, as by a falling weight (Froude's towing tank),
until its speed v is steady. The forces and speeds of several tows give

.. math:: F = d_1 v + d_2 v^2

by least squares of the relative errors. The body cannot turn or leave the rail, and the water is at
rest. Not modelled: the walls of a tank, and waves at its surface.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....base.geometry import Array
from .decay import fit_two_powers


@dataclass(frozen=True, eq=False, kw_only=True)
class Resistance:
    """The resistance along an axis."""

    speeds: Array
    """The steady speeds, (n,) [m/s or rad/s]."""
    forces: Array
    """The forces that pulled, (n,) [N or N m]."""
    linear: float
    """The linear damping :math:`d_1` [N s/m or N m s]."""
    quadratic: float
    """The quadratic damping :math:`d_2` [N s2/m2 or N m s2]."""


def fit_resistance(speeds: Array, forces: Array) -> Resistance:
    """Fit linear and quadratic damping to steady speeds and forces, all greater than 0."""
    linear, quadratic = fit_two_powers(speeds, forces)
    return Resistance(
        speeds=np.asarray(speeds), forces=np.asarray(forces), linear=linear, quadratic=quadratic
    )
