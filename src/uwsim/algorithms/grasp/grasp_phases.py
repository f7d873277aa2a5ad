"""The phases in which the jaw grasps the handle of the box: align, descend, close."""

from __future__ import annotations

from typing import ClassVar

from .arm import JAW_CLOSED
from .phase import Phase
from .station import horizontal_length
from .task import APPROACH_HEIGHT, Task

OCCLUSION_HEIGHT = 0.2
"""The height of the grip over the handle below which the jaw hides the box from the camera [m]."""


class AlignPhase(Phase):
    """The vehicle brings the grip over the handle; the arm compensates the vehicle's error."""

    name = "align"
    limit = 60.0

    def enter(self, task: Task) -> None:
        """Reset the time since which the grip is aligned."""
        self._aligned_since: float | None = None

    def step(self, task: Task) -> str | None:
        """Wait until the grip is over the handle for 1 s."""
        if task.is_target_lost(15.0):
            return "retry"
        error = task.hover(APPROACH_HEIGHT)
        if horizontal_length(error) > task.tolerance or abs(float(error[2])) > 0.05:
            self._aligned_since = None
        elif self._aligned_since is None:
            self._aligned_since = task.now
        is_aligned = self._aligned_since is not None and task.now - self._aligned_since > 1.0
        return "descend" if is_aligned else None


class DescendPhase(Phase):
    """The grip descends to the handle; it waits while its horizontal error is large."""

    name = "descend"
    limit = 50.0

    def enter(self, task: Task) -> None:
        """Start with the grip at the approach height."""
        self._height, self._last_time = APPROACH_HEIGHT, task.now
        self._aligned_since: float | None = None

    def step(self, task: Task) -> str | None:
        """Descend while the grip is over the handle."""
        dt, self._last_time = task.now - self._last_time, task.now
        self.uses_images = self._height > OCCLUSION_HEIGHT
        error = task.hover(self._height)
        side_error = horizontal_length(error)
        if side_error < 1.5 * task.tolerance and abs(float(error[2])) < 0.08:
            self._height = max(self._height - task.descent * dt, 0.0)
        if self._height > 0.0 or side_error > task.tolerance or abs(float(error[2])) > 0.02:
            self._aligned_since = None
        elif self._aligned_since is None:
            self._aligned_since = task.now
        is_aligned = self._aligned_since is not None and task.now - self._aligned_since >= 0.3
        return "close" if is_aligned else None


class ClosePhase(Phase):
    """The jaw closes; the position and torque of the fingers show whether it holds an object."""

    name = "close"
    limit = 8.0
    uses_images = False
    next_phase: ClassVar[str] = "lift"
    """The name of the phase that follows when the jaw holds an object."""

    def enter(self, task: Task) -> None:
        """Tare the wrist, stop the arm and close the jaw."""
        task.vehicle.wrist.tare()
        task.vehicle.grip_goal = None
        task.vehicle.jaw.setpoint = JAW_CLOSED

    def step(self, task: Task) -> str | None:
        """Wait until the fingers are at rest."""
        task.keep_station(0.0, is_settled=True)
        if task.phase_time < 2.0 or task.vehicle.jaw.is_moving:
            return None
        if task.vehicle.jaw.holds_object:
            return self.next_phase
        position = task.vehicle.jaw.position
        task.failure = f"missed: the jaw closed to {position:.3f} rad, there is nothing in it"
        return "retry"
