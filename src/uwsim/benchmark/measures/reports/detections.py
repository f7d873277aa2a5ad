"""Detections: the reported places of the holes of a net, or of an object, and the true ones.

.. code-block:: xml

    <u:detections>
      <name>holes</name> <target>bluerov2</target> <topic>/holes</topic>
      <net>net</net> <tolerance>0.3</tolerance>
    </u:detections>

With ``<object>wreck</object>`` instead of ``<net>`` the origin of this body is sought.

The places are in the navigation frame of the vehicle, as for ``<u:mapError>``: the axes of L, with
the origin at the position of the vehicle when the measure starts, but at the depth 0 of L.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ....base.geometry import Array
from ....base.numerics.linear import rotate_rows
from ....errors import BadSetting
from ....messages import PointCloud2, points
from ....schema import element
from ....world import World
from ..measure import Measure, MeasureSpec

MAX_REPORTS = 1000
"""The greatest number of reported places that are compared; further ones are false reports."""


@dataclass(frozen=True, kw_only=True)
class DetectionsSpec(MeasureSpec):
    """A ``<u:detections>`` element of a benchmark file."""

    target: str = element(refers_to="body")
    """The vehicle whose start is the horizontal origin of the reported places."""
    topic: str
    """The topic of the reports (sensor_msgs/PointCloud2): all places that are believed to be holes,
    or the object. A report replaces the one before."""
    net: str | None = None
    """The object with a ``<u:net>`` whose holes are sought; required without ``object``."""
    object_: str | None = element("object", default=None, refers_to="body")
    """The body that is sought, at its place when the measure starts; required without ``net``."""
    tolerance: float = element(exclusive_minimum=0.0)
    """The greatest distance of a reported place from the centre of a hole, or from the object
    [m]."""

    def errors(self) -> Sequence[str]:
        """Return an error unless there is either a net or an object."""
        if (self.net is None) == (self.object_ is None):
            return ["<u:detections> has one of <net> and <object>"]
        return []

    def bind(self, world: World) -> Detections:
        """Resolve vehicle, and net or object; raises UnknownName if one is unknown."""
        return Detections(self, world)


class Detections(Measure):
    r"""The F1 score of the newest report: 2 p r / (p + r), with the precision p and the recall r.

    Pairs of a reported place and a hole are formed in the order of their distances, each place and
    each hole at most once, while the distance is at most the tolerance. A hole of a pair is found.
    A reported place without a hole is false.

    An object counts as the one hole of a net.

    Details: ``precision``, the share of the reported places in pairs [1], None without a report;
    ``recall``, the share of the holes that are found [1], None without holes; ``n_found``,
    ``n_missed`` and ``n_false``; and ``error``, the mean distance of the pairs [m]. Before the
    first report nothing is found. The value is 0 without a pair, and None if there are no holes.
    """

    unit = "1"
    detail_units: ClassVar[Mapping[str, str]] = {"error": "m"}
    fed_by_algorithm = True

    def __init__(self, spec: DetectionsSpec, world: World) -> None:
        self._spec, self._world = spec, world
        self._target = world.body(spec.target)
        self._object = None if spec.object_ is None else world.body(spec.object_)
        self._holes = np.empty((0, 3))  # in W (n, 3) [m]
        if spec.net is not None:
            self._holes = world.surroundings.holes(spec.net)[:, :3]
        self._inbox = world.bus.inbox(spec.topic, PointCloud2)
        self._origin: Array | None = None  # of the places, in L (3,) [m]
        self._n_reports = 0  # the number of reported places
        self._distances: list[float] = []  # of the pairs [m]
        self._note = ""

    def start(self) -> None:
        """Set the origin of the places; earlier reports do not count."""
        localized_from_world = self._world.world_from_localized.inverse()
        position = (localized_from_world @ self._target.world_from_body).position
        self._origin = np.array([position[0], position[1], 0.0])
        if self._object is not None:
            self._holes = self._object.world_from_body.position[None]
        self._inbox.clear()

    def update(self) -> None:
        """Compare the newest report."""
        for message in self._inbox.take():
            try:
                places = points(message)
            except BadSetting as error:
                self._note = f"a report on {self._spec.topic!r} was not used: {error}"
                continue
            self._n_reports = len(places)
            self._distances = self._pair(places[:MAX_REPORTS])

    @property
    def value(self) -> float | None:
        """The F1 score [1]."""
        if self._origin is None or not len(self._holes):
            return None
        return 2.0 * len(self._distances) / (self._n_reports + len(self._holes))

    @property
    def missing_reason(self) -> str | None:
        """The reason why there is no value."""
        if self.value is not None:
            return None
        return "it was never on" if self._origin is None else "the net has no holes"

    @property
    def details(self) -> dict[str, float | None]:
        """The precision, the recall, the numbers of places, and the mean distance of pairs."""
        n = len(self._distances)
        return {
            "precision": n / self._n_reports if self._n_reports else None,
            "recall": n / len(self._holes) if len(self._holes) else None,
            "n_found": float(n),
            "n_missed": float(len(self._holes) - n),
            "n_false": float(self._n_reports - n),
            "error": sum(self._distances) / n if n else None,
        }

    @property
    def reasons(self) -> dict[str, str]:
        """The reasons why there is no precision, recall or error."""
        reasons = {} if self._n_reports else {"precision": "nothing was reported"}
        if not self._distances:
            reasons["error"] = "no hole was found"
        return reasons if len(self._holes) else {**reasons, "recall": "the net has no holes"}

    @property
    def log_header(self) -> tuple[str, ...]:
        """The value and the numbers of places."""
        return ("f1", "n_found", "n_false")

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """The present values."""
        details = self.details
        return (self.value, details["n_found"], details["n_false"])

    @property
    def notes(self) -> tuple[str, ...]:
        """The error of an invalid report."""
        return (self._note,) if self._note else ()

    def close(self) -> None:
        """Unsubscribe."""
        self._inbox.close()

    def _pair(self, places: Array) -> list[float]:
        """Return the distance of each pair of a reported place and a hole [m]."""
        if self._origin is None or not len(self._holes):
            return []
        frame = self._world.world_from_localized
        world_places = rotate_rows(frame.rotation, places + self._origin) + frame.position
        offsets = world_places[:, None] - self._holes[None]
        distances = np.sqrt(np.sum(offsets * offsets, axis=2))
        distances = np.where(distances <= self._spec.tolerance, distances, np.inf)  # NaN: inf
        pairs: list[float] = []
        while distances.size and np.isfinite(distances.min()):
            i, j = np.unravel_index(int(np.argmin(distances)), distances.shape)
            pairs.append(float(distances[i, j]))
            distances[i], distances[:, j] = np.inf, np.inf
        return pairs
