"""contactSensorToROS: whether a vehicle or object is in contact, on a topic."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import ClassVar

from ..errors import UnknownName
from ..messages import Bool
from .interface import Interface, InterfaceSpec, TopicWorld, rate_element, sample_rate


@dataclass(frozen=True, kw_only=True)
class ContactSensorToROSSpec(InterfaceSpec):
    """A publisher of whether a vehicle or object is in contact, as std_msgs/Bool."""

    sources: ClassVar[tuple[str, ...]] = ("vehicle", "object")
    messages: ClassVar[Mapping[str, type]] = {"topic": Bool}

    name: str
    """The name of the vehicle or object."""
    topic: str
    """The name of the topic."""
    rate: float = rate_element()
    """The rate of publication [Hz]."""

    def bind(self, world: TopicWorld) -> ContactPublisher:
        """Start to publish; raise UnknownName if no body of that name has a collision shape."""
        if not world.contacts.is_possible(self.name):
            raise UnknownName("vehicle or object with a shape", self.name, ())
        publisher = ContactPublisher(self.name, self.topic, world)
        is_read = partial(world.bus.has_subscribers, self.topic)
        world.create_timer(sample_rate(self.rate, world), publisher.publish, is_needed=is_read)
        return publisher


class ContactPublisher(Interface):
    """A publisher of whether a body is in contact."""

    def __init__(self, name: str, topic: str, world: TopicWorld) -> None:
        self._name, self._world = name, world
        self._publish = world.bus.publisher(topic, Bool)

    def publish(self) -> None:
        """Publish whether the body is in contact now; the message has no time stamp."""
        self._publish(Bool(data=bool(self._world.contacts.find(self._name))))
