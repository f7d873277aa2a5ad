"""The phases of a grasp: a state machine whose states are classes.

===========  ==================================================  =======================
phase        what is done                                        then
===========  ==================================================  =======================
`Search`     fly a square spiral until the box was seen          detect
`Detect`     stay, look again                                    station
`Station`    fly over it, look until its place is sure           pregrasp
`Pregrasp`   arm down, jaw open and across the handle            align
`Align`      grip over the handle                                descend
`Descend`    grip down to the handle                             close
`Close`      close the jaw, feel whether something is in it      lift, or retry
`Lift`       rise                                                hold, or retry
`Hold`       stay there                                          retreat, or retry
`Retreat`    rise further, with the box                          done
`Retry`      open the jaw, rise                                  detect
`Done`       stay
`Aborted`    stay; the reason is published
===========  ==================================================  =======================

A phase that outlasts its `limit` goes on to `late`. `step` returns the name of the next phase, or
None to stay.
"""

from __future__ import annotations

import abc
from typing import ClassVar

import numpy as np

from ...geometry import Array
from .arm import CLOSED, DOWN, OPEN
from .station import horizontal
from .task import Task

ABOVE = 0.30
"""Height of the grip over the handle from which it begins to descend [m]."""


RISE = 0.1
"""Speed of the lift [m/s]."""
SETTLING = 0.25
"""Height at which the lift waits for the box to hang still [m]."""
HIDDEN = 0.2
"""Height of the grip over the handle below which the jaw hides the box from the camera [m]."""


class Phase(abc.ABC):
    """One state of the machine."""

    name: ClassVar[str]
    limit: ClassVar[float] = 60.0
    """Longest duration [s]."""
    late: ClassVar[str] = "retry"
    """Phase that follows when that is over."""
    looks: bool = True
    """Whether images are looked at."""

    def enter(self, task: Task) -> None:  # noqa: B027 - most have nothing to begin
        """Begin."""

    @abc.abstractmethod
    def step(self, task: Task) -> str | None:
        """Set goals; return the next phase, or None."""


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
        craft.jaw_wanted = OPEN
        craft.posture = np.array([*DOWN[:3].tolist(), craft.wrist_for(task.closes)])
        return "align" if craft.is_still and task.elapsed > 1.0 else None


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
        """Close; the arm stays as it is, the vehicle over the handle."""
        task.craft.grip_goal = None
        task.craft.jaw_wanted = CLOSED

    def step(self, task: Task) -> str | None:
        """Wait until the fingers stand still."""
        task.station(0.0, settled=True)
        if task.elapsed < 2.0 or abs(task.craft.jaw_speed) > 0.02:
            return None
        if task.holds_something:
            return "lift"
        task.why = f"missed: the jaw closed to {task.craft.jaw:.3f} rad, there is nothing in it"
        return "retry"


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
        if not task.holds_something:
            task.why = "dropped: the jaw closed while the box was lifted"
            return "retry"
        above = float(self._start[2] - task.craft.pose.position[2])
        return "hold" if above > task.lift - 0.05 else None

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
        if not task.holds_something:
            task.why = "dropped: the jaw closed while the box was held"
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
        if not task.holds_something:
            task.why = "dropped: the jaw closed while the box was brought up"
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
        craft.jaw_wanted, craft.grip_goal = OPEN, None
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


PHASES: dict[str, type[Phase]] = {
    "search": Search,
    "detect": Detect,
    "station": Station,
    "pregrasp": Pregrasp,
    "align": Align,
    "descend": Descend,
    "close": Close,
    "lift": Lift,
    "hold": Hold,
    "retreat": Retreat,
    "retry": Retry,
    "done": Done,
    "aborted": Aborted,
}
"""The phases by name, in their usual order."""
