"""Communication devices: the pose of the device's link on a topic, the device's frame on ``/tf``.

The pose is that of the visual of the link to which the device is attached, in the world frame W.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..devices.comms.comms_device import CommsDevice
from ..errors import UnknownName
from ..messages import Pose, TFMessage
from ..messages.build import transform
from .frames import TF
from .interface import Interface, TopicWorld, sample_rate
from .sensor_topic import SensorTopicSpec


@dataclass(frozen=True, kw_only=True)
class CommsDeviceROSSpec(SensorTopicSpec):
    """An interface that publishes a communication device."""

    def bind(self, world: TopicWorld) -> CommsDevicePublisher:
        """Start to publish; raise UnknownName if there is no such device."""
        device = world.sensors.sensor(self.name, self.sources)
        if not isinstance(device, CommsDevice):
            raise UnknownName("communication device", self.name, ())
        publisher = CommsDevicePublisher(self.topic, device, world)
        world.create_timer(sample_rate(self.rate, world), publisher.publish)
        return publisher


@dataclass(frozen=True, kw_only=True)
class CustomCommsDeviceROSSpec(CommsDeviceROSSpec):
    """A publisher of a communication device: its link's pose as geometry_msgs/Pose, and /tf."""

    sources: ClassVar[tuple[str, ...]] = ("CustomCommsDevice",)


@dataclass(frozen=True, kw_only=True)
class AcousticCommsDeviceROSSpec(CommsDeviceROSSpec):
    """A publisher of an acoustic modem: its link's pose as geometry_msgs/Pose, and /tf."""

    sources: ClassVar[tuple[str, ...]] = ("AcousticCommsDevice",)


class CommsDevicePublisher(Interface):
    """A publisher of the pose of a device's link and of the device's frame."""

    def __init__(self, topic: str, device: CommsDevice, world: TopicWorld) -> None:
        self._device, self._world = device, world
        self._publish = world.bus.publisher(topic, Pose)
        self._publish_frame = world.bus.publisher(TF, TFMessage)

    def publish(self) -> None:
        """Publish both at the present time."""
        device, time = self._device, self._world.time
        self._publish(device.sample(time))
        pose = device.parent_from_device
        self._publish_frame(
            TFMessage(transforms=[transform(device.parent_frame, device.frame, pose, time)])
        )
