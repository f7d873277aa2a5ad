r"""A link with a delay and losses between an operator and a vehicle; an extension of the dialect.

.. code-block:: xml

    <u:topicLink>
      <name>operator</name> <delay>0.5</delay> <jitter>0.1</jitter> <loss>0.02</loss>
      <command> <from>/operator/twist</from> <to>/bluerov2/twist</to> <rate>10</rate> </command>
      <report> <from>/bluerov2/imu</from> <to>/operator/imu</to> </report>
    </u:topicLink>

A message that is published on the topic ``from`` at the time t is published on ``to`` in the first
step that begins at or after

.. math:: t + \text{delay} + U(0, \text{jitter}),

but never before an earlier message of its route, or not at all, with the probability ``loss``. It
arrives unchanged, with its own time stamp. The vehicle's end of a route is hidden from algorithms
and programs: ``to`` of a command and ``from`` of a report. An operator therefore has the delayed
topics only. Not modelled: a limited bandwidth, other than by ``rate``; losses in bursts; messages
that overtake others; services.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from ..base.record import Record
from ..base.terminal import warn
from ..errors import BadMessage
from ..schema import Spec, element
from ..world import DeviceWorld
from .device import Device, DeviceSpec, DeviceTopic, DeviceVehicle
from .fault_times import TIME_TOLERANCE


@dataclass(frozen=True, kw_only=True)
class TopicRouteSpec(Spec):
    """A ``<command>`` or ``<report>`` of a ``<u:topicLink>``: one topic, in one direction."""

    from_: str = element("from")
    """The topic from which messages are taken."""
    to: str
    """The topic on which they arrive; another one than ``from``."""
    rate: float | None = element(default=None, exclusive_minimum=0.0, maximum=1000.0)
    """The greatest rate [Hz]; messages that are sooner after the one before are left out. By
    default all are transferred."""

    @property
    def source(self) -> str:
        """The topic from which messages are taken, without a leading slash."""
        return self.from_.strip().strip("/")

    @property
    def target(self) -> str:
        """The topic on which they arrive, without a leading slash."""
        return self.to.strip().strip("/")


@dataclass(frozen=True, kw_only=True)
class TopicLinkSpec(DeviceSpec):
    """A ``<u:topicLink>``: topics of an operator, with a delay and losses."""

    name: str
    """The name of the link."""
    delay: float = element(default=0.0, minimum=0.0, maximum=3600.0)
    """The delay of each message, in one direction [s]."""
    jitter: float = element(default=0.0, minimum=0.0, maximum=3600.0)
    """The largest additional delay, uniformly distributed from 0 [s]."""
    loss: float = element(default=0.0, minimum=0.0, maximum=1.0)
    """The probability that a message is lost [1]."""
    command: tuple[TopicRouteSpec, ...] = ()
    """The topics from the operator to the vehicle."""
    report: tuple[TopicRouteSpec, ...] = ()
    """The topics from the vehicle to the operator."""

    @property
    def topics(self) -> tuple[DeviceTopic, ...]:
        """The topics of the operator; their types are those of the vehicle's topics."""
        commands = [DeviceTopic(name=route.source, is_subscribed=True) for route in self.command]
        reports = [
            DeviceTopic(name=route.target, rate=route.rate, relayed_topic=route.source)
            for route in self.report
        ]
        return (*commands, *reports)

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> TopicLink:
        """Hide the vehicle's topics, and connect each as soon as its type is known."""
        return TopicLink(self, world, vehicle.name)


@dataclass(slots=True)
class RouteState(Record):
    """The state of one topic of a link."""

    rng: np.random.Generator
    """The random generator of losses and jitter; two numbers are drawn for each message."""
    due_messages: deque[tuple[float, Any]] = field(default_factory=deque)
    """The messages on their way, each with the time at which it arrives [s]."""
    last_time: float = -math.inf
    """The time at which the newest message was taken [s]."""


