"""Refuses inertias that no body can have, of links and of objects, before the engine does.

Those of hydrodynamics files are checked as these are read.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ..errors import Diagnostic
from ..scene.hydrodynamics.checks import inertia_errors
from ..scene.hydrodynamics.spec import VehicleHydrodynamics
from ..schema import diagnostic_at
from .resolved_scene import ResolvedScene

MIN_MASS = 0.01
"""Of a link whose URDF gives none [kg]."""
MIN_INERTIA = 1e-4
"""Of a link whose URDF gives none [kg m2]."""
MAX_BUOYANCY = 100.0
"""Greatest buoyancy per weight: the lightest foam has 10 kg/m3 [1]."""


def inertias_refused(
    resolved: ResolvedScene, dynamics: Mapping[int, VehicleHydrodynamics]
) -> Iterator[Diagnostic]:
    """Report every inertia that cannot be simulated.

    Args:
        resolved: the scene, with the robot of each vehicle that has one.
        dynamics: of each vehicle that is simulated, by its number.
    """
    scene = resolved.scene
    for index, vehicle in dynamics.items():
        theirs = {body.link for body in vehicle.bodies if body.inertia is not None}
        for link in resolved.robots[index].links:
            if link.name in theirs or not (link.mass > 0.0 and min(link.inertia[:3]) > 0.0):
                continue  # what the URDF says of it is not used
            for said in inertia_errors(f"link {link.name!r}", link.inertia):
                yield diagnostic_at(link, said)
    if not (dynamics or scene.has_uwsim_physics):
        return
    for thing in scene.objects:
        moments = thing.solid.inertia
        if not thing.solid.is_loose or not any(moments):
            continue
        for said in inertia_errors(f"object {thing.name!r}", (*moments, 0.0, 0.0, 0.0)):
            yield diagnostic_at(thing.solid, said, "inertia", file=scene.path)
