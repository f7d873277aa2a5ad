r"""Ground truth: what an estimate is compared with, evaluated in the live scene.

.. code-block:: xml

    <groundTruth type="constant"> <value>257.5</value> <value>162.5</value> </groundTruth>
    <groundTruth type="cornersFromCamera">
      <camera>bowtech1</camera> <target>blackbox</target> <publishOn>autoInit</publishOn>
    </groundTruth>
    <groundTruth type="centroidFromCamera">
      <camera>bowtech1</camera> <target>blackbox</target>
    </groundTruth>
    <groundTruth type="relativeLocation">
      <from>localizedWorld</from> <to>girona500</to>
    </groundTruth>
    <groundTruth type="topic">
      <topic>truth/corners</topic> <components>nw_x nw_y ne_x ne_y</components> <unit>px</unit>
      <publishOn>autoInit</publishOn>
    </groundTruth>

A truth that comes on a topic (std_msgs/Float32MultiArray) is hidden from the algorithm under test:
it can neither read nor publish there. `uwsim.benchmark.updaters.bag_fog_updater` publishes that of
recorded images, from a CSV file.

Image coordinates are in pixels from the centre of the first pixel, top left, v down, as in ROS and
OpenCV (`uwsim.base.geometry.Intrinsics`); constants are compared as they are.
"""

from __future__ import annotations

import abc
import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..base.geometry import Array
from ..base.inbox import Inbox
from ..base.numerics.linear import product, rotate_back, transform_points
from ..messages import Float32MultiArray
from ..schema import Spec, element
from ..world import Body, Box, Camera, World
from .metrics.min_area_rectangle import like_rectangle, rectangle

BEHIND = "the target is behind the camera"
CORNERS = ("nw_x", "nw_y", "ne_x", "ne_y", "se_x", "se_y", "sw_x", "sw_y")


class GroundTruthSpec(Spec, abc.ABC):
    """A ``<groundTruth>`` element."""

    unit: ClassVar[str]
    """Unit of its numbers."""
    camera: str | None = None
    """Name of the virtual camera; None when there is none."""
    publish_on: str | None = None
    """Service called with the truth when the measure starts; None: no call."""

    @abc.abstractmethod
    def bind(self, world: World, truth: str = "original") -> GroundTruth:
        """Find what it looks at; raises UnknownName if that is not there."""


class GroundTruth(abc.ABC):
    """A vector of numbers that is true now."""

    components: tuple[str, ...]
    """The names of its numbers."""

    @property
    def missing(self) -> str:
        """Why there may be none now."""
        return ""

    @property
    def n_images(self) -> int | None:
        """Images that its camera took so far; None where no camera takes images of it."""
        return None

    def close(self) -> None:  # noqa: B027 - most truths hold nothing
        """Release its resources (a subscription)."""

    @abc.abstractmethod
    def read(self) -> Array | None:
        """Return the truth now (k,); None where there is none (the target is behind the camera)."""


@dataclass(frozen=True, kw_only=True)
class ConstantSpec(GroundTruthSpec):
    """A ``<groundTruth type="constant">`` element."""

    unit: ClassVar[str] = "1"

    values: tuple[float, ...] = element("value")
    """The numbers."""

    def bind(self, world: World, truth: str = "original") -> Constant:
        """Needs nothing of the world."""
        return Constant(self.values)


class Constant(GroundTruth):
    """Numbers given by the file, named 1, 2, ..."""

    def __init__(self, values: tuple[float, ...]) -> None:
        self._values = np.array(values, dtype=np.float64)
        self.components = tuple(str(i + 1) for i in range(len(values)))

    def read(self) -> Array:
        """Return the numbers."""
        return self._values


@dataclass(frozen=True, kw_only=True)
class CornersFromCameraSpec(GroundTruthSpec):
    """A ``<groundTruth type="cornersFromCamera">`` element."""

    unit: ClassVar[str] = "px"

    camera: str = element(refers_to="camera")
    """Name of the virtual camera."""
    target: str = element(refers_to="body")
    """Route of the body with the corners."""
    publish_on: str | None = element(default=None)
    """Service called with the corners when the measure starts; None: no call."""

    def bind(self, world: World, truth: str = "original") -> GroundTruth:
        """Find camera and target; raises UnknownName if one is not there."""
        camera, body = world.camera(self.camera), world.body(self.target)
        unseen = "unseen" in world.compatibility
        if truth == "face":
            return FaceCorners(camera, body, unseen=unseen)
        return CornersFromCamera(camera, body, unseen=unseen)


@dataclass(frozen=True, kw_only=True)
class CentroidFromCameraSpec(GroundTruthSpec):
    """A ``<groundTruth type="centroidFromCamera">`` element."""

    unit: ClassVar[str] = "px"

    camera: str = element(refers_to="camera")
    """Name of the virtual camera."""
    target: str = element(refers_to="body")
    """Route of the body whose origin is used."""
    publish_on: str | None = element(default=None)
    """Service called with the centroid when the measure starts; None: no call."""

    def bind(self, world: World, truth: str = "original") -> GroundTruth:
        """Find camera and target; raises UnknownName if one is not there."""
        camera, body = world.camera(self.camera), world.body(self.target)
        unseen = "unseen" in world.compatibility
        if truth == "face":
            return FaceCentre(camera, body, unseen=unseen)
        return CentroidFromCamera(camera, body, unseen=unseen)


