"""The base classes of the elements of ``<rosInterfaces>``, and the protocols that they use."""

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
from ..world import Body, Contact, TetherControl, TimedWorld
from .frames import Frame

M = TypeVar("M")
MAX_RATE = 10_000
"""The greatest rate of publication [Hz]."""
MIN_RATE = 0.001
"""The smallest rate of publication [Hz]."""


class BodyContacts(Protocol):
    """The contacts between bodies."""

    def is_possible(self, name: str) -> bool:
        """Return whether a vehicle or object has that name and a collision shape."""

    def find(self, name: str) -> Sequence[Contact]:
        """Find the present contacts of a vehicle or object; raise UnknownName without it."""


class TopicSensors(Protocol):
    """The sensors and devices that interfaces publish."""

    def camera(self, name: str) -> VirtualCamera:
        """Find a virtual camera; raise UnknownName if there is none of that name."""

    def sensor(self, name: str, elements: tuple[str, ...]) -> Sensor:
        """Find a sensor or device that is one of ``elements``; raise UnknownName without it."""

    def publisher(self, sensor: str, topic: str, type_: type) -> Callable[[Any], None]:
        """Return a function that applies a sensor's faults to a message and publishes it."""

    def has_faults(self, sensor: str) -> bool:
        """Return whether faults change the messages of a sensor before they are published."""


class Segmenter(Protocol):
    """The renderer of images whose pixels are segmentation IDs."""

    @property
    def part_names(self) -> Mapping[int, str]:
        """The name of each body by its segmentation ID: ``vehicle/link``, or the object's name."""

    def segmentation(
        self, world_from_camera: Pose, intrinsics: Intrinsics
    ) -> npt.NDArray[np.uint16]:
        """Return the segmentation ID of the body in each pixel, (h, w); 0: none."""


class TopicWorld(TimedWorld, Protocol):
    """The world as interfaces use it: vehicles, sensors, frames, timers and commands."""

    @property
    def world_from_localized(self) -> Pose:
        """The pose of the localized world L in the world W: the scene's offset."""

    @property
    def compatibility(self) -> frozenset[str]:
        """The names of the compatibility quirks that are on (`uwsim.base.compatibility`)."""

    @property
    def is_blind(self) -> bool:
        """True if nothing is rendered and images are black."""

    def body(self, name: str) -> Body:
        """Find a vehicle, a link (``vehicle/link``) or an object; raise UnknownName without it."""

    def vehicle(self, name: str) -> Vehicle:
        """Find a vehicle; raise UnknownName if there is none of that name."""

    def tether(self, name: str) -> TetherControl:
        """Find a tether; raise UnknownName if there is none of that name."""

    @property
    def sensors(self) -> TopicSensors:
        """The sensors and devices that publish."""

    @property
    def contacts(self) -> BodyContacts:
        """The contacts between bodies."""

    @property
    def segmenter(self) -> Segmenter:
        """The renderer of images whose pixels are segmentation IDs."""

    def frames(self, *, with_objects: bool) -> Callable[[], Sequence[Frame]]:
        """Return a function that lists the frames of vehicles, their links and sensors.

        ``with_objects`` adds objects, segments of tethers, and the markers that exist then.
        """

    def create_timer(
        self,
        rate: float,
        call: Callable[[], None],
        *,
        is_needed: Callable[[], bool] | None = None,
        sampling: Sampling | None = None,
    ) -> Callable[[], None]:
        """Call ``call`` at ``rate`` [Hz] from now on; return a function that ends this.

        If ``is_needed`` returns False, ``call`` is left out. ``sampling`` takes a sample before
        each call, also before one that is left out.
        """

    def defer_to_next_step(self, apply: Callable[[M], None]) -> Callable[[M], None]:
        """Return a function that defers ``apply(message)`` to the start of the next step."""


def rate_element() -> Any:
    """Declare the field of an interface's ``<rate>`` [Hz]."""
    original = Original(allows_trailing_text=True)
    return element(default=10.0, minimum=MIN_RATE, maximum=MAX_RATE, original=original)


def sample_rate(rate: float, world: TopicWorld) -> float:
    """Return the rate at which samples are taken [Hz]; the quirk ``whole-rates`` rounds it down."""
    return max(1.0, math.floor(rate)) if "whole-rates" in world.compatibility else rate


