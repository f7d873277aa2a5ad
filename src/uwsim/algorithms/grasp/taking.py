"""Phases in which the jaw takes the handle: align, descend, close."""

from __future__ import annotations

from .arm import CLOSED
from .phase import Phase
from .station import horizontal
from .task import ABOVE, Task

HIDDEN = 0.2
"""Height of the grip over the handle below which the jaw hides the box from the camera [m]."""


class Align(Phase):
    """Brings the grip over the handle: the vehicle, and the arm for the rest."""

    name = "align"
    limit = 60.0

    def enter(self, task: Task) -> None:
        """Begin to count."""
        self._good_since: float | None = None

    def step(self, task: Task) -> str | None:
        """Wait until the grip stays over the handle."""
        if task.is_target_lost(15.0):
            return "retry"
        off = task.hover(ABOVE)
        if horizontal(off) > task.gate or abs(float(off[2])) > 0.05:
            self._good_since = None
        elif self._good_since is None:
            self._good_since = task.now
        good = self._good_since is not None and task.now - self._good_since > 1.0
        return "descend" if good else None


class Descend(Phase):
    """Lowers the grip to the handle; waits while it is off to the side."""

    name = "descend"
    limit = 50.0

    def enter(self, task: Task) -> None:
        """Begin where it is."""
        self._height, self._last = ABOVE, task.now
        self._good_since: float | None = None

    def step(self, task: Task) -> str | None:
        """Go down as long as the grip is over the handle."""
        dt, self._last = task.now - self._last, task.now
        self.looks = self._height > HIDDEN
        off = task.hover(self._height)
        side = horizontal(off)
        if side < 1.5 * task.gate and abs(float(off[2])) < 0.08:
            self._height = max(self._height - task.descent * dt, 0.0)
        if self._height > 0.0 or side > task.gate or abs(float(off[2])) > 0.02:
            self._good_since = None
        elif self._good_since is None:
            self._good_since = task.now
        good = self._good_since is not None and task.now - self._good_since >= 0.3
        return "close" if good else None


class Close(Phase):
    """Closes the jaw and feels whether something is in it."""

    name = "close"
    limit = 8.0
    looks = False

    def enter(self, task: Task) -> None:
        """Close; the arm stays as it is, the vehicle over the handle; the wrist carries no load."""
        task.craft.wrist.tare()
        task.craft.grip_goal = None
        task.craft.jaw.wanted = CLOSED

    def step(self, task: Task) -> str | None:
        """Wait until the fingers stand still."""
        task.station(0.0, settled=True)
        if task.elapsed < 2.0 or task.craft.jaw.is_moving:
            return None
        if task.craft.jaw.holds_something:
            return "lift"
        position = task.craft.jaw.position
        task.why = f"missed: the jaw closed to {position:.3f} rad, there is nothing in it"
        return "retry"
