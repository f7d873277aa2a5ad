r"""u:jointPosition: the position of the hinge or slide of an object.

.. code-block:: xml

    <u:jointPosition> <name>angle</name> <target>valve1</target> </u:jointPosition>
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from ...schema import element
from ...world import World
from .measure import Measure, MeasureSpec


@dataclass(frozen=True, kw_only=True)
class JointPositionSpec(MeasureSpec):
    """A ``<u:jointPosition>`` element of a benchmark file."""

    target: str = element(refers_to="joint")
    """The name of an object with a ``<u:hinge>`` or ``<u:slide>``."""

    def bind(self, world: World) -> JointPosition:
        """Resolve the object; raises UnknownName if there is none with a joint."""
        world.joint_position(self.target)
        return JointPosition(self, world)


class JointPosition(Measure):
    """The last position of the joint of an object, from its pose in the scene file on.

    The unit is rad for a hinge and m for a slide; the column states rad or m. Details: the greatest
    and the least position, and the greatest speed, from the difference of two steps.
    """

    unit = "rad or m"
    detail_units: ClassVar[Mapping[str, str]] = {
        "greatest": "rad or m",
        "least": "rad or m",
        "max_speed": "rad/s or m/s",
    }

    def __init__(self, spec: JointPositionSpec, world: World) -> None:
        self._world, self._target = world, spec.target
        self._position: float | None = None  # [rad or m]
        self._max_position = self._min_position = self._max_speed = 0.0

    def start(self) -> None:
        """Take the first sample."""
        self.update()

    def update(self) -> None:
        """Take a sample."""
        position = self._world.joint_position(self._target)
        if self._position is None:
            self._max_position = self._min_position = position
        else:
            speed = abs(position - self._position) / self._world.timestep
            self._max_speed = max(self._max_speed, speed)
        self._max_position, self._min_position = (
            max(self._max_position, position),
            min(self._min_position, position),
        )
        self._position = position

    @property
    def value(self) -> float | None:
        """The last position [rad or m]; None if the measure was never active."""
        return self._position

    @property
    def details(self) -> dict[str, float | None]:
        """The greatest and least position [rad or m], and the greatest speed [1/s]."""
        if self._position is None:
            return dict.fromkeys(self.detail_units)
        return {
            "greatest": self._max_position,
            "least": self._min_position,
            "max_speed": self._max_speed,
        }
