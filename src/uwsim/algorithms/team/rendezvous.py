"""``rendezvous-wait``, ``rendezvous-pursuit``, ``rendezvous-predict``: two vehicles meet.

Each vehicle sends a report of its position and velocity at a period, by its modem. They differ in
what a vehicle does with a report of the other one:

- *wait*: the first vehicle goes to the reported place; the second one stays where it is.
- *pursuit*: both go to the newest reported place.
- *predict*: both go to where the other one is now if it has kept its velocity since its report. The
  age of a report includes its travel, ``latency`` [s], as a constant.

A vehicle keeps its depth, and ends at a horizontal distance ``standoff`` [m] from the other one, so
that they do not collide. Before its first report a vehicle stays at its place.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from ...bus import Node
from ..parametric import ParametricAlgorithm, start_benchmark
from .guided_vehicle import GuidedVehicle, place_beside
from .position_report import PositionReport, ReportLink

MAX_AGE = 20.0
"""The greatest age of a report up to which the motion of the other vehicle is predicted [s]."""


class RendezvousPursuit(ParametricAlgorithm):
    """Two vehicles that go to the newest reported place of one another."""

    IS_WAITING: ClassVar[bool] = False
    """True if the second vehicle stays at its place."""
    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        "vehicles": "first second",
        "period": 5.0,
        "speed": 0.6,
        "standoff": 0.8,
        "prediction": 0.0,
        "latency": 2.0,
    }
    """The names of the ``vehicles``, whose modems are ``NAME_modem``; the ``period`` of the reports
    [s]; the ``speed`` through the water [m/s]; the ``standoff`` [m]; whether to predict the motion
    (1 or 0); and the ``latency`` of a report [s]."""

    def start(self, node: Node) -> None:
        """Start the two vehicles, and the benchmark."""
        self._read_parameters(node.parameters)
        names = str(self._parameters["vehicles"]).split()
        numbers = {
            name: float(value) for name, value in self._parameters.items() if name != "vehicles"
        }
        self._members = [
            _Member(node, name, numbers, is_waiting=self.IS_WAITING and index > 0)
            for index, name in enumerate(names)
        ]
        self._n_slots = 0
        node.create_timer(numbers["period"] / len(names), self._send_next)
        start_benchmark(node)

    def _send_next(self) -> None:
        """Send the report of the next vehicle: each has its own slot of the period."""
        self._members[self._n_slots % len(self._members)].send()
        self._n_slots += 1


class RendezvousPredict(RendezvousPursuit):
    """Two vehicles that go to the predicted places of one another."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **RendezvousPursuit.PARAMETERS,
        "prediction": 1.0,
    }
    """The parameters of `RendezvousPursuit`."""


class RendezvousWait(RendezvousPursuit):
    """A vehicle that waits and reports its place, and another one that goes there."""

    IS_WAITING: ClassVar[bool] = True


class _Member:
    """One of the vehicles: it knows its own sensors, and the packets of its modem."""

    def __init__(
        self, node: Node, name: str, numbers: Mapping[str, float], *, is_waiting: bool
    ) -> None:
        self._node, self._numbers, self._is_waiting = node, numbers, is_waiting
        self._vehicle = GuidedVehicle(node, name, speed=numbers["speed"])
        self._link = ReportLink(node, f"{name}_modem", self._on_report)
        self._report: PositionReport | None = None
        self._depth: float | None = None  # the depth that is kept [m]
        node.create_timer(0.5, self._steer)

    def _on_report(self, report: PositionReport) -> None:
        self._report = report

    def send(self) -> None:
        """Send a report, if the vehicle knows its position."""
        if self._vehicle.is_ready:
            self._link.send(self._vehicle.position, self._vehicle.velocity)

    def _steer(self) -> None:
        """Set the goal of the vehicle."""
        if not self._vehicle.is_ready:
            return
        position = self._vehicle.position
        if self._depth is None:
            self._depth = float(position[2])
            self._vehicle.go_to(position)
        if self._report is None or self._is_waiting:
            return
        age = self._node.now - self._report.time + self._numbers["latency"]
        predicted_time = self._report.time + self._numbers["prediction"] * min(age, MAX_AGE)
        position[2] = self._depth
        place = self._report.position_at(predicted_time)
        self._vehicle.go_to(place_beside(place, position, self._numbers["standoff"]))
