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

- ``want(topic)`` and ``unwant(topic)``: a subscriber outside came or left. The bridge subscribes on
  the bus while there is at least one, so that cameras render only for those who look.
- ``put(topic, message, by)``: a message from outside, stamps already in simulation time (`inward`),
  and who sent it; it is given away. It waits in a bounded queue (latest wins) for the next step
  boundary.
- ``request(name, request, by)``: call a service of the bus; returns a Future with the response,
  which comes at the next step boundary.
- ``offer(name, service)`` and ``withdraw(name)``: somebody outside offers a service to the bus. A
  call of it is handed to ``call_outside``, and the simulation waits for the response; calls that
  come in meanwhile are answered, so that the one asked may ask back.
- ``tap(topic, receive)``: have the messages of a topic from outside at once, with who sent them, in
  the thread in which they come, instead of at a step boundary (`uwsim.middleware.lockstep`).

`step` is the boundary: call it at the end of each step (`Simulation.watch(bridge.step)`), and
before the first. There it follows the bus, answers requests in their order, publishes what came
from outside, by topic in the order of names and within a topic in the order of arrival, and has it
delivered. A message that came from outside is not sent back out by the same bridge (unless
``SENDS_BACK``); other bridges send it. What arrives when depends on the wall clock: a run with a
bridge is not repeatable. For a repeatable one, a program outside takes part in lock-step
(`uwsim.middleware.lockstep`).

