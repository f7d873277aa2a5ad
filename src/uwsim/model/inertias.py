"""Checks of the inertias of links and objects, which the engine would reject with poor messages.

Inertias in hydrodynamics files are checked by their reader.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ..errors import Diagnostic
from ..scene.hydrodynamics.checks import inertia_errors
from ..scene.hydrodynamics.spec import VehicleHydrodynamics
from ..schema import diagnostic_at
from .resolved_scene import ResolvedScene

MIN_MASS = 0.01
"""The mass of a link without a mass in its URDF [kg]."""
MIN_INERTIA = 1e-4
"""The moments of inertia of a link without an inertia in its URDF [kg m2]."""
MAX_BUOYANCY = 100.0
"""The greatest ratio of buoyancy to weight: the lightest foam has 10 kg/m3 [1]."""


def check_inertias(
    resolved_scene: ResolvedScene, dynamics: Mapping[int, VehicleHydrodynamics]
) -> Iterator[Diagnostic]:
    """Yield an error for every inertia that is physically impossible.

    Args:
        resolved_scene: the scene with its robots.
        dynamics: the hydrodynamics of each vehicle with dynamics, by the vehicle's index.
    """
    scene = resolved_scene.scene
    for index, vehicle in dynamics.items():
        set_links = {body.link for body in vehicle.bodies if body.inertia is not None}
        for link in resolved_scene.robots[index].links:
            if link.name in set_links or not (link.mass > 0.0 and min(link.inertia[:3]) > 0.0):
                continue  # the inertia in the URDF is not used
            for error in inertia_errors(f"link {link.name!r}", link.inertia):
                yield diagnostic_at(link, error)
    if not (dynamics or scene.has_original_physics):
        return
    for spec in scene.objects:
        moments = spec.solid.inertia
        if not spec.solid.is_loose or not any(moments):
            continue
        for error in inertia_errors(f"object {spec.name!r}", (*moments, 0.0, 0.0, 0.0)):
            yield diagnostic_at(spec.solid, error, "inertia", file=scene.path)
