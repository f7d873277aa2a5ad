r"""u:grasp: whether a vehicle lifted and held an object, and the phases of the attempt.

.. code-block:: xml

    <u:grasp>
      <name>success</name>
      <target>blackbox</target>
      <vehicle>girona500</vehicle> <jaw>girona500/end_effector</jaw>
      <lift>0.5</lift> <hold>10</hold>
      <topic>graspPhase</topic> <phases>search approach grasp lift hold</phases>
    </u:grasp>

W is the world frame, z up.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...base.geometry import Array, Pose
from ...base.inbox import Inbox
from ...base.numerics.linear import length
from ...messages import String
from ...schema import element
from ...world import Body, World
from ..metrics.impulse import Impulse
from .measure import Measure, MeasureSpec
from .phases import Phases

RAISED_HEIGHT = 0.02
"""The height above its rest position from which a held object is off the ground [m]."""
DROP_HEIGHT = 0.1
"""The largest lift after which a lost object counts as missed, not dropped [m].

The algorithm may then try again."""
DROP_TIME = 0.5
"""The time without contact with the vehicle after which a raised object counts as dropped [s]."""
SETTLING_TIME = 1.0
"""The time from when the object leaves the ground until slip is first evaluated [s]."""
NOT_FOUND = "not found"
"""The start of the reason with which an algorithm ends an unsuccessful search."""


@dataclass(frozen=True, kw_only=True)
class GraspSpec(MeasureSpec):
    """A ``<u:grasp>`` element of a benchmark file."""

    columns: ClassVar[tuple[str, ...]] = ("height", "force_on_object", "force_on_ground")
    statuses: ClassVar[tuple[str, ...]] = (
        *("collision", "dropped", "missed", "not found", "lost target", "timeout"),
    )

    target: str = element(refers_to="contacts")
    """The name of the object."""
    vehicle: str = element(refers_to="vehicle")
    """The name of the vehicle that lifts the object."""
    jaw: str = element(refers_to="body")
    """The route of the frame between the fingers of the jaw, in which slip is measured."""
    ground: str = element(default="terrain", refers_to="contacts")
    """The name of the body on which the object lies."""
    lift: float = element(default=0.5, exclusive_minimum=0.0)
    """The height above its rest position to which the object has to be lifted [m]."""
    hold: float = element(default=10.0, exclusive_minimum=0.0)
    """The time for which the lifted object has to be held [s]."""
    max_impulse: float = element(default=40.0, exclusive_minimum=0.0)
    """The impulse within 50 ms, on the ground or the object, above which a contact is a collision
    [N s]."""
    topic: str | None = None
    """The topic on which the algorithm publishes its phase (std_msgs/String)."""
    phases: str = ""
    """The names of the algorithm's phases, in their order, separated by blanks."""
    truth: str = ""
    """The topics with the true state, separated by blanks; a note in the result names those that
    the algorithm reads."""

    def errors(self) -> Sequence[str]:
        """Return errors: phases without a topic, a repeated phase, one name for two bodies."""
        names, errors = self.phases.split(), []
        if names and self.topic is None:
            errors.append("<phases> need a <topic> on which they are published")
        if len(set(names)) < len(names):
            errors.append("<phases> has a phase twice")
        if len({self.target, self.vehicle, self.ground}) < 3:
            errors.append("<target>, <vehicle> and <ground> have to be three different things")
        if self.jaw in (self.target, self.ground):
            errors.append(f"<jaw> is {self.jaw!r}; expected a frame of {self.vehicle!r}")
        return errors

    def bind(self, world: World) -> Grasp:
        """Resolve object, vehicle and jaw; raises UnknownName if one is unknown."""
        world.contacts(self.target)
        world.contacts(self.vehicle)
        inbox = world.bus.inbox(self.topic, String) if self.topic else None
        return Grasp(self, world, inbox)


