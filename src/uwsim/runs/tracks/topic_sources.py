"""The sources of the topics of a scene: the kind of sensor or device that publishes each."""

from __future__ import annotations

from collections.abc import Iterator

from ...devices.device import DeviceSpec
from ...devices.topic_link import TopicLinkSpec
from ...scene.spec import SceneSpec
from ...schema.names import prefixed_name
from ...topics import InterfaceSpec, element_name
from ...topics.simulated_device_ros import unwrap_interfaces


def topic_sources(scene: SceneSpec) -> dict[str, str]:
    """Return the kind of source of each topic that sensors, devices and interfaces publish.

    The keys are the names of the topics without a leading slash. A kind is the element of the
    sensor or device, such as ``virtualCamera``. It is the element of the interface where this
    names no sensor (``PATToROSOdom``, ``ArmToROSJointState``), or where its messages contain what
    the sensor does not measure (``u:segmentationToROS``). A topic that a ``<u:topicLink>`` relays
    has the kind of its source.
    """
    kinds = {
        topic: _source_kind(interface, scene)
        for interface in unwrap_interfaces(scene.ros_interfaces)
        if not interface.subscribes
        for topic in _topics_of(interface)
    }
    kinds |= {topic: kind for topic, kind, is_read in _device_topics(scene) if not is_read}
    return kinds | {topic: kinds[source] for topic, source in _relays(scene) if source in kinds}


def topics_on_board(scene: SceneSpec) -> dict[str, str]:
    """Return the link of each topic of a vehicle with a ``<u:topicLink>``, by topic.

    These are the topics that its sensors, devices and interfaces publish, whether the link reports
    them or not; the link's own topics are those of the operator.
    """
    links: dict[str, str] = {}
    for vehicle in scene.vehicles:
        names = {getattr(part, "name", None) for _, part in vehicle.all_parts()} - {None}
        for link in vehicle.parts_of(TopicLinkSpec)[:1]:
            for interface in unwrap_interfaces(scene.ros_interfaces):
                part_name = getattr(interface, "camera_name", None) or getattr(
                    interface, "name", None
                )
                is_own = getattr(interface, "vehicle_name", None) == vehicle.name
                if not interface.subscribes and (is_own or part_name in names):
                    links |= dict.fromkeys(_topics_of(interface), link.name)
            for _, part in vehicle.all_parts():
                if isinstance(part, DeviceSpec) and not isinstance(part, TopicLinkSpec):
                    topics = [topic for topic in part.topics if not topic.is_subscribed]
                    links |= {topic.name.strip().lstrip("/"): link.name for topic in topics}
    return links


def command_topics(scene: SceneSpec) -> frozenset[str]:
    """Return the topics to which interfaces and devices of a scene subscribe."""
    topics = {
        topic
        for interface in unwrap_interfaces(scene.ros_interfaces)
        if interface.subscribes
        for topic in _topics_of(interface)
    }
    return frozenset(topics | {topic for topic, _, is_read in _device_topics(scene) if is_read})


def _topics_of(interface: InterfaceSpec) -> Iterator[str]:
    for field in interface.message_types():
        if topic := getattr(interface, field, ""):
            yield str(topic).strip().lstrip("/")


def _source_kind(interface: InterfaceSpec, scene: SceneSpec) -> str:
    name = getattr(interface, "camera_name", None) or getattr(interface, "name", None)
    kinds = [
        element
        for vehicle in scene.vehicles
        for element, part in vehicle.all_parts()
        if getattr(part, "name", None) == name and element in interface.sources
    ]
    own_kind = prefixed_name(element_name(interface))
    return interface.source_kind or next(iter(kinds), own_kind)


def _device_topics(scene: SceneSpec) -> Iterator[tuple[str, str, bool]]:
    """Yield each topic of a device, the element of the device, and whether the device reads it."""
    for vehicle in scene.vehicles:
        for element, part in vehicle.all_parts():
            if isinstance(part, DeviceSpec):
                for topic in part.topics:
                    yield topic.name.strip().lstrip("/"), element, topic.is_subscribed


def _relays(scene: SceneSpec) -> Iterator[tuple[str, str]]:
    """Yield each topic on which a device publishes the messages of another, and that other one."""
    for vehicle in scene.vehicles:
        for _, part in vehicle.all_parts():
            if isinstance(part, DeviceSpec):
                for topic in part.topics:
                    if topic.relayed_topic:
                        yield topic.name, topic.relayed_topic
