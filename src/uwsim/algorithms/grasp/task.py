"""What the phases share: the craft, the target, the clock, the parameters."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from ...base.geometry import Array
from .craft import Craft
from .perception import GraspModel, ObjectPerception
from .station import horizontal
from .target import Target

ABOVE = 0.30
"""Height of the grip over the handle from which it begins to descend [m]."""


class Task:
    """The state of one attempt to fetch a box."""

    def __init__(
        self,
        craft: Craft,
        perception: ObjectPerception,
        model: GraspModel,
        parameters: Mapping[str, float | str],
        say_status: Callable[[str], None],
    ) -> None:
        self.craft, self.perception, self.model = craft, perception, model
        self.say_status = say_status
        """Publishes on ``algorithmStatus``."""
        self.target = Target()
        self.now = 0.0
        """Simulation time [s]."""
        self.since = 0.0
        """When the present phase began [s]."""
        self.why = ""
        """Why the last thing failed."""
        self.failures = 0
        self.pattern: list[tuple[float, float]] = []
        """Corners of the search pattern that are left, navigation frame [m]."""
        self.search_depth = 0.0
        """Of the base while it searches [m]."""
        number = {name: float(value) for name, value in parameters.items() if _is_number(value)}
        self.attempts = int(number["attempts"])
        self.lift, self.settle, self.hold = number["lift"], number["settle"], number["hold"]
        self.descent = number["descent"]
        self._tolerance, self._min_load = number["tolerance"], number["min_load"]

    @property
    def elapsed(self) -> float:
        """Since the present phase began [s]."""
        return self.now - self.since

    @property
    def gate(self) -> float:
        """Largest horizontal error of the grip that will do [m]: larger in a current."""
        return self._tolerance + 0.04 * horizontal(self.craft.law.current)

    @property
    def grip(self) -> Array:
        """The point of the target that the jaw takes, (3,) [m]."""
        assert self.target.pose is not None
        return self.model.grip(self.target.pose)

    @property
    def closes(self) -> float:
        """The heading of the axis along which the jaw closes, modulo half a turn [rad]."""
        assert self.target.pose is not None
        return self.model.closes(self.target.pose)

    @property
    def carries_something(self) -> bool:
        """Whether the wrist carries a weight; taken for true where it has no sensor."""
        load = self.craft.wrist.load
        return load is None or load > self._min_load

    def is_target_lost(self, patience: float) -> bool:
        """Whether the target was not seen for longer than this [s]; the reason is noted."""
        lost = self.target.pose is None or self.now - self.target.seen_at > patience
        if lost:
            self.why = f"lost target: it was not seen for {patience:g} s"
        return lost

    def go(self, place: Array, velocity: Array | None = None) -> None:
        """Send the base to a place (3,) [m] that moves at a velocity (3,) [m/s]."""
        self.craft.goal = place
        self.craft.goal_velocity = np.zeros(3) if velocity is None else velocity

    def station(self, height: float, *, settled: bool = False) -> Array:
        """Keep the base where the reaching arm's grip would be over the handle.

        Args:
            height: of the grip over the handle [m].
            settled: the arm is as it is; else it is taken to reach down.

        Returns:
            How far the base is off, (3,) [m].
        """
        craft = self.craft
        goal = self.grip - np.array([0.0, 0.0, height])
        base = craft.base_for(goal, craft.joints) if settled else craft.base_for(goal)
        self.go(base)
        off: Array = base - craft.pose.position
        return off

    def hover(self, height: float) -> Array:
        """Keep the grip over the handle with base and arm; return how far it is off, (3,) [m]."""
        self.station(height)
        craft = self.craft
        craft.closes = self.closes
        craft.grip_goal = self.grip - np.array([0.0, 0.0, height])
        off: Array = craft.grip_goal - craft.grip
        return off


def square_spiral(
    start: Array, heading: float, spacing: float, radius: float
) -> list[tuple[float, float]]:
    """Corners of a square spiral about a start (at least 2,) [m], the first ahead of it.

    Args:
        start: north and east [m].
        heading: of the first leg [rad].
        spacing: between legs [m].
        radius: how far it reaches [m].
    """
    corners: list[tuple[float, float]] = []
    x, y, n = 0.0, 0.0, 0
    c, s = math.cos(heading), math.sin(heading)
    while True:
        length = spacing * (n // 2 + 1)
        ahead = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[n % 4]
        x, y, n = x + length * ahead[0], y + length * ahead[1], n + 1
        if max(abs(x), abs(y)) > radius + 1e-9:
            return corners
        corners.append((float(start[0]) + c * x - s * y, float(start[1]) + s * x + c * y))


def _is_number(value: float | str) -> bool:
    return not isinstance(value, str)