class Grasp(Measure):
    r"""1 if the object was lifted by ``lift`` and then held for ``hold`` seconds, else 0.

    The object is *carried* while it is in contact with the vehicle and not with the ground, and
    more than 2 cm above its rest height. The *hold* begins when the object is carried at least
    ``lift`` above its rest height, and lasts while it is carried. Everything but the phases is
    computed from the state of the simulation, not from messages of the algorithm.

    *Slip.* When the hold begins, the mean position of the contacts between object and vehicle
    defines a point of the object. ``slip`` is the largest displacement of this point in the jaw's
    frame during the hold. ``slip_raising`` is the same for a point defined 1 s after the object has
    left the ground, until the hold begins.

    *Impulses* are :math:`\max_t \lVert \int_{t-50\,\mathrm{ms}}^{t} F\,dt \rVert` of the net force
    F of the vehicle on the object, and of the ground on the vehicle; the forces of the two fingers
    of a closed jaw cancel. ``excursion`` is the largest displacement of the vehicle's base from the
    first contact with the object until the object leaves the ground.

    The measure ends the level after a success, after a collision, and when the object was dropped.
    It determines the status of the level (`task_status`).
    """

    unit = "1"
    detail_units: ClassVar[dict[str, str]] = {
        "height": "m",
        "held": "s",
        "slip": "m",
        "slip_raising": "m",
        "impulse_on_object": "N s",
        "impulse_on_ground": "N s",
        "excursion": "m",
        "time_touched": "s",
        "time_raised": "s",
        "time_lifted": "s",
        "time_done": "s",
        "time": "s",
    }

    def __init__(self, spec: GraspSpec, world: World, inbox: Inbox[String] | None) -> None:
        self._spec, self._world = spec, world
        self._object: Body = world.body(spec.target)
        self._jaw: Body = world.body(spec.jaw)
        self._base: Body = world.body(spec.vehicle)
        self._phases = Phases(spec.phases.split(), world, inbox)
        self._on_object = Impulse(world.timestep)
        self._on_ground = Impulse(world.timestep)
        self._start_time: float | None = None  # simulation time [s]; all times below are after it
        self._rest_height = 0.0  # height of the object at the start, z in W [m]
        self._height = 0.0  # largest height while carried, above the rest height [m]
        self._longest_hold = 0.0  # [s]
        self._event_times: dict[str, float] = {}  # first time of each event [s]
        self._hold_start: float | None = None  # [s]
        self._hold_point: tuple[Array, Array] | None = None  # `_contact_point` of the hold
        self._raising_point: tuple[Array, Array] | None = None  # `_contact_point` while raising
        self._slip: float | None = None  # [m]
        self._slip_raising: float | None = None  # [m]
        self._contact_position: Array | None = None  # of the base at first contact, W (3,) [m]
        self._excursion: float | None = None  # [m]
        self._last_contact: float | None = None  # time of last contact of vehicle and object [s]
        self._carry_start: float | None = None  # [s]
        self._n_collisions = 0  # contacts of the vehicle with the ground
        self._ground_contact: float | None = None  # time of the last of these contacts [s]
        self._end: tuple[str, str | None] | None = None  # status and reason of the ended task
        self._read_topics: dict[str, None] = {}  # topics with the truth that the algorithm read

    def start(self) -> None:
        """Store the rest height of the object."""
        self._start_time = self._world.time
        self._rest_height = float(self._object.world_from_body.position[2])
        self._find_read_topics()
        self.update()

    def update(self) -> None:
        """Evaluate contacts and poses after one more step."""
        if self._start_time is None or self._end is not None:
            return
        time = self._world.time - self._start_time
        self._phases.update()
        forces = self._world.contact_forces(self._spec.target)
        is_held = self._spec.vehicle in forces
        self._add_forces(time, forces)
        if is_held:
            self._record_event("touched", time)
            self._last_contact = time
        height = 0.0  # unused unless the object is held
        if is_held and self._spec.ground not in forces:
            height = float(self._object.world_from_body.position[2]) - self._rest_height
        is_carried = height > RAISED_HEIGHT
        if is_carried:
            self._record_event("raised", time)
            self._height = max(self._height, height)
            self._carry_start = time if self._carry_start is None else self._carry_start
        else:
            self._carry_start = self._raising_point = self._hold_start = None
        self._track_motion(time)
        if is_carried:
            self._time_hold(time, height)
        self._check_end(time, is_carried)

    def _check_end(self, time: float, is_carried: bool) -> None:
        """End the level if the object was dropped, or the algorithm has given up."""
        if self._end is not None:
            return
        last_contact = time if self._last_contact is None else self._last_contact
        if self._height > DROP_HEIGHT and time - last_contact > DROP_TIME:
            phase = "while it was held" if "lifted" in self._event_times else "on its way up"
            self._end = "dropped", f"{self._spec.target!r} fell at {time:g} s, {phase}"
        elif self._phases.abort_reason is not None and not is_carried:
            self._end = self._failure()

    def _add_forces(self, time: float, forces: Mapping[str, Array]) -> None:
        """Update the impulses with the forces [N] on the object; detect collisions."""
        spec = self._spec
        self._on_object.add(forces.get(spec.vehicle))
        ground = self._world.contact_forces(spec.vehicle).get(spec.ground)
        self._on_ground.add(ground)
        if ground is not None:
            if self._ground_contact is None or time - self._ground_contact > 0.1:
                self._n_collisions += 1
            self._ground_contact = time
        for name, impulse in ((spec.target, self._on_object), (spec.ground, self._on_ground)):
            if self._end is None and impulse.peak > spec.max_impulse:
                size = f"{impulse.peak:.3g} N s within 50 ms"
                self._end = ("collision", f"{spec.vehicle!r} hit {name!r} at {time:g} s: {size}")

    def _track_motion(self, time: float) -> None:
        """Update the excursion of the base, and the slip of the object while it is raised."""
        if "touched" in self._event_times and "raised" not in self._event_times:
            base = self._base.world_from_body.position
            if self._contact_position is None:
                self._contact_position = base
            self._excursion = max(self._excursion or 0.0, length(base - self._contact_position))
        carry_start = self._carry_start
        if (
            carry_start is not None
            and time - carry_start >= SETTLING_TIME
            and "lifted" not in self._event_times
        ):
            if self._raising_point is None:
                self._raising_point = self._contact_point()
            displacement = self._displacement(*self._raising_point)
            self._slip_raising = max(self._slip_raising or 0.0, displacement)

    def _time_hold(self, time: float, height: float) -> None:
        """Begin the hold, or update its slip and duration, and end the level after success."""
        if self._hold_start is None:
            if height < self._spec.lift:
                return
            self._record_event("lifted", time)
            self._hold_start, self._slip = time, 0.0
            self._hold_point = self._contact_point()
        assert self._hold_point is not None
        self._slip = max(self._slip or 0.0, self._displacement(*self._hold_point))
        self._longest_hold = max(self._longest_hold, time - self._hold_start)
        if self._longest_hold >= self._spec.hold - 1e-9:
            self._record_event("done", time)
            self._end = "ok", None

    def _contact_point(self) -> tuple[Array, Array]:
        """Return the mean position of the contacts between object and vehicle.

        It is given twice: in the object's frame and in the jaw's frame, (3,) [m] each. Without
        contacts it is the origin of the jaw's frame.
        """
        contacts = self._world.contacts(self._spec.target)
        points = [contact.position for contact in contacts if contact.other == self._spec.vehicle]
        centre = np.mean(points, axis=0) if points else self._jaw.world_from_body.position
        point = self._object.world_from_body.inverse().transform(centre[None])[0]
        return point, self._jaw_position(point)

    def _jaw_position(self, point: Array) -> Array:
        """Return the position of a point of the object in the jaw's frame, (3,) [m]."""
        jaw_from_object: Pose = self._jaw.world_from_body.inverse() @ self._object.world_from_body
        position: Array = jaw_from_object.transform(point[None])[0]
        return position

    def _displacement(self, point: Array, start: Array) -> float:
        """Return the distance [m] of a point of the object from ``start``, in the jaw's frame."""
        return length(self._jaw_position(point) - start)

    def _record_event(self, event: str, time: float) -> None:
        self._event_times.setdefault(event, time)

    @property
    def value(self) -> float | None:
        """1 for a success, 0 otherwise; None if the measure was never active."""
        if self._start_time is None:
            return None
        return 1.0 if "done" in self._event_times else 0.0

    @property
    def details(self) -> dict[str, float | None]:
        """The distances [m], impulses [N s], times of events [s], and the phases."""
        was_active = self._start_time is not None
        times = {
            f"time_{name}": self._event_times.get(name)
            for name in ("touched", "raised", "lifted", "done")
        }
        return {
            "height": self._height if was_active else None,
            "held": self._longest_hold if was_active else None,
            "slip": self._slip,
            "slip_raising": self._slip_raising,
            "impulse_on_object": self._on_object.peak if was_active else None,
            "impulse_on_ground": self._on_ground.peak if was_active else None,
            "collisions": float(self._n_collisions) if was_active else None,
            "excursion": self._excursion,
            **times,
            **self._phases.details,
        }

    @property
    def notes(self) -> tuple[str, ...]:
        """The note that the algorithm read topics with the truth."""
        self._find_read_topics()
        if not self._read_topics:
            return ()
        topics = ", ".join(self._read_topics)
        return (f"the algorithm reads the truth ({topics}): an upper bound for others",)

    def _find_read_topics(self) -> None:
        for topic in self._spec.truth.split():
            ends = self._world.bus.endpoints(topic)
            if ends is not None and ends.is_read:
                self._read_topics[topic] = None

    @property
    def reasons(self) -> dict[str, str]:
        """The reasons why details are None."""
        reasons = {
            "slip": "it was never lifted",
            "slip_raising": "it was never raised for a second",
            "excursion": "it was never touched",
            "time_touched": "it was never touched",
            "time_raised": "it was never raised",
            "time_lifted": "it was never lifted",
            "time_done": "it was not held long enough",
        }
        return {
            name: reasons[name]
            for name, value in self.details.items()
            if value is None and name in reasons
        }

    @property
    def log_header(self) -> tuple[str, ...]:
        """The columns: success, height above rest, two forces, slip, and number of the phase."""
        forces = ("force_on_object [N]", "force_on_ground [N]")
        return ("value", "height [m]", *forces, "slip [m]", "phase [1]")

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """The present values of the columns of the log."""
        if self._start_time is None:
            return (None,) * len(self.log_header)
        height = float(self._object.world_from_body.position[2]) - self._rest_height
        forces = (self._on_object.force, self._on_ground.force)
        return (self.value, height, *forces, self._slip, float(self._phases.number))

    @property
    def ends_level(self) -> str | None:
        """A sentence that states the success, or the failure after which none is possible."""
        if self._end is None:
            return None
        return self._end[1] or "the object was lifted and held"

    @property
    def task_status(self) -> tuple[str, str | None] | None:
        """The status ``ok`` for a success; else the first failure that applies."""
        return self._failure() if self._end is None else self._end

    def _failure(self) -> tuple[str, str]:
        """Return the status of a level without success, and the reason."""
        target, reason = f"{self._spec.target!r}", self._phases.abort_reason
        if self._height > DROP_HEIGHT:
            hold = f"{self._spec.hold:g} s"
            return "dropped", reason or f"{target} was raised, and not held for {hold}"
        if "touched" in self._event_times:
            return "missed", reason or f"{target} was touched, and never lifted"
        if reason is not None:
            is_search = reason.startswith(NOT_FOUND) or self._phases.is_at_first
            return "not found" if is_search else "lost target", reason
        if self._phases.is_at_first:
            return "not found", f"{target} was still searched for when the time was over"
        return "timeout", f"{target} was not touched before the time was over"

    @property
    def current_phase(self) -> str | None:
        """The present phase of the algorithm."""
        return self._phases.name

    @property
    def viewed_bodies(self) -> tuple[Body, Body]:
        """The vehicle and its jaw."""
        return self._base, self._jaw

    def close(self) -> None:
        """Unsubscribe."""
        self._phases.close()
