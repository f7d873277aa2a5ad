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
from .calls import Calls, Stopped
from .undelivered import UndeliveredMessages

M = TypeVar("M")
STOPPED = "was stopped"
"""What befell an algorithm that is not called any more though it raised nothing."""


def latency_of(parameters: Mapping[str, float | str]) -> float:
    """Return the parameter ``latency_s`` [s], 0 if not given; BadSetting if it is no time."""
    latency = parameters.get("latency_s", 0.0)
    if isinstance(latency, str) or latency < 0.0:
        raise BadSetting(f"algorithm.latency_s is {latency!r}; expected a time >= 0 [s].")
    return latency


def what_broke(error: BaseException, algorithm: type) -> str:
    """Describe what a third-party program raised, or why it was stopped."""
    return str(error) if isinstance(error, Stopped) else describe_exception(error, algorithm)


@runtime_checkable
class SavesItself(Protocol):
    """An algorithm whose state is part of that of the simulation."""

    def save(self) -> bytes:
        """Return its state."""

    def restore(self, data: bytes) -> None:
        """Go back, or on, to a state that `save` has returned."""


class AlgorithmState(ExternalValue):
    """The state of an attached algorithm.

    Args:
        algorithm: the algorithm.
    """

    def __init__(self, algorithm: Algorithm) -> None:
        self._algorithm = algorithm

    def value(self) -> bytes:
        """Return what its ``save`` returns.

        Raises:
            UwsimError: it has no ``save`` and ``restore``, or saves no bytes.
        """
        name, saved = type(self._algorithm).__name__, None
        if isinstance(self._algorithm, SavesItself):
            saved = self._algorithm.save()
        if not isinstance(saved, bytes):
            raise UwsimError(
                f"The state cannot be saved: {name} is attached, which has no save() that returns "
                "bytes and restore(bytes)."
            )
        return saved

    def set(self, value: object) -> None:
        """Hand it to the ``restore`` of the algorithm."""
        if not isinstance(value, bytes) or not isinstance(self._algorithm, SavesItself):
            raise wrong_scene_error()
        self._algorithm.restore(value)


@dataclass(slots=True)
class NodeTimerState(Record):
    """How far a timer of an algorithm is."""

    due: int
    """The step from which on it is due."""
    n_fired: int = 0
    """How often it was called."""


@dataclass(slots=True)
class NodeState(Record):
    """What changes of an attached algorithm and its node."""

    name: str
    """The name of the algorithm."""
    rng: np.random.Generator
    """The generator of the algorithm."""
    timers: list[NodeTimerState] = field(default_factory=list)
    """How far its timers are."""
    algorithm: AlgorithmState | None = None
    """Its own state; None before it was started."""
    error: str | None = None
    """What it raised, if it did, and where; or why it was stopped."""
    how: str = "raised"
    """What came before `error`: it raised, or was stopped."""


class _Timer:
    """A periodic timer."""

    def __init__(self, start: int, period: float, callback: Callable[[], None]) -> None:
        self._start, self._period, self.callback = start, period, callback  # [steps]
        self.state = NodeTimerState(start)

    def move_on(self) -> None:
        """Advance the due time by one period."""
        self.state.n_fired += 1
        self.state.due = self._start + math.ceil(self.state.n_fired * self._period - 1e-9)


