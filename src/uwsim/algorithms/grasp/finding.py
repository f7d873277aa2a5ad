"""Phases until the arm is over the box: search, detect, station, pregrasp."""

from __future__ import annotations

import numpy as np

from .arm import DOWN, OPEN
from .phase import Phase
from .station import horizontal
from .task import ABOVE, Task


class Search(Phase):
    """Flies a square spiral over where it began, at its depth, until the box was seen thrice."""

    name = "search"
    limit = 180.0
    late = "aborted"

    def enter(self, task: Task) -> None:
        """Lay the pattern out; the second search begins where the first ended."""
        task.why = "not found: the search pattern is flown"
        task.target.forget()
        task.perception.forget()

    def step(self, task: Task) -> str | None:
        """Fly to the next corner."""
        craft = task.craft
        if task.target.count >= 3:
            return "detect"
        if task.target.count and task.now - task.target.seen_at < 1.0:
            return None  # stay for a second look
        if not task.pattern:
            return "aborted"
        craft.goal = np.array([*task.pattern[0], task.search_depth])
        if horizontal(craft.goal - craft.pose.position) < 0.15:
            task.pattern.pop(0)
        return None


class Detect(Phase):
    """Stays and looks again."""

    name = "detect"
    limit = 10.0
    late = "search"

    def enter(self, task: Task) -> None:
        """Stay."""
        task.go(task.craft.pose.position.copy())

    def step(self, task: Task) -> str | None:
        """Wait for some more sightings."""
        if task.is_target_lost(3.0):
            return "search"
        return "station" if task.target.count >= 6 else None


class Station(Phase):
    """Flies over the box and looks at it until its place is sure."""

    name = "station"
    limit = 45.0
    late = "search"

    def enter(self, task: Task) -> None:
        """Say that there is a target."""
        task.say_status("tracking")

    def step(self, task: Task) -> str | None:
        """Go where the grip will be over the handle."""
        if task.is_target_lost(6.0):
            return "search"
        off = task.station(ABOVE + 0.1)
        sure = task.target.count >= 8 and task.target.deviation < 0.02
        return "pregrasp" if sure and horizontal(off) < 0.3 else None


class Pregrasp(Phase):
    """Brings the arm down and the open jaw across the handle, above it."""

    name = "pregrasp"
    limit = 30.0

    def step(self, task: Task) -> str | None:
        """Wait for the arm."""
        task.station(ABOVE + 0.1)
        craft = task.craft
        craft.jaw.wanted = OPEN
        craft.posture = np.array([*DOWN[:3].tolist(), craft.wrist_for(task.closes)])
        return "align" if craft.is_still and task.elapsed > 1.0 else None
