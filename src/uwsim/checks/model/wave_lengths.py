"""Warnings about vehicles that are long compared with the waves, which they would diffract.

A body shorter than a fifth of the wave length hardly disturbs the waves (DNV-RP-C205, 2010, section
6.1.2). Not checked: vehicles that begin deeper than half of the wave length, where the water hardly
moves.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress

from ...errors import Diagnostic, UwsimError
from ...model.collision.hull import hull_of
from ...model.dynamics import DYNAMICS
from ...scene.accepted_warnings import acceptance_hint
from ..subjects import CheckedScene

MAX_LENGTH_RATIO = 0.2
"""The greatest length of a body that hardly disturbs waves, over the length of the waves [1]."""


def long_vehicles(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of vehicles with dynamics that are longer than a fifth of the shortest waves' length.

    The length of a wave system is that of its peak.
    """
    ocean = scene.spec.ocean_state
    lengths = [2.0 * math.pi / number for s in ocean.waves if (number := s.peak_number(ocean.sea))]
    if not lengths:
        return
    wave_length = min(lengths)
    for index in scene.dynamics:
        vehicle = scene.spec.vehicles[index]
        pose = scene.spec.world_from_localized @ vehicle.localized_from_base
        depth = ocean.ocean_surface_height - float(pose.position[2])
        if "waves" in vehicle.accepts or depth > 0.5 * wave_length:
            continue
        with suppress(UwsimError):  # reported where models are checked
            hull = hull_of(scene.resolved_scene, index)
            if hull is not None and hull.size > MAX_LENGTH_RATIO * wave_length:
                yield scene.warning(
                    vehicle,
                    f"the vehicle {vehicle.name!r}: it is {hull.size:.3g} m long and waves are "
                    f"{wave_length:.3g} m; it would diffract them, which is not modelled. Expected "
                    f"waves longer than {hull.size / MAX_LENGTH_RATIO:.3g} m. "
                    f"{acceptance_hint('waves')}",
                    DYNAMICS,
                )