@dataclass(frozen=True, kw_only=True)
class RelativeLocationSpec(GroundTruthSpec):
    """A ``<groundTruth type="relativeLocation">`` element."""

    unit: ClassVar[str] = "m"

    from_: str = element("from", refers_to="body")
    """Route of the body in whose frame the location is given (``<from>``)."""
    to: str = element(refers_to="body")
    """Route of the body whose origin is used."""

    def bind(self, world: World, truth: str = "original") -> RelativeLocation:
        """Find both bodies; raises UnknownName if one is not there."""
        return RelativeLocation(world.body(self.from_), world.body(self.to))


class RelativeLocation(GroundTruth):
    """The origin of one body in the frame of another, x y z [m]."""

    components = ("x", "y", "z")

    def __init__(self, from_: Body, to: Body) -> None:
        self._from, self._to = from_, to

    def read(self) -> Array:
        """Return the location now, (3,) [m]."""
        frame = self._from.world_from_body
        return rotate_back(frame.rotation, self._to.world_from_body.position - frame.position)


class _Seen(GroundTruth):
    """Points of a body as a camera sees them; computed again only when one of the two moved.

    Compatibility ``unseen``: what is behind the camera is seen through its centre, upside down.
    """

    @property
    def missing(self) -> str:
        """That the target is behind the camera."""
        return BEHIND

    def __init__(self, camera: Camera, body: Body, points: Array, *, unseen: bool) -> None:
        self._camera, self._body, self._unseen = camera, body, unseen
        self._points = points  # (n, 3) [m], body frame
        self._seen_from: tuple[bytes, ...] = ()
        self._seen: Array | None = None

    @property
    def n_images(self) -> int | None:
        """Images that its camera took so far; None where it takes none."""
        return self._camera.n_images

    def read(self) -> Array | None:
        """Return the truth now [px]; None when a point is not in front of the camera."""
        camera, body = self._camera.world_from_camera, self._body.world_from_body
        key = (
            camera.position.tobytes(),
            camera.rotation.tobytes(),
            body.position.tobytes(),
            body.rotation.tobytes(),
        )
        if key != self._seen_from:
            points = transform_points(self._points, body.rotation, body.position - camera.position)
            seen = product(points, camera.rotation)  # (n, 3) [m], camera frame
            pixels = self._camera.intrinsics.project(
                seen, includes_behind=self._unseen
            )  # (n, 2) [px]
            is_seen = all(map(math.isfinite, pixels.ravel().tolist()))
            self._seen = self._from_pixels(pixels) if is_seen else None
            self._seen_from = key
        return self._seen

    @abc.abstractmethod
    def _from_pixels(self, pixels: Array) -> Array:
        """Make the truth of the projected points (n, 2) [px]."""


class CornersFromCamera(_Seen):
    r"""The original's corners: those of the smallest rectangle round the projected bounding box.

    The eight corners of the body's local bounding box are projected; of their convex hull the
    rectangle of smallest area is taken (`uwsim.benchmark.metrics.min_area_rectangle`); x, y of NW,
    NE, SE, SW. It is *not* where the corners of a face are: the box has depth, and perspective
    makes its near face larger; ``u:truth="face"`` gives those.
    """

    components = CORNERS

    def __init__(self, camera: Camera, body: Body, *, unseen: bool = False) -> None:
        super().__init__(camera, body, box_of(body).corners(), unseen=unseen)

    def _from_pixels(self, pixels: Array) -> Array:
        return rectangle(pixels).reshape(8)


class CentroidFromCamera(GroundTruth):
    """The original's centroid: the projected *origin* of the body, not the centre of its box.

    Compatibility ``unseen``: as in `_Seen`.
    """

    components = ("x", "y")

    @property
    def missing(self) -> str:
        """That the target is behind the camera."""
        return BEHIND

    def __init__(self, camera: Camera, body: Body, *, unseen: bool = False) -> None:
        self._camera, self._body, self._unseen = camera, body, unseen

    @property
    def n_images(self) -> int | None:
        """Images that its camera took so far; None where it takes none."""
        return self._camera.n_images

    def read(self) -> Array | None:
        """Return the centroid now, (2,) [px]; None when it is not in front of the camera."""
        pixel = self.pixel()
        return None if pixel is None else np.array(pixel)

    def pixel(self) -> tuple[float, float] | None:
        """As `read`, in plain numbers, because it is called at every step."""
        camera = self._camera.world_from_camera
        way = self._body.world_from_body.position - camera.position  # (3,) [m]
        x, y, z = rotate_back(camera.rotation, way).tolist()
        u, v = self._camera.intrinsics.pixel(x, y, z, includes_behind=self._unseen)
        return (u, v) if math.isfinite(u) and math.isfinite(v) else None


