"""The segmentation of a camera's image on a topic: the body that each pixel shows, and a legend.

.. code-block:: xml

    <u:segmentationToROS>
      <cameraName>bowtech1</cameraName>
      <imageTopic>/uwsim/camera1/segmentation</imageTopic>
      <legendTopic>/uwsim/camera1/legend</legendTopic>
      <rate>10</rate>
    </u:segmentationToROS>

The image is ``16UC1``: a number for each pixel, 0 where it shows no body. Water and noise have no
influence on it. The legend is a JSON object in a std_msgs/String with the names of all numbers of
the scene: ``{"0": "", "1": "girona500/base_link", "7": "blackbox"}``. A vehicle's link is
``vehicle/link``; sand over a buried object is ``sand/object``.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Protocol, runtime_checkable

from ..base.geometry import Intrinsics, Pose
from ..errors import UnknownName
from ..messages import Image, String, label_image
from .depth_images import CAMERAS
from .interface import Interface, InterfaceSpec, TopicWorld, rate_element, sample_rate


@dataclass(frozen=True, kw_only=True)
class SegmentationToROSSpec(InterfaceSpec):
    """A publisher of the body that each pixel shows as sensor_msgs/Image, and a legend."""

    sources: ClassVar[tuple[str, ...]] = CAMERAS
    source_kind: ClassVar[str] = "u:segmentationToROS"  # no camera gives the true labels
    messages: ClassVar[Mapping[str, type]] = {"image_topic": Image, "legend_topic": String}

    camera_name: str
    """The name of the camera."""
    image_topic: str
    """The topic of the images: 16UC1, the segmentation ID of the body in each pixel, 0 for none."""
    legend_topic: str
    """The topic of the legend: a JSON object with the name of each body by its segmentation ID."""
    rate: float = rate_element()
    """The rate of publication [Hz]."""

    def bind(self, world: TopicWorld) -> SegmentationPublisher:
        """Start to publish; raise UnknownName if there is no such camera."""
        publisher = SegmentationPublisher(self, world)
        world.create_timer(sample_rate(self.rate, world), publisher.publish)
        return publisher


@runtime_checkable
class Pinhole(Protocol):
    """A camera with a pose and intrinsics."""

    @property
    def frame_id(self) -> str:
        """The ``frame_id`` in the headers of its messages."""

    @property
    def intrinsics(self) -> Intrinsics:
        """The intrinsics of the camera."""

    @property
    def world_from_camera(self) -> Pose:
        """The present pose of the camera in W, with OpenGL axes: x right, y up, z backward."""


class SegmentationPublisher(Interface):
    """A publisher of the segmentation of a camera; nothing is rendered without a subscriber."""

    def __init__(self, spec: SegmentationToROSSpec, world: TopicWorld) -> None:
        camera = world.sensors.sensor(spec.camera_name, CAMERAS)
        if not isinstance(camera, Pinhole):
            raise UnknownName("camera", spec.camera_name, ())
        self._camera, self._world = camera, world
        self._image_topic, self._legend_topic = spec.image_topic, spec.legend_topic
        self._publish_image = world.sensors.publisher(spec.camera_name, spec.image_topic, Image)
        self._publish_legend = world.bus.publisher(spec.legend_topic, String)

    def publish(self) -> None:
        """Publish the legend and the image that is due."""
        world, camera = self._world, self._camera
        if world.bus.has_subscribers(self._legend_topic):
            names = {0: ""} | dict(sorted(world.segmenter.part_names.items()))
            self._publish_legend(String(data=json.dumps(names)))
        if world.bus.has_subscribers(self._image_topic):
            numbers = world.segmenter.segmentation(camera.world_from_camera, camera.intrinsics)
            self._publish_image(label_image(numbers, time=world.time, frame_id=camera.frame_id))