Topics and services have no leading slash on the bus; transports add it where it is customary.
Topics that are withheld from algorithms under test are not shown to the outside.
"""

from __future__ import annotations

import threading
import time
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from functools import partial
from typing import ClassVar

from ..base.message_fields import size_of
from ..bus import Bus, TopicEnds
from ..errors import RunFailed, UwsimError
from ..messages.services import Service
from .admission import Admission
from .clock_topic import COARSE_PERIOD, ClockTopic
from .entrance import Entrance
from .later_answers import LaterAnswers, pass_on
from .log import Log
from .queues import LatestQueue
from .shown import known_services, known_topics
from .waiting_calls import AT_ONCE, MAX_CALLS, Call, WaitingCalls

CALL_LIMIT = 60.0
"""How long a call of a service that is offered outside may take [s of wall time]."""
LATCHED = ("tf_static", "robot_description", "scene")
"""Topics whose newest message a late subscriber gets as well."""
DEPTH, LATCHED_DEPTH = 10, 100
"""Messages of a topic that ROS 2 keeps for a reader that is behind, or late."""
CLOSED = "The simulation has ended."
NOT_ADMITTED = "only the program that takes part in this run may call."
Tap = Callable[[object, str], None]
"""Called with a message, and who sent it."""


class Bridge(ABC):
    """Connects a bus to a transport; the module says who calls what, and in which thread.

    Args:
        bus: of the simulation.
        clock: returns the simulation time [s].
        log: where events are reported.
    """

    SENDS_BACK: ClassVar[bool] = False
    """Whether messages from outside are sent out, too: where those outside do not reach each
    other."""

    clock_period: ClassVar[float] = COARSE_PERIOD
    """Shortest simulation time between two messages on ``/clock`` [s]."""

    must_meet: ClassVar[bool] = False
    """Whether messages are lost before both ends of a topic know each other."""

    sees_leaving: ClassVar[bool] = False
    """Whether it is known at once that a subscriber outside is gone, and a client says nothing."""

    invites: ClassVar[bool] = False
    """Whether a client in lock-step joins when it is invited, and not of its own accord."""

    def __init__(self, bus: Bus, clock: Callable[[], float], log: Log) -> None:
        self.bus, self.clock, self.log = bus, clock, log
        self._lock = threading.Lock()
        self._has_news = False
        self._wants: list[tuple[str, int]] = []
        self._incoming: dict[str, LatestQueue[tuple[object, str]]] = {}
        self._calls = WaitingCalls()
        self._offers: list[tuple[str, Service | None]] = []
        self._is_urgent = False  # something waits that is done also while the simulation waits
        self._woken = threading.Event()
        self._taps: dict[str, list[Tap]] = {}
        self._from_outside: set[str] = set()
        self.n_arrived: Counter[str] = Counter()
        """Messages that have come from outside so far, by topic."""
        self.n_sent = 0
        """Messages that were handed to those outside so far."""
        self.n_called = 0
        """Services of the outside that the simulation has called so far."""
        self.clock_topic = ClockTopic(
            clock, self._publish_clock, self._clock_is_read, period=self.clock_period
        )
        """The time outside."""
        self.later = LaterAnswers(bus.services)
        """Services whose responses come at a later step."""
        self.admission: Admission | None = None
        """Who may publish and call; None: everybody."""
        self._n_wanted: Counter[str] = Counter()
        self._stops: dict[str, Callable[[], None]] = {}
        self._entrance = Entrance(bus, log, owner=self, publisher_of=self._publisher_of)
        self._revision = -1
        self._topics: dict[str, TopicEnds] = {}
        self._services: dict[str, Service] = {}
        self._is_closed = False

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

    def want(self, topic: str) -> None:
        """One more outside reads ``topic``. Any thread."""
        self._add_want(topic, 1)

    def unwant(self, topic: str) -> None:
        """One fewer outside reads ``topic``. Any thread."""
        self._add_want(topic, -1)

    def read_all(self, topic: str) -> None:  # noqa: B027 - others lose nothing
        """Read ``topic`` from its publishers' first message on; where a transport may lose some."""

    def is_wanted(self, topic: str) -> bool:
        """Whether anybody outside reads ``topic``. In the thread of the simulation."""
        return self._n_wanted[topic.lstrip("/")] > 0

    def is_fed(self, topic: str) -> bool:
        """Whether anybody outside publishes ``topic``; True where a transport cannot tell."""
        return True

    def _add_want(self, topic: str, n: int) -> None:
        with self._lock:
            self._wants.append((topic.lstrip("/"), n))
            self._has_news = self._is_urgent = True
        self._woken.set()

    def offer(self, name: str, service: Service) -> None:
        """Somebody outside offers a service. Any thread."""
        self._add_offer(name, service)

    def withdraw(self, name: str) -> None:
        """A service is no longer offered outside. Any thread."""
        self._add_offer(name, None)

    def _add_offer(self, name: str, service: Service | None) -> None:
        with self._lock:
            self._offers.append((name.lstrip("/"), service))
            self._has_news = self._is_urgent = True
        self._woken.set()

    def tap(self, topic: str, receive: Tap) -> None:
        """Call ``receive`` with each message of a topic from outside, at once, in its thread.

        Those that wait already come first, in this thread.
        """
        name = topic.lstrip("/")
        with self._lock:
            waiting = self._incoming.pop(name, None)
            self._taps.setdefault(name, []).append(receive)
        for message, by in waiting.take() if waiting is not None else ():
            receive(message, by)

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
        if self.admission is not None and name not in self._taps:
            later = partial(self.put, topic, message, by)
            if not self.admission.takes(name, by, later, size):
                return
        with self._lock:
            if self._is_closed:
                return
            is_full = 0
            taps = list(self._taps.get(name, ()))
            if not taps:
                is_full = self._incoming.setdefault(name, LatestQueue()).put((message, by), size)
                self.n_arrived[name] += 1
                self._has_news = True
        for receive in taps:
            receive(message, by)
        self._woken.set()
        if is_full:
            self.log.say(
                f"/{name}: messages come faster than the simulation takes them; the oldest are "
                "dropped",
                kind=f"flood {name}",
            )

    def request(self, name: str, request: object, by: str = "") -> Future[object]:
        """Call a service of the bus; the response comes at a step boundary. Any thread.

        ``by`` is who calls, as for `put`. The future's exception is an UwsimError.
        """
        name = name.lstrip("/")
        future: Future[object] = Future()
        is_refused = self.admission is not None and not self.admission.may_call(name, by)
        with self._lock:
            if is_refused:
                future.set_exception(UwsimError(f"Service {name!r}: {NOT_ADMITTED}"))
            elif self._is_closed:
                future.set_exception(UwsimError(CLOSED))
            elif not self._calls.add((name, request, future)):
                future.set_exception(UwsimError(f"More than {MAX_CALLS} calls are waiting."))
            else:
                self._has_news = self._is_urgent = True
        self._woken.set()
        return future

    def step(self) -> None:
        """Exchange what has come, at a step boundary. In the thread of the simulation only."""
        if self.bus.revision != self._revision:
            self._follow()
        if self._has_news:
            self._exchange()
        self._tick()

    def wait_for(self, until: Callable[[], bool], limit_s: float) -> bool:
        """Wait for something from outside, in the thread of the simulation, at most ``limit_s``.

        Meanwhile subscribers are followed and calls of services answered, and messages kept for
        the next step boundary. Returns whether it came.
        """
        deadline = time.monotonic() + limit_s
        while not until():
            if self._is_urgent:
                self._serve(AT_ONCE)
                if time.monotonic() < deadline:
                    continue
            left = deadline - time.monotonic()
            if left <= 0.0:
                return False
            self._woken.wait(left)
            self._woken.clear()
        if self._is_urgent:
            self._serve(AT_ONCE)
        return True

    def wake(self) -> None:
        """Have `wait_for` look again. Any thread."""
        self._woken.set()

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
        with self._lock:
            self._is_closed = True
            requests = self._calls.take()
            self._incoming.clear()
        for _, _, future in requests:
            future.set_exception(UwsimError(CLOSED))
        for stop in self._stops.values():
            stop()
        self._stops.clear()
        for name in sorted(self._from_outside):
            self.bus.services.withdraw(name)
        self._from_outside.clear()

    def _send_latched(self, topic: str) -> None:
        """Send what was published on a latched topic before, and from now on whatever comes."""
        before = self.bus.unread(topic)
        if before is not None:
            self.send(topic, before)
        self.want(topic)

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
        with self._lock:
            self._has_news = bool(self._calls)
            incoming, self._incoming = self._incoming, {}
        for topic in sorted(incoming):
            for message, by in incoming[topic].take():
                self._entrance.publish(topic, message, by)
        self.bus.deliver()
        self._entrance.forget_messages()

    def _serve(self, limit: int | None) -> None:
        """Follow those outside who read or offer services, and answer calls (`WaitingCalls`)."""
        with self._lock:
            wants, self._wants = self._wants, []
            offers, self._offers = self._offers, []
            self._is_urgent = False
        for topic, n in wants:
            self._n_wanted[topic] += n
            self._follow_demand(topic)
        for name, service in offers:
            self._follow_offer(name, service)
        self._calls.serve(self._answer, limit)
        if self._calls:
            with self._lock:
                self._has_news = self._is_urgent = True

    def _follow_offer(self, name: str, service: Service | None) -> None:
        """Offer a service of the outside on the bus, or no longer."""
        if service is None:
            if name in self._from_outside:
                self._from_outside.discard(name)
                self.bus.services.withdraw(name)
        elif self.bus.services.serves(name):
            self.log.say(f"service /{name} is offered already; that of the outside is not taken")
        else:
            self._from_outside.add(name)
            self.bus.services.serve(name, service.request, lambda request: self._ask(name, request))

    def _ask(self, name: str, request: object) -> object:
        """Call a service of the outside and wait for its response.

        Raises:
            RunFailed: there is none.
        """
        future = self.call_outside(name, request)
        self.n_called += 1
        future.add_done_callback(lambda _: self.wake())
        if not self.wait_for(future.done, CALL_LIMIT):
            raise RunFailed(f"Service /{name}: no response within {CALL_LIMIT:g} s of wall time.")
        return future.result()

    def _follow_demand(self, topic: str) -> None:
        """Subscribe on the bus while somebody outside reads a topic."""
        is_wanted = self._n_wanted[topic] > 0
        if is_wanted and topic not in self._stops:
            if self.bus.is_withheld(topic):
                self.log.say(f"/{topic} is for observers of the run; it is not sent")
                return
            self._stops[topic] = self.bus.subscribe(
                topic, object, lambda message: self._pass(topic, message), owner=self
            )
        elif not is_wanted and topic in self._stops:
            self._stops.pop(topic)()

    def _pass(self, topic: str, message: object) -> None:
        if self.SENDS_BACK or not self._entrance.has_published(message):
            self.n_sent += 1
            self.send(topic, message)

    def _answer(self, call: Call) -> None:
        name, request, future = call
        if not future.set_running_or_notify_cancel():
            return
        if self.later.takes(name, request, future):
            return
        try:
            if name in self._from_outside:  # nobody here waits for it
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
