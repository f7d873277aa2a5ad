r"""u:grasp: whether an object is lifted and held, and how an attempt at it went.

.. code-block:: xml

    <u:grasp>
      <name>success</name>
      <target>blackbox</target>
      <vehicle>girona500</vehicle> <jaw>girona500/end_effector</jaw>
      <lift>0.5</lift> <hold>10</hold>
      <topic>graspPhase</topic> <phases>search approach grasp lift hold</phases>
    </u:grasp>
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

RAISED = 0.02
"""An object that a vehicle holds so far above where it lay is off the ground [m]."""
LIFTED = 0.1
"""One that was lower than this and fell may be tried again: it was missed, not dropped [m]."""
FELL = 0.5
"""An object that nothing of the vehicle has touched for so long was dropped [s]."""
SETTLING = 1.0
"""Between leaving the ground and the first look at slip [s]."""
NOT_FOUND = "not found"
"""What a reason begins with when an algorithm gives up its search."""


@dataclass(frozen=True, kw_only=True)
class GraspSpec(MeasureSpec):
    """A ``<u:grasp>`` element of a benchmark file."""

    target: str = element(refers_to="contacts")
    """Name of the object."""
    vehicle: str = element(refers_to="vehicle")
    """Name of the vehicle that is to lift it."""
    jaw: str = element(refers_to="body")
    """Route of the frame in which slip is measured: where the jaw closes."""
    ground: str = element(default="terrain", refers_to="contacts")
    """Name of what the object lies on."""
    lift: float = element(default=0.5, above=0.0)
    """How far it is to be lifted [m]."""
    hold: float = element(default=10.0, above=0.0)
    """How long it is to be held once it was lifted so far [s]."""
    max_impulse: float = element(default=40.0, above=0.0)
    """A larger impulse on ground or object within 50 ms is a collision [N s]."""
    topic: str | None = None
    """Topic on which the algorithm says its phase (std_msgs/String)."""
    phases: str = ""
    """The phases that count, in their order, separated by blanks."""
    truth: str = ""
    """Topics that hold the truth, separated by blanks: who reads one is marked in the result."""

    def errors(self) -> Sequence[str]:
        """Phases without a topic, or one twice; one name for two things."""
        names, found = self.phases.split(), []
        if names and self.topic is None:
            found.append("<phases> need a <topic> on which they are published")
        if len(set(names)) < len(names):
            found.append("<phases> has a phase twice")
        if len({self.target, self.vehicle, self.ground}) < 3:
            found.append("<target>, <vehicle> and <ground> have to be three different things")
        if self.jaw in (self.target, self.ground):
            found.append(f"<jaw> is {self.jaw!r}; expected a frame of {self.vehicle!r}")
        return found

    def bind(self, world: World) -> Grasp:
        """Find object, vehicle and jaw; raises UnknownName if one is not there."""
        world.contacts(self.target)
        world.contacts(self.vehicle)
        inbox = world.bus.inbox(self.topic, String) if self.topic else None
        return Grasp(self, world, inbox)


class Grasp(Measure):
    r"""1 if the object was lifted by ``lift`` and then held for ``hold`` seconds, else 0.

    The object counts as *carried* while the vehicle touches it, the ground does not, and it is at
    least 2 cm higher than it lay. The *hold* begins when it is carried at ``lift`` above where it
    lay, and lasts while it is carried. All of this is the truth of the simulation; the algorithm
    adds only its phases.

    Slip is how far the point of the object that was in the middle of its contacts with the vehicle
    when the hold began has moved in the jaw's frame, the largest value during the hold;
    ``slip_raising`` the same from 1 s after the object was off the ground until the hold began.
    Impulses are :math:`\max_t \lVert \int_{t-50\,\mathrm{ms}}^{t} F\,dt \rVert` of the net force
    of the vehicle on the object, and of the ground on the vehicle; the two forces of a closed jaw
    cancel. ``excursion`` is how far the vehicle's base went from where it was when the object was
    first touched, until that was off the ground.

    It ends the level with success, with a collision, and when the object was dropped; and it is
    its judge (`task_status`).
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
        self._thing: Body = world.body(spec.target)
        self._jaw: Body = world.body(spec.jaw)
        self._base: Body = world.body(spec.vehicle)
        self._phases = Phases(spec.phases.split(), world, inbox)
        self._on_object = Impulse(world.timestep)
        self._on_ground = Impulse(world.timestep)
        self._began: float | None = None  # [s]
        self._lay = 0.0  # height in W [m]
        self._height = 0.0  # largest, above where it lay [m]
        self._held = 0.0  # longest hold [s]
        self._marks: dict[str, float] = {}  # of what happened first when, in the level [s]
        self._hold_since: float | None = None  # [s]
        self._grip: tuple[Array, Array] | None = None  # of the hold: `_point_at_jaw`
        self._raising: tuple[Array, Array] | None = None  # of the raising
        self._slip: float | None = None
        self._slip_raising: float | None = None
        self._touched_at: Array | None = None  # the base's position then, (3,) [m]
        self._excursion: float | None = None
        self._let_go: float | None = None  # when the vehicle last touched it [s]
        self._carried_since: float | None = None  # [s]
        self._n_collisions = 0
        self._touched_ground: float | None = None  # [s]
        self._end: tuple[str, str | None] | None = None
        self._truths_read: dict[str, None] = {}

    def start(self) -> None:
        """Take note of where the object lies."""
        self._began = self._world.time
        self._lay = float(self._thing.world_from_body.position[2])
        self._look_who_reads()
        self.update()

    def update(self) -> None:
        """Look at contacts and poses after one more step."""
        if self._began is None or self._end is not None:
            return
        time = self._world.time - self._began
        self._phases.update()
        by = self._world.contact_forces(self._spec.target)
        is_held = self._spec.vehicle in by
        self._feel(time, by)
        if is_held:
            self._mark("touched", time)
            self._let_go = time
        height = 0.0  # nothing else asks for it
        if is_held and self._spec.ground not in by:
            height = float(self._thing.world_from_body.position[2]) - self._lay
        is_carried = height > RAISED
        if is_carried:
            self._mark("raised", time)
            self._height = max(self._height, height)
            self._carried_since = time if self._carried_since is None else self._carried_since
        else:
            self._carried_since = self._raising = self._hold_since = None
        self._follow(time)
        if is_carried:
            self._time_hold(time, height)
        self._look_for_the_end(time, is_carried)

    def _look_for_the_end(self, time: float, is_carried: bool) -> None:
        """End the level when the object was dropped, or the algorithm has given up."""
        if self._end is not None:
            return
        if self._height > LIFTED and self._let_go is not None and time - self._let_go > FELL:
            what = "while it was held" if "lifted" in self._marks else "on its way up"
            self._end = "dropped", f"{self._spec.target!r} fell at {time:g} s, {what}"
        elif self._phases.gave_up is not None and not is_carried:
            self._end = self._failure()

    def _feel(self, time: float, by: Mapping[str, Array]) -> None:
        """Add to the impulses; too large a one is a collision."""
        spec = self._spec
        self._on_object.add(by.get(spec.vehicle))
        ground = self._world.contact_forces(spec.vehicle).get(spec.ground)
        self._on_ground.add(ground)
        if ground is not None:
            if self._touched_ground is None or time - self._touched_ground > 0.1:
                self._n_collisions += 1
            self._touched_ground = time
        for what, impulse in ((spec.target, self._on_object), (spec.ground, self._on_ground)):
            if self._end is None and impulse.largest > spec.max_impulse:
                size = f"{impulse.largest:.3g} N s within 50 ms"
                self._end = "collision", f"{spec.vehicle!r} hit {what!r} at {time:g} s: {size}"

    def _follow(self, time: float) -> None:
        """Follow the base while the jaw closes, and the object while it is raised."""
        if "touched" in self._marks and "raised" not in self._marks:
            base = self._base.world_from_body.position
            if self._touched_at is None:
                self._touched_at = base
            self._excursion = max(self._excursion or 0.0, length(base - self._touched_at))
        since = self._carried_since
        if since is not None and time - since >= SETTLING and "lifted" not in self._marks:
            if self._raising is None:
                self._raising = self._point_at_jaw()
            self._slip_raising = max(self._slip_raising or 0.0, self._moved(*self._raising))

    def _time_hold(self, time: float, height: float) -> None:
        """Begin the hold, follow it, and end the level when it was long enough."""
        if self._hold_since is None:
            if height < self._spec.lift:
                return
            self._mark("lifted", time)
            self._hold_since, self._slip = time, 0.0
            self._grip = self._point_at_jaw()
        assert self._grip is not None
        self._slip = max(self._slip or 0.0, self._moved(*self._grip))
        self._held = max(self._held, time - self._hold_since)
        if self._held >= self._spec.hold - 1e-9:
            self._mark("done", time)
            self._end = "ok", None

    def _point_at_jaw(self) -> tuple[Array, Array]:
        """The middle of its contacts with the vehicle: in the object's frame, and in the jaw's."""
        touching = self._world.contacts(self._spec.target)
        places = [one.position for one in touching if one.other == self._spec.vehicle]
        middle = np.mean(places, axis=0) if places else self._jaw.world_from_body.position
        point = self._thing.world_from_body.inverse().transform(middle[None])[0]
        return point, self._place(point)

    def _place(self, point: Array) -> Array:
        """Where a point of the object is in the jaw's frame, (3,) [m]."""
        jaw_from_thing: Pose = self._jaw.world_from_body.inverse() @ self._thing.world_from_body
        place: Array = jaw_from_thing.transform(point[None])[0]
        return place

    def _moved(self, point: Array, was: Array) -> float:
        return length(self._place(point) - was)

    def _mark(self, event: str, time: float) -> None:
        self._marks.setdefault(event, time)

    @property
    def value(self) -> float | None:
        """1 for a success, 0 for anything else; None when the measure was never on."""
        if self._began is None:
            return None
        return 1.0 if "done" in self._marks else 0.0

    @property
    def details(self) -> dict[str, float | None]:
        """What happened when [s], how far, how hard; the phases."""
        is_on = self._began is not None
        times = {
            f"time_{name}": self._marks.get(name)
            for name in ("touched", "raised", "lifted", "done")
        }
        return {
            "height": self._height if is_on else None,
            "held": self._held if is_on else None,
            "slip": self._slip,
            "slip_raising": self._slip_raising,
            "impulse_on_object": self._on_object.largest if is_on else None,
            "impulse_on_ground": self._on_ground.largest if is_on else None,
            "collisions": float(self._n_collisions) if is_on else None,
            "excursion": self._excursion,
            **times,
            **self._phases.details,
        }

    @property
    def notes(self) -> tuple[str, ...]:
        """Which topics with the truth the algorithm read."""
        self._look_who_reads()
        if not self._truths_read:
            return ()
        topics = ", ".join(self._truths_read)
        return (f"the algorithm reads the truth ({topics}): an upper bound for others",)

    def _look_who_reads(self) -> None:
        for topic in self._spec.truth.split():
            ends = self._world.bus.ends(topic)
            if ends is not None and ends.is_read:
                self._truths_read[topic] = None

    @property
    def reasons(self) -> dict[str, str]:
        """Why details are None."""
        why = {
            "slip": "it was never lifted",
            "slip_raising": "it was never raised for a second",
            "excursion": "it was never touched",
            "time_touched": "it was never touched",
            "time_raised": "it was never raised",
            "time_lifted": "it was never lifted",
            "time_done": "it was not held long enough",
        }
        return {
            name: why[name] for name, value in self.details.items() if value is None and name in why
        }

    @property
    def log_header(self) -> tuple[str, ...]:
        """Success, height above where it lay, the two forces, slip so far, number of the phase."""
        forces = ("force_on_object [N]", "force_on_ground [N]")
        return ("value", "height [m]", *forces, "slip [m]", "phase [1]")

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """As of now."""
        if self._began is None:
            return (None,) * len(self.log_header)
        height = float(self._thing.world_from_body.position[2]) - self._lay
        forces = (self._on_object.now, self._on_ground.now)
        return (self.value, height, *forces, self._slip, float(self._phases.number))

    @property
    def ends_level(self) -> str | None:
        """That the task is done, or can no longer be."""
        if self._end is None:
            return None
        return self._end[1] or "the object was lifted and held"

    @property
    def task_status(self) -> tuple[str, str | None] | None:
        """``ok`` for a success; else the first that applies of the failures."""
        return self._failure() if self._end is None else self._end

    def _failure(self) -> tuple[str, str]:
        """Status of a level without success, and why."""
        thing, why = f"{self._spec.target!r}", self._phases.gave_up
        if self._height > LIFTED:
            return "dropped", why or f"{thing} was raised, and not held for {self._spec.hold:g} s"
        if "touched" in self._marks:
            return "missed", why or f"{thing} was touched, and never lifted"
        if why is not None:
            is_search = why.startswith(NOT_FOUND) or self._phases.is_at_first
            return "not found" if is_search else "lost target", why
        if self._phases.is_at_first:
            return "not found", f"{thing} was still searched for when the time was over"
        return "timeout", f"{thing} was not touched before the time was over"

    @property
    def moment(self) -> str | None:
        """The algorithm's phase."""
        return self._phases.name

    @property
    def watched(self) -> tuple[Body, Body]:
        """The vehicle and its jaw."""
        return self._base, self._jaw

    def close(self) -> None:
        """Unsubscribe."""
        self._phases.close()
