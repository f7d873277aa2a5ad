"""Faults of sensors, applied to their messages before they are published."""

from __future__ import annotations

import copy
import dataclasses
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..base.record import Record
from ..devices.fault import FaultSpec
from ..devices.fault_fields import measured_fields
from ..devices.fault_times import TIME_TOLERANCE, FaultState, FaultTimes
from ..messages import time_from_seconds
from ..scene.spec import SceneSpec

Publish = Callable[[Any], None]


@dataclass(slots=True)
class SensorFaultState(Record):
    """The state of a fault on one topic."""

    times: FaultState
    """The state of the times at which the fault is present."""
    noise: np.random.Generator
    """The random generator of the outliers."""
    frozen_message: Any = None
    """The message that a ``freeze`` fault repeats; None: none is frozen."""
    delayed_messages: deque[tuple[float, Any]] = field(default_factory=deque)
    """The delayed messages, each with the time at which it is due [s]."""


@dataclass(slots=True)
class FaultyTopicState(Record):
    """The state of a topic with faults."""

    faults: list[SensorFaultState]
    """The state of each fault."""


class SensorFault:
    """One fault of a sensor, on one topic.

    Args:
        spec: the spec of the fault.
        type_: the type of the messages.
        times_rng: the random generator of the fault's times, equal on all topics of the sensor.
        noise: the random generator of the outliers.
    """

    def __init__(
        self,
        spec: FaultSpec,
        type_: type,
        times_rng: np.random.Generator,
        noise: np.random.Generator,
    ) -> None:
        self._spec = spec
        self.times = FaultTimes(spec, times_rng)
        """The times at which the fault is present."""
        self.state = SensorFaultState(self.times.state, noise)
        """The state of the fault."""
        self._fields = tuple(measured_fields(type_(), spec.field)) if _disturbs_values(spec) else ()

    def apply(self, message: Any, time: float) -> list[Any]:
        """Return the messages to publish in place of ``message`` at ``time`` [s]."""
        is_present, kind = self.times.is_present(time), self._spec.kind
        if kind == "latency":
            return self._delay(message, time, is_present)
        if not is_present:
            self.state.frozen_message = message if kind == "freeze" else None
            return [message]
        if kind == "dropout":
            return []
        if kind == "freeze":
            self.state.frozen_message = self.state.frozen_message or message
            return [_restamp(self.state.frozen_message, time)]
        return [self._disturb(message)]

    def _delay(self, message: Any, time: float, is_present: bool) -> list[Any]:
        """Add a message; return the delayed messages that are due, all if the fault has ended."""
        self.state.delayed_messages.append(
            (time + self._spec.delay if is_present else time, message)
        )
        messages = []
        while self.state.delayed_messages and (
            not is_present or self.state.delayed_messages[0][0] <= time + TIME_TOLERANCE
        ):
            messages.append(self.state.delayed_messages.popleft()[1])
        return messages

    def _disturb(self, message: Any) -> Any:
        """Return a copy of the message with a bias or outliers."""
        disturbed_copy = copy.deepcopy(message)
        for path in self._fields:
            owner = disturbed_copy
            *parents, name = path.split(".")
            for parent in parents:
                owner = getattr(owner, parent)
            value = getattr(owner, name)
            error: Any = self._spec.size
            if self._spec.kind == "outliers":
                error = error * self.state.noise.standard_normal(np.shape(value) or None)
            if isinstance(value, np.ndarray):
                setattr(owner, name, (value + error).astype(value.dtype))
            else:
                setattr(owner, name, float(value + error))
        return disturbed_copy


class FaultyTopic:
    """A topic of a sensor with faults, which change each message one after the other."""

    def __init__(
        self, faults: Sequence[SensorFault], publish: Publish, clock: Callable[[], float]
    ) -> None:
        self._faults, self._publish, self._clock = list(faults), publish, clock
        self.state = FaultyTopicState([fault.state for fault in faults])
        """The state of the topic."""

    def publish(self, message: object) -> None:
        """Apply the faults to a message and publish the result: none, one or several messages."""
        time, messages = self._clock(), [message]
        for fault in self._faults:
            messages = [
                output for input_message in messages for output in fault.apply(input_message, time)
            ]
        for output in messages:
            self._publish(output)


def make_faults(
    scene: SceneSpec,
    sensor: str,
    topic: str,
    type_: type,
    stream: Callable[[str], np.random.Generator],
) -> list[SensorFault]:
    """Return the faults of a sensor for one of its topics, with messages of ``type_``."""
    faults = []
    for vehicle in scene.vehicles:
        for index, spec in enumerate(vehicle.parts_of(FaultSpec)):
            if spec.sensor == sensor:
                name = f"{vehicle.name}/{sensor}/fault{index}"
                faults.append(SensorFault(spec, type_, stream(name), stream(f"{name}/{topic}")))
    return faults


def _disturbs_values(spec: FaultSpec) -> bool:
    return spec.kind in ("bias", "outliers")


def _restamp(message: Any, time: float) -> Any:
    if not hasattr(message, "header"):
        return message
    message_copy = copy.copy(message)
    message_copy.header = dataclasses.replace(message.header, stamp=time_from_seconds(time))
    return message_copy
