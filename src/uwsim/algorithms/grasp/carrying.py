"""Phases with the box, and after it: lift, hold, retreat; retry, done, aborted."""

from __future__ import annotations

import numpy as np

from ...base.geometry import Array
from .arm import OPEN
from .phase import Phase
from .task import Task

RISE = 0.1
"""Speed of the lift [m/s]."""
SETTLING = 0.25
"""Height at which the lift waits for the box to hang still [m]."""


class Lift(Phase):
    """Rises with what is in the jaw."""

    name = "lift"
    limit = 40.0
    looks = False

    def enter(self, task: Task) -> None:
        """Rise from where the vehicle is."""
        self._start = task.craft.pose.position.copy()
        self._began = task.now

    def step(self, task: Task) -> str | None:
        """Raise the goal; the box must not fall."""
        risen, speed = self._risen(task.now - self._began, task)
        task.go(self._start - np.array([0.0, 0.0, risen]), np.array([0.0, 0.0, speed]))
        if not task.craft.jaw.holds_something:
            task.why = "dropped: the jaw closed while the box was lifted"
            return "retry"
        above = float(self._start[2] - task.craft.pose.position[2])
        if above <= task.lift - 0.05:
            return None
        if not task.carries_something:
            task.why = "missed: the wrist carries no weight after the lift"
            return "retry"
        return "hold"

    def _risen(self, time: float, task: Task) -> tuple[float, float]:
        """How far the goal has risen [m] at a time [s], and its velocity (down) [m/s].

        It waits at `SETTLING`, so that the box finds its place in the jaw.
        """
        up = SETTLING / RISE
        if time < up:
            return RISE * time, -RISE
        if time < up + task.settle:
            return SETTLING, 0.0
        risen = RISE * (time - task.settle)
        return (risen, -RISE) if risen < task.lift else (task.lift, 0.0)


class Hold(Phase):
    """Stays, with the box in the jaw."""

    name = "hold"
    looks = False

    def enter(self, task: Task) -> None:
        """Stay where the lift ended."""
        assert task.craft.goal is not None
        self._place = task.craft.goal.copy()

    def step(self, task: Task) -> str | None:
        """Wait; the box must not fall."""
        task.go(self._place)
        if not (task.craft.jaw.holds_something and task.carries_something):
            task.why = "dropped: jaw and wrist lost the box while it was held"
            return "retry"
        return "retreat" if task.elapsed > task.hold else None


class Retreat(Phase):
    """Rises further, with the box."""

    name = "retreat"
    limit = 30.0
    late = "done"
    looks = False

    def enter(self, task: Task) -> None:
        """Rise from where it held."""
        self._start: Array = task.craft.pose.position.copy()

    def step(self, task: Task) -> str | None:
        """Raise the goal."""
        risen = min(0.1 * task.elapsed, 0.5)
        task.go(self._start - np.array([0.0, 0.0, risen]), np.array([0.0, 0.0, -0.1]))
        if not (task.craft.jaw.holds_something and task.carries_something):
            task.why = "dropped: jaw and wrist lost the box while it was brought up"
            return "retry"
        return "done" if risen >= 0.5 else None


class Retry(Phase):
    """Opens the jaw, rises and begins anew, `Task.attempts` times at most."""

    name = "retry"
    limit = 10.0
    late = "search"

    def enter(self, task: Task) -> None:
        """Open; rise from where it is."""
        task.failures += 1
        craft = task.craft
        craft.jaw.wanted, craft.grip_goal = OPEN, None
        self._start: Array = craft.pose.position.copy()
        self._has_forgotten = False

    def step(self, task: Task) -> str | None:
        """Rise by half a metre."""
        if task.failures >= task.attempts:
            return "aborted"
        up = np.array([0.0, 0.0, min(0.15 * task.elapsed, 0.5)])
        task.go(self._start - up, np.array([0.0, 0.0, -0.15 if up[2] < 0.5 else 0.0]))
        if task.elapsed < 4.0:
            return None
        if not self._has_forgotten:
            task.target.forget()
            task.perception.forget()
            self._has_forgotten = True
        return "station" if task.target.count >= 3 else None


class Done(Phase):
    """The box is up: stays."""

    name = "done"
    limit = float("inf")
    looks = False

    def enter(self, task: Task) -> None:
        """Say so."""
        task.say_status("done")
        self._place: Array = task.craft.pose.position.copy()

    def step(self, task: Task) -> str | None:
        """Stay."""
        task.go(self._place)
        return None


class Aborted(Phase):
    """Gave up: stays, with the jaw open."""

    name = "aborted"
    limit = float("inf")
    looks = False

    def enter(self, task: Task) -> None:
        """Say why."""
        task.say_status(f"lost: {task.why}")
        task.craft.grip_goal = None
        self._place: Array = task.craft.pose.position.copy()

    def step(self, task: Task) -> str | None:
        """Stay."""
        task.go(self._place)
        return None
