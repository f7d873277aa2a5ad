"""Errors about ``<u:instrumentStream>`` and ``<u:actuatorStream>``: formats, addresses, topics."""

from __future__ import annotations

from collections.abc import Iterator

from ...devices.device import DeviceSpec
from ...devices.streams.actuator_stream import ActuatorStreamSpec
from ...devices.streams.instrument_stream import InstrumentStreamSpec
from ...errors import Diagnostic
from ...scene.spec import SceneSpec
from ..subjects import CheckedScene


def check_streams(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report invalid values of streams, and warn of topics that nothing publishes."""
    topics: set[str] | None = None
    for vehicle in scene.spec.vehicles:
        for spec in vehicle.parts_of(InstrumentStreamSpec):
            for message in spec.errors():
                yield scene.error(spec, f"<u:instrumentStream>: {message}")
            topics = published_topics(scene.spec) if topics is None else topics
            if spec.topic and spec.topic.strip("/") not in topics:
                near = scene.diagnostics.suggest(spec.topic.strip("/"), topics, "warning")
                message = f"nothing in the scene publishes {spec.topic!r}.{near}"
                yield scene.warning(spec, f"<u:instrumentStream>: {message}", "topic")
        for actuator_spec in vehicle.parts_of(ActuatorStreamSpec):
            for message in actuator_spec.errors():
                yield scene.error(actuator_spec, f"<u:actuatorStream>: {message}")
            if vehicle.dynamics is None:
                message = f"{vehicle.name} has no thrusters; expected a vehicle with u:dynamics"
                yield scene.error(actuator_spec, f"<u:actuatorStream>: {message}")


def published_topics(scene: SceneSpec) -> set[str]:
    """Return the topics that interfaces and devices publish, without their first slash."""
    topics = {
        str(getattr(interface, field)).strip("/")
        for interface in scene.ros_interfaces
        if not interface.subscribes
        for field in interface.message_types()
    }
    for vehicle in scene.vehicles:
        devices = [part for part in vehicle.parts if isinstance(part, DeviceSpec)]
        topics |= {
            topic.name.strip("/")
            for device in devices
            for topic in device.topics
            if not topic.is_subscribed
        }
    return topics
