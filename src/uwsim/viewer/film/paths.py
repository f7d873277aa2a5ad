"""The path of the camera of a film: a slow orbit, a chase of the vehicle, or a fixed pose."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from ...base.geometry import Array, Intrinsics, Pose, rotation_z
from ...base.numerics.linear import product
from ...errors import BadSetting, did_you_mean
from ...simulation.views import Size, chase_pose, chase_radius, find_focus, orbit_view
from .trial_scene import TrialScene, frame_at

ViewKind = Literal["orbit", "chase", "fixed", "camera"]
VIEWS: tuple[ViewKind, ...] = get_args(ViewKind)
ORBIT_ANGLE = math.radians(25.0)
"""The amplitude of the azimuth in the orbit [rad]."""
ORBIT_PERIOD = 40.0
"""The period of the azimuth in the orbit [s of simulation time]."""
SMOOTHING_TIME = 1.5
"""The standard deviation of the Gaussian that smooths the path of the camera [s]."""


def view_kind(text: str) -> ViewKind:
    """Return the kind of a view by its name; raise BadSetting."""
    for kind in VIEWS:
        if text == kind:
            return kind
    near = did_you_mean(text, VIEWS)
    raise BadSetting(f"--view {text!r}: expected one of {', '.join(VIEWS)}.{near}")


@dataclass(frozen=True, eq=False)
class VehiclePath:
    """The smoothed path of the first vehicle in W.

    In a scene without a vehicle, the position is the centre of the view.
    """

    positions: Array
    """The position in each frame of the track, (n, 3) [m]."""
    bow_directions: Array
    """The horizontal unit vector towards the bow in each frame of the track, (n, 3)."""


class CameraPath:
    """The pose of the camera of an external view over time.

    Args:
        scene: the scene in its state at the first image of the film.
        kind: the kind of the view; not ``camera``.
        size: the width and height of the image [px].
        start: the simulation time of the first image [s].
    """

    def __init__(self, scene: TrialScene, kind: ViewKind, size: Size, start: float) -> None:
        self._scene, self._kind, self._start = scene, kind, start
        view = orbit_view(scene.simulation, size)
        self.intrinsics: Intrinsics = view.intrinsics
        """The intrinsics of the camera."""
        self._initial_pose = view.world_from_camera
        focus = find_focus(scene.simulation)
        self._radius = chase_radius(scene.simulation, focus)
        self._vehicle_path = smooth_vehicle_path(scene, focus.centre, focus.bow_direction)
        self._centre = focus.centre
        self._start_position = self._vehicle_path.positions[frame_at(scene.track, start)[0]]

    def pose(self, time: float) -> Pose:
        """Return the camera's pose in W at a simulation time [s]; OpenGL axes."""
        if self._kind == "fixed":
            return self._initial_pose
        frame, _ = frame_at(self._scene.track, time)
        path = self._vehicle_path
        position, bow_direction = path.positions[frame], path.bow_directions[frame]
        if self._kind == "chase":
            return chase_pose(position, bow_direction, self._radius)
        angle = ORBIT_ANGLE * math.sin(2.0 * math.pi * (time - self._start) / ORBIT_PERIOD)
        rotation = rotation_z(angle)
        centre = self._centre + position - self._start_position
        offset = product(rotation, self._initial_pose.position - self._centre)
        return Pose(centre + offset, product(rotation, self._initial_pose.rotation))


def smooth_vehicle_path(scene: TrialScene, centre: Array, bow_direction: Array) -> VehiclePath:
    """Return the smoothed path of the first vehicle.

    Args:
        scene: the scene and its motion.
        centre: the position in all frames if there is no vehicle, in W, (3,) [m].
        bow_direction: the direction in all frames if there is no vehicle, in W, (3,).
    """
    world, track = scene.simulation.world, scene.track
    roots = [
        f"{world.model.scene.vehicles[i].name}/{robot.root}"
        for i, robot in world.model.robots.items()
    ]
    if not roots or roots[0] not in track.bodies:
        positions, directions = (
            np.repeat(vector[None], track.n_frames, axis=0) for vector in (centre, bow_direction)
        )
        return VehiclePath(positions, directions)
    rows = track.poses[:, track.bodies.index(roots[0])]
    w, x, y, z = rows[:, 3:].T
    bow = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), np.zeros(len(rows))], axis=1)
    directions = smooth(bow, track.rate)
    directions /= np.maximum(np.linalg.norm(directions, axis=1, keepdims=True), 1e-9)
    return VehiclePath(smooth(rows[:, :3], track.rate), directions)


def smooth(values: Array, rate: float) -> Array:
    """Smooth m signals, (n, m), sampled at a rate [Hz], by a Gaussian (`SMOOTHING_TIME`).

    The first and the last sample are repeated beyond the ends.
    """
    reach = math.ceil(3.0 * SMOOTHING_TIME * rate)
    offsets = np.arange(-reach, reach + 1) / (SMOOTHING_TIME * rate)
    weights = np.exp(-0.5 * offsets * offsets)
    weights /= weights.sum()
    extension = np.pad(values, ((reach, reach), (0, 0)), mode="edge")
    columns = [np.convolve(column, weights, mode="valid") for column in extension.T]
    return np.stack(columns, axis=1)
