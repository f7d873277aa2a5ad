"""The base class of all transports: it connects a bus to the threads of a transport.

A transport derives from `Bridge` and implements three methods, which are called in the thread of
the simulation:

- ``on_topics(topics)``: topics, their types, publishers or subscribers on the bus have changed.
  Advertise the published topics (`TopicEndpoints.is_published`) and subscribe to the topics that
  are read (`TopicEndpoints.is_read`). It is also called for publishers that are added later.
- ``on_services(services)``: services offered on the bus have changed.
- ``send(topic, message)``: a message of a topic with an external subscriber. It must not wait:
  put it into a `LatestQueue` and encode it in a thread of the transport. Messages are frozen.

Any thread of the transport may call:

- ``subscribers.add(topic)`` and ``.remove(topic)``: an external subscriber was added or has left.
  The bridge subscribes on the bus while there is at least one, so that cameras render only for
  subscribers.
- ``put(topic, message, sender)``: accept a message from outside, with stamps in simulation time
  (`to_sim_time`), and its sender. The caller must not use the message afterwards. The message waits
  for the next step boundary in a bounded queue, which keeps the newest messages.
- ``request(name, request, sender)``: call a service of the bus; returns a Future with the response,
  which comes at the next step boundary.
- ``external_services.offer(name, service)`` and ``.withdraw(name)``: an external program offers or
  withdraws a service. The bus calls the service with ``call_external_service``, and the simulation
  waits for the response. Calls that arrive meanwhile are answered, so that the external program may
  itself call a service.
- ``arrivals.tap(topic, receive)``: receive the messages of a topic from outside at once, with
  their senders, in the thread in which they arrive, instead of at a step boundary
  (`uwsim.middleware.lockstep`).

`step` is the step boundary: it is called at the end of each step (`Simulation.watch(bridge.step)`),
and before the first step. It reads changes of the bus, answers requests in their order, and
publishes arrived messages: by topic in the order of names, and within a topic in the order of
arrival. A message from outside is not sent back by the same bridge (unless
`TransportTraits.relays_between_clients`); other bridges send it. The time of arrival depends on the
wall clock: a run with a bridge is not repeatable. In a repeatable run, an external program takes
part in lock-step (`uwsim.middleware.lockstep`).

Topics and services have no leading slash on the bus; transports add it where it is customary.
Topics that are hidden from algorithms under test are not sent.
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
from ..bus import Bus, TopicEndpoints
from ..errors import UwsimError
from ..messages.services import Service
from .admission import Admission
from .clock_topic import COARSE_PERIOD, ClockTopic
from .exchange.arrivals import Arrivals
from .exchange.call_queue import CALLS_AT_ONCE, MAX_CALLS, Call, CallQueue
from .exchange.deferred_responses import DeferredResponses, forward_result
from .exchange.external_services import ExternalServices
from .exchange.inbound_publisher import InboundPublisher
from .exchange.subscribers import Subscribers
from .exchange.work_signal import WorkSignal
from .exposed import exposed_services, exposed_topics
from .log import Log

LATCHED = ("tf_static", "robot_description", "scene")
"""The topics whose newest message is also sent to subscribers that join later."""
DEPTH, LATCHED_DEPTH = 10, 100
"""The queue depths in ROS 2: the number of messages kept for a slow and for a late subscriber."""
CLOSED_ERROR = "The simulation has ended."
"""The error of a call after the end of the simulation."""
NOT_ADMITTED_ERROR = "only the program that takes part in this run may call it."
"""The error of a call by a program that does not take part."""


@dataclass(frozen=True, kw_only=True)
class TransportTraits:
    """The capabilities and requirements of a transport."""

    relays_between_clients: bool = False
    """True if the bridge also sends messages from one external program to the others, because they
    are connected only through it."""
    clock_period: float = COARSE_PERIOD
    """The shortest simulation time between two messages on ``/clock`` [s]."""
    needs_discovery: bool = False
    """True if messages are lost until publisher and subscriber have discovered each other."""
    detects_leaving: bool = False
    """True if the transport detects at once that an external subscriber has ended."""
    needs_invitation: bool = False
    """True if a client in lock-step joins only after the simulation has invited it."""


class Bridge(ABC):
    """The connection of a bus to a transport; see the module for callers and threads.

    Args:
        bus: the bus of the simulation.
        clock: a function that returns the simulation time [s].
        log: the log for events.
    """

    traits: ClassVar[TransportTraits] = TransportTraits()
    """The capabilities of the transport."""

    def __init__(self, bus: Bus, clock: Callable[[], float], log: Log) -> None:
        self.bus, self.log = bus, log
        self._signal = WorkSignal()
        self._calls = CallQueue()
        self._inbound = InboundPublisher(bus, log, owner=self, publisher_of=self._publisher_of)
        self.arrivals = Arrivals(log, self._signal)
        """The messages from external publishers."""
        self.subscribers = Subscribers(
            bus, log, self._signal, owner=self, is_forwarded=self._is_forwarded, send=self.send
        )
        """The external subscribers of each topic."""
        self.external_services = ExternalServices(
            bus.services, log, self._signal, call=self.call_external_service, wait_for=self.wait_for
        )
        """The services that external programs offer."""
        self.clock_topic = ClockTopic(
            clock, self._publish_clock, self._clock_is_read, period=self.traits.clock_period
        )
        """The topic ``/clock``."""
        self.deferred_responses = DeferredResponses(bus.services)
        """The services whose responses come at a later step."""
        self.admission: Admission | None = None
        """The rule that decides which programs may publish and call; None: all programs."""
        self._revision = -1
        self._topics: dict[str, TopicEndpoints] = {}
        self._services: dict[str, Service] = {}

    @abstractmethod
    def on_topics(self, topics: Mapping[str, TopicEndpoints]) -> None:
        """Advertise and subscribe according to the publishers and subscribers on the bus."""

    @abstractmethod
    def on_services(self, services: Mapping[str, Service]) -> None:
        """Offer these services to external clients."""

    @abstractmethod
    def send(self, topic: str, message: object) -> None:
        """Send a message to the external subscribers of its topic, without waiting."""

    def call_external_service(self, name: str, request: object) -> Future[object]:
        """Call a service that an external program offers.

        Called in the thread of the simulation.
        """
        raise UwsimError(f"{type(self).__name__} calls no external services.")

    def read_all(self, topic: str) -> None:  # noqa: B027 - most transports lose no messages
        """Read ``topic`` from the first message on, if the transport may lose messages."""

    def has_publisher(self, topic: str) -> bool:
        """Return whether ``topic`` has an external publisher; True if that cannot be detected."""
        return True

    def send_to(self, client_name: str, topic: str, message: object) -> None:
        """Send a message to one program, or to all if the transport cannot select one.

        ``client_name`` is the name of the program: the ``sender`` of its messages in `put`. May be
        called from any thread.
        """
        self.send(topic, message)

    def report_error(self, client_name: str, text: str) -> None:  # noqa: B027 - only some can
        """Report an error in a program's messages to the program, if the transport can.

        ``client_name`` is the name of the program: the ``sender`` of its messages in `put`. May be
        called from any thread.
        """

    def put(self, topic: str, message: object, sender: str = "") -> None:
        """Accept a message from outside for the next step boundary. May be called from any thread.

        ``sender`` is empty if the transport cannot distinguish senders.
        """
        name = topic.lstrip("/")
        size = size_of(message)
        if self.admission is not None and not self.arrivals.is_tapped(name):
            accept = partial(self.put, topic, message, sender)
            if not self.admission.may_publish(name, sender, accept, size):
                return
        self.arrivals.add(name, message, sender, size)

    def request(self, name: str, request: object, sender: str = "") -> Future[object]:
        """Call a service of the bus; the response comes at a step boundary.

        ``sender`` is the client, as in `put`. The future's exception is an UwsimError. May be
        called from any thread.
        """
        name = name.lstrip("/")
        future: Future[object] = Future()
        is_refused = self.admission is not None and not self.admission.may_call(name, sender)
        with self._signal.lock:
            if is_refused:
                future.set_exception(UwsimError(f"Service {name!r}: {NOT_ADMITTED_ERROR}"))
            elif self._signal.is_closed:
                future.set_exception(UwsimError(CLOSED_ERROR))
            elif not self._calls.add((name, request, future)):
                future.set_exception(UwsimError(f"More than {MAX_CALLS} calls are waiting."))
            else:
                self._signal.mark_urgent()
        self._signal.wake()
        return future

    def step(self) -> None:
        """Exchange messages and calls at a step boundary.

        Called only in the thread of the simulation.
        """
        if self.bus.revision != self._revision:
            self._report_changes()
        if self._signal.has_work:
            self._exchange_messages()
        self._tick()

    def wait_for(self, condition: Callable[[], bool], limit_s: float) -> bool:
        """Wait for a condition, in the thread of the simulation, at most ``limit_s``.

        Meanwhile changes of external subscribers are applied and calls of services are answered;
        messages are kept for the next step boundary. Returns whether the condition holds.
        """
        deadline = time.monotonic() + limit_s
        while not condition():
            if self._signal.is_urgent:
                self._serve(CALLS_AT_ONCE)
                if time.monotonic() < deadline:
                    continue
            time_left = deadline - time.monotonic()
            if time_left <= 0.0:
                return False
            self._signal.wait(time_left)
        if self._signal.is_urgent:
            self._serve(CALLS_AT_ONCE)
        return True

    def _tick(self) -> None:
        """Do the transport's own work at each step boundary: publish the time if it is due."""
        if self.clock_topic.is_due:
            self.clock_topic.send()

    def _publish_clock(self) -> None:  # noqa: B027 - a transport without a clock has none
        """Publish ``/clock``, if it has a subscriber."""

    def _clock_is_read(self) -> bool:
        """Return whether ``/clock`` has external subscribers; True if that cannot be detected."""
        return True

    def close(self) -> None:
        """Disconnect from the bus; waiting calls fail. Transports first close their sockets."""
        with self._signal.lock:
            self._signal.is_closed = True
            requests = self._calls.take()
            self.arrivals.take()
        for _, _, future in requests:
            future.set_exception(UwsimError(CLOSED_ERROR))
        self.subscribers.close()
        self.external_services.close()

    def _follow_latched(self, topic: str) -> None:
        """Send the last message of a latched topic, and subscribe to the topic."""
        message = self.bus.unread_message(topic)
        if message is not None:
            self.send(topic, message)
        self.subscribers.add(topic)

    def _report_changes(self) -> None:
        """Report changes of topics and services on the bus to the transport."""
        self._revision = self.bus.revision
        topics = exposed_topics(self.bus, ignored_owner=self, log=self.log)
        if topics != self._topics:
            previous_topics, self._topics = self._topics, topics
            self.on_topics(topics)
            for name in LATCHED:
                endpoints, previous_endpoints = topics.get(name), previous_topics.get(name)
                was_published = previous_endpoints is not None and previous_endpoints.is_published
                if endpoints is not None and endpoints.is_published and not was_published:
                    self._follow_latched(name)
        services = exposed_services(self.bus.services)
        if services != self._services:
            self._services = services
            self.on_services(services)

    def _exchange_messages(self) -> None:
        self._serve(MAX_CALLS if self.admission is not None else None)
        with self._signal.lock:
            self._signal.has_work = bool(self._calls)
            queues = self.arrivals.take()
        for topic in sorted(queues):
            for message, sender in queues[topic].take():
                self._inbound.publish(topic, message, sender)
        self.bus.deliver()
        self._inbound.forget_messages()

    def _serve(self, limit: int | None) -> None:
        """Update external subscribers and services, and answer calls (`CallQueue`)."""
        with self._signal.lock:
            changes, offers = self.subscribers.take(), self.external_services.take()
            self._signal.is_urgent = False
        self.subscribers.apply(changes)
        self.external_services.apply(offers)
        self._calls.serve(self._answer, limit)
        if self._calls:
            with self._signal.lock:
                self._signal.mark_urgent()

    def _is_forwarded(self, message: object) -> bool:
        """Return whether to send a message of the bus: it did not come in through this bridge."""
        return self.traits.relays_between_clients or not self._inbound.has_published(message)

    def _answer(self, call: Call) -> None:
        name, request, future = call
        if not future.set_running_or_notify_cancel():
            return
        if self.deferred_responses.defer(name, request, future):
            return
        try:
            if name in self.external_services:  # the simulation does not wait for the response
                forward_result(self.call_external_service(name, request), future)
            else:
                future.set_result(self.bus.services.call(name, request))
        except UwsimError as error:
            future.set_exception(error)
        except Exception as error:  # a defect of the handler must not end the run
            text = f"The service failed: {type(error).__name__}: {error}"
            self.log.report(f"/{name}: {text}", kind=f"failed {name}")
            future.set_exception(UwsimError(text))

    def _publisher_of(self, topic: str) -> str:
        """Return the name of a topic's publisher, if its messages do not state it; may be empty."""
        return ""
