"""The velocity of kinematic bodies, whose poses change in jumps.

Each command message moves a body in one jump. The jump is spread evenly over the time since the
previous jump, at most `MAX_JUMP`. A twist command at 10 Hz therefore gives its velocity in every
step of 2 ms, and not 50 times this velocity in one of 50 steps. A jump faster than `MAX_JUMP_SPEED`
counts as a placement without velocity.
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
    """The index of the step at which the body jumped."""
    n_steps: int
    """The number of steps over which the jump is spread."""


class JumpTimes:
    """The time and the duration of the last jump of a body.

    Args:
        timestep: the length of a step [s].
        last_step: the step of the placement before the first jump; None if it was long ago.
        n_steps: the number of steps over which this placement is spread.
    """

    def __init__(self, timestep: float, *, last_step: int | None = None, n_steps: int = 0) -> None:
        self._timestep, self._max_steps = timestep, max(1, round(MAX_JUMP / timestep))
        self.state = JumpState(-self._max_steps if last_step is None else last_step, n_steps)
        """The step of the last jump, and the number of steps over which it is spread."""

    @property
    def n_steps(self) -> int:
        """The number of steps over which the last jump is spread."""
        return self.state.n_steps

    def add(self, step: int) -> None:
        """Record a jump at a step."""
        self.state.n_steps = min(max(1, step - self.state.step), self._max_steps)
        self.state.step = step

    def forget(self) -> None:
        """Forget the last jump, as if it had happened long ago."""
        self.state.step = -self._max_steps

    def age(self, step: int) -> int:
        """Return the number of steps since the last jump."""
        return step - self.state.step

    @property
    def duration(self) -> float:
        """The duration of the last jump [s]."""
        return self.n_steps * self._timestep


def jump_velocity(velocity: Array, speed: float) -> Array:
    """Return the velocity of a jump, or zeros if ``speed`` is that of a placement."""
    return velocity if speed <= MAX_JUMP_SPEED else np.zeros_like(velocity)
