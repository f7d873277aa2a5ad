"""Where the viewer of a film is: a slow orbit, behind the vehicle, or standing still."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from ...base.geometry import Array, Intrinsics, Pose, rotation_z
from ...base.numerics.linear import product
from ...errors import BadSetting, did_you_mean
from ...scene.mounts import camera_axes
from ...simulation.views import Size, focus_of, orbit_view
from .puppets import Puppets, frame_at

ViewKind = Literal["orbit", "chase", "fixed", "camera"]
VIEWS: tuple[ViewKind, ...] = get_args(ViewKind)
SWAY = math.radians(25.0)
"""How far the orbit goes to each side [rad]."""
PERIOD = 40.0
"""Time in which it does so, there and back [s of the film]."""
SMOOTHING = 1.5
"""Standard deviation of the Gaussian that smooths the way of the viewer [s]."""
BEHIND = 3.0
"""Distance of the chasing viewer behind the vehicle, in halves of its diagonal [1]."""
ABOVE = 1.1
"""Its height above the vehicle, in the same [1]."""


def view_kind(text: str) -> ViewKind:
    """Return the kind of a view as it is typed; raises BadSetting."""
    for each in VIEWS:
        if text == each:
            return each
    near = did_you_mean(text, VIEWS)
    raise BadSetting(f"--view {text!r}: expected one of {', '.join(VIEWS)}.{near}")


@dataclass(frozen=True, eq=False)
class Leader:
    """The first vehicle's way, smoothed."""

    positions: Array
    """(frames, 3) [m]; the middle of the scene where there is no vehicle."""
    headings: Array
    """Where it looks, level, (frames, 3)."""


class CameraPath:
    """The viewer's pose over time.

    Args:
        puppets: the scene, as it is at the first frame of the film.
        kind: of the view, not ``camera``.
        size: width and height of the image [px].
        start: time of the first frame [s].
    """

    def __init__(
        self,
        puppets: Puppets,
        kind: ViewKind,
        size: Size,
        start: float,
    ) -> None:
        self._puppets, self._kind, self._start = puppets, kind, start
        view = orbit_view(puppets.simulation, size)
        self.intrinsics: Intrinsics = view.intrinsics
        """The pinhole."""
        self._first = view.world_from_camera
        focus = focus_of(puppets.simulation)
        self._radius = 0.5 * float(np.linalg.norm(np.ptp(focus.corners, axis=0)))
        self._leader = leader_of(puppets, focus.middle, focus.ahead)
        self._middle = focus.middle
        self._from = self._leader.positions[frame_at(puppets.track, start)[0]]

    def pose(self, time: float) -> Pose:
        """Return the viewer's pose in W at a time [s]; OpenGL axes."""
        if self._kind == "fixed":
            return self._first
        frame, _ = frame_at(self._puppets.track, time)
        here, ahead = self._leader.positions[frame], self._leader.headings[frame]
        if self._kind == "chase":
            own = min(self._radius, 2.0)
            eye = here - BEHIND * own * ahead + np.array([0.0, 0.0, ABOVE * own])
            look = here + 0.5 * own * ahead - eye
            return Pose(eye, camera_axes(look / np.linalg.norm(look), np.array([0.0, 0.0, 1.0])))
        angle = SWAY * math.sin(2.0 * math.pi * (time - self._start) / PERIOD)
        turn = rotation_z(angle)
        middle = self._middle + here - self._from
        offset = product(turn, self._first.position - self._middle)
        return Pose(middle + offset, product(turn, self._first.rotation))


def leader_of(puppets: Puppets, middle: Array, ahead: Array) -> Leader:
    """Smooth the way of the first vehicle; without one the viewer's centre stands still."""
    world, track = puppets.simulation.world, puppets.track
    roots = [
        f"{world.model.scene.vehicles[i].name}/{robot.root}"
        for i, robot in world.model.robots.items()
    ]
    if not roots or roots[0] not in track.bodies:
        n = track.n_frames
        return Leader(np.repeat(middle[None], n, axis=0), np.repeat(ahead[None], n, axis=0))
    rows = track.poses[:, track.bodies.index(roots[0])]
    w, x, y, z = rows[:, 3:].T
    bow = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), np.zeros(len(rows))], axis=1)
    headings = smoothed(bow, track.rate)
    headings /= np.maximum(np.linalg.norm(headings, axis=1, keepdims=True), 1e-9)
    return Leader(smoothed(rows[:, :3], track.rate), headings)


def smoothed(values: Array, rate: float) -> Array:
    """Smooth values (n, m) taken at a rate [Hz] by a Gaussian; ends are continued."""
    reach = math.ceil(3.0 * SMOOTHING * rate)
    at = np.arange(-reach, reach + 1) / (SMOOTHING * rate)
    weights = np.exp(-0.5 * at * at)
    weights /= weights.sum()
    padded = np.pad(values, ((reach, reach), (0, 0)), mode="edge")
    columns = [np.convolve(column, weights, mode="valid") for column in padded.T]
    return np.stack(columns, axis=1)
