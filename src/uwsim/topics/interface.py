"""The interface of the elements of ``<rosInterfaces>``, and the world as they see it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, ClassVar, Protocol, TypeVar, runtime_checkable

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Intrinsics, Pose
from ..base.record import NoState, Record
from ..base.sampling import Sample, Sampler, Sampling
from ..bus import Bus
from ..schema import Original, Spec, element
from ..sensors.sensor import Sensor
from ..sensors.virtual_camera import VirtualCamera
from ..vehicle import Vehicle
from ..world import Body, Contact, TimedWorld
from .frames import Frame

M = TypeVar("M")
MAX_RATE = 10_000
"""Nothing is published more often [Hz]."""
MIN_RATE = 0.001
"""Nor less often [Hz]."""


class BodyContacts(Protocol):
    """Contacts between bodies, as an interface sees them."""

    def is_possible(self, name: str) -> bool:
        """Whether there is a vehicle or object of that name, with a shape that others touch."""

    def find(self, name: str) -> Sequence[Contact]:
        """Find where a vehicle or object touches others now; UnknownName if there is none."""


class TopicSensors(Protocol):
    """The sensors and devices that interfaces publish."""

    def camera(self, name: str) -> VirtualCamera:
        """Find a virtual camera; UnknownName if there is none."""

    def sensor(self, name: str, elements: tuple[str, ...]) -> Sensor:
        """Find a sensor or device of one of these elements that publishes; UnknownName if none."""

    def publisher(self, sensor: str, topic: str, type_: type) -> Callable[[Any], None]:
        """Return what publishes the messages of a sensor on a topic, with the sensor's faults."""

    def has_faults(self, sensor: str) -> bool:
        """Whether something becomes of the messages of a sensor before they are published."""


class Segmenter(Protocol):
    """Images of the bodies that pixels see."""

    @property
    def part_names(self) -> Mapping[int, str]:
        """Number in segmentation images -> ``vehicle/link`` or object."""

    def segmentation(
        self, world_from_camera: Pose, intrinsics: Intrinsics
    ) -> npt.NDArray[np.uint16]:
        """Return the number of the body that each pixel sees, (h, w); 0: none."""


class TopicWorld(TimedWorld, Protocol):
    """The world as an interface sees it: vehicles, sensors, frames, timers and commands."""

    @property
    def world_from_localized(self) -> Pose:
        """W from L: the scene's offset."""

    @property
    def compatibility(self) -> frozenset[str]:
        """The names of the compatibility quirks that are on (`uwsim.base.compatibility`)."""

    @property
    def is_blind(self) -> bool:
        """Whether images are black and nothing is drawn."""

    def body(self, name: str) -> Body:
        """Find a vehicle, link or object by its route ``a/b``; UnknownName if none."""

    def vehicle(self, name: str) -> Vehicle:
        """Find a vehicle; UnknownName if there is none."""

    @property
    def sensors(self) -> TopicSensors:
        """The sensors and devices that publish."""

    @property
    def contacts(self) -> BodyContacts:
        """Contacts between bodies."""

    @property
    def segmenter(self) -> Segmenter:
        """What tells which body a pixel sees."""

    def frames(self, *, with_objects: bool) -> Sequence[Frame]:
        """List the frames of vehicles, their links and sensors, and those of objects."""

    def marker_frames(self) -> Sequence[Frame]:
        """List the frames of the markers that are there now."""

    def every(
        self,
        rate: float,
        call: Callable[[], None],
        *,
        is_needed: Callable[[], bool] | None = None,
        sampling: Sampling | None = None,
    ) -> Callable[[], None]:
        """Have ``call`` called at the samples of ``rate`` [Hz] from now on; returns how to stop.

        With ``is_needed`` it is called only where that says so; ``sampling`` takes a sample before,
        needed or not.
        """

    def at_next_step(self, apply: Callable[[M], None]) -> Callable[[M], None]:
        """Return what has ``apply(message)`` called at the start of the next step."""


