r"""u:reach: whether a point of one body reached a point of another, and stayed there.

.. code-block:: xml

    <u:reach>
      <name>success</name>
      <from>girona500/end_effector</from>
      <to>blackbox</to> <toPoint> <x>0</x> <y>0</y> <z>0.128</z> </toPoint>
      <tolerance>0.03</tolerance> <hold>1</hold>
    </u:reach>
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from ...schema import element
from ...world import World
from ..metrics.relative_pose import RelativePose
from ..metrics.signal import Signal
from .measure import Measure, MeasureSpec


@dataclass(frozen=True, kw_only=True)
class ReachSpec(MeasureSpec):
    """A ``<u:reach>`` element of a benchmark file."""

    columns: ClassVar[tuple[str, ...]] = ("distance",)
    statuses: ClassVar[tuple[str, ...]] = ("timeout",)

    from_: str = element("from", refers_to="body")
    """The route of the body that reaches, such as the frame of a tool."""
    to: str = element(refers_to="body")
    """The route of the body that is reached."""
    from_point: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The point of the first body, in its frame [m]."""
    to_point: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The point of the second body, in its frame [m]."""
    tolerance: float = element(default=0.03, exclusive_minimum=0.0)
    """The distance below which the point is reached [m]."""
    hold: float = element(default=1.0, minimum=0.0)
    """The time for which the distance has to be below the tolerance [s]."""

    def bind(self, world: World) -> Reach:
        """Resolve both bodies; raises UnknownName if one is unknown."""
        first, second = world.body(self.from_), world.body(self.to)
        return Reach(self, world, RelativePose(first, second, self.from_point, self.to_point))


class Reach(Measure):
    r"""1 if the distance of two points was below the tolerance for the time ``hold``, else 0.

    With the points :math:`p` and :math:`q` of the two bodies there is a sample
    :math:`\lVert p - q \rVert` at each step. ``held`` is the longest time without a sample above
    the tolerance. A success ends the level. The measure determines the status of the level: ``ok``
    or ``timeout``. Contacts and the attitude of the bodies are not part of the criterion.
    """

    unit = "1"
    detail_units: ClassVar[Mapping[str, str]] = {
        **dict.fromkeys(("distance", "least_distance", "mean_distance"), "m"),
        **dict.fromkeys(("held", "time_reached", "time_done"), "s"),
    }

    def __init__(self, spec: ReachSpec, world: World, pose: RelativePose) -> None:
        self._spec, self._world, self._pose = spec, world, pose
        self._distances = Signal(())
        self._least_distance: float | None = None  # [m]
        self._start_time = 0.0  # simulation time [s]; all times below are after it
        self._hold_start: float | None = None  # [s]
        self._longest_hold = 0.0  # [s]
        self._reached_time: float | None = None  # first time within the tolerance [s]
        self._done_time: float | None = None  # time of the success [s]

    def start(self) -> None:
        """Take the first sample."""
        self._start_time = self._world.time
        self.update()

    def update(self) -> None:
        """Take a sample, and end the level after a success."""
        if self._done_time is not None:
            return
        time, distance = self._world.time - self._start_time, self._pose.distance()
        self._distances.add(distance, ())
        least_distance = self._least_distance
        self._least_distance = distance if least_distance is None else min(least_distance, distance)
        if distance > self._spec.tolerance:
            self._hold_start = None
            return
        self._reached_time = time if self._reached_time is None else self._reached_time
        self._hold_start = time if self._hold_start is None else self._hold_start
        self._longest_hold = max(self._longest_hold, time - self._hold_start)
        if self._longest_hold >= self._spec.hold - 1e-9:
            self._done_time = time

    @property
    def value(self) -> float | None:
        """1 for a success, 0 otherwise; None if the measure was never active."""
        return None if not self._distances.n else float(self._done_time is not None)

    @property
    def details(self) -> dict[str, float | None]:
        """The distances [m], and times [s]."""
        return {
            "distance": self._distances.value("last"),
            "least_distance": self._least_distance,
            "mean_distance": self._distances.value("mean"),
            "held": self._longest_hold if self._distances.n else None,
            "time_reached": self._reached_time,
            "time_done": self._done_time,
        }

    @property
    def reasons(self) -> dict[str, str]:
        """The reasons why details are None."""
        reasons = {
            "time_reached": "it was never reached",
            "time_done": "it was not held long enough",
        }
        return {name: reason for name, reason in reasons.items() if self.details[name] is None}

    @property
    def log_header(self) -> tuple[str, ...]:
        """The columns: success, and the distance."""
        return ("value", "distance [m]")

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """The present values of the columns of the log."""
        return (self.value, self._distances.value("last"))

    @property
    def ends_level(self) -> str | None:
        """A sentence that states the success."""
        return None if self._done_time is None else f"{self._spec.to!r} was reached"

    @property
    def task_status(self) -> tuple[str, str | None]:
        """The status ``ok`` for a success, else ``timeout``."""
        if self._done_time is not None:
            return "ok", None
        hold, tolerance = self._longest_hold, self._spec.tolerance
        return "timeout", f"{self._spec.to!r} was within {tolerance:g} m for {hold:g} s at most"
