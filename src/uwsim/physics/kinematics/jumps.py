"""The velocity of bodies that commands place in jumps.

Commands move a body in jumps, one a message. A jump is spread evenly over the time since the
previous one, at most `MAX_JUMP`. A twist that comes ten times a second is therefore the velocity at
every step, not fifty times that velocity at one step of fifty. A jump faster than `MAX_JUMP_SPEED`
is a placement and no motion.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ...base.record import Record

MAX_JUMP = 1.0
"""The longest time over which a jump is spread [s]."""
MAX_JUMP_SPEED = 100.0
"""The speed above which a jump is a placement, without a velocity after it [m/s, rad/s]."""


@dataclass(slots=True)
class JumpState(Record):
    """The last jump of a body."""

    step: int
    """The step of the jump."""
    n_steps: int
    """The number of steps over which the jump is spread."""


class JumpTimes:
    """The time of the last jump of a body, and its duration.

    Args:
        timestep: the length of a step [s].
        last_step: the step of the placement before the first jump; None: long ago.
        n_steps: the number of steps over which this placement is spread.
    """

    def __init__(self, timestep: float, *, last_step: int | None = None, n_steps: int = 0) -> None:
        self._timestep, self._max_steps = timestep, max(1, round(MAX_JUMP / timestep))
        self.state = JumpState(-self._max_steps if last_step is None else last_step, n_steps)
        """The last jump."""

    @property
    def n_steps(self) -> int:
        """The number of steps over which the last jump is spread."""
        return self.state.n_steps

    def add(self, step: int) -> None:
        """Record a jump at a step."""
        self.state.n_steps = min(max(1, step - self.state.step), self._max_steps)
        self.state.step = step

    def forget(self) -> None:
        """Move the last jump to the distant past."""
        self.state.step = -self._max_steps

    def age(self, step: int) -> int:
        """Return the number of steps since the last jump."""
        return step - self.state.step

    @property
    def duration(self) -> float:
        """The duration of the last jump [s]."""
        return self.n_steps * self._timestep


def jump_velocity(velocity: Array, speed: float) -> Array:
    """Return the velocity of a jump, or zeros where its greatest speed makes it a placement."""
    return velocity if speed <= MAX_JUMP_SPEED else np.zeros_like(velocity)