class Interface:
    """An interface that is connected to a world and its bus: it publishes or subscribes."""

    state: Record = NoState()
    """The state of the interface, all of it that changes with time; `Simulation.save` stores it."""


@runtime_checkable
class SimulatedInterface(Protocol):
    """The spec of an interface that has an effect; one without ``bind`` is only read."""

    def bind(self, world: TopicWorld) -> Interface:
        """Find the vehicle or sensor, and start; raise UnknownName if there is no such one."""


@dataclass(frozen=True, kw_only=True)
class InterfaceSpec(Spec):
    """An element of ``<rosInterfaces>``."""

    subscribes: ClassVar[bool] = False
    """True if the interface subscribes to its topics; otherwise it publishes on them."""
    sources: ClassVar[tuple[str, ...]] = ()
    """The kinds of elements that the interface may name, such as ``imu``; empty: it names none."""
    messages: ClassVar[Mapping[str, type]] = {}
    """The message type of each topic, by the name of the field that names the topic."""
    source_kind: ClassVar[str] = ""
    """The kind of source that the messages have for the tracks of suites, if it is not the element
    of the sensor that the interface names; empty otherwise."""

    @classmethod
    def message_types(cls) -> Mapping[str, type]:
        """Return the message type of each topic, by the name of the field that names the topic."""
        return cls.messages

    @classmethod
    def is_simulated(cls) -> bool:
        """Return whether the interface has an effect in the simulation."""
        return issubclass(cls, SimulatedInterface)


@dataclass(frozen=True, kw_only=True)
class VehicleTopicSpec(InterfaceSpec):
    """An interface of a vehicle with one topic."""

    sources: ClassVar[tuple[str, ...]] = ("vehicle",)

    topic: str
    """The name of the topic."""
    vehicle_name: str
    """The name of the vehicle."""


@dataclass(frozen=True, kw_only=True)
class VehiclePublisherSpec(VehicleTopicSpec):
    """An interface that publishes a quantity of a vehicle."""

    rate: float = rate_element()
    """The rate of publication [Hz]."""


def is_sample_needed(bus: Bus, topic: str) -> bool:
    """Return whether a topic has a subscriber, or `Bus.unread_message` may request its message."""
    return bus.keeps_unread_messages or bus.has_subscribers(topic)


class SampledTopic(Interface):
    """A publisher of samples that compiled code takes.

    The message of a sample is created only if the topic has a subscriber, or on request.

    Args:
        topic: the name of the topic.
        sampler: the compiled function that takes a sample.
        make_message: a function that creates the message of a sample from its time [s] and its
            values; it returns None if there is none.
        publish: a function that publishes a message.
    """

    def __init__(
        self,
        topic: str,
        sampler: Sampler,
        make_message: Callable[[float, Array], object],
        publish: Callable[[Any], None],
    ) -> None:
        self._topic, self._sampler, self._publish = topic, sampler, publish
        self._make_message = make_message
        self.state: Sample = Sample.create(sampler)
        """The newest sample."""

    def begin(
        self, rate: float, world: TopicWorld, *, is_faulty: bool = False, is_pure: bool = False
    ) -> None:
        """Take samples from now on.

        Args:
            rate: the rate of the samples [Hz].
            world: the world that takes the samples.
            is_faulty: True if faults change each message before it is published.
            is_pure: True if taking a sample changes no state; then none is taken without a
                subscriber.
        """
        bus, topic = world.bus, self._topic
        sampling = Sampling(
            self._sampler, self.state, partial(is_sample_needed, bus, topic) if is_pure else None
        )
        is_read = None if is_faulty else bus.make_subscriber_check(topic)
        if not is_faulty:
            bus.defer_unread_message(topic, self.newest_message)
        world.create_timer(
            sample_rate(rate, world), self.publish, is_needed=is_read, sampling=sampling
        )

    def newest_message(self) -> object | None:
        """Create the message of the newest sample; None before the first sample."""
        numbers = self.state.numbers
        time = float(numbers[0])
        return None if math.isnan(time) else self._make_message(time, numbers[1:])

    def publish(self) -> None:
        """Publish the newest sample."""
        if (message := self.newest_message()) is not None:
            self._publish(message)
