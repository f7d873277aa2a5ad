"""The density of a scene's water as a function of depth."""

from __future__ import annotations

from collections.abc import Mapping

from ..scene.hydrodynamics import VehicleHydrodynamics
from ..scene.ocean_state import DEFAULT_TEMPERATURE, OceanStateSpec
from ..scene.seawater import sea_water_density

SEA_DENSITY = sea_water_density(DEFAULT_TEMPERATURE, 35.0)
"""The density of water if neither the scene nor a hydrodynamics file gives one [kg/m3]."""


def density_levels(
    ocean: OceanStateSpec, dynamics: Mapping[int, VehicleHydrodynamics]
) -> tuple[tuple[float, float], ...]:
    """Return the depth [m] and density [kg/m3] of each level; uniform water has one level.

    Args:
        ocean: the spec of the water.
        dynamics: the hydrodynamics of the vehicles, whose density applies if the scene gives none.
    """
    if ocean.profile is not None:
        return ocean.profile.levels
    densities = [ocean.water_density, *(vehicle.density for vehicle in dynamics.values())]
    set_densities = (density for density in densities if density is not None)
    return ((0.0, next(set_densities, SEA_DENSITY)),)
