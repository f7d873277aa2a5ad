"""Trajectories: the paths of the bodies of ``<showTrajectory>``, for a viewer.

The position of a body is read 60 times a second, as the window of the original UWSim does. A point
is added when the body is more than 0.02 m from the last point. With a ``timeWindow`` above 0, older
points are removed.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array, Pose
from ..base.record import Record
from ..scene.sim_params import ShowTrajectorySpec
from ..world import Body

MIN_SPACING = 0.02
"""The minimum distance between two points [m]."""
SAMPLE_RATE = 60.0
"""The rate at which the position of the body is read [Hz]."""
MAX_POINTS = 1_000_000
"""The maximum number of points; the oldest are removed first."""


@dataclass(slots=True)
class TrajectoryState(Record):
    """The state of a trajectory: the path of a body."""

    points: deque[tuple[float, float, float, float]]
    """The points, each with its time [s] and its position in L [m]."""


class Trajectory:
    """The path of a body.

    Args:
        spec: the ``<showTrajectory>`` element: line style, colour and time window.
        body: the body whose path is recorded.
        localized_from_world: the pose of W in L.
        clock: returns the simulation time [s].
    """

    def __init__(
        self,
        spec: ShowTrajectorySpec,
        body: Body,
        localized_from_world: Pose,
        clock: Callable[[], float],
    ) -> None:
        self.spec = spec
        """The colour, the style and the time window."""
        self._body, self._clock = body, clock
        self._localized_from_world = localized_from_world
        self.state = TrajectoryState(deque(maxlen=MAX_POINTS))
        """The path."""

    @property
    def points(self) -> Array:
        """The positions in L, oldest first, (n, 3) [m]."""
        self._remove_old_points()
        return np.array([point[1:] for point in self.state.points], dtype=float).reshape(-1, 3)

    @property
    def times(self) -> Array:
        """The times of the positions, (n,) [s]."""
        self._remove_old_points()
        return np.array([point[0] for point in self.state.points], dtype=float)

    def add_point(self) -> None:
        """Add a point if the body has moved."""
        position = self._body.world_from_body.position[None, :]
        x, y, z = self._localized_from_world.transform(position)[0].tolist()
        last_point = self.state.points[-1] if self.state.points else None
        if (
            last_point is None
            or (x - last_point[1]) ** 2 + (y - last_point[2]) ** 2 + (z - last_point[3]) ** 2
            > MIN_SPACING**2
        ):
            self.state.points.append((self._clock(), x, y, z))
        self._remove_old_points()

    def clear(self) -> None:
        """Remove all points."""
        self.state.points.clear()

    def _remove_old_points(self) -> None:
        window, now = self.spec.time_window, self._clock()
        while window > 0.0 and self.state.points and now - self.state.points[0][0] > window:
            self.state.points.popleft()
