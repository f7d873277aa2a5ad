"""SimulatedDeviceROS: an element around the interface of a device, as some older files have it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from ..schema import element
from .interface import Interface, InterfaceSpec, TopicWorld
from .sensor_topic import EchoROSSpec


@dataclass(frozen=True, kw_only=True)
class SimulatedDeviceROSSpec(InterfaceSpec):
    """An optional wrapper around the interface of a device."""

    echo_ros: EchoROSSpec | None = element("echoROS", default=None)
    """The interface of an echo device."""

    def bind(self, world: TopicWorld) -> Interface:
        """Bind the wrapped interface; raise UnknownName if there is no such device."""
        return Interface() if self.echo_ros is None else self.echo_ros.bind(world)


def unwrap_interfaces(interfaces: Iterable[InterfaceSpec]) -> Iterator[InterfaceSpec]:
    """Yield all interfaces; a wrapper is replaced by the interface that it contains."""
    for interface in interfaces:
        if not isinstance(interface, SimulatedDeviceROSSpec):
            yield interface
        elif interface.echo_ros is not None:
            yield interface.echo_ros
