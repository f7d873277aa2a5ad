r"""Ground truth: the reference for an estimate, evaluated in the live scene.

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

A truth on a topic (std_msgs/Float32MultiArray) is hidden from the algorithm under test, which can
neither read nor publish it. `uwsim.benchmark.updaters.bag_fog_updater` publishes the truth of
recorded images, from a CSV file.

Image coordinates are in pixels from the centre of the first pixel, top left, v down, as in ROS and
OpenCV (`uwsim.base.geometry.Intrinsics`); constants have the coordinates of the estimate.
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
from .metrics.min_area_rectangle import match_corners, min_area_rectangle

TARGET_BEHIND_CAMERA = "the target is behind the camera"
CORNERS = ("nw_x", "nw_y", "ne_x", "ne_y", "se_x", "se_y", "sw_x", "sw_y")


class GroundTruthSpec(Spec, abc.ABC):
    """A ``<groundTruth>`` element."""

    unit: ClassVar[str]
    """The unit of the components."""
    camera: str | None = None
    """The name of the virtual camera; None when there is none."""
    publish_on: str | None = None
    """The service called with the truth when the measure starts; None: no call."""

    @abc.abstractmethod
    def bind(self, world: World, truth: str = "original") -> GroundTruth:
        """Resolve the names of the truth; raises UnknownName if one is unknown."""


class GroundTruth(abc.ABC):
    """A vector of numbers, the present truth."""

    components: tuple[str, ...]
    """The names of the numbers."""

    @property
    def absence_reason(self) -> str:
        """The reason why there may be no truth now."""
        return ""

    @property
    def n_images(self) -> int | None:
        """The number of images of its camera so far; None if no camera takes images of it."""
        return None

    def close(self) -> None:  # noqa: B027 - most truths hold nothing
        """Release its resources (a subscription)."""

    @abc.abstractmethod
    def read(self) -> Array | None:
        """Return the present truth (k,); None if there is none (a target behind the camera)."""


@dataclass(frozen=True, kw_only=True)
class ConstantSpec(GroundTruthSpec):
    """A ``<groundTruth type="constant">`` element."""

    unit: ClassVar[str] = "1"

    values: tuple[float, ...] = element("value")
    """The numbers."""

    def bind(self, world: World, truth: str = "original") -> Constant:
        """Return the truth, which needs nothing of the world."""
        return Constant(self.values)


class Constant(GroundTruth):
    """The numbers of the file, named 1, 2, ..."""

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
    """The name of the virtual camera."""
    target: str = element(refers_to="body")
    """The route of the body with the corners."""
    publish_on: str | None = element(default=None)
    """The service called with the corners when the measure starts; None: no call."""

    def bind(self, world: World, truth: str = "original") -> GroundTruth:
        """Resolve camera and target; raises UnknownName if one is unknown."""
        camera, body = world.camera(self.camera), world.body(self.target)
        includes_behind = "unseen" in world.compatibility
        if truth == "face":
            return FaceCorners(camera, body, includes_behind=includes_behind)
        return CornersFromCamera(camera, body, includes_behind=includes_behind)


@dataclass(frozen=True, kw_only=True)
class CentroidFromCameraSpec(GroundTruthSpec):
    """A ``<groundTruth type="centroidFromCamera">`` element."""

    unit: ClassVar[str] = "px"

    camera: str = element(refers_to="camera")
    """The name of the virtual camera."""
    target: str = element(refers_to="body")
    """The route of the body whose origin is used."""
    publish_on: str | None = element(default=None)
    """The service called with the centroid when the measure starts; None: no call."""

    def bind(self, world: World, truth: str = "original") -> GroundTruth:
        """Resolve camera and target; raises UnknownName if one is unknown."""
        camera, body = world.camera(self.camera), world.body(self.target)
        includes_behind = "unseen" in world.compatibility
        if truth == "face":
            return FaceCentre(camera, body, includes_behind=includes_behind)
        return CentroidFromCamera(camera, body, includes_behind=includes_behind)


@dataclass(frozen=True, kw_only=True)
class RelativeLocationSpec(GroundTruthSpec):
    """A ``<groundTruth type="relativeLocation">`` element."""

    unit: ClassVar[str] = "m"

    from_: str = element("from", refers_to="body")
    """The route of the body in whose frame the location is given (``<from>``)."""
    to: str = element(refers_to="body")
    """The route of the body whose origin is used."""

    def bind(self, world: World, truth: str = "original") -> RelativeLocation:
        """Resolve both bodies; raises UnknownName if one is unknown."""
        return RelativeLocation(world.body(self.from_), world.body(self.to))


class RelativeLocation(GroundTruth):
    """The origin of one body in the frame of another, x y z [m]."""

    components = ("x", "y", "z")

    def __init__(self, reference_body: Body, target: Body) -> None:
        self._reference_body, self._target = reference_body, target

    def read(self) -> Array:
        """Return the present location, (3,) [m]."""
        frame = self._reference_body.world_from_body
        return rotate_back(frame.rotation, self._target.world_from_body.position - frame.position)


class ProjectedTruth(GroundTruth):
    """The projected points of a body, computed again only after camera or body has moved.

    Compatibility ``unseen``: points behind the camera are projected through its centre.
    """

    @property
    def absence_reason(self) -> str:
        """The reason why there may be no truth: the target is behind the camera."""
        return TARGET_BEHIND_CAMERA

    def __init__(self, camera: Camera, body: Body, points: Array, *, includes_behind: bool) -> None:
        self._camera, self._body, self._includes_behind = camera, body, includes_behind
        self._points = points  # (n, 3) [m], body frame
        self._last_poses: tuple[bytes, ...] = ()
        self._last_truth: Array | None = None

    @property
    def n_images(self) -> int | None:
        """The number of images of its camera so far; None if it takes none."""
        return self._camera.n_images

    def read(self) -> Array | None:
        """Return the present truth [px]; None if a point is not in front of the camera."""
        camera, body = self._camera.world_from_camera, self._body.world_from_body
        poses = (
            camera.position.tobytes(),
            camera.rotation.tobytes(),
            body.position.tobytes(),
            body.rotation.tobytes(),
        )
        if poses != self._last_poses:
            points = transform_points(self._points, body.rotation, body.position - camera.position)
            camera_points = product(points, camera.rotation)  # (n, 3) [m], camera frame
            pixels = self._camera.intrinsics.project(
                camera_points, includes_behind=self._includes_behind
            )  # (n, 2) [px]
            is_visible = all(map(math.isfinite, pixels.ravel().tolist()))
            self._last_truth = self._from_pixels(pixels) if is_visible else None
            self._last_poses = poses
        return self._last_truth

    @abc.abstractmethod
    def _from_pixels(self, pixels: Array) -> Array:
        """Return the truth of the projected points (n, 2) [px]."""


class CornersFromCamera(ProjectedTruth):
    r"""The original's corners: those of the smallest rectangle round the projected bounding box.

    The eight corners of the body's local bounding box are projected; the truth is the rectangle of
    smallest area round their convex hull (`uwsim.benchmark.metrics.min_area_rectangle`): x, y of
    NW, NE, SE, SW. These are *not* the corners of a face: the box has depth, and perspective makes
    its near face larger; ``u:truth="face"`` gives the corners of a face.
    """

    components = CORNERS

    def __init__(self, camera: Camera, body: Body, *, includes_behind: bool = False) -> None:
        super().__init__(
            camera, body, bounding_box(body).corners(), includes_behind=includes_behind
        )

    def _from_pixels(self, pixels: Array) -> Array:
        return min_area_rectangle(pixels).reshape(8)


class CentroidFromCamera(GroundTruth):
    """The original's centroid: the projected *origin* of the body, not the centre of its box.

    Compatibility ``unseen``: as in `ProjectedTruth`.
    """

    components = ("x", "y")

    @property
    def absence_reason(self) -> str:
        """The reason why there may be no truth: the target is behind the camera."""
        return TARGET_BEHIND_CAMERA

    def __init__(self, camera: Camera, body: Body, *, includes_behind: bool = False) -> None:
        self._camera, self._body, self._includes_behind = camera, body, includes_behind

    @property
    def n_images(self) -> int | None:
        """The number of images of its camera so far; None if it takes none."""
        return self._camera.n_images

    def read(self) -> Array | None:
        """Return the present centroid, (2,) [px]; None if it is not in front of the camera."""
        pixel = self.pixel()
        return None if pixel is None else np.array(pixel)

    def pixel(self) -> tuple[float, float] | None:
        """Return the centroid as plain numbers, for calls at every step."""
        camera = self._camera.world_from_camera
        world_offset = self._body.world_from_body.position - camera.position  # (3,) [m]
        x, y, z = rotate_back(camera.rotation, world_offset).tolist()
        u, v = self._camera.intrinsics.pixel(x, y, z, includes_behind=self._includes_behind)
        return (u, v) if math.isfinite(u) and math.isfinite(v) else None


class FaceCorners(ProjectedTruth):
    """The projected corners of the body's top face.

    The top face is that of the local bounding box whose outward normal points most upwards in W
    at the moment of binding (first of +z, -z, +y, -y, +x, -x of equal ones); it stays the same
    face however the body turns. Its corners are named NW, NE, SE, SW so that they are nearest to
    those of `CornersFromCamera` when first visible; each keeps its name after that.
    """

    components = CORNERS

    def __init__(self, camera: Camera, body: Body, *, includes_behind: bool = False) -> None:
        super().__init__(camera, body, top_face(body), includes_behind=includes_behind)
        self._box = CornersFromCamera(camera, body, includes_behind=includes_behind)
        self._order: list[int] | None = None

    def _from_pixels(self, pixels: Array) -> Array:
        if self._order is None:
            rectangle_corners = self._box.read()
            if rectangle_corners is None:
                return match_corners(pixels, min_area_rectangle(pixels))[1].reshape(8)
            self._order, _ = match_corners(pixels, rectangle_corners.reshape(4, 2))
        corners: Array = pixels[self._order].reshape(8)
        return corners


class FaceCentre(ProjectedTruth):
    """The projected centre of the body's top face (see `FaceCorners`)."""

    components = ("x", "y")

    def __init__(self, camera: Camera, body: Body, *, includes_behind: bool = False) -> None:
        super().__init__(
            camera,
            body,
            top_face(body).mean(axis=0, keepdims=True),
            includes_behind=includes_behind,
        )

    def _from_pixels(self, pixels: Array) -> Array:
        pixel: Array = pixels[0]
        return pixel


