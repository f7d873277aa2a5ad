"""The path of the camera of a film: a slow orbit, a chase of the vehicle, or a fixed pose."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from ...base.geometry import Array, Intrinsics, Pose, rotation_z
from ...base.numerics.linear import product
from ...errors import BadSetting, did_you_mean
from ...scene.mounts import camera_axes
from ...simulation.views import Size, find_focus, orbit_view
from .trial_scene import TrialScene, frame_at

ViewKind = Literal["orbit", "chase", "fixed", "camera"]
VIEWS: tuple[ViewKind, ...] = get_args(ViewKind)
ORBIT_ANGLE = math.radians(25.0)
"""The angle of the orbit to each side [rad]."""
ORBIT_PERIOD = 40.0
"""The period of the orbit, there and back [s of the film]."""
SMOOTHING_TIME = 1.5
"""The standard deviation of the Gaussian that smooths the path of the camera [s]."""
DISTANCE = 3.0
"""The distance of the chasing camera behind the vehicle, in half diagonals of the subject [1]."""
HEIGHT = 1.1
"""The height of the chasing camera above the vehicle, in the same unit [1]."""


def view_kind(text: str) -> ViewKind:
    """Return the kind of a view by its name; raise BadSetting."""
    for kind in VIEWS:
        if text == kind:
            return kind
    near = did_you_mean(text, VIEWS)
    raise BadSetting(f"--view {text!r}: expected one of {', '.join(VIEWS)}.{near}")


@dataclass(frozen=True, eq=False)
class VehiclePath:
    """The smoothed path of the first vehicle."""

    positions: Array
    """The positions, (frames, 3) [m]; the centre of the view without a vehicle."""
    headings: Array
    """The horizontal directions of the bow, (frames, 3)."""


class CameraPath:
    """The camera's pose over time.

    Args:
        scene: the scene, as it is at the first frame of the film.
        kind: of the view, not ``camera``.
        size: width and height of the image [px].
        start: time of the first frame [s].
    """

    def __init__(self, scene: TrialScene, kind: ViewKind, size: Size, start: float) -> None:
        self._scene, self._kind, self._start = scene, kind, start
        view = orbit_view(scene.simulation, size)
        self.intrinsics: Intrinsics = view.intrinsics
        """The intrinsics of the camera."""
        self._initial_pose = view.world_from_camera
        focus = find_focus(scene.simulation)
        self._radius = 0.5 * float(np.linalg.norm(np.ptp(focus.corners, axis=0)))
        self._vehicle_path = smooth_vehicle_path(scene, focus.middle, focus.bow_direction)
        self._middle = focus.middle
        self._start_position = self._vehicle_path.positions[frame_at(scene.track, start)[0]]

    def pose(self, time: float) -> Pose:
        """Return the camera's pose in W at a time [s]; OpenGL axes."""
        if self._kind == "fixed":
            return self._initial_pose
        frame, _ = frame_at(self._scene.track, time)
        position, heading = self._vehicle_path.positions[frame], self._vehicle_path.headings[frame]
        if self._kind == "chase":
            scale = min(self._radius, 2.0)
            eye = position - DISTANCE * scale * heading + np.array([0.0, 0.0, HEIGHT * scale])
            view = position + 0.5 * scale * heading - eye
            return Pose(eye, camera_axes(view / np.linalg.norm(view), np.array([0.0, 0.0, 1.0])))
        angle = ORBIT_ANGLE * math.sin(2.0 * math.pi * (time - self._start) / ORBIT_PERIOD)
        rotation = rotation_z(angle)
        middle = self._middle + position - self._start_position
        offset = product(rotation, self._initial_pose.position - self._middle)
        return Pose(middle + offset, product(rotation, self._initial_pose.rotation))


def smooth_vehicle_path(scene: TrialScene, middle: Array, heading: Array) -> VehiclePath:
    """Smooth the path of the first vehicle; without one, the view's centre is fixed."""
    world, track = scene.simulation.world, scene.track
    roots = [
        f"{world.model.scene.vehicles[i].name}/{robot.root}"
        for i, robot in world.model.robots.items()
    ]
    if not roots or roots[0] not in track.bodies:
        n = track.n_frames
        return VehiclePath(np.repeat(middle[None], n, axis=0), np.repeat(heading[None], n, axis=0))
    rows = track.poses[:, track.bodies.index(roots[0])]
    w, x, y, z = rows[:, 3:].T
    bow = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), np.zeros(len(rows))], axis=1)
    headings = smooth(bow, track.rate)
    headings /= np.maximum(np.linalg.norm(headings, axis=1, keepdims=True), 1e-9)
    return VehiclePath(smooth(rows[:, :3], track.rate), headings)


def smooth(values: Array, rate: float) -> Array:
    """Smooth values (n, m) taken at a rate [Hz] by a Gaussian; ends are continued."""
    reach = math.ceil(3.0 * SMOOTHING_TIME * rate)
    offsets = np.arange(-reach, reach + 1) / (SMOOTHING_TIME * rate)
    weights = np.exp(-0.5 * offsets * offsets)
    weights /= weights.sum()
    extension = np.pad(values, ((reach, reach), (0, 0)), mode="edge")
    columns = [np.convolve(column, weights, mode="valid") for column in extension.T]
    return np.stack(columns, axis=1)
