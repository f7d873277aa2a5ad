"""The node of an algorithm that runs in this process."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import NoReturn, Protocol, TypeVar, runtime_checkable

import numpy as np

from ...base.deprecation import deprecated_name
from ...base.exceptions import describe_exception
from ...base.interrupts import is_user_interrupt
from ...base.message_fields import copy_message
from ...base.record import ExternalValue, Record, wrong_scene_error
from ...base.terminal import warn
from ...base.tracked_parameters import TrackedParameters
from ...bus import Algorithm, Bus
from ...errors import BadSetting, ClientLost, NeverStarted, NotAllowed, UwsimError
from .calls import Calls, CallStopped
from .undelivered import UndeliveredMessages

M = TypeVar("M")
STOPPED_VERB = "was stopped"
"""The verb in messages about an algorithm that was stopped without an exception."""


def latency_of(parameters: Mapping[str, float | str]) -> float:
    """Return the parameter ``latency_s`` [s], by default 0; raise BadSetting if it is no time."""
    latency = parameters.get("latency_s", 0.0)
    if isinstance(latency, str) or latency < 0.0:
        raise BadSetting(f"algorithm.latency_s is {latency!r}; expected a time >= 0 [s].")
    return latency


def describe_failure(error: BaseException, algorithm: type) -> str:
    """Describe the exception of an algorithm, or the reason why it was stopped."""
    return str(error) if isinstance(error, CallStopped) else describe_exception(error, algorithm)


@runtime_checkable
class SavesItself(Protocol):
    """An algorithm whose own state can be saved as part of the state of the simulation."""

    def save(self) -> bytes:
        """Return the state of the algorithm as bytes."""

    def restore(self, data: bytes) -> None:
        """Set the algorithm to a state that `save` has returned."""


class AlgorithmState(ExternalValue):
    """The state of an attached algorithm."""

    def __init__(self, algorithm: Algorithm) -> None:
        self._algorithm = algorithm

    def value(self) -> bytes:
        """Return the bytes of the algorithm's ``save``.

        Raises:
            UwsimError: the algorithm has no ``save`` and ``restore``, or saves no bytes.
        """
        name, data = type(self._algorithm).__name__, None
        if isinstance(self._algorithm, SavesItself):
            data = self._algorithm.save()
        if not isinstance(data, bytes):
            raise UwsimError(
                f"The state cannot be saved: {name} is attached, which has no save() that returns "
                "bytes and restore(bytes)."
            )
        return data

    def set(self, value: object) -> None:
        """Pass a state to the ``restore`` of the algorithm."""
        if not isinstance(value, bytes) or not isinstance(self._algorithm, SavesItself):
            raise wrong_scene_error()
        self._algorithm.restore(value)


@dataclass(slots=True)
class NodeTimerState(Record):
    """The state of a timer of an algorithm."""

    due: int
    """The step at which the timer is due next."""
    n_fired: int = 0
    """The number of calls so far."""


@dataclass(slots=True)
class NodeState(Record):
    """The state of an attached algorithm and its node."""

    name: str
    """The name of the algorithm."""
    rng: np.random.Generator
    """The random generator of the algorithm."""
    timers: list[NodeTimerState] = field(default_factory=list)
    """The states of the timers of the algorithm."""
    algorithm: AlgorithmState | None = None
    """The state of the algorithm itself; None before it is started."""
    error: str | None = None
    """The exception that the algorithm raised, and where, or the reason why it was stopped."""
    failure_verb: str = "raised"
    """The verb of a sentence about `error`: ``raised`` or ``was stopped``."""


class _Timer:
    """A periodic timer of an algorithm; its start and its period are in steps."""

    def __init__(self, start: int, period: float, callback: Callable[[], None]) -> None:
        self._start, self._period, self.callback = start, period, callback
        self.state = NodeTimerState(start)

    def advance(self) -> None:
        """Advance the due time by one period."""
        self.state.n_fired += 1
        self.state.due = self._start + math.ceil(self.state.n_fired * self._period - 1e-9)


class InProcessNode:
    """A `uwsim.bus.Node` in lock-step: its callbacks run within a step of the simulation.

    Any exception in a callback is a failure of the algorithm, not of the simulator: it is stored in
    `error`, and the algorithm is not called any more. Messages are copied when they are published.

    Args:
        bus: the bus of the simulation.
        name: the name of the algorithm.
        timestep: the length of a step [s].
        rng: the random generator of the algorithm.
        parameters: the parameters of the algorithm; ``latency_s`` [s] delays its messages.
        raises: True: an exception is also raised to the caller of the simulation.
        calls: the counter of the algorithm's calls; None: they are not counted.
    """

    def __init__(
        self,
        bus: Bus,
        *,
        name: str,
        timestep: float,
        rng: np.random.Generator,
        parameters: Mapping[str, float | str],
        raises: bool = False,
        calls: Calls | None = None,
    ) -> None:
        self._bus = bus
        self._raises = raises
        self._calls = calls or Calls()
        self._backlog = UndeliveredMessages()
        self._thread = threading.get_ident()
        self._is_started = True
        self._subscriptions: dict[str, Callable[[], str | None]] = {}
        self._publications: dict[str, Callable[[], str | None]] = {}
        self._timestep = timestep
        self.state = NodeState(name, rng)
        """The state of the algorithm and its node."""
        user_parameters = {key: value for key, value in parameters.items() if key != "latency_s"}
        self._parameters = TrackedParameters(user_parameters)
        self._timers: list[_Timer] = []
        self._delay_steps = round(latency_of(parameters) / timestep)
        self._close: list[Callable[[], None]] = []
        self._algorithm: type = object
        self.name = name
        """The name of the algorithm."""

    @property
    def error(self) -> str | None:
        """The exception that the algorithm raised, and where, or the reason why it was stopped."""
        return self.state.error

    @property
    def failure_verb(self) -> str:
        """The verb of a sentence about `error`: ``raised`` or ``was stopped``."""
        return self.state.failure_verb

    @property
    def now(self) -> float:
        """The simulation time [s]."""
        return self._bus.step * self._timestep

    @property
    def parameters(self) -> TrackedParameters:
        """The parameters that the user has set; defaults are those of the algorithm."""
        return self._parameters

    @property
    def rng(self) -> np.random.Generator:
        """The random generator of the algorithm."""
        return self.state.rng

    @property
    @deprecated_name("rng")
    def random(self) -> np.random.Generator:
        """The old name of `rng`."""
        return self.rng

    def run(self, algorithm: Algorithm) -> None:
        """Start the algorithm; an exception is stored in `error`.

        Raises:
            BadSetting: the algorithm rejects a parameter, which is a mistake of the user.
        """
        self._algorithm, self.state.algorithm = type(algorithm), AlgorithmState(algorithm)
        try:
            with self._calls:
                algorithm.start(self)
        except (BadSetting, NeverStarted):
            raise
        except BaseException as error:
            self._store_failure(error)

    def subscribe(self, topic: str, type: type[M], callback: Callable[[M], None]) -> None:
        """Call ``callback`` with every message on ``topic``."""
        self._check(topic)

        def receive(message: M) -> None:
            self._guard(callback, message)

        self._close.append(self._bus.subscribe(topic, type, receive))
        self._subscriptions[f"it subscribes to {topic!r}, but "] = lambda: (
            self._bus.describe_missing_publisher(topic)
        )

    def publisher(self, topic: str, type: type[M]) -> Callable[[M], None]:
        """Return the function that publishes a message, delayed by the parameter ``latency_s``."""
        self._check(topic)
        self._publications[f"it publishes on {topic!r}, but "] = lambda: (
            self._bus.describe_missing_subscriber(topic)
        )
        send = self._bus.publisher(topic, type, delay_steps=self._delay_steps, report=self._warn)

        def publish(message: M) -> None:
            self._check(topic)
            if not self._bus.has_subscribers(topic) or message.__class__ is not type:
                send(message)
                return
            try:
                self._backlog.add(message, step=self._bus.step, delay_steps=self._delay_steps)
            except NotAllowed as error:
                self._reject_use(str(error))
            send(copy_message(message))

        return publish

    def _warn(self, topic: str, text: str) -> None:
        warn(f"{self.name}: /{topic}: {text}")

    def describe_unconnected_topics(self) -> list[str]:
        """Return a sentence for each topic of the algorithm without a publisher or a subscriber."""
        return self._describe_topics({**self._subscriptions, **self._publications})

    @deprecated_name("describe_unconnected_topics")
    def unconnected(self) -> list[str]:
        """Call `describe_unconnected_topics`; this is its deprecated name."""
        return self.describe_unconnected_topics()

    def describe_unpublished_topics(self) -> list[str]:
        """Return a sentence for each topic that is subscribed and has no publisher."""
        return self._describe_topics(self._subscriptions)

    def _describe_topics(self, topics: Mapping[str, Callable[[], str | None]]) -> list[str]:
        reasons = {message: find_reason() for message, find_reason in topics.items()}
        return [
            f"{self.name}: {message}{reason}"
            for message, reason in reasons.items()
            if reason is not None
        ]

    def serve(self, name: str, type: type[M], handler: Callable[[M], object]) -> None:
        """Offer a service; ``type`` is the class of its request."""
        self._check()

        def answer(request: M) -> object:
            return self._guard(handler, request)

        self._bus.services.serve(name, type, answer)
        self._close.append(lambda: self._bus.services.withdraw(name))

    def call(self, name: str, request: object) -> object:
        """Call a service and return its response; raise UnknownName if no node offers it."""
        self._check()
        return self._bus.services.call(name, request)

    def create_timer(self, period_s: float, callback: Callable[[], None]) -> None:
        """Call ``callback`` every ``period_s`` [s] of simulation time, from now on."""
        self._check()
        if not 0.0 < period_s < math.inf:
            raise BadSetting(f"A timer's period is {period_s!r}; expected a time > 0 [s].")
        timer = _Timer(self._bus.step, period_s / self._timestep, callback)
        self._timers.append(timer)
        self.state.timers.append(timer.state)

    @deprecated_name("create_timer")
    def every(self, period_s: float, callback: Callable[[], None]) -> None:
        """Call `create_timer`; this is its deprecated name."""
        self.create_timer(period_s, callback)

    def tick(self) -> None:
        """Call the timers that are due at the current step, in the order of their creation."""
        for timer in self._timers:
            if self._bus.step >= timer.state.due:
                timer.advance()
                self._guard(timer.callback)

    @property
    def next_tick(self) -> float:
        """The next step at which `tick` calls a timer; infinity without timers."""
        return min((timer.state.due for timer in self._timers), default=math.inf)

    def close(self) -> None:
        """Disconnect the algorithm from the bus."""
        self._is_started = False
        for close in self._close:
            close()
        self._close.clear()
        self._timers.clear()

    def _guard(self, callback: Callable[..., object], *arguments: object) -> object:
        if self.state.error is not None:
            return None
        self._thread = threading.get_ident()
        try:
            with self._calls:
                return callback(*arguments)
        except BaseException as error:
            self._store_failure(error)
            return None

    def _store_failure(self, error: BaseException) -> None:
        if is_user_interrupt(error) or isinstance(error, ClientLost):
            raise error
        self.state.error = describe_failure(error, self._algorithm)
        if isinstance(error, CallStopped):
            self.state.failure_verb = STOPPED_VERB
        if self._raises:
            raise error

    def _check(self, topic: str | None = None) -> None:
        """Raise NotAllowed for a forbidden use, and stop the algorithm even if it catches that."""
        if threading.get_ident() != self._thread:
            self._reject_use("it uses its node from a thread of its own")
        if not self._is_started:
            self._reject_use("it uses its node after the end")
        reason = None if topic is None else self._bus.hidden_reason(topic)
        if reason is not None:
            self._reject_use(f"topic {topic!r} {reason}")

    def _reject_use(self, message: str) -> NoReturn:
        self.state.error = self.state.error or f"NotAllowed: {message}"
        raise NotAllowed(message)
