"""Warnings about DVLs that find no bottom at the start.

The bottom is what stands fixed and can be touched, and terrain; other vehicles and free objects
are not looked at.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import numpy as np

from ...errors import Diagnostic, UwsimError
from ...model.placement import ground_faces
from ...rays import RayScene, Surface
from ...scene.accepted_warnings import unless_meant
from ...scene.mounts import MountFrames
from ...scene.pointing import describe_direction
from ...scene.spec import SceneSpec
from ...scene.urdf.robot import RobotSpec
from ...sensors.dvl_sensor import DvlSensorSpec
from ...sensors.janus import ENOUGH, Janus
from ..subjects import CheckedScene

FARTHEST = 20000.0
"""How far the bottom is looked for along each beam [m]."""


def velocity_logs(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of DVLs that find no bottom at the start."""
    vehicles, robots = scene.spec.vehicles, scene.robots
    logs = [
        (index, spec)
        for index in scene.checked_vehicles
        for spec in vehicles[index].parts_of(DvlSensorSpec)
        if "bottom" not in vehicles[index].accepts
        and robots[index].link(spec.relative_to) is not None
    ]
    with suppress(UwsimError):  # reported where models are checked
        bottom = Bottom(scene.spec, scene.data_path) if logs else None
        for index, spec in logs:
            if text := bottom and bottom.missed_by(spec, index, robots[index]):
                yield scene.warning(spec, f"{spec.name!r}: {text}. {unless_meant('bottom')}")


class Bottom:
    """The bottom of a scene, for the beams of DVLs.

    Args:
        scene: spec of the scene.
        data_path: folders in which files are looked for.

    Raises:
        UwsimError: a mesh cannot be read.
    """

    def __init__(self, scene: SceneSpec, data_path: tuple[Path, ...]) -> None:
        self._scene = scene
        faces = ground_faces(scene, data_path)
        self._rays = RayScene([[Surface(index, each, True) for index, each in faces.items()]])

    def missed_by(self, spec: DvlSensorSpec, index: int, robot: RobotSpec) -> str:
        """Describe how a DVL of a vehicle misses the bottom at the start; empty if it finds it."""
        frames = MountFrames(self._scene.vehicles[index], robot, self._scene.world_from_localized)
        janus = Janus(math.radians(spec.beam_angle))
        hits = self._rays.cast(frames.world_from_mounted(spec), janus.directions, FARTHEST)
        axial = hits.distance * janus.cosine
        if spec.is_bottom(axial).sum() >= ENOUGH:
            return ""
        met = axial[np.isfinite(axial)]
        where = f"at {met.min():.3g} to {met.max():.3g} m" if len(met) else "nowhere"
        return (
            f"it has no bottom track at the start: it {describe_direction(spec, frames)}, and its "
            f"beams meet the bottom {where}; expected {ENOUGH} beams or more that meet it at "
            f"{spec.min_altitude:g} to {spec.max_altitude:g} m"
        )
