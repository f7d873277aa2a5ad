r"""Tracking error: the distance of a body from a place that moves with time.

.. code-block:: xml

    <u:trackingError u:value="rms">
      <name>offset</name> <target>bluerov2</target>
      <trajectory> <shape>circle</shape> <centre> <x>0</x> <y>0</y> <z>2</z> </centre>
                   <radius>1</radius> <period>20</period> </trajectory>
    </u:trackingError>

With ``<relativeTo>leader</relativeTo>``, the trajectory is that of the vehicle in a formation: its
places are offsets from the position of the vehicle ``leader``.

L is the localized world frame.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from ...base.numerics.linear import rotate
from ...schema import element
from ...world import World
from ..metrics.reference import Reference
from ..metrics.signal import VALUES, Signal
from ..reference_trajectory import TrajectorySpec
from .measure import Measure, MeasureSpec


@dataclass(frozen=True, kw_only=True)
class TrackingErrorSpec(MeasureSpec):
    """A ``<u:trackingError>`` element of a benchmark file."""

    values: ClassVar[tuple[str, ...]] = VALUES

    target: str = element(refers_to="body")
    """The route of the body."""
    trajectory: TrajectorySpec
    """The place at which the body should be at each time."""
    relative_to: str | None = element(default=None, refers_to="vehicle")
    """The vehicle from whose position the places of the trajectory are offsets, in the axes of L;
    None: the places are positions in L."""

    def errors(self) -> Sequence[str]:
        """Return errors of the trajectory."""
        return self.trajectory.errors()

    def bind(self, world: World) -> TrackingError:
        """Resolve the target; raises UnknownName if there is none."""
        return TrackingError(self, world)


class TrackingError(Measure):
    r"""The distance :math:`\lVert p(t) - q(t) \rVert` of a body's origin from its desired position.

    There is a sample at each step, at the simulation time t. x, y, z are the components of
    :math:`p - q` in L. Unlike the distance from a path (``<pathFollowing>``), it counts whether the
    body is at the right place at the right time. With ``relativeTo``, q is the position of that
    vehicle plus the place of the trajectory.
    """

    unit = "m"

    def __init__(self, spec: TrackingErrorSpec, world: World) -> None:
        self._body, self._world = world.body(spec.target), world
        self._reference = Reference(spec.trajectory, world, relative_to=spec.relative_to)
        self._statistic = spec.value
        self._localized_from_world = world.world_from_localized.inverse()
        self._signal = Signal(("x", "y", "z"))

    def start(self) -> None:
        """Take the first sample."""
        self.update()

    def update(self) -> None:
        """Take a sample."""
        frame = self._localized_from_world
        position = rotate(frame.rotation, self._body.world_from_body.position) + frame.position
        error = (position - self._reference.position()).tolist()
        self._signal.add(math.hypot(*error), error)

    @property
    def value(self) -> float | None:
        """The last distance, or the statistic given by ``u:value`` [m]."""
        return self._signal.value(self._statistic)

    @property
    def details(self) -> dict[str, float | None]:
        """The statistics of distance and components."""
        return dict(self._signal.details)

    @property
    def log_header(self) -> tuple[str, ...]:
        """The names of the distance and its components."""
        return ("total", "x", "y", "z")

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """The newest sample."""
        return tuple(self._signal.last_sample)
