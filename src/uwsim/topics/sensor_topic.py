"""Interfaces that publish the samples of a sensor or device at a rate.

.. code-block:: xml

    <u:sensorToROS> <name>imu</name> <topic>/g500/imu</topic> <rate>10</rate> </u:sensorToROS>

``u:sensorToROS`` may name a sensor or device of any kind; the other elements, which are those of
the original, may name only some kinds. An interface has an effect if one of the kinds that it may
name is simulated.
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
from ..sensors.sensor import CompiledSensor, Sensor, find_message_type
from .interface import (
    Interface,
    InterfaceSpec,
    SampledTopic,
    TopicWorld,
    is_sample_needed,
    rate_element,
    sample_rate,
)


@dataclass(frozen=True, kw_only=True)
class SensorTopicSpec(InterfaceSpec):
    """An interface of a sensor or device with one topic."""

    name: str
    """The name of the sensor or device."""
    topic: str
    """The name of the topic."""
    rate: float = rate_element()
    """The rate of publication [Hz]."""

    @classmethod
    def is_simulated(cls) -> bool:
        """Return whether one of the kinds of sensors that it may name is simulated."""
        return bool(cls.message_types())

    @classmethod
    def message_types(cls) -> Mapping[str, type]:
        """Return the message type of the first of ``sources`` that has one; empty if none has."""
        classes = _spec_classes()
        types = [find_message_type(classes[source]) for source in cls.sources]
        return next(({"topic": type_} for type_ in types if type_ is not None), {})

    def bind(self, world: TopicWorld) -> Interface:
        """Start to publish; raise UnknownName if there is no such sensor."""
        sensor = world.sensors.sensor(self.name, self.sources)
        spec_class = self._spec_class(sensor, world)
        publish = world.sensors.publisher(self.name, self.topic, spec_class.message_type)
        if isinstance(sensor, CompiledSensor):
            sampled_topic = SampledTopic(self.topic, sensor.sampler, sensor.message, publish)
            is_faulty = world.sensors.has_faults(self.name)
            sampled_topic.begin(self.rate, world, is_faulty=is_faulty, is_pure=spec_class.is_pure)
            return sampled_topic
        is_needed = partial(is_sample_needed, world.bus, self.topic) if spec_class.is_pure else None
        publisher = SensorPublisher(sensor, publish, lambda: world.time)
        world.create_timer(sample_rate(self.rate, world), publisher.publish, is_needed=is_needed)
        return publisher

    def _spec_class(self, sensor: Sensor, world: TopicWorld) -> type[Any]:
        """Return the class of the sensor's spec; sensors of two kinds may share a name."""
        classes = _spec_classes()
        for source in self.sources:
            with suppress(UnknownName):
                if world.sensors.sensor(self.name, (source,)) is sensor:
                    return classes[source]
        raise UnknownName("sensor", self.name, ())


def _spec_classes() -> dict[str, type[Any]]:
    return {prefixed_name(tag): spec for tag, spec in {**SENSORS, **DEVICES}.items()}


@dataclass(frozen=True, kw_only=True)
class SensorToROSSpec(SensorTopicSpec):
    """A publisher of any sensor or device that measures, with its own message type.

    Not for colour cameras, which need two topics, for images and for CameraInfo
    (``virtualCameraToROSImage``).
    """

    sources: ClassVar[tuple[str, ...]] = tuple(
        element
        for element, spec in _spec_classes().items()
        if find_message_type(spec) is not None and element != "virtualCamera"
    )

    @classmethod
    def message_types(cls) -> Mapping[str, type]:
        """Return the name of the field of the topic; the named sensor has the message type."""
        return {"topic": object}


class SensorPublisher(Interface):
    """A publisher of the samples of a sensor."""

    def __init__(
        self, sensor: Sensor, publish: Callable[[object], None], clock: Callable[[], float]
    ) -> None:
        self._sensor, self._publish, self._clock = sensor, publish, clock

    def publish(self) -> None:
        """Take a sample and publish it."""
        message = self._sensor.sample(self._clock())
        if message is not None:
            self._publish(message)


@dataclass(frozen=True, kw_only=True)
class RangeSensorToROSRangeSpec(SensorTopicSpec):
    """A publisher of a range sensor or object picker as sensor_msgs/Range."""

    sources: ClassVar[tuple[str, ...]] = ("rangeSensor", "objectPicker")


@dataclass(frozen=True, kw_only=True)
class ImuToROSImuSpec(SensorTopicSpec):
    """A publisher of an IMU as sensor_msgs/Imu."""

    sources: ClassVar[tuple[str, ...]] = ("imu",)


@dataclass(frozen=True, kw_only=True)
class PressureSensorToROSSpec(SensorTopicSpec):
    """A publisher of a pressure sensor as underwater_sensor_msgs/Pressure."""

    sources: ClassVar[tuple[str, ...]] = ("pressureSensor",)


@dataclass(frozen=True, kw_only=True)
class GPSSensorToROSSpec(SensorTopicSpec):
    """A publisher of a GPS as sensor_msgs/NavSatFix."""

    sources: ClassVar[tuple[str, ...]] = ("gpsSensor",)


@dataclass(frozen=True, kw_only=True)
class DVLSensorToROSSpec(SensorTopicSpec):
    """A publisher of a DVL as underwater_sensor_msgs/DVL."""

    sources: ClassVar[tuple[str, ...]] = ("dvlSensor",)


@dataclass(frozen=True, kw_only=True)
class MultibeamSensorToLaserScanSpec(SensorTopicSpec):
    """A publisher of a multibeam sonar as sensor_msgs/LaserScan."""

    sources: ClassVar[tuple[str, ...]] = ("multibeamSensor",)


@dataclass(frozen=True, kw_only=True)
class ProfilingSonarROSSpec(SensorTopicSpec):
    """A publisher of a profiling sonar as sensor_msgs/LaserScan."""

    sources: ClassVar[tuple[str, ...]] = ("ProfilingSonar",)


@dataclass(frozen=True, kw_only=True)
class EchoROSSpec(SensorTopicSpec):
    """A publisher of the text of an echo device as std_msgs/String."""

    sources: ClassVar[tuple[str, ...]] = ("echo",)


@dataclass(frozen=True, kw_only=True)
class ForceSensorROSSpec(SensorTopicSpec):
    """A publisher of a force sensor as geometry_msgs/WrenchStamped."""

    sources: ClassVar[tuple[str, ...]] = ("ForceSensor",)


@dataclass(frozen=True, kw_only=True)
class BatteryToROSSpec(SensorTopicSpec):
    """A publisher of a battery as sensor_msgs/BatteryState."""

    sources: ClassVar[tuple[str, ...]] = ("u:battery",)


@dataclass(frozen=True, kw_only=True)
class MotorCurrentsToROSSpec(SensorTopicSpec):
    """A publisher of the currents of motors [A] as the efforts of sensor_msgs/JointState."""

    sources: ClassVar[tuple[str, ...]] = ("u:motorCurrents",)
