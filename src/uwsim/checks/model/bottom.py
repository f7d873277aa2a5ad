"""Warnings about DVLs that do not detect the seabed at the start.

The seabed consists of the fixed objects that have contacts, and of terrain. Not checked: other
vehicles and loose objects.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import numpy as np

from ...errors import Diagnostic, UwsimError
from ...model.placement import ground_faces
from ...model.terrain import height_grids, height_rays
from ...rays import RayScene, Surface
from ...scene.accepted_warnings import acceptance_hint
from ...scene.mounts import MountFrames
from ...scene.pointing import describe_direction
from ...scene.spec import SceneSpec
from ...scene.urdf.robot import RobotSpec
from ...sensors.dvl_sensor import DvlSensorSpec
from ...sensors.janus import MIN_BEAMS, Janus
from ..subjects import CheckedScene

MAX_RANGE = 20000.0
"""The greatest range of the search for the seabed along each beam [m]."""


def velocity_logs(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of DVLs that do not detect the seabed at the start."""
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
            if message := bottom and bottom.describe_miss(spec, index, robots[index]):
                yield scene.warning(spec, f"{spec.name!r}: {message}. {acceptance_hint('bottom')}")


class Bottom:
    """The seabed of a scene, for the beams of DVLs.

    Args:
        scene: the spec of the scene.
        data_path: the folders that are searched for files.

    Raises:
        UwsimError: a mesh cannot be read.
    """

    def __init__(self, scene: SceneSpec, data_path: tuple[Path, ...]) -> None:
        self._scene = scene
        faces = ground_faces(scene, data_path)
        grids = height_grids(scene, data_path).items()
        self._rays = RayScene(
            [[Surface(index, part, True) for index, part in faces.items()]],
            [height_rays(grid, index) for index, grid in grids],
        )

    def describe_miss(self, spec: DvlSensorSpec, index: int, robot: RobotSpec) -> str:
        """Describe why a DVL does not detect the seabed at the start; empty if it does.

        Args:
            spec: the DVL.
            index: the index of its vehicle in the scene.
            robot: the robot of the vehicle.
        """
        frames = MountFrames(self._scene.vehicles[index], robot, self._scene.world_from_localized)
        janus = Janus(math.radians(spec.beam_angle))
        hits = self._rays.cast(frames.world_from_mounted(spec), janus.directions, MAX_RANGE)
        axial = hits.distance * janus.cosine
        if spec.is_bottom(axial).sum() >= MIN_BEAMS:
            return ""
        ranges = axial[np.isfinite(axial)]
        range_text = f"at {ranges.min():.3g} to {ranges.max():.3g} m" if len(ranges) else "nowhere"
        return (
            f"it has no bottom track at the start. It {describe_direction(spec, frames)}, and its "
            f"beams hit the seabed {range_text}; expected {MIN_BEAMS} hits or more at "
            f"{spec.min_altitude:g} to {spec.max_altitude:g} m"
        )
