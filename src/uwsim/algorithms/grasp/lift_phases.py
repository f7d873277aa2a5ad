"""The phases after the jaw has closed: lift, hold, retreat, retry, done, aborted."""

from __future__ import annotations

import numpy as np

from ...base.geometry import Array
from .arm import JAW_OPEN
from .phase import Phase
from .task import Task

LIFT_SPEED = 0.1
"""The speed of the lift [m/s]."""
SETTLING_HEIGHT = 0.25
"""The height of the lift at which the vehicle waits until the box is at rest in the jaw [m]."""


class LiftPhase(Phase):
    """The vehicle rises by `Task.lift` with the box in the jaw."""

    name = "lift"
    limit = 40.0
    uses_images = False

    def enter(self, task: Task) -> None:
        """Store the position of the vehicle, and the time."""
        self._start = task.vehicle.pose.position.copy()
        self._start_time = task.now

    def step(self, task: Task) -> str | None:
        """Raise the goal of the vehicle, and check that the jaw holds the box."""
        height, speed = self._lift_goal(task.now - self._start_time, task)
        task.set_goal(self._start - np.array([0.0, 0.0, height]), np.array([0.0, 0.0, speed]))
        if not task.vehicle.jaw.holds_object:
            task.failure = "dropped: the jaw closed while the box was lifted"
            return "retry"
        lifted_height = float(self._start[2] - task.vehicle.pose.position[2])
        if lifted_height <= task.lift - 0.05:
            return None
        if not task.has_load:
            task.failure = "missed: the wrist carries no weight after the lift"
            return "retry"
        return "hold"

    def _lift_goal(self, time: float, task: Task) -> tuple[float, float]:
        """Return the height of the goal over the start [m], and its velocity, positive down [m/s].

        The goal waits at `SETTLING_HEIGHT` for `Task.settle` seconds. ``time`` is the time since
        the start of the phase [s].
        """
        settling_start = SETTLING_HEIGHT / LIFT_SPEED
        if time < settling_start:
            return LIFT_SPEED * time, -LIFT_SPEED
        if time < settling_start + task.settle:
            return SETTLING_HEIGHT, 0.0
        height = LIFT_SPEED * (time - task.settle)
        return (height, -LIFT_SPEED) if height < task.lift else (task.lift, 0.0)


class HoldPhase(Phase):
    """The vehicle keeps its position for `Task.hold` seconds, with the box in the jaw."""

    name = "hold"
    uses_images = False

    def enter(self, task: Task) -> None:
        """Store the last goal of the lift."""
        assert task.vehicle.goal is not None
        self._position = task.vehicle.goal.copy()

    def step(self, task: Task) -> str | None:
        """Keep the position, and check that the jaw holds the box."""
        task.set_goal(self._position)
        if not (task.vehicle.jaw.holds_object and task.has_load):
            task.failure = "dropped: jaw and wrist lost the box while it was held"
            return "retry"
        return "retreat" if task.phase_time > task.hold else None


class RetreatPhase(Phase):
    """The vehicle rises by another 0.5 m, with the box in the jaw."""

    name = "retreat"
    limit = 30.0
    timeout_phase = "done"
    uses_images = False

    def enter(self, task: Task) -> None:
        """Store the position of the vehicle."""
        self._start: Array = task.vehicle.pose.position.copy()

    def step(self, task: Task) -> str | None:
        """Raise the goal of the vehicle, and check that the jaw holds the box."""
        height = min(0.1 * task.phase_time, 0.5)
        task.set_goal(self._start - np.array([0.0, 0.0, height]), np.array([0.0, 0.0, -0.1]))
        if not (task.vehicle.jaw.holds_object and task.has_load):
            task.failure = "dropped: jaw and wrist lost the box while it was brought up"
            return "retry"
        return "done" if height >= 0.5 else None


class RetryPhase(Phase):
    """The vehicle opens the jaw, rises and tries again; it aborts after too many failures."""

    name = "retry"
    limit = 10.0
    timeout_phase = "search"

    def enter(self, task: Task) -> None:
        """Count the failure and open the jaw."""
        task.failures += 1
        vehicle = task.vehicle
        vehicle.jaw.setpoint, vehicle.grip_goal = JAW_OPEN, None
        self._start: Array = vehicle.pose.position.copy()
        self._has_reset = False

    def step(self, task: Task) -> str | None:
        """Rise by 0.5 m, reset the target and wait for three sightings."""
        if task.failures >= task.attempts:
            return "aborted"
        up = np.array([0.0, 0.0, min(0.15 * task.phase_time, 0.5)])
        task.set_goal(self._start - up, np.array([0.0, 0.0, -0.15 if up[2] < 0.5 else 0.0]))
        if task.phase_time < 4.0:
            return None
        if not self._has_reset:
            task.target.reset()
            task.perception.reset()
            self._has_reset = True
        return "station" if task.target.n_sightings >= 3 else None


class DonePhase(Phase):
    """The vehicle keeps its position; the box was lifted and held."""

    name = "done"
    limit = float("inf")
    uses_images = False

    def enter(self, task: Task) -> None:
        """Publish the status ``done``."""
        task.publish_status("done")
        self._position: Array = task.vehicle.pose.position.copy()

    def step(self, task: Task) -> str | None:
        """Keep the position."""
        task.set_goal(self._position)
        return None


class AbortedPhase(Phase):
    """The vehicle keeps its position: the search found nothing, or there were too many failures."""

    name = "aborted"
    limit = float("inf")
    uses_images = False

    def enter(self, task: Task) -> None:
        """Publish the status ``lost`` with the reason."""
        task.publish_status(f"lost: {task.failure}")
        task.vehicle.grip_goal = None
        self._position: Array = task.vehicle.pose.position.copy()

    def step(self, task: Task) -> str | None:
        """Keep the position."""
        task.set_goal(self._position)
        return None
