"""u:sonarToROS: a sonar on two topics, the echoes as numbers and as an image to look at."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Protocol, cast

from ..messages import Image, ProjectedSonarImage
from ..sensors.sensor import Sensor
from .interface import Interface, InterfaceSpec, TopicWorld, rate_element, sample_rate


@dataclass(frozen=True, kw_only=True)
class SonarToROSSpec(InterfaceSpec):
    """A publisher of a sonar as marine_acoustic_msgs/ProjectedSonarImage and sensor_msgs/Image."""

    sources: ClassVar[tuple[str, ...]] = ("u:imagingSonar", "u:scanningSonar", "u:sideScanSonar")
    messages: ClassVar[Mapping[str, type]] = {"topic": ProjectedSonarImage, "image_topic": Image}

    name: str
    """The name of the sonar."""
    topic: str
    """The topic of the echoes."""
    image_topic: str
    """The topic of the images: a fan seen from above, or the waterfall of a side-scan."""
    rate: float = rate_element()
    """The rate of pings [Hz]."""

    def bind(self, world: TopicWorld) -> SonarPublisher:
        """Start to ping; raise UnknownName if there is no such sonar."""
        sonar = cast("Sonar", world.sensors.sensor(self.name, self.sources))
        publisher = SonarPublisher(self, sonar, world)
        world.create_timer(sample_rate(self.rate, world), publisher.publish)
        return publisher


class Sonar(Sensor, Protocol):
    """A bound sonar."""

    def image(self, time: float) -> Image:
        """Return the last echoes as an image, stamped ``time`` [s]."""


class SonarPublisher(Interface):
    """A publisher of the echoes of a sonar, and of their image if its topic has a subscriber."""

    def __init__(self, spec: SonarToROSSpec, sonar: Sonar, world: TopicWorld) -> None:
        self._sonar, self._world, self._image_topic = sonar, world, spec.image_topic
        self._publish = world.sensors.publisher(spec.name, spec.topic, ProjectedSonarImage)
        self._publish_image = world.sensors.publisher(spec.name, spec.image_topic, Image)

    def publish(self) -> None:
        """Ping, also without a subscriber: speckle, scan and waterfall advance with each ping."""
        time = self._world.time
        self._publish(self._sonar.sample(time))
        if self._world.bus.has_subscribers(self._image_topic):
            self._publish_image(self._sonar.image(time))
