"""What all transports share: a bus on one side, threads of a transport on the other.

The contract. A transport derives from `Bridge` and gives it three methods, which are called in
the thread of the simulation:

- ``on_topics(topics)``: topics, their types or who is at their ends have changed, on the bus. It
  tells the outside what is published here (`TopicEnds.is_published`: advertise it) and what is
  read here (`TopicEnds.is_read`: subscribe to it). Publishers that come late come this way.
- ``on_services(services)``: services offered on the bus have changed.
- ``send(topic, message)``: a message of a topic that somebody outside reads. It must not wait:
  put it into a `LatestQueue` and encode it in a thread of the transport. Messages are frozen.

Any thread of the transport may call:

- ``demand.want(topic)`` and ``demand.unwant(topic)``: a subscriber outside came or left. The
  bridge subscribes on the bus while there is at least one, so that cameras render only for those
  who look.
- ``put(topic, message, by)``: a message from outside, stamps already in simulation time (`inward`),
  and who sent it; it is given away. It waits in a bounded queue (latest wins) for the next step
  boundary.
- ``request(name, request, by)``: call a service of the bus; returns a Future with the response,
  which comes at the next step boundary.
- ``outside_services.offer(name, service)`` and ``.withdraw(name)``: somebody outside offers a
  service to the bus. A call of it is handed to ``call_outside``, and the simulation waits for the
  response; calls that come in meanwhile are answered, so that the one asked may ask back.
- ``arrivals.tap(topic, receive)``: have the messages of a topic from outside at once, with who
  sent them, in the thread in which they come, instead of at a step boundary
  (`uwsim.middleware.lockstep`).

`step` is the boundary: call it at the end of each step (`Simulation.watch(bridge.step)`), and
before the first. There it follows the bus, answers requests in their order, publishes what came
from outside, by topic in the order of names and within a topic in the order of arrival, and has it
delivered. A message that came from outside is not sent back out by the same bridge (unless
`TransportTraits.sends_back`); other bridges send it. What arrives when depends on the wall clock: a
run with a bridge is not repeatable. For a repeatable one, a program outside takes part in lock-step
(`uwsim.middleware.lockstep`).

Topics and services have no leading slash on the bus; transports add it where it is customary.
Topics that are withheld from algorithms under test are not shown to the outside.
"""

from __future__ import annotations

import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from dataclasses import dataclass
from functools import partial
from typing import ClassVar

from ..base.message_fields import size_of
from ..bus import Bus, TopicEnds
from ..errors import UwsimError
from ..messages.services import Service
from .admission import Admission
from .clock_topic import COARSE_PERIOD, ClockTopic
from .exchange.arrivals import Arrivals
from .exchange.demand import Demand
from .exchange.entrance import Entrance
from .exchange.intake import Intake
from .exchange.later_answers import LaterAnswers, pass_on
from .exchange.outside_services import OutsideServices
from .exchange.waiting_calls import AT_ONCE, MAX_CALLS, Call, WaitingCalls
from .log import Log
from .shown import known_services, known_topics

LATCHED = ("tf_static", "robot_description", "scene")
"""Topics whose newest message a late subscriber gets as well."""
DEPTH, LATCHED_DEPTH = 10, 100
"""Messages of a topic that ROS 2 keeps for a reader that is behind, or late."""
CLOSED = "The simulation has ended."
NOT_ADMITTED = "only the program that takes part in this run may call."


@dataclass(frozen=True, kw_only=True)
class TransportTraits:
    """What a transport can do, and what it needs."""

    sends_back: bool = False
    """Whether messages from outside are sent out, too: where those outside do not reach each
    other."""
    clock_period: float = COARSE_PERIOD
    """Shortest simulation time between two messages on ``/clock`` [s]."""
    must_meet: bool = False
    """Whether messages are lost before both ends of a topic know each other."""
    sees_leaving: bool = False
    """Whether it is known at once that a subscriber outside is gone, and a client says nothing."""
    invites: bool = False
    """Whether a client in lock-step joins when it is invited, and not of its own accord."""


