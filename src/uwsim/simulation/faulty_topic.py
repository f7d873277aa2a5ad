"""Faults of a sensor on its way to a topic: the same for every sensor and message."""

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
    """What changes of a fault on one topic."""

    times: FaultState
    """When it is present."""
    noise: np.random.Generator
    """The generator of the outliers."""
    last: Any = None
    """The message that it repeats; None: there is none."""
    waiting: deque[tuple[float, Any]] = field(default_factory=deque)
    """When messages come that it delays [s], and the messages."""


@dataclass(slots=True)
class FaultyTopicState(Record):
    """What changes of a topic with faults."""

    faults: list[SensorFaultState]
    """What changes of each fault."""


class SensorFault:
    """One fault of a sensor, on one topic.

    Args:
        spec: the fault.
        type_: of the messages.
        random: for its times: the same on each topic of the sensor.
        noise: for the outliers.
    """

    def __init__(
        self, spec: FaultSpec, type_: type, random: np.random.Generator, noise: np.random.Generator
    ) -> None:
        self._spec = spec
        self.times = FaultTimes(spec, random)
        """When it is present."""
        self.state = SensorFaultState(self.times.state, noise)
        """What changes of it."""
        self._fields = tuple(measured_fields(type_(), spec.field)) if _changes(spec) else ()

    def passed(self, message: Any, time: float) -> list[Any]:
        """Return the messages that come in the place of one at ``time`` [s]."""
        acts, kind = self.times.acts(time), self._spec.kind
        if kind == "latency":
            return self._delayed(message, time, acts)
        if not acts:
            self.state.last = message if kind == "freeze" else None
            return [message]
        if kind == "dropout":
            return []
        if kind == "freeze":
            self.state.last = self.state.last or message
            return [_stamped(self.state.last, time)]
        return [self._changed(message)]

    def _delayed(self, message: Any, time: float, acts: bool) -> list[Any]:
        """What has waited long enough; when the fault is over all that is left comes at once."""
        self.state.waiting.append((time + self._spec.delay if acts else time, message))
        ready = []
        while self.state.waiting and (
            not acts or self.state.waiting[0][0] <= time + TIME_TOLERANCE
        ):
            ready.append(self.state.waiting.popleft()[1])
        return ready

    def _changed(self, message: Any) -> Any:
        """The message with a bias or outliers."""
        changed = copy.deepcopy(message)
        for path in self._fields:
            owner = changed
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
        return changed


class FaultyTopic:
    """A topic of a sensor with faults: messages pass one after the other."""

    def __init__(
        self, faults: Sequence[SensorFault], publish: Publish, clock: Callable[[], float]
    ) -> None:
        self._faults, self._publish, self._clock = list(faults), publish, clock
        self.state = FaultyTopicState([fault.state for fault in faults])
        """What changes of it."""

    def publish(self, message: object) -> None:
        """Publish what becomes of a message."""
        time, messages = self._clock(), [message]
        for fault in self._faults:
            messages = [each for one in messages for each in fault.passed(one, time)]
        for each in messages:
            self._publish(each)


def faults_of(
    scene: SceneSpec,
    sensor: str,
    topic: str,
    type_: type,
    stream: Callable[[str], np.random.Generator],
) -> list[SensorFault]:
    """Return the faults of a sensor's messages of a type on a topic."""
    found = []
    for vehicle in scene.vehicles:
        for number, spec in enumerate(vehicle.parts_of(FaultSpec)):
            if spec.sensor == sensor:
                own = f"{vehicle.name}/{sensor}/fault{number}"
                found.append(SensorFault(spec, type_, stream(own), stream(f"{own}/{topic}")))
    return found


def _changes(spec: FaultSpec) -> bool:
    return spec.kind in ("bias", "outliers")


def _stamped(message: Any, time: float) -> Any:
    """The message with another time stamp."""
    if not hasattr(message, "header"):
        return message
    again = copy.copy(message)
    again.header = dataclasses.replace(message.header, stamp=time_from_seconds(time))
    return again
