"""What every element of ``<rosInterfaces>`` is, and what of the world it sees."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar, Protocol, TypeVar, runtime_checkable

from ..schema import element
from ..sensors.sensor import Sensor
from ..sensors.virtual_camera import VirtualCamera
from ..vehicle import Vehicle
from ..world import World
from .frames import Frame

M = TypeVar("M")


class TopicWorld(World, Protocol):
    """What an interface sees: the world, its vehicles and sensors, and when to publish and act."""

    @property
    def is_blind(self) -> bool:
        """Whether images are black and nothing is drawn."""

    def vehicle(self, name: str) -> Vehicle:
        """Find a vehicle; UnknownName if there is none."""

    def camera(self, name: str) -> VirtualCamera:
        """Find a virtual camera; UnknownName if there is none."""

    def sensor(self, name: str, elements: tuple[str, ...]) -> Sensor:
        """Find a sensor or device that publishes, read from one of these elements; UnknownName."""

    def is_touchable(self, name: str) -> bool:
        """Whether there is a vehicle or object of that name, with a shape that others touch."""

    def frames(self, *, with_objects: bool) -> Sequence[Frame]:
        """List the frames of vehicles, their links and sensors, and those of objects."""

    def every(self, rate: float, call: Callable[[], None]) -> Callable[[], None]:
        """Have ``call`` called at the samples of ``rate`` [Hz] from now on; returns how to stop."""

    def at_next_step(self, obey: Callable[[M], None], message: M) -> None:
        """Have ``obey(message)`` called at the start of the next step; a method of an interface."""


class Interface:
    """An interface at work: it publishes or listens by itself from the time it is bound."""

    STATE: ClassVar[tuple[str, ...]] = ()
    """Names of the attributes that change as time goes by; `Simulation.save` keeps them."""


@runtime_checkable
class Binds(Protocol):
    """An interface that is simulated: what has no ``bind`` is read and does nothing."""

    def bind(self, world: TopicWorld) -> Interface:
        """Find what it is about and start it; raises UnknownName if that is not there."""


@dataclass(frozen=True, kw_only=True)
class InterfaceSpec:
    """An element of ``<rosInterfaces>``."""

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
        """Whether it does anything."""
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
    """An interface that publishes something of a vehicle."""

    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""