class FaceCorners(_Seen):
    """The projected corners of the body's top face.

    The top face is that of the local bounding box whose outward normal points most upwards in W
    at the moment of binding (first of +z, -z, +y, -y, +x, -x where they tie); it stays the same
    face however the body turns. Its corners are called NW, NE, SE, SW so that they lie nearest
    to those of `CornersFromCamera` the first time they are seen; each keeps its name after that.
    """

    components = CORNERS

    def __init__(self, camera: Camera, body: Body, *, unseen: bool = False) -> None:
        super().__init__(camera, body, top_face(body), unseen=unseen)
        self._box = CornersFromCamera(camera, body, unseen=unseen)
        self._order: list[int] | None = None

    def _from_pixels(self, pixels: Array) -> Array:
        if self._order is None:
            around = self._box.read()
            if around is None:
                return like_rectangle(pixels, rectangle(pixels))[1].reshape(8)
            self._order, _ = like_rectangle(pixels, around.reshape(4, 2))
        ordered: Array = pixels[self._order].reshape(8)
        return ordered


class FaceCentre(_Seen):
    """The projected centre of the body's top face (see `FaceCorners`)."""

    components = ("x", "y")

    def __init__(self, camera: Camera, body: Body, *, unseen: bool = False) -> None:
        super().__init__(camera, body, top_face(body).mean(axis=0, keepdims=True), unseen=unseen)

    def _from_pixels(self, pixels: Array) -> Array:
        pixel: Array = pixels[0]
        return pixel


def box_of(body: Body) -> Box:
    """Return the local bounding box of a body; a point at its origin if it has no meshes."""
    return body.box or Box((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def top_face(body: Body) -> Array:
    """Return the corners of the face that points upwards, once around, body frame (4, 3) [m]."""
    up = body.world_from_body.rotation[2]  # z of W in the body frame, (3,)
    axis = max((2, 1, 0), key=lambda i: (round(abs(float(up[i])), 9), i))
    box = box_of(body)
    low, high = np.array(box.lower), np.array(box.upper)
    first, second = (axis + 1) % 3, (axis + 2) % 3
    corners = np.empty((4, 3))  # [m]
    corners[:, axis] = high[axis] if up[axis] >= 0.0 else low[axis]
    corners[:, first] = [low[first], high[first], high[first], low[first]]
    corners[:, second] = [low[second], low[second], high[second], high[second]]
    return corners


@dataclass(frozen=True, kw_only=True)
class TopicTruthSpec(GroundTruthSpec):
    """A ``<groundTruth type="topic">`` element; an extension."""

    topic: str
    """Topic of the truth (std_msgs/Float32MultiArray); an empty message means that there is
    none."""
    components: str
    """Names of its numbers, separated by blanks: ``x y``."""
    unit: str = element(default="1")  # type: ignore[misc]  # of others it follows from the type
    """Unit of its numbers."""
    publish_on: str | None = element(default=None)
    """Service called with the truth when the measure starts; None: no call."""

    def bind(self, world: World, truth: str = "original") -> TopicTruth:
        """Listen to the topic, and hide it from the algorithm."""
        world.bus.withhold(self.topic)
        inbox = world.bus.inbox(self.topic, Float32MultiArray, latched=True)
        return TopicTruth(self.topic, tuple(self.components.split()), inbox)


class TopicTruth(GroundTruth):
    """The newest message of a topic; a sample is taken whenever one arrives."""

    def __init__(
        self, topic: str, components: tuple[str, ...], inbox: Inbox[Float32MultiArray]
    ) -> None:
        self._topic, self._inbox, self._n = topic, inbox, 0
        self.components = components

    @property
    def missing(self) -> str:
        """What came instead, if anything."""
        last, n = self._inbox.last_message, len(self.components)
        if last is None:
            return f"nothing was published on {self._topic!r}"
        if not last.data.size:
            return f"{self._topic!r} has none for this image"
        if last.data.size != n:
            return f"the truth on {self._topic!r} has {last.data.size} numbers, expected {n}"
        return f"the truth on {self._topic!r} is not finite"

    @property
    def n_images(self) -> int:
        """Messages that arrived so far: each belongs to an image."""
        self._n += len(self._inbox.take())
        return self._n

    def read(self) -> Array | None:
        """Return the newest truth, (k,); None before the first, and where there is none."""
        last = self._inbox.last_message
        numbers = np.zeros(0) if last is None else np.asarray(last.data, dtype=np.float64)
        is_whole = numbers.shape == (len(self.components),) and bool(np.isfinite(numbers).all())
        return numbers if is_whole else None

    def close(self) -> None:
        """Stop listening."""
        self._inbox.close()


GROUND_TRUTHS: dict[str, type[GroundTruthSpec]] = {
    "centroidFromCamera": CentroidFromCameraSpec,
    "constant": ConstantSpec,
    "cornersFromCamera": CornersFromCameraSpec,
    "relativeLocation": RelativeLocationSpec,
    "topic": TopicTruthSpec,
}
"""Type -> spec. In alphabetical order."""