@dataclass(slots=True)
class TopicLinkState(Record):
    """The state of a link."""

    routes: list[RouteState]
    """The state of each topic, in the order in which they were connected."""


class TopicRoute:
    """One topic of a link, in one direction.

    Args:
        link: the properties of the link.
        spec: the topics and the rate.
        clock: a function that returns the simulation time [s].
        publish: the function that publishes a message on the target topic.
        rng: the random generator of losses and jitter.
    """

    def __init__(
        self,
        link: TopicLinkSpec,
        spec: TopicRouteSpec,
        clock: Callable[[], float],
        publish: Callable[[Any], None],
        rng: np.random.Generator,
    ) -> None:
        self._link, self._clock, self._publish = link, clock, publish
        self._target, self._has_warned = spec.target, False
        self._period = 0.0 if spec.rate is None else 1.0 / spec.rate
        self.state = RouteState(rng)
        """The state of the route."""

    def receive(self, message: object) -> None:
        """Take a message; publish it at once if the link has no delay."""
        state, time = self.state, self._clock()
        if time - state.last_time < self._period - TIME_TOLERANCE:
            return
        state.last_time = time
        loss_draw, jitter_draw = state.rng.random(2).tolist()
        if loss_draw < self._link.loss:
            return
        due_time = time + self._link.delay + self._link.jitter * jitter_draw
        state.due_messages.append(
            (max(due_time, state.due_messages[-1][0]) if state.due_messages else due_time, message)
        )
        self.publish_due(time)

    def publish_due(self, time: float) -> None:
        """Publish the messages that are due at ``time`` [s]."""
        messages = self.state.due_messages
        while messages and messages[0][0] <= time + TIME_TOLERANCE:
            message = messages.popleft()[1]
            try:
                self._publish(message)
            except BadMessage as error:  # the receiver cannot use it: it is lost
                if not self._has_warned:
                    warn(f"/{self._target}: a message over {self._link.name!r} is lost: {error}")
                self._has_warned = True


class TopicLink(Device):
    """A link between an operator and a vehicle."""

    REASON: ClassVar[str] = "is reached only over the link {!r}, as {!r}"
    """The reason why the vehicle's end of a route is hidden."""

    def __init__(self, spec: TopicLinkSpec, world: DeviceWorld, vehicle: str) -> None:
        self._spec, self._world, self._vehicle = spec, world, vehicle
        self._routes: dict[TopicRouteSpec, TopicRoute] = {}
        self.state: TopicLinkState = TopicLinkState([])
        self._specs = [
            *((route.target, route.source, route) for route in spec.command),
            *((route.source, route.target, route) for route in spec.report),
        ]
        for vehicle_topic, operator_topic, _ in self._specs:
            world.bus.hide_topic(vehicle_topic, self.REASON.format(spec.name, operator_topic))
        world.bus.observe(self._connect)

    def _connect(self, topic: str, message_type: type) -> None:
        """Connect the routes of a topic of the vehicle, whose type has become known."""
        bus = self._world.bus
        for vehicle_topic, _, spec in self._specs:
            if vehicle_topic != topic or spec in self._routes:
                continue
            name = f"{self._vehicle}/{self._spec.name}/{spec.source}"
            route = TopicRoute(
                self._spec,
                spec,
                lambda: self._world.time,
                bus.publisher(spec.target, message_type, owner=self),
                self._world.stream(name),
            )
            self._routes[spec] = route
            self.state.routes.append(route.state)
            bus.subscribe(spec.source, message_type, route.receive, owner=self)

    def step(self, time: float) -> None:
        """Publish the messages that arrive in the step that begins at ``time`` [s]."""
        for route in self._routes.values():
            route.publish_due(time)

    def idle_until(self, time: float) -> float:
        """Return the time at which the next message arrives [s]; inf if none is on its way."""
        due_times = [state.due_messages[0][0] for state in self.state.routes if state.due_messages]
        return min(due_times, default=math.inf)
