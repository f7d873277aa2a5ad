"""The frames of a scene on ``/tf``.

======================  =======================  ===================================================
parent                  child                    transform
======================  =======================  ===================================================
``rootName``            vehicle                  the base in L
vehicle                 vehicle/root link        identity; the original says base_link, always
vehicle/link            vehicle/link             every joint of the robot, fixed ones too
vehicle/link            sensor                   where the sensor is on its link, in ROS's axes
``rootName``            object                   the mesh frame in L, with ``enableObjects`` 1
``rootName``            marker ``<id>+<ns>``     its pose in L, with ``enableObjects`` 1
======================  =======================  ===================================================

ROS's axes: cameras look along +z of their frame, with x to the right of the image and y down; the
zero of a scan is along +x and its angles turn about z.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import ClassVar

from ..messages import TFMessage
from ..messages.build import transform
from .frames import TF, Frame
from .interface import Interface, InterfaceSpec, TopicWorld, rate_element, sample_rate


@dataclass(frozen=True, kw_only=True)
class WorldToROSTFSpec(InterfaceSpec):
    """Publishes the frames of vehicles, sensors and objects as tf2_msgs/TFMessage on /tf."""

    messages: ClassVar[Mapping[str, type]] = {"topic": TFMessage}
    topic: ClassVar[str] = TF

    root_name: str
    """Name of the frame of the file."""
    enable_objects: bool = False
    """Whether objects are published too."""
    rate: float = rate_element()
    """How often [Hz]."""

    def bind(self, world: TopicWorld) -> FramePublisher:
        """Publish from now on."""
        frames = world.frames(with_objects=self.enable_objects)
        publisher = FramePublisher(self, frames, world)
        is_read = partial(world.bus.has_readers, TF)
        world.every(sample_rate(self.rate, world), publisher.publish, is_needed=is_read)
        return publisher


class FramePublisher(Interface):
    """Publishes the transforms of frames."""

    def __init__(self, spec: WorldToROSTFSpec, frames: Sequence[Frame], world: TopicWorld) -> None:
        self._spec, self._frames, self._world = spec, frames, world
        self._publish = world.bus.publisher(TF, TFMessage)

    def publish(self) -> None:
        """Publish all frames as they are now."""
        time, root = self._world.time, self._spec.root_name
        markers = self._world.marker_frames() if self._spec.enable_objects else ()
        self._publish(
            TFMessage(
                transforms=[
                    transform(each.parent or root, each.child, each.parent_from_child(), time)
                    for each in (*self._frames, *markers)
                ]
            )
        )
