"""WorldToROSTF: the frames of a scene on ``/tf``.

======================  =======================  ===================================================
parent                  child                    transform
======================  =======================  ===================================================
``rootName``            vehicle                  the pose of the vehicle's base in L
vehicle                 vehicle/root link        identity; the original always names it base_link
vehicle/link            vehicle/link             the pose of a link in its parent, for every joint
vehicle/link            sensor                   the pose of the sensor in its link
``rootName``            object                   the pose of the mesh in L (``enableObjects`` 1)
``rootName``            marker ``<id>+<ns>``     the marker's pose in L (``enableObjects`` 1)
======================  =======================  ===================================================

L is the localized world, the frame of the scene. The frames of sensors have the axes of ROS: the
optical axis of a camera is +z, with x to the right of the image and y down; the zero angle of a
scan is along +x, and its angles turn about +z.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import ClassVar

from ..messages import TFMessage
from ..messages.build import transform
from .frames import TF, Frame
from .interface import Interface, InterfaceSpec, TopicWorld, rate_element, sample_rate


@dataclass(frozen=True, kw_only=True)
class WorldToROSTFSpec(InterfaceSpec):
    """A publisher of the frames of vehicles, sensors and objects as tf2_msgs/TFMessage on /tf."""

    messages: ClassVar[Mapping[str, type]] = {"topic": TFMessage}
    topic: ClassVar[str] = TF

    root_name: str
    """The name of the frame L on ``/tf``."""
    enable_objects: bool = False
    """True if objects are published too."""
    rate: float = rate_element()
    """The rate of publication [Hz]."""

    def bind(self, world: TopicWorld) -> FramePublisher:
        """Start to publish."""
        frames = world.frames(with_objects=self.enable_objects)
        publisher = FramePublisher(self, frames, world)
        is_read = partial(world.bus.has_subscribers, TF)
        world.create_timer(sample_rate(self.rate, world), publisher.publish, is_needed=is_read)
        return publisher


class FramePublisher(Interface):
    """A publisher of the transforms of frames."""

    def __init__(
        self,
        spec: WorldToROSTFSpec,
        frames: Callable[[], Sequence[Frame]],
        world: TopicWorld,
    ) -> None:
        self._spec, self._frames, self._world = spec, frames, world
        self._publish = world.bus.publisher(TF, TFMessage)

    def publish(self) -> None:
        """Publish all frames at their present pose."""
        time, root = self._world.time, self._spec.root_name
        self._publish(
            TFMessage(
                transforms=[
                    transform(frame.parent or root, frame.child, frame.parent_from_child(), time)
                    for frame in self._frames()
                ]
            )
        )