def rate_element() -> Any:
    """Declare the field of a rate."""
    lenient = Original(allows_trailing_text=True)
    return element(default=10.0, minimum=MIN_RATE, maximum=MAX_RATE, original=lenient)


def sample_rate(rate: float, world: TopicWorld) -> float:
    """Return the rate at which samples are taken [Hz]."""
    return max(1.0, math.floor(rate)) if "whole-rates" in world.compatibility else rate


class Interface:
    """A bound interface: it publishes or subscribes from the time it is bound."""

    state: Record = NoState()
    """All that changes of it as time goes by; `Simulation.save` keeps it."""


@runtime_checkable
class Binds(Protocol):
    """The spec of a simulated interface; one without ``bind`` is read and has no effect."""

    def bind(self, world: TopicWorld) -> Interface:
        """Find its vehicle or sensor and start it; raises UnknownName if there is none."""


@dataclass(frozen=True, kw_only=True)
class InterfaceSpec(Spec):
    """An element of ``<rosInterfaces>``."""

    subscribes: ClassVar[bool] = False
    """Whether it takes messages; the others publish them."""
    sources: ClassVar[tuple[str, ...]] = ()
    """Elements of which it may name one; none: it names nothing."""
    messages: ClassVar[Mapping[str, type]] = {}
    """Types of its messages, by the field that names the topic."""

    @classmethod
    def carries(cls) -> Mapping[str, type]:
        """Return the types of its messages, by the field that names the topic."""
        return cls.messages

    @classmethod
    def is_simulated(cls) -> bool:
        """Whether it is simulated."""
        return issubclass(cls, Binds)


@dataclass(frozen=True, kw_only=True)
class VehicleTopicSpec(InterfaceSpec):
    """An interface of a vehicle with one topic."""

    sources: ClassVar[tuple[str, ...]] = ("vehicle",)

    topic: str
    """Name of the topic."""
    vehicle_name: str
    """Name of the vehicle."""


@dataclass(frozen=True, kw_only=True)
class VehiclePublisherSpec(VehicleTopicSpec):
    """An interface that publishes a quantity of a vehicle."""

    rate: float = rate_element()
    """How often [Hz]."""


def is_needed(bus: Bus, topic: str) -> bool:
    """Whether anyone reads a topic now, or may later ask for what is published on it now."""
    return bus.keeps_unread or bus.has_readers(topic)


class SampledTopic(Interface):
    """Publishes the samples that compiled code takes.

    A message is made where somebody reads the topic, and of the newest sample when it is asked for.

    Args:
        topic: its name.
        sampler: what takes the samples.
        make: makes a message of the time and the numbers of a sample; None for none.
        publish: publishes a message.
    """

    def __init__(
        self,
        topic: str,
        sampler: Sampler,
        make: Callable[[float, Array], object],
        publish: Callable[[Any], None],
    ) -> None:
        self._topic, self._sampler, self._make, self._publish = topic, sampler, make, publish
        self.state: Sample = Sample.before_first(sampler)
        """The last sample."""

    def begin(
        self, rate: float, world: TopicWorld, *, is_faulty: bool = False, is_pure: bool = False
    ) -> None:
        """Take samples from now on.

        Args:
            rate: how often [Hz].
            world: which takes them.
            is_faulty: whether something becomes of each message before it is published.
            is_pure: whether a sample changes nothing, so that it need not be taken for nobody.
        """
        bus, topic = world.bus, self._topic
        sampling = Sampling(
            self._sampler, self.state, partial(is_needed, bus, topic) if is_pure else None
        )
        is_read = None if is_faulty else bus.reader_check(topic)
        if not is_faulty:
            bus.defer_unread(topic, self.newest)
        world.every(sample_rate(rate, world), self.publish, is_needed=is_read, sampling=sampling)

    def newest(self) -> object | None:
        """Make the message of the newest sample; None before the first."""
        numbers = self.state.numbers
        time = float(numbers[0])
        return None if math.isnan(time) else self._make(time, numbers[1:])

    def publish(self) -> None:
        """Publish the newest sample."""
        if (message := self.newest()) is not None:
            self._publish(message)