def bounding_box(body: Body) -> Box:
    """Return the local bounding box of a body; a point at its origin if it has no meshes."""
    return body.box or Box((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def top_face(body: Body) -> Array:
    """Return the corners of the face that points upwards, in cyclic order, body axes (4, 3) [m]."""
    up = body.world_from_body.rotation[2]  # z of W in the body frame, (3,)
    axis = max((2, 1, 0), key=lambda i: (round(abs(float(up[i])), 9), i))
    box = bounding_box(body)
    low, high = np.array(box.lower), np.array(box.upper)
    axis_u, axis_v = (axis + 1) % 3, (axis + 2) % 3
    corners = np.empty((4, 3))  # [m]
    corners[:, axis] = high[axis] if up[axis] >= 0.0 else low[axis]
    corners[:, axis_u] = [low[axis_u], high[axis_u], high[axis_u], low[axis_u]]
    corners[:, axis_v] = [low[axis_v], low[axis_v], high[axis_v], high[axis_v]]
    return corners


@dataclass(frozen=True, kw_only=True)
class TopicTruthSpec(GroundTruthSpec):
    """A ``<groundTruth type="topic">`` element; an extension."""

    topic: str
    """The topic of the truth (std_msgs/Float32MultiArray); an empty message: none."""
    components: str
    """The names of its numbers, separated by blanks: ``x y``."""
    unit: str = element(default="1")  # type: ignore[misc]  # of others it follows from the type
    """The unit of its numbers."""
    publish_on: str | None = element(default=None)
    """The service called with the truth when the measure starts; None: no call."""

    def bind(self, world: World, truth: str = "original") -> TopicTruth:
        """Subscribe to the topic, and hide it from the algorithm."""
        world.bus.hide_topic(self.topic)
        inbox = world.bus.inbox(self.topic, Float32MultiArray, latched=True)
        return TopicTruth(self.topic, tuple(self.components.split()), inbox)


class TopicTruth(GroundTruth):
    """The newest message of a topic; each message is a sample."""

    def __init__(
        self, topic: str, components: tuple[str, ...], inbox: Inbox[Float32MultiArray]
    ) -> None:
        self._topic, self._inbox, self._n_messages = topic, inbox, 0
        self.components = components

    @property
    def absence_reason(self) -> str:
        """The reason why there is no truth: no message, or an invalid one."""
        message, n = self._inbox.last_message, len(self.components)
        if message is None:
            return f"nothing was published on {self._topic!r}"
        if not message.data.size:
            return f"{self._topic!r} has none for this image"
        if message.data.size != n:
            return f"the truth on {self._topic!r} has {message.data.size} numbers, expected {n}"
        return f"the truth on {self._topic!r} is not finite"

    @property
    def n_images(self) -> int:
        """The number of messages so far; each belongs to an image."""
        self._n_messages += len(self._inbox.take())
        return self._n_messages

    def read(self) -> Array | None:
        """Return the newest truth, (k,); None before the first, and if there is none."""
        message = self._inbox.last_message
        numbers = np.zeros(0) if message is None else np.asarray(message.data, dtype=np.float64)
        is_valid = numbers.shape == (len(self.components),) and bool(np.isfinite(numbers).all())
        return numbers if is_valid else None

    def close(self) -> None:
        """Unsubscribe."""
        self._inbox.close()


GROUND_TRUTHS: dict[str, type[GroundTruthSpec]] = {
    "centroidFromCamera": CentroidFromCameraSpec,
    "constant": ConstantSpec,
    "cornersFromCamera": CornersFromCameraSpec,
    "relativeLocation": RelativeLocationSpec,
    "topic": TopicTruthSpec,
}
"""The spec of each type, in alphabetical order."""
