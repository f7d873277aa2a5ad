r"""u:waypoints: places that a body has to reach one after the other, as in OneOcean's tasks.

.. code-block:: xml

    <u:waypoints>
      <name>route</name> <target>auv</target> <topic>/auv/goal</topic>
      <count>20</count> <length>277.2</length> <radius>1.6</radius>
    </u:waypoints>

The places depend on the seed and on where the body begins, by the rules of the repository
OneOcean-IROS (benchmark_core/env.py): see `draw_waypoints`. All are within a square of `SIDE` by
`SIDE` with a corner at the origin of L, the localized world frame.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from uwsim.base.geometry import Array
from uwsim.base.numerics.linear import rotate
from uwsim.benchmark.measures import Measure, MeasureSpec, Signal
from uwsim.messages import PoseStamped
from uwsim.schema import element
from uwsim.world import Body, World

SIDE = 600.0
"""The side of the square in which all places are [m]."""
SPREAD = 0.05
"""The standard deviation of the places about the line, by the length of the line [1]."""
SHARE_BEHIND = 0.25
"""The share of the line that is behind the start [1]."""


def draw_waypoints(
    start: Array, generator: np.random.Generator, *, count: int, length: float
) -> Array:
    """Draw places at the depth of the start, (count, 3) [m].

    One place is at the distance ``length`` in a direction of which all are equally likely. Several
    are about a line in such a direction, of which a quarter is behind the start: at equal
    distances along it, with normal deviations of 5 % of its length along x and y. Coordinates
    beyond the square are moved to its border.

    Args:
        start: the place where the vehicle begins, (3,) [m].
        generator: the random generator.
        count: the number of places.
        length: the distance of the one place, or the length of the line [m].
    """
    angle = generator.uniform(0.0, 2.0 * math.pi)
    direction = np.array([math.cos(angle), math.sin(angle), 0.0])
    if count == 1:
        return _clip_to_square((start + length * direction)[np.newaxis])
    start_of_line, end_of_line = _clip_to_square(
        start + np.array([[-SHARE_BEHIND], [1.0 - SHARE_BEHIND]]) * length * direction
    )
    places: Array = start_of_line + np.linspace(0.0, 1.0, count)[:, np.newaxis] * (
        end_of_line - start_of_line
    )
    places[:, :2] += generator.normal(scale=SPREAD * length, size=(count, 2))
    return _clip_to_square(places)


def _clip_to_square(places: Array) -> Array:
    clipped_places = places.copy()
    clipped_places[:, :2] = np.clip(places[:, :2], 0.0, SIDE)
    return clipped_places


@dataclass(frozen=True, kw_only=True)
class WaypointsSpec(MeasureSpec):
    """A ``<u:waypoints>`` element of a benchmark file."""

    target: str = element(refers_to="body")
    """The route of the body."""
    topic: str
    """The topic of the present place (geometry_msgs/PoseStamped, in L)."""
    count: int = element(minimum=1, maximum=1000)
    """The number of places."""
    length: float = element(minimum=0.0, maximum=1000.0)
    """The distance of the one place, or the length of the line of several [m]; 0: the start."""
    radius: float = element(exclusive_minimum=0.0)
    """The distance at which a place is reached [m]."""

    def bind(self, world: World) -> Waypoints:
        """Resolve the target; raises UnknownName if there is none."""
        return Waypoints(self, world, world.body(self.target))


class Waypoints(Measure):
    """The share of the places that the body has reached, one after the other.

    A place is reached at the first step at which the body's origin is within the radius. Then the
    next place is published. Details: the number of ``reached`` places, and the statistics of the
    distance from the present place over all steps [m].
    """

    unit = "1"
    detail_units: ClassVar[Mapping[str, str]] = {
        "reached": "1",
        **dict.fromkeys(("distance", "mean", "rms", "max", "std"), "m"),
        "n": "1",
    }

    def __init__(self, spec: WaypointsSpec, world: World, body: Body) -> None:
        self._spec, self._world, self._body = spec, world, body
        self._localized_from_world = world.world_from_localized.inverse()
        self._publish = world.bus.publisher(spec.topic, PoseStamped)
        self._places: Array | None = None  # in L (count, 3) [m]
        self._n_reached = 0
        self._signal = Signal(())  # the distance from the present place [m]

    def start(self) -> None:
        """Draw the places, and publish the first."""
        self._places = draw_waypoints(
            self._position(),
            self._world.stream("waypoints"),
            count=self._spec.count,
            length=self._spec.length,
        )
        self._publish_place()
        self.update()

    def update(self) -> None:
        """Take a sample of the distance; go on to the next place if this one is reached."""
        if self._places is None:
            return
        place = self._places[min(self._n_reached, len(self._places) - 1)]
        distance = math.hypot(*(self._position() - place).tolist())
        self._signal.add(distance, ())
        if self._n_reached < len(self._places) and distance <= self._spec.radius:
            self._n_reached += 1
            if self._n_reached < len(self._places):
                self._publish_place()

    @property
    def value(self) -> float | None:
        """The share of the places that were reached; None if the measure was never active."""
        return None if self._places is None else self._n_reached / len(self._places)

    @property
    def details(self) -> dict[str, float | None]:
        """The number of places that were reached, and the distances from the present place."""
        return {
            "reached": float(self._n_reached),
            "distance": self._signal.last_sample[0],
            **self._signal.details,
        }

    def _position(self) -> Array:
        """Return the position of the body in L, (3,) [m]."""
        frame = self._localized_from_world
        return rotate(frame.rotation, self._body.world_from_body.position) + frame.position

    def _publish_place(self) -> None:
        if self._places is None:
            return
        message, point = PoseStamped(), self._places[self._n_reached].tolist()
        message.pose.position.x, message.pose.position.y, message.pose.position.z = point
        self._publish(message)


MEASURES = {"waypoints": WaypointsSpec}