class InProcessNode:
    """A `uwsim.bus.Node` in lock-step: callbacks run inside the step, time waits for them.

    An exception in a callback, of whatever kind, is the algorithm's failure, not the simulator's:
    it is kept in `error`, and the algorithm is not called any more. With ``raises`` it goes on to
    who drives the simulation. Messages are copied when they are published.
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
        self._undelivered = UndeliveredMessages()
        self._thread = threading.get_ident()
        self._is_started = True
        self._heard: dict[str, Callable[[], str | None]] = {}
        self._published: dict[str, Callable[[], str | None]] = {}
        self._timestep = timestep
        self.state = NodeState(name, rng)
        """What changes of it."""
        own = {key: value for key, value in parameters.items() if key != "latency_s"}
        self._parameters = TrackedParameters(own)
        self._timers: list[_Timer] = []
        self._delay_steps = round(latency_of(parameters) / timestep)
        self._close: list[Callable[[], None]] = []
        self._algorithm: type = object
        self.name = name
        """Name of the algorithm."""

    @property
    def error(self) -> str | None:
        """What it raised, if it did, and where; or why it was stopped."""
        return self.state.error

    @property
    def how(self) -> str:
        """What came before `error`: it raised, or was stopped."""
        return self.state.how

    @property
    def now(self) -> float:
        """Simulation time [s]."""
        return self._bus.step * self._timestep

    @property
    def parameters(self) -> TrackedParameters:
        """The parameters that the user set; the algorithm has its own defaults."""
        return self._parameters

    @property
    def rng(self) -> np.random.Generator:
        """The algorithm's own random stream."""
        return self.state.rng

    @property
    @deprecated_name("rng")
    def random(self) -> np.random.Generator:
        """The old name of `rng`."""
        return self.rng

    def run(self, algorithm: Algorithm) -> None:
        """Start the algorithm; what it raises is kept in `error`.

        Raises:
            BadSetting: it refuses one of its parameters: that is the user's mistake, not its own.
        """
        self._algorithm, self.state.algorithm = type(algorithm), AlgorithmState(algorithm)
        try:
            with self._calls:
                algorithm.start(self)
        except (BadSetting, NeverStarted):
            raise
        except BaseException as error:
            self._broken_by(error)

    def subscribe(self, topic: str, type: type[M], callback: Callable[[M], None]) -> None:
        """Call ``callback`` with every message on ``topic``."""
        self._check(topic)

        def receive(message: M) -> None:
            self._guard(callback, message)

        self._close.append(self._bus.subscribe(topic, type, receive))
        self._heard[f"it subscribes to {topic!r}, but "] = lambda: (
            self._bus.describe_missing_publisher(topic)
        )

    def publisher(self, topic: str, type: type[M]) -> Callable[[M], None]:
        """Return ``publish(message)``; delayed by the parameter ``latency_s``."""
        self._check(topic)
        self._published[f"it publishes on {topic!r}, but "] = lambda: (
            self._bus.describe_missing_subscriber(topic)
        )
        give = self._bus.publisher(topic, type, delay_steps=self._delay_steps, report=self._say)

        def publish(message: M) -> None:
            self._check(topic)
            if not self._bus.has_subscribers(topic) or message.__class__ is not type:
                give(message)
                return
            try:
                self._undelivered.add(message, step=self._bus.step, delay_steps=self._delay_steps)
            except NotAllowed as refused:
                self._break_rule(str(refused))
            give(copy_message(message))

        return publish

    def _say(self, topic: str, text: str) -> None:
        """Tell what a subscriber has to remark on one of its messages."""
        warn(f"{self.name}: /{topic}: {text}")

    def unconnected(self) -> list[str]:
        """A sentence for each of its topics that has no publisher or no subscriber."""
        return self._ends({**self._heard, **self._published})

    def unfed(self) -> list[str]:
        """A sentence for each topic that it subscribes to and that has no publisher."""
        return self._ends(self._heard)

    def _ends(self, topics: Mapping[str, Callable[[], str | None]]) -> list[str]:
        found = {message: missing() for message, missing in topics.items()}
        return [f"{self.name}: {message}{why}" for message, why in found.items() if why is not None]

    def serve(self, name: str, type: type[M], handler: Callable[[M], object]) -> None:
        """Offer a service; ``type`` is the class of its request."""
        self._check()

        def answer(request: M) -> object:
            return self._guard(handler, request)

        self._bus.services.serve(name, type, answer)
        self._close.append(lambda: self._bus.services.withdraw(name))

    def call(self, name: str, request: object) -> object:
        """Call a service; UnknownName if it is not offered."""
        self._check()
        return self._bus.services.call(name, request)

    def create_timer(self, period_s: float, callback: Callable[[], None]) -> None:
        """Call ``callback`` every ``period_s`` of simulation time, from now on."""
        self._check()
        if not 0.0 < period_s < math.inf:
            raise BadSetting(f"A timer's period is {period_s!r}; expected a time > 0 [s].")
        timer = _Timer(self._bus.step, period_s / self._timestep, callback)
        self._timers.append(timer)
        self.state.timers.append(timer.state)

    @deprecated_name("create_timer")
    def every(self, period_s: float, callback: Callable[[], None]) -> None:
        """Call `create_timer`, whose old name this is."""
        self.create_timer(period_s, callback)

    def tick(self) -> None:
        """Call the timers that are due at the current step, in the order they were set."""
        for timer in self._timers:
            if self._bus.step >= timer.state.due:
                timer.move_on()
                self._guard(timer.callback)

    @property
    def next_tick(self) -> float:
        """The step at which `tick` calls a timer; inf without any."""
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
            self._broken_by(error)
            return None

    def _broken_by(self, error: BaseException) -> None:
        """Keep what a third-party program raised; called in its except clause."""
        if is_user_interrupt(error) or isinstance(error, ClientLost):
            raise error
        self.state.error = what_broke(error, self._algorithm)
        if isinstance(error, Stopped):
            self.state.how = STOPPED
        if self._raises:
            raise error

    def _check(self, topic: str | None = None) -> None:
        """Refuse a forbidden use of the node; that ends the algorithm, caught or not."""
        if threading.get_ident() != self._thread:
            self._break_rule("it uses its node from a thread of its own")
        if not self._is_started:
            self._break_rule("it uses its node after the end")
        if topic is not None and self._bus.is_hidden(topic):
            self._break_rule(f"topic {topic!r} is for observers of the run")

    def _break_rule(self, message: str) -> NoReturn:
        self.state.error = self.state.error or f"NotAllowed: {message}"
        raise NotAllowed(message)
