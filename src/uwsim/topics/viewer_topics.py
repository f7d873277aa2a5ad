"""Interfaces whose messages a viewer shows: images, and clouds of points.

What is to be shown is kept where a viewer, or a program, reads it: `HudImage.pixels` and
`CloudsState.clouds` of ``simulation.world.interfaces``. A message that cannot be shown leaves it as
it is; `problem` says why.
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
"""Most points of an interface that are kept; the oldest clouds go first."""


@dataclass(frozen=True, kw_only=True)
class ROSImageToHUDSpec(InterfaceSpec):
    """Shows images of a topic in the viewer."""

    subscribes: ClassVar[bool] = True
    messages: ClassVar[Mapping[str, type]] = {"image_topic": Image}

    width: int = element(minimum=1)
    """Columns of the images [px]."""
    height: int = element(minimum=1)
    """Rows of the images [px]."""
    posx: int = 0
    """From the left edge of the window [px]."""
    posy: int = 0
    """From the bottom edge of the window [px]."""
    scale: float = 1.0
    """Size on the screen [1]."""
    black_white: bool = False
    """Whether the images have one channel."""
    image_topic: str
    """Topic of the images."""
    info_topic: str = ""
    """Topic of the camera's description; the original does not read it."""

    def bind(self, world: TopicWorld) -> HudImage:
        """Listen from now on."""
        hud = HudImage(self)
        world.bus.subscribe(self.image_topic, Image, hud.receive)
        return hud


@dataclass(slots=True)
class HudState(Record):
    """What has come for a display."""

    message: Image | None = None
    """The newest image that can be shown."""
    problem: str | None = None
    """Why the newest message cannot be shown; None: it can."""


class HudImage(Interface):
    """The newest image of a topic, as it is to be shown."""

    def __init__(self, spec: ROSImageToHUDSpec) -> None:
        self.spec = spec
        """Where and how large it is shown."""
        self.state: HudState = HudState()

    @property
    def pixels(self) -> npt.NDArray[np.uint8] | None:
        """The image, row 0 at the top, (h, w, 3), or (h, w) if grey; None before the first."""
        message = self.state.message
        return None if message is None else pixels_of(message)

    def receive(self, message: Image) -> None:
        """Keep an image of the size and kind that the interface expects."""
        self.state.problem = self._wrong(message)
        if self.state.problem is None:
            self.state.message = message

    def _wrong(self, message: Image) -> str | None:
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
    """A cloud of points, placed where its frame was when it arrived."""

    points: npt.NDArray[np.float32]
    """In L, (n, 3) [m]."""
    colours: npt.NDArray[np.uint8]
    """Red, green, blue of each, (n, 3)."""


@dataclass(slots=True)
class CloudsState(Record):
    """The clouds that have come on a topic."""

    clouds: list[ShownCloud] = field(default_factory=list)
    """What is shown, oldest first."""
    problem: str | None = None
    """Why the newest message cannot be shown; None: it can."""


@dataclass(frozen=True, kw_only=True)
class ROSPointCloudLoaderSpec(InterfaceSpec):
    """Shows sensor_msgs/PointCloud2 in the scene."""

    subscribes: ClassVar[bool] = True
    messages: ClassVar[Mapping[str, type]] = {"topic": PointCloud2}

    topic: str
    """Name of the topic."""
    del_last_pcd: bool = element("delLastPCD", attribute=True, default=True)
    """Whether a cloud replaces the one before."""

    def bind(self, world: TopicWorld) -> PointClouds:
        """Listen from now on."""
        clouds = PointClouds(world, replaces=self.del_last_pcd)
        world.bus.subscribe(self.topic, PointCloud2, clouds.receive)
        return clouds


class PointClouds(Interface):
    """The clouds that came on a topic, with four fields in their own colours, else by height."""

    def __init__(self, world: TopicWorld, *, replaces: bool) -> None:
        self._world, self._replaces = world, replaces
        self.state: CloudsState = CloudsState()

    def receive(self, message: PointCloud2) -> None:
        """Place a cloud where its frame is now; it stays there."""
        try:
            cloud = self._placed(message)
        except (BadSetting, UnknownName) as error:
            self.state.problem = str(error)
            return
        self.state.problem = None
        clouds = [cloud] if self._replaces else [*self.state.clouds, cloud]
        while sum(len(each.points) for each in clouds) > MAX_POINTS and len(clouds) > 1:
            clouds = clouds[1:]
        self.state.clouds = clouds

    def _placed(self, message: PointCloud2) -> ShownCloud:
        own = points(message)
        frame = self._world.body(message.header.frame_id.strip().strip("/"))
        is_finite = np.isfinite(own).all(axis=1)
        own = own[is_finite]
        is_coloured = len(message.fields) == 4
        colours = point_colours(message)[is_finite] if is_coloured else jet(own[:, 2])
        localized_from_world = self._world.world_from_localized.inverse()
        localized_from_frame = localized_from_world @ frame.world_from_body
        return ShownCloud(localized_from_frame.transform(own).astype(np.float32), colours)


def jet(heights: npt.NDArray[np.float64]) -> npt.NDArray[np.uint8]:
    r"""Colour heights from blue (lowest) over green to red, (n, 3).

    With :math:`s = 2 (z - z_{min}) / (z_{max} - z_{min}) - 1` red, green and blue are
    :math:`b(s - 0.5)`, :math:`b(s)` and :math:`b(s + 0.5)`; b is a trapezium, 1 from -0.25 to 0.25
    and 0 beyond 0.75.
    """
    if len(heights) == 0:
        return np.empty((0, 3), dtype=np.uint8)
    lowest, highest = float(heights.min()), float(heights.max())
    span = highest - lowest
    s = 2.0 * (heights - lowest) / span - 1.0 if span > 0.0 else np.zeros(len(heights))
    shifted = np.stack([s - 0.5, s, s + 0.5], axis=1)
    shares = np.clip(1.5 - 2.0 * np.abs(shifted), 0.0, 1.0)
    return np.rint(255.0 * shares).astype(np.uint8)
