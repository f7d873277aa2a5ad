r"""Position error: the distance of a body from its desired position.

.. code-block:: xml

    <positionError u:value="mean">
      <name>station</name> <target>girona500</target>
      <position> <x>2</x> <y>0</y> <z>2.5</z> </position>
      <topic>goal</topic>
    </positionError>

L is the localized world frame, W the world frame.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...base.geometry import Array, Pose
from ...base.inbox import Inbox
from ...base.numerics.linear import rotate
from ...messages import PoseStamped
from ...schema import element
from ...world import Body, World
from ..metrics.signal import VALUES, Signal
from .measure import Measure, MeasureSpec

ATTITUDE = ("rx", "ry", "rz", "rw")
"""The details with the attitude of the body, a quaternion x, y, z, w."""


@dataclass(frozen=True, kw_only=True)
class PositionErrorSpec(MeasureSpec):
    """A ``<positionError>`` element of a benchmark file."""

    values: ClassVar[tuple[str, ...]] = VALUES

    target: str = element(refers_to="body")
    """The route of the body."""
    position: tuple[float, float, float]
    """The desired position, in the localized world frame L [m]."""
    topic: str | None = element(default=None)
    """The topic of the desired position (geometry_msgs/PoseStamped, in L), which replaces
    ``position``: the newest message when the measure starts, or the first message after that."""

    @property
    def start_value(self) -> float:
        """The value that the original UWSim reports before its first sample [m].

        It is 100; with a topic, the value until the first message.
        """
        return 100.0 if self.topic is None else -1.0

    def bind(self, world: World) -> PositionError:
        """Resolve the target; raises UnknownName if there is none."""
        inbox = (
            None if self.topic is None else world.bus.inbox(self.topic, PoseStamped, latched=True)
        )
        return PositionError(self, world, world.body(self.target), inbox)


class PositionError(Measure):
    r"""The distance :math:`\lVert p - q \rVert` of a body's origin from its desired position.

    There is a sample at each step. x, y, z are the components of :math:`p - q` in L; rx, ry, rz, rw
    are the body's present attitude in L, a quaternion xyzw, as in the original UWSim.

    Compatibility ``position-frame``: the components are in W, and the position on the topic is
    taken to be in W. ``position-start``: the first sample is taken a step later; until then the
    value is 100. With a topic, the value is then -1 until the first message arrives.
    """

    unit = "m"
    detail_units: ClassVar[Mapping[str, str]] = dict.fromkeys(ATTITUDE, "1")

    def __init__(
        self, spec: PositionErrorSpec, world: World, body: Body, inbox: Inbox[PoseStamped] | None
    ) -> None:
        self._body, self._inbox, self._topic = body, inbox, spec.topic
        self._statistic = spec.value
        self._localized_from_world = world.world_from_localized.inverse()
        uses_world_frame = "position-frame" in world.compatibility
        self._frame_from_world = Pose.identity() if uses_world_frame else self._localized_from_world
        self._goal: Array | None = None  # in L, or in W with position-frame (3,) [m]
        if inbox is None:
            localized_from_goal = Pose(np.array(spec.position), np.eye(3))  # in L
            self._goal = (
                world.world_from_localized @ localized_from_goal
                if uses_world_frame
                else localized_from_goal
            ).position
        self._signal = Signal(("x", "y", "z"))
        self._was_active = False
        self._was_updated = False
        self._starts_at_100 = "position-start" in world.compatibility

    def start(self) -> None:
        """Take the first sample."""
        self._was_active = True
        if self._goal is None:
            self._goal = self._read_goal(-1)  # the newest message
        if not self._starts_at_100:
            self.update()

    def update(self) -> None:
        """Take a sample if the desired position is known."""
        self._was_updated = True
        if self._goal is None:
            self._goal = self._read_goal(0)  # the first message since the start
        if self._goal is not None:
            error = (self._position() - self._goal).tolist()
            self._signal.add(math.hypot(*error), error)

    @property
    def value(self) -> float | None:
        """The last distance, or the statistic given by ``u:value`` [m]."""
        if self._starts_at_100 and not self._signal.n:
            return -1.0 if self._was_updated else 100.0
        return self._signal.value(self._statistic)

    @property
    def missing_reason(self) -> str | None:
        """The reason why there is no value."""
        if self.value is not None:
            return None
        return f"no position on {self._topic!r}" if self._was_active else "it was never on"

    @property
    def details(self) -> dict[str, float | None]:
        """The statistics of distance and components, and the present attitude."""
        return {**self._signal.details, **dict(zip(ATTITUDE, self._attitude(), strict=True))}

    @property
    def log_header(self) -> tuple[str, ...]:
        """The names of the distance, its components and the attitude."""
        return ("total", "x", "y", "z", *ATTITUDE)

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """The newest sample."""
        total, *components = self._signal.last_sample
        return (self.value if total is None else total, *components, *self._attitude())

    def close(self) -> None:
        """Unsubscribe."""
        if self._inbox is not None:
            self._inbox.close()

    def _position(self) -> Array:
        """Return the position of the body in L, or in W with ``position-frame``, (3,) [m]."""
        frame = self._frame_from_world
        return rotate(frame.rotation, self._body.world_from_body.position) + frame.position

    def _attitude(self) -> tuple[float, ...]:
        w, x, y, z = (self._localized_from_world @ self._body.world_from_body).quaternion.tolist()
        return (x, y, z, w)

    def _read_goal(self, index: int) -> Array | None:
        """Return the position in one of the messages that arrived; None if none arrived."""
        messages = self._inbox.take() if self._inbox is not None else []
        if not messages:
            return None
        point = messages[index].pose.position
        return np.array([point.x, point.y, point.z])
