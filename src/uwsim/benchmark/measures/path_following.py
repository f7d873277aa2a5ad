r"""Path following: the distance of a body from a path.

.. code-block:: xml

    <pathFollowing u:value="rms">
      <name>pathError</name> <target>girona500</target>
      <topic>path</topic> <from>localizedWorld</from>
    </pathFollowing>

With ``<u:path>`` the benchmark file itself defines the path, by points or by a CSV file:

.. code-block:: xml

    <pathFollowing u:value="rms">
      <name>pathError</name> <target>girona500</target> <from>localizedWorld</from>
      <u:path> <u:points> 0 0 4  2 0 4  2 1 4 </u:points> </u:path>
    </pathFollowing>

A path may be a task: the level ends when the body has reached a share of it, or is too far from it.

.. code-block:: xml

    <pathFollowing u:value="rms" u:endShare="0.98" u:maxDistance="2">
      <name>offset</name> <target>bluerov2</target>
      <u:path> <u:object>pipe</u:object> <u:height>1.2</u:height> </u:path>
    </pathFollowing>
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from ...base.geometry import Array
from ...base.inbox import Inbox
from ...base.numerics.linear import rotate_back
from ...base.numerics.polyline import Polyline
from ...messages import Path
from ...schema import element
from ...world import Body, World
from ..metrics.signal import VALUES, Signal
from ..reference_path import ReferencePathSpec, path_message
from .measure import Measure, MeasureSpec

DETAIL_UNITS = {"iae": "m s", "distance": "m", "waypoint": "1", "ise": "m^2 s", "share": "1"}
"""The details and their units; the first three are those of the original UWSim, in its order."""
STATISTIC_UNITS = {"mean": "m", "rms": "m", "max": "m", "std": "m", "n": "1"}
"""The statistics of the distance and their units."""


@dataclass(frozen=True, kw_only=True)
class PathFollowingSpec(MeasureSpec):
    """A ``<pathFollowing>`` element of a benchmark file.

    ``u:value="last"`` selects the integral of the distance over time, as in the original UWSim;
    ``mean``, ``rms`` and ``max`` select these statistics of the distance from the path.
    """

    values: ClassVar[tuple[str, ...]] = VALUES
    error_flag: ClassVar[int] = -1
    statuses: ClassVar[tuple[str, ...]] = ("lost", "timeout")

    target: str = element(refers_to="body")
    """The route of the body."""
    topic: str | None = element(default=None)
    """The topic of the path (nav_msgs/Path); without one there is no path, and so no value."""
    from_: str | None = element("from", default=None, refers_to="body")
    """The route of the body in whose frame the path is given; None: the world frame W (not the
    localized world L)."""
    reference: ReferencePathSpec | None = element("path", namespaced=True, default=None)
    """The path. If there is a ``<topic>`` too, the path is published on it when the measure
    starts."""
    end_share: float | None = element(
        default=None, attribute=True, namespaced=True, exclusive_minimum=0.0, maximum=1.0
    )
    """The share of the path's length at which the level ends, in status ``ok`` (``u:endShare``)
    [1]. A level that ends earlier has the status ``timeout``."""
    max_distance: float | None = element(
        default=None, attribute=True, namespaced=True, exclusive_minimum=0.0
    )
    """The distance from the path beyond which the level ends, in status ``lost``
    (``u:maxDistance``) [m]."""
    path: str = field(default="", compare=False, metadata={"path": True})
    """The path of the benchmark file, in whose folder a CSV file of points is."""

    def errors(self) -> Sequence[str]:
        """Return errors of the path."""
        if self.reference is None:
            return ()
        if self.reference.object is not None and self.from_ is not None:
            return ["<from> does not apply to the line of an <u:object>; remove it"]
        return self.reference.errors()

    @property
    def start_value(self) -> float:
        """The value that the original UWSim reports before its first sample [m s]."""
        return 0.0

    def bind(self, world: World) -> PathFollowing:
        """Resolve target and frame; raises UnknownName if one is unknown."""
        inbox = None if self.topic is None else world.bus.inbox(self.topic, Path, latched=True)
        frame = None if self.from_ is None else world.body(self.from_)
        points = None if self.reference is None else self.reference.read(self.path, world)
        return PathFollowing(self, world, world.body(self.target), frame, inbox, points)


class PathFollowing(Measure):
    r"""The distance :math:`d` of a body's origin from a path, or its integral over time.

    .. math:: \text{iae} = \int d \, dt \qquad \text{ise} = \int d^2 \, dt

    d is sampled at every step and assumed to be linear in time between steps. With the distances
    :math:`d_0` and :math:`d_1` at the start and end of a step of :math:`\Delta t`, the step adds
    :math:`(d_0 + d_1) \Delta t / 2` to the first integral and
    :math:`(d_0^2 + d_0 d_1 + d_1^2) \Delta t / 3` to the second. The time while the measure is
    inactive, or without a path, does not count.

    The path is given by ``<u:path>``. Without that element, it is the newest path on the topic when
    the measure starts, or the first one to arrive after that; later paths are ignored until the
    next level. Straight segments join the points of the path in the frame ``from``, at the present
    pose of that frame (orientations of points and the message's frame_id are not used).

    d is the distance from the current segment. The first segment is current at the start. When the
    body is nearer to the next segment than to the current one, the next segment becomes current;
    an earlier segment never becomes current again. At most one segment is passed at each step. A
    body that begins in the middle of the path is measured against the first segments until it comes
    near them. A point that repeats the previous point is left out.

    Details: ``iae`` (the value) [m s]; ``ise`` [m^2 s]; the present ``distance`` [m]; ``waypoint``,
    the index of the point at which the current segment begins; ``share``, the largest fraction of
    the path's length that the point nearest to the body has reached [1]; and the statistics of the
    distance over all steps [m].

    With ``u:endShare`` or ``u:maxDistance`` the measure is the task of the level (`task_status`).
    With ``u:endShare`` there is a further detail: ``time_done``, the time after the start at which
    the end was reached [s].

    Compatibility ``path-ise``: both ``iae`` and ``ise`` are the sum of :math:`d_1 \Delta t`.
    ``path-frame``: the position of ``from`` in W is added to the points of the path.
    ``path-repeats``: a repeated point is a segment of length 0; as the body is never nearer to this
    segment than to the previous one, the previous segment stays current. ``path-point``: a path of
    one point is invalid. (The original UWSim reads beyond the end of its list of points. Without
    this quirk the path is a segment of length 0.)
    """

    unit = "m s"

    def __init__(
        self,
        spec: PathFollowingSpec,
        world: World,
        target: Body,
        frame: Body | None,
        inbox: Inbox[Path] | None,
        points: Array | None = None,
    ) -> None:
        self._world, self._target, self._frame, self._inbox = world, target, frame, inbox
        self._topic, self._statistic = spec.topic, spec.value
        self._end_share, self._max_distance = spec.end_share, spec.max_distance
        self._loss: str | None = None  # the reason for the status "lost"
        self._has_original_ise = "path-ise" in world.compatibility
        self._adds_position = "path-frame" in world.compatibility
        self._keeps_repeats = "path-repeats" in world.compatibility
        self._refuses_points = "path-point" in world.compatibility
        if spec.value != "last":
            self.unit = "m"  # type: ignore[misc]  # depends on u:value
        ise = {"ise": "m s"} if self._has_original_ise else {}
        end_time = {} if spec.end_share is None else {"time_done": "s"}
        self.detail_units = {**DETAIL_UNITS, **STATISTIC_UNITS, **ise, **end_time}  # type: ignore[misc]
        self._start_time = 0.0  # simulation time [s]
        self._done_time: float | None = None  # time of the end of the path after the start [s]
        self._path: Polyline | None = None
        self._waypoints: list[int] = []  # the index of the point at which each segment begins
        self._error = ""  # what is wrong with the newest path
        self._reference = points  # of <u:path> (n, 3) [m]
        self._was_active = False
        self._segment = 0  # index of the current segment
        self._farthest_length = 0.0  # largest path length up to a nearest point [m]
        self._iae = 0.0  # [m s]
        self._ise = 0.0  # [m^2 s]
        self._last_sample: tuple[int, float] | None = None  # the last step, and d at it [m]
        self._signal = Signal(())

    def start(self) -> None:
        """Begin with the newest path."""
        self._was_active = True
        self._start_time = self._world.time
        self._last_sample = None
        if self._reference is not None:
            self._set_path(self._reference)
            if self._topic is not None:
                self._world.bus.publisher(self._topic, Path)(path_message(self._reference))
        self.update()

    def update(self) -> None:
        """Sample the distance, and integrate from the last step to this one."""
        if self._path is None:
            self._read_path()
        if self._path is None:
            return
        position = self._position()
        self._segment, distance, length = self._path.follow(self._segment, position)
        self._farthest_length = max(self._farthest_length, length)
        if self._last_sample is not None:
            step, last_distance = self._last_sample
            duration = (self._world.step - step) * self._world.timestep  # [s]
            self._integrate(last_distance, distance, duration)
        self._last_sample = (self._world.step, distance)
        self._signal.add(distance, ())
        if self._done_time is None and self._has_arrived:
            self._done_time = self._world.time - self._start_time
        if self._loss is None and self._max_distance is not None and distance > self._max_distance:
            self._loss = f"{distance:.3g} m from the path at {self._world.time:g} s"

    @property
    def ends_level(self) -> str | None:
        """The reason to end the level: the end of the path, or a distance that is too great."""
        return "the end of the path is reached" if self._has_arrived else self._loss

    @property
    def task_status(self) -> tuple[str, str | None] | None:
        """The status of the task: ``ok``, ``lost`` or ``timeout``; None without a task."""
        if self._loss is not None and not self._has_arrived:
            return "lost", self._loss
        if self._end_share is None or self._has_arrived or not self._signal.n:
            return ("ok", None) if self._has_arrived else None
        return "timeout", f"reached {self.details['share'] or 0.0:.3g} of the path"

    @property
    def _has_arrived(self) -> bool:
        if self._end_share is None or self._path is None:
            return False
        return self._farthest_length >= self._end_share * self._path.length

    @property
    def value(self) -> float | None:
        """The integral of the distance [m s], or the statistic given by ``u:value`` [m]."""
        if not self._signal.n:
            return None
        return self._iae if self._statistic == "last" else self._signal.value(self._statistic)

    @property
    def missing_reason(self) -> str | None:
        """The reason why there is no value."""
        if self._signal.n:
            return None
        if not self._was_active:
            return "it was never on"
        if self._topic is None:
            return "neither <topic> nor <u:path> gives a path"
        return self._error or f"no path on {self._topic!r}"

    @property
    def details(self) -> dict[str, float | None]:
        """The integrals and statistics of the distance, and the fraction of the path reached."""
        parts: dict[str, float | None] = dict.fromkeys(DETAIL_UNITS)
        if self._path is not None:
            length = self._path.length
            parts = {
                "iae": self._iae,
                "distance": self._signal.last_sample[0],
                "waypoint": float(self._waypoints[self._segment]),
                "ise": self._iae if self._has_original_ise else self._ise,
                "share": self._farthest_length / length if length > 0.0 else None,
            }
        end_time = {} if self._end_share is None else {"time_done": self._done_time}
        return {**parts, **self._signal.details, **end_time}

    @property
    def reasons(self) -> dict[str, str]:
        """The reason why the path has no share."""
        is_point = self._path is not None and self._path.length == 0.0
        reasons = {"share": "the path has no length"} if is_point else {}
        if self._end_share is not None and self._done_time is None:
            reasons["time_done"] = "the end of the path was not reached"
        return reasons

    @property
    def log_header(self) -> tuple[str, ...]:
        """The details except the statistics; the first three are those of the original UWSim."""
        return tuple(DETAIL_UNITS)

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """The present values."""
        details = self.details
        return tuple(details[name] for name in self.log_header)

    @property
    def newest_sample(self) -> float | None:
        """The present distance [m]."""
        return self._signal.last_sample[0]

    @property
    def notes(self) -> tuple[str, ...]:
        """The error of an invalid path."""
        return (self._error,) if self._error else ()

    def close(self) -> None:
        """Unsubscribe."""
        if self._inbox is not None:
            self._inbox.close()

    def _read_path(self) -> None:
        messages = self._inbox.take() if self._inbox is not None else []
        if not messages:
            return
        points = _path_points(messages[-1])
        if points is None:
            self._error = f"the path on {self._topic!r} has points that are no finite numbers"
        elif not len(points):
            self._error = f"the path on {self._topic!r} has no points"
        elif len(points) == 1 and self._refuses_points:
            self._error = f"the path on {self._topic!r} has one point"
        else:
            self._set_path(points)

    def _set_path(self, points: Array) -> None:
        """Set the path to points (n, 3) [m]."""
        if self._adds_position and self._frame is not None:
            points = points + self._frame.world_from_body.position
        is_distinct = np.r_[True, np.any(points[1:] != points[:-1], axis=1) | self._keeps_repeats]
        self._waypoints = np.flatnonzero(is_distinct).tolist()
        self._path = Polyline(points[is_distinct])

    def _position(self) -> Array:
        """Return the position of the body in the path's frame, (3,) [m]."""
        position = self._target.world_from_body.position
        if self._frame is None:
            return position
        world_from_frame = self._frame.world_from_body
        return rotate_back(world_from_frame.rotation, position - world_from_frame.position)

    def _integrate(self, last_distance: float, distance: float, duration: float) -> None:
        """Add a step of ``duration`` [s] between two distances [m] to the integrals."""
        if self._has_original_ise:
            self._iae += distance * duration
            return
        self._iae += (last_distance + distance) * duration / 2.0
        self._ise += (last_distance**2 + last_distance * distance + distance**2) * duration / 3.0


def _path_points(path: Path) -> Array | None:
    """Return the points of a path, (n, 3) [m]; None if one is not finite."""
    try:
        positions = [pose.pose.position for pose in path.poses]
        points = np.array([(p.x, p.y, p.z) for p in positions], dtype=np.float64)
    except (AttributeError, TypeError, ValueError):  # a message built by other code
        return None
    return points.reshape(-1, 3) if np.isfinite(points).all() else None
