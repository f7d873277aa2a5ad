"""The density of a scene's water over depth."""

from __future__ import annotations

from collections.abc import Mapping

from ..scene.hydrodynamics import VehicleHydrodynamics
from ..scene.ocean_state import MILD, OceanStateSpec
from ..scene.seawater import sea_water_density

SEA = sea_water_density(MILD, 35.0)
"""Density of water of which nothing is given [kg/m3]."""


def density_levels(
    ocean: OceanStateSpec, dynamics: Mapping[int, VehicleHydrodynamics]
) -> tuple[tuple[float, float], ...]:
    """Return depth [m] and density [kg/m3] of the levels; one level of uniform water.

    Args:
        ocean: what the scene says.
        dynamics: of the vehicles: the water that their sets are for, if the scene says nothing.
    """
    if ocean.profile is not None:
        return ocean.profile.levels
    given = [ocean.water_density, *(each.density for each in dynamics.values())]
    known = (density for density in given if density is not None)
    return ((0.0, next(known, SEA)),)
