"""Trajectories: where the bodies of ``<showTrajectory>`` went, kept for a viewer.

A point is added when the body is more than 0.02 m from the last one, looked at 60 times a second
as the original's window does; with ``timeWindow`` above 0 points go after that time.
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

SPACING = 0.02
"""Least distance between two points [m]."""
RATE = 60.0
"""How often the body is looked at [Hz]."""
MAX_POINTS = 1_000_000
"""Most points that are kept; the oldest go first."""


@dataclass(slots=True)
class TrajectoryState(Record):
    """Where a body went."""

    points: deque[tuple[float, float, float, float]]
    """When [s], and where in L [m]."""


class Trajectory:
    """Where a body went.

    Args:
        spec: of whose trajectory it is, and how it is drawn.
        body: the body.
        localized_from_world: from W to L.
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
        """Colour, style and time window."""
        self._body, self._clock = body, clock
        self._localized_from_world = localized_from_world
        self.state = TrajectoryState(deque(maxlen=MAX_POINTS))
        """Where it went."""

    @property
    def points(self) -> Array:
        """Where it was, in L, oldest first, (n, 3) [m]."""
        self._forget()
        return np.array([point[1:] for point in self.state.points], dtype=float).reshape(-1, 3)

    @property
    def times(self) -> Array:
        """When it was there, (n,) [s]."""
        self._forget()
        return np.array([point[0] for point in self.state.points], dtype=float)

    def look(self) -> None:
        """Add a point if the body has moved."""
        world = self._body.world_from_body.position[None, :]
        x, y, z = self._localized_from_world.transform(world)[0].tolist()
        last = self.state.points[-1] if self.state.points else None
        if (
            last is None
            or (x - last[1]) ** 2 + (y - last[2]) ** 2 + (z - last[3]) ** 2 > SPACING**2
        ):
            self.state.points.append((self._clock(), x, y, z))
        self._forget()

    def clear(self) -> None:
        """Forget all points."""
        self.state.points.clear()

    def _forget(self) -> None:
        """Drop what is older than the time window."""
        window, now = self.spec.time_window, self._clock()
        while window > 0.0 and self.state.points and now - self.state.points[0][0] > window:
            self.state.points.popleft()
