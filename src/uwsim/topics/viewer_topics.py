"""Interfaces whose messages a viewer shows: images in the window, and point clouds in the scene.

A viewer or a program reads `HudImage.pixels` and `CloudsState.clouds` from the interfaces in
``simulation.world.interfaces``. An invalid message leaves them unchanged; ``problem`` in the state
of the interface is then the error.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from ..base.record import Record
from ..errors import BadSetting, UnknownName
from ..messages import Image, PointCloud2, pixels_of, points
from ..messages.point_cloud import point_colours
from ..schema import element
from .interface import Interface, InterfaceSpec, TopicWorld

MAX_POINTS = 10_000_000
"""The greatest number of points that an interface holds; the oldest clouds are removed first."""


@dataclass(frozen=True, kw_only=True)
class ROSImageToHUDSpec(InterfaceSpec):
    """A subscription to images that the viewer shows in its window."""

    subscribes: ClassVar[bool] = True
    messages: ClassVar[Mapping[str, type]] = {"image_topic": Image}

    width: int = element(minimum=1)
    """The number of columns of the images [px]."""
    height: int = element(minimum=1)
    """The number of rows of the images [px]."""
    posx: int = 0
    """The distance of the image from the left edge of the window [px]."""
    posy: int = 0
    """The distance of the image from the bottom edge of the window [px]."""
    scale: float = 1.0
    """The size on the screen, relative to the size of the image [1]."""
    black_white: bool = False
    """True if the images have one channel."""
    image_topic: str
    """The topic of the images."""
    info_topic: str = ""
    """The topic of the camera's description; the original does not read it."""

    def bind(self, world: TopicWorld) -> HudImage:
        """Start to subscribe."""
        hud = HudImage(self)
        world.bus.subscribe(self.image_topic, Image, hud.receive)
        return hud


@dataclass(slots=True)
class HudState(Record):
    """The state of a displayed image topic."""

    message: Image | None = None
    """The newest valid image."""
    problem: str | None = None
    """The error of the newest message; None if it is valid."""


class HudImage(Interface):
    """The newest image of a topic, for display."""

    def __init__(self, spec: ROSImageToHUDSpec) -> None:
        self.spec = spec
        """The position and size on the screen."""
        self.state: HudState = HudState()

    @property
    def pixels(self) -> npt.NDArray[np.uint8] | None:
        """The newest valid image, row 0 at the top, (h, w, 3), or (h, w) if grey; None before."""
        message = self.state.message
        return None if message is None else pixels_of(message)

    def receive(self, message: Image) -> None:
        """Store an image of the size and encoding that the interface expects."""
        self.state.problem = self._find_problem(message)
        if self.state.problem is None:
            self.state.message = message

    def _find_problem(self, message: Image) -> str | None:
        spec = self.spec
        encoding = "mono8" if spec.black_white else "rgb8"
        if message.encoding != encoding:
            return f"the image is {message.encoding[:40]!r}; expected {encoding}"
        if (message.width, message.height) != (spec.width, spec.height):
            size = f"{message.width} x {message.height} px"
            return f"the image has {size}; expected {spec.width} x {spec.height} px"
        n_bytes = spec.width * spec.height * (1 if spec.black_white else 3)
        return None if message.data.size == n_bytes else f"the image is not of {n_bytes} bytes"


@dataclass(frozen=True, eq=False)
class ShownCloud:
    """A point cloud at the pose that its frame had when the message arrived."""

    points: npt.NDArray[np.float32]
    """The points in L, the frame of the scene, (n, 3) [m]."""
    colours: npt.NDArray[np.uint8]
    """The red, green and blue of each point, (n, 3), from 0 to 255."""


@dataclass(slots=True)
class CloudsState(Record):
    """The state of a displayed topic of point clouds."""

    clouds: list[ShownCloud] = field(default_factory=list)
    """The displayed clouds, oldest first."""
    problem: str | None = None
    """The error of the newest message; None if it is valid."""


@dataclass(frozen=True, kw_only=True)
class ROSPointCloudLoaderSpec(InterfaceSpec):
    """A subscription to sensor_msgs/PointCloud2 that the scene shows."""

    subscribes: ClassVar[bool] = True
    messages: ClassVar[Mapping[str, type]] = {"topic": PointCloud2}

    topic: str
    """The name of the topic."""
    del_last_pcd: bool = element("delLastPCD", attribute=True, default=True)
    """True if a cloud replaces the previous cloud."""

    def bind(self, world: TopicWorld) -> PointClouds:
        """Start to subscribe."""
        clouds = PointClouds(world, replaces_previous=self.del_last_pcd)
        world.bus.subscribe(self.topic, PointCloud2, clouds.receive)
        return clouds


class PointClouds(Interface):
    """The point clouds of a topic.

    A message with four fields has the colours of the points. Otherwise z of a point in the frame of
    the message determines its colour.
    """

    def __init__(self, world: TopicWorld, *, replaces_previous: bool) -> None:
        self._world, self._replaces_previous = world, replaces_previous
        self.state: CloudsState = CloudsState()

    def receive(self, message: PointCloud2) -> None:
        """Add a cloud at the present pose of its frame; it does not move with the frame later."""
        try:
            cloud = self._place_cloud(message)
        except (BadSetting, UnknownName) as error:
            self.state.problem = str(error)
            return
        self.state.problem = None
        clouds = [cloud] if self._replaces_previous else [*self.state.clouds, cloud]
        while sum(len(past_cloud.points) for past_cloud in clouds) > MAX_POINTS and len(clouds) > 1:
            clouds = clouds[1:]
        self.state.clouds = clouds

    def _place_cloud(self, message: PointCloud2) -> ShownCloud:
        local_points = points(message)
        frame = self._world.body(message.header.frame_id.strip().strip("/"))
        is_finite = np.isfinite(local_points).all(axis=1)
        local_points = local_points[is_finite]
        is_coloured = len(message.fields) == 4
        colours = point_colours(message)[is_finite] if is_coloured else jet(local_points[:, 2])
        localized_from_world = self._world.world_from_localized.inverse()
        localized_from_frame = localized_from_world @ frame.world_from_body
        return ShownCloud(localized_from_frame.transform(local_points).astype(np.float32), colours)


def jet(heights: npt.NDArray[np.float64]) -> npt.NDArray[np.uint8]:
    r"""Return the colour of each height z [m]: from blue (lowest) over green to red, (n, 3) uint8.

    With :math:`s = 2 (z - z_{min}) / (z_{max} - z_{min}) - 1`, red, green and blue are
    :math:`b(s - 0.5)`, :math:`b(s)` and :math:`b(s + 0.5)`. The function :math:`b` is a trapezium:
    1 from -0.25 to 0.25, and 0 beyond 0.75 on either side.
    """
    if len(heights) == 0:
        return np.empty((0, 3), dtype=np.uint8)
    min_height, max_height = float(heights.min()), float(heights.max())
    span = max_height - min_height
    s = 2.0 * (heights - min_height) / span - 1.0 if span > 0.0 else np.zeros(len(heights))
    arguments = np.stack([s - 0.5, s, s + 0.5], axis=1)
    intensities = np.clip(1.5 - 2.0 * np.abs(arguments), 0.0, 1.0)
    return np.rint(255.0 * intensities).astype(np.uint8)
