"""Interfaces that publish a sensor at a rate.

.. code-block:: xml

    <u:sensorToROS> <name>imu</name> <topic>/g500/imu</topic> <rate>10</rate> </u:sensorToROS>

What is published is what the sensor or device measures. ``u:sensorToROS`` names one of any kind;
the other elements, which are older, each take those of some. Where none of the elements that an
interface may name is simulated (has a ``bind``), the interface is not either.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import Any, ClassVar

from ..devices import DEVICES
from ..errors import UnknownName
from ..schema.names import prefixed_name
from ..sensors import SENSORS
from ..sensors.sensor import CompiledSensor, Sensor, measured_by
from .interface import (
    Interface,
    InterfaceSpec,
    SampledTopic,
    TopicWorld,
    is_needed,
    rate_element,
    sample_rate,
)


@dataclass(frozen=True, kw_only=True)
class SensorTopicSpec(InterfaceSpec):
    """An interface of a sensor or device with one topic."""

    name: str
    """Name of the sensor or device."""
    topic: str
    """Name of the topic."""
    rate: float = rate_element()
    """How often [Hz]."""

    @classmethod
    def is_simulated(cls) -> bool:
        """Whether one of its sources is."""
        return bool(cls.carries())

    @classmethod
    def carries(cls) -> Mapping[str, type]:
        """Return the message type of its sources."""
        parts = _parts()
        types = [measured_by(parts[source]) for source in cls.sources]
        return next(({"topic": type_} for type_ in types if type_ is not None), {})

    def bind(self, world: TopicWorld) -> Interface:
        """Publish the sensor from now on; raises UnknownName if it is not there."""
        sensor = world.sensors.sensor(self.name, self.sources)
        part = self._part(sensor, world)
        publish = world.sensors.publisher(self.name, self.topic, part.message_type)
        if isinstance(sensor, CompiledSensor):
            sampled = SampledTopic(self.topic, sensor.sampler, sensor.message, publish)
            is_faulty = world.sensors.has_faults(self.name)
            sampled.begin(self.rate, world, is_faulty=is_faulty, is_pure=part.is_pure)
            return sampled
        needed = partial(is_needed, world.bus, self.topic) if part.is_pure else None
        publisher = SensorPublisher(sensor, publish, lambda: world.time)
        world.every(sample_rate(self.rate, world), publisher.publish, is_needed=needed)
        return publisher

    def _part(self, sensor: Sensor, world: TopicWorld) -> type[Any]:
        """Return the class of the sensor's spec; sensors of two kinds may share a name."""
        parts = _parts()
        for source in self.sources:
            with suppress(UnknownName):
                if world.sensors.sensor(self.name, (source,)) is sensor:
                    return parts[source]
        raise UnknownName("sensor", self.name, ())


def _parts() -> dict[str, type[Any]]:
    """Return the specs of all sensors and devices by their elements."""
    return {prefixed_name(tag): spec for tag, spec in {**SENSORS, **DEVICES}.items()}


@dataclass(frozen=True, kw_only=True)
class SensorToROSSpec(SensorTopicSpec):
    """Publishes any sensor or device that measures, with its own message type.

    A colour camera has two topics, of images and of CameraInfo: `VirtualCameraToROSImage` is its
    element.
    """

    sources: ClassVar[tuple[str, ...]] = tuple(
        element
        for element, spec in _parts().items()
        if measured_by(spec) is not None and element != "virtualCamera"
    )

    @classmethod
    def carries(cls) -> Mapping[str, type]:
        """Return the field of the topic; what it carries is the type of the sensor it names."""
        return {"topic": object}


class SensorPublisher(Interface):
    """Publishes what a sensor measures."""

    def __init__(
        self,
        sensor: Sensor,
        publish: Callable[[object], None],
        clock: Callable[[], float],
    ) -> None:
        self._sensor, self._publish, self._clock = sensor, publish, clock

    def publish(self) -> None:
        """Take a sample and publish it."""
        message = self._sensor.sample(self._clock())
        if message is not None:
            self._publish(message)


@dataclass(frozen=True, kw_only=True)
class RangeSensorToROSRangeSpec(SensorTopicSpec):
    """Publishes a range sensor or picker as sensor_msgs/Range."""

    sources: ClassVar[tuple[str, ...]] = ("rangeSensor", "objectPicker")


@dataclass(frozen=True, kw_only=True)
class ImuToROSImuSpec(SensorTopicSpec):
    """Publishes an imu as sensor_msgs/Imu."""

    sources: ClassVar[tuple[str, ...]] = ("imu",)


@dataclass(frozen=True, kw_only=True)
class PressureSensorToROSSpec(SensorTopicSpec):
    """Publishes a pressure sensor as underwater_sensor_msgs/Pressure."""

    sources: ClassVar[tuple[str, ...]] = ("pressureSensor",)


@dataclass(frozen=True, kw_only=True)
class GPSSensorToROSSpec(SensorTopicSpec):
    """Publishes a GPS as sensor_msgs/NavSatFix."""

    sources: ClassVar[tuple[str, ...]] = ("gpsSensor",)


@dataclass(frozen=True, kw_only=True)
class DVLSensorToROSSpec(SensorTopicSpec):
    """Publishes a DVL as underwater_sensor_msgs/DVL."""

    sources: ClassVar[tuple[str, ...]] = ("dvlSensor",)


@dataclass(frozen=True, kw_only=True)
class MultibeamSensorToLaserScanSpec(SensorTopicSpec):
    """Publishes a multibeam as sensor_msgs/LaserScan."""

    sources: ClassVar[tuple[str, ...]] = ("multibeamSensor",)


@dataclass(frozen=True, kw_only=True)
class ProfilingSonarROSSpec(SensorTopicSpec):
    """Publishes a profiling sonar as sensor_msgs/LaserScan."""

    sources: ClassVar[tuple[str, ...]] = ("ProfilingSonar",)


@dataclass(frozen=True, kw_only=True)
class EchoROSSpec(SensorTopicSpec):
    """Publishes the text of an echo device as std_msgs/String."""

    sources: ClassVar[tuple[str, ...]] = ("echo",)


@dataclass(frozen=True, kw_only=True)
class ForceSensorROSSpec(SensorTopicSpec):
    """Publishes a force sensor as geometry_msgs/WrenchStamped."""

    sources: ClassVar[tuple[str, ...]] = ("ForceSensor",)


@dataclass(frozen=True, kw_only=True)
class BatteryToROSSpec(SensorTopicSpec):
    """Publishes a battery as sensor_msgs/BatteryState."""

    sources: ClassVar[tuple[str, ...]] = ("u:battery",)


@dataclass(frozen=True, kw_only=True)
class MotorCurrentsToROSSpec(SensorTopicSpec):
    """Publishes the currents of motors [A] as sensor_msgs/JointState: its efforts."""

    sources: ClassVar[tuple[str, ...]] = ("u:motorCurrents",)
