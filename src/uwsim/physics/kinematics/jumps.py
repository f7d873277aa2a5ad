"""How jumps of what is placed by commands count as motion.

Commands move a body in jumps, one a message. A jump counts as made evenly over the time since the
one before, `MAX_JUMP` at most. So a twist that comes ten times a second is the velocity at every
step, not five hundred times as much at one step out of fifty. What would be faster than
`MAX_JUMP_SPEED` is a placement and no motion.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ...base.record import Record

MAX_JUMP = 1.0
"""A jump after a longer rest counts as made in this time [s]."""
MAX_JUMP_SPEED = 100.0
"""A faster jump is a placement: the body has no velocity after it [m/s, rad/s]."""


@dataclass(slots=True)
class JumpState(Record):
    """The last jump of a body."""

    step: int
    """The step at which it was made."""
    n_steps: int
    """The steps that it took."""


class JumpTimes:
    """The time of the last jump of a body, and how long it took.

    Args:
        timestep: length of a step [s].
        last: step at which it was placed before its first jump; None: long ago.
        n_steps: that this took.
    """

    def __init__(self, timestep: float, *, last: int | None = None, n_steps: int = 0) -> None:
        self._timestep, self._longest = timestep, max(1, round(MAX_JUMP / timestep))
        self.state = JumpState(-self._longest if last is None else last, n_steps)
        """Its last jump."""

    @property
    def n_steps(self) -> int:
        """The steps that the last jump took."""
        return self.state.n_steps

    def add(self, step: int) -> None:
        """Record a jump at a step."""
        self.state.n_steps = min(max(1, step - self.state.step), self._longest)
        self.state.step = step

    def forget(self) -> None:
        """Let the last jump be long ago."""
        self.state.step = -self._longest

    def age(self, step: int) -> int:
        """Return the steps since the last jump."""
        return step - self.state.step

    @property
    def duration(self) -> float:
        """How long the last jump took [s]."""
        return self.n_steps * self._timestep


def without_placement(velocity: Array, speed: float) -> Array:
    """Return the velocity of a jump, or zeros where its greatest speed makes it a placement."""
    return velocity if speed <= MAX_JUMP_SPEED else np.zeros_like(velocity)