class Bridge(ABC):
    """Connects a bus to a transport; the module says who calls what, and in which thread.

    Args:
        bus: of the simulation.
        clock: returns the simulation time [s].
        log: where events are reported.
    """

    traits: ClassVar[TransportTraits] = TransportTraits()
    """What its transport can do."""

    def __init__(self, bus: Bus, clock: Callable[[], float], log: Log) -> None:
        self.bus, self.log = bus, log
        self._intake = Intake()
        self._calls = WaitingCalls()
        self._entrance = Entrance(bus, log, owner=self, publisher_of=self._publisher_of)
        self.arrivals = Arrivals(log, self._intake)
        """Messages that have come from outside."""
        self.demand = Demand(
            bus, log, self._intake, owner=self, goes_out=self._goes_out, send=self.send
        )
        """Topics that are read outside."""
        self.outside_services = OutsideServices(
            bus.services, log, self._intake, call=self.call_outside, wait_for=self.wait_for
        )
        """Services that are offered outside."""
        self.clock_topic = ClockTopic(
            clock, self._publish_clock, self._clock_is_read, period=self.traits.clock_period
        )
        """The time outside."""
        self.later = LaterAnswers(bus.services)
        """Services whose responses come at a later step."""
        self.admission: Admission | None = None
        """Who may publish and call; None: everybody."""
        self._revision = -1
        self._topics: dict[str, TopicEnds] = {}
        self._services: dict[str, Service] = {}

    @abstractmethod
    def on_topics(self, topics: Mapping[str, TopicEnds]) -> None:
        """Advertise and subscribe outside according to who is on the bus."""

    @abstractmethod
    def on_services(self, services: Mapping[str, Service]) -> None:
        """Offer these services outside."""

    @abstractmethod
    def send(self, topic: str, message: object) -> None:
        """Hand a message to those outside who read its topic, without waiting."""

    def call_outside(self, name: str, request: object) -> Future[object]:
        """Call a service that somebody outside offers. In the thread of the simulation."""
        raise UwsimError(f"{type(self).__name__} calls no services outside.")

    def read_all(self, topic: str) -> None:  # noqa: B027 - others lose nothing
        """Read ``topic`` from its publishers' first message on; where a transport may lose some."""

    def is_fed(self, topic: str) -> bool:
        """Whether anybody outside publishes ``topic``; True where a transport cannot tell."""
        return True

    def send_to(self, by: str, topic: str, message: object) -> None:
        """Send a message to one program outside, or to all where a transport cannot. Any thread.

        ``by`` is how the messages of the program name it.
        """
        self.send(topic, message)

    def tell(self, by: str, text: str) -> None:  # noqa: B027 - not every transport can
        """Tell a program outside what is wrong with what it sent, where there is a way. Any thread.

        ``by`` is how its messages name it.
        """

    def put(self, topic: str, message: object, by: str = "") -> None:
        """Take in a message from outside, for the next step boundary. Any thread.

        ``by`` is who published it, for the log; empty where the transport cannot tell.
        """
        name = topic.lstrip("/")
        size = size_of(message)
        if self.admission is not None and not self.arrivals.is_tapped(name):
            later = partial(self.put, topic, message, by)
            if not self.admission.takes(name, by, later, size):
                return
        self.arrivals.add(name, message, by, size)

    def request(self, name: str, request: object, by: str = "") -> Future[object]:
        """Call a service of the bus; the response comes at a step boundary. Any thread.

        ``by`` is who calls, as for `put`. The future's exception is an UwsimError.
        """
        name = name.lstrip("/")
        future: Future[object] = Future()
        is_refused = self.admission is not None and not self.admission.may_call(name, by)
        with self._intake.lock:
            if is_refused:
                future.set_exception(UwsimError(f"Service {name!r}: {NOT_ADMITTED}"))
            elif self._intake.is_closed:
                future.set_exception(UwsimError(CLOSED))
            elif not self._calls.add((name, request, future)):
                future.set_exception(UwsimError(f"More than {MAX_CALLS} calls are waiting."))
            else:
                self._intake.add_urgent()
        self._intake.wake()
        return future

    def step(self) -> None:
        """Exchange what has come, at a step boundary. In the thread of the simulation only."""
        if self.bus.revision != self._revision:
            self._follow()
        if self._intake.has_news:
            self._exchange()
        self._tick()

    def wait_for(self, until: Callable[[], bool], limit_s: float) -> bool:
        """Wait for something from outside, in the thread of the simulation, at most ``limit_s``.

        Meanwhile subscribers are followed and calls of services answered, and messages kept for
        the next step boundary. Returns whether it came.
        """
        deadline = time.monotonic() + limit_s
        while not until():
            if self._intake.is_urgent:
                self._serve(AT_ONCE)
                if time.monotonic() < deadline:
                    continue
            left = deadline - time.monotonic()
            if left <= 0.0:
                return False
            self._intake.wait(left)
        if self._intake.is_urgent:
            self._serve(AT_ONCE)
        return True

    def _tick(self) -> None:
        """Do what a transport does at each step boundary: tell the time when it is due."""
        if self.clock_topic.is_due:
            self.clock_topic.send()

    def _publish_clock(self) -> None:  # noqa: B027 - a transport without a clock has none
        """Publish ``/clock``, if anybody reads it."""

    def _clock_is_read(self) -> bool:
        """Whether anybody outside reads ``/clock``; True where a transport cannot tell."""
        return True

    def close(self) -> None:
        """Leave the bus; calls that wait fail. Transports close their sockets, then call this."""
        with self._intake.lock:
            self._intake.is_closed = True
            requests = self._calls.take()
            self.arrivals.take()
        for _, _, future in requests:
            future.set_exception(UwsimError(CLOSED))
        self.demand.close()
        self.outside_services.close()

    def _send_latched(self, topic: str) -> None:
        """Send what was published on a latched topic before, and from now on whatever comes."""
        before = self.bus.unread(topic)
        if before is not None:
            self.send(topic, before)
        self.demand.want(topic)

    def _follow(self) -> None:
        """Tell the transport what has changed on the bus."""
        self._revision = self.bus.revision
        topics = known_topics(self.bus, besides=self, log=self.log)
        if topics != self._topics:
            before, self._topics = self._topics, topics
            self.on_topics(topics)
            for name in LATCHED:
                ends, old = topics.get(name), before.get(name)
                if ends is not None and ends.is_published and not (old and old.is_published):
                    self._send_latched(name)
        services = known_services(self.bus.services)
        if services != self._services:
            self._services = services
            self.on_services(services)

    def _exchange(self) -> None:
        self._serve(MAX_CALLS if self.admission is not None else None)
        with self._intake.lock:
            self._intake.has_news = bool(self._calls)
            incoming = self.arrivals.take()
        for topic in sorted(incoming):
            for message, by in incoming[topic].take():
                self._entrance.publish(topic, message, by)
        self.bus.deliver()
        self._entrance.forget_messages()

    def _serve(self, limit: int | None) -> None:
        """Follow those outside who read or offer services, and answer calls (`WaitingCalls`)."""
        with self._intake.lock:
            changes, offers = self.demand.take(), self.outside_services.take()
            self._intake.is_urgent = False
        self.demand.follow(changes)
        self.outside_services.follow(offers)
        self._calls.serve(self._answer, limit)
        if self._calls:
            with self._intake.lock:
                self._intake.add_urgent()

    def _goes_out(self, message: object) -> bool:
        """Whether a message of the bus is sent: it has not come from outside by this bridge."""
        return self.traits.sends_back or not self._entrance.has_published(message)

    def _answer(self, call: Call) -> None:
        name, request, future = call
        if not future.set_running_or_notify_cancel():
            return
        if self.later.takes(name, request, future):
            return
        try:
            if name in self.outside_services:  # nobody here waits for it
                pass_on(self.call_outside(name, request), future)
            else:
                future.set_result(self.bus.services.call(name, request))
        except UwsimError as error:
            future.set_exception(error)
        except Exception as error:  # a defect of the handler must not end the run
            text = f"The service failed: {type(error).__name__}: {error}"
            self.log.say(f"/{name}: {text}", kind=f"failed {name}")
            future.set_exception(UwsimError(text))

    def _publisher_of(self, topic: str) -> str:
        """Name who publishes a topic outside, where a message does not say it; may be empty."""
        return ""
