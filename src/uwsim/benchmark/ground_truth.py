r"""Ground truths: the true values with which an algorithm's estimates are compared.

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

A ground truth is computed from the present state of the simulated scene, except for those of type
``constant`` and ``topic``. The topic of a truth (std_msgs/Float32MultiArray) is hidden from the
algorithm under test, which can neither read it nor publish on it. For recorded images,
`uwsim.benchmark.updaters.bag_fog_updater` publishes the truth from a CSV file.

Image coordinates u, v are in pixels from the centre of the top left pixel, u to the right and v
down, as in ROS and OpenCV (`uwsim.base.geometry.Intrinsics`). W is the world frame, z up.
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
"""The components of four corners in an image: the u (x) and v (y) of each, clockwise from NW."""


class GroundTruthSpec(Spec, abc.ABC):
    """A ``<groundTruth>`` element."""

    unit: ClassVar[str]
    """The unit of the components."""
    camera: str | None = None
    """The name of the virtual camera in whose image the truth is; None: the truth is no pixel."""
    publish_on: str | None = None
    """The service called with the truth when the measure starts; None: no call."""

    @abc.abstractmethod
    def bind(self, world: World, truth: str = "original") -> GroundTruth:
        """Resolve the names of bodies and cameras; raises UnknownName if one is unknown.

        Args:
            world: the scene with the bodies and cameras.
            truth: the value of ``u:truth`` of the measure: ``original`` or ``face``.
        """


class GroundTruth(abc.ABC):
    """A true value: a vector of numbers that may change at every step."""

    components: tuple[str, ...]
    """The names of the numbers."""

    @property
    def absence_reason(self) -> str:
        """The reason that applies when `read` returns None."""
        return ""

    @property
    def n_images(self) -> int | None:
        """The number of images that the truth's camera has taken; None if it takes none."""
        return None

    def close(self) -> None:  # noqa: B027 - most truths have no subscription
        """End the subscription, if the truth is received on a topic."""

    @abc.abstractmethod
    def read(self) -> Array | None:
        """Return the present truth (k,); None if there is none (a target behind the camera)."""


@dataclass(frozen=True, kw_only=True)
class ConstantSpec(GroundTruthSpec):
    """A ``<groundTruth type="constant">`` element."""

    unit: ClassVar[str] = "1"

    values: tuple[float, ...] = element("value")
    """The true values, in the units and coordinates of the estimate."""

    def bind(self, world: World, truth: str = "original") -> Constant:
        """Return the constant truth, which does not depend on the world."""
        return Constant(self.values)


class Constant(GroundTruth):
    """A truth that never changes; its components are named 1, 2, ..."""

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
    """The route of the body whose corners are projected into the image."""
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
    """The route of the body whose origin is projected into the image."""
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
    """The route of the body in whose frame the location is expressed (``<from>``)."""
    to: str = element(refers_to="body")
    """The route of the body whose origin is the location."""

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
    """The projection of points of a body into an image.

    It is computed again only after the camera or the body has moved. Compatibility ``unseen``:
    points behind the camera are projected through its optical centre.
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
        """The number of images that the camera has taken; None if it takes none."""
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
        """Return the truth (k,) [px] for the projected points (n, 2) [px]."""


class CornersFromCamera(ProjectedTruth):
    r"""The corners of the smallest rectangle round a projected bounding box.

    As in the original UWSim, the eight corners of the body's local bounding box are projected into
    the image, and the truth is the rectangle of the smallest area round their convex hull
    (`uwsim.benchmark.metrics.min_area_rectangle`): x, y of NW, NE, SE, SW. These are *not* the
    corners of a face of the body: the box has depth, and in perspective the near face of the box is
    the larger one. ``u:truth="face"`` selects the corners of a face (`FaceCorners`).
    """

    components = CORNERS

    def __init__(self, camera: Camera, body: Body, *, includes_behind: bool = False) -> None:
        super().__init__(
            camera, body, bounding_box(body).corners(), includes_behind=includes_behind
        )

    def _from_pixels(self, pixels: Array) -> Array:
        return min_area_rectangle(pixels).reshape(8)


class CentroidFromCamera(GroundTruth):
    """The projection of a body's *origin*, not of the centre of its box, as in the original UWSim.

    Compatibility ``unseen``: a point behind the camera is projected, as in `ProjectedTruth`.
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
        """The number of images that the camera has taken; None if it takes none."""
        return self._camera.n_images

    def read(self) -> Array | None:
        """Return the present centroid, (2,) [px]; None if it is not in front of the camera."""
        pixel = self.pixel()
        return None if pixel is None else np.array(pixel)

    def pixel(self) -> tuple[float, float] | None:
        """Return the centroid u, v [px] as floats, which cost less than an array at every step."""
        camera = self._camera.world_from_camera
        world_offset = self._body.world_from_body.position - camera.position  # (3,) [m]
        x, y, z = rotate_back(camera.rotation, world_offset).tolist()
        u, v = self._camera.intrinsics.pixel(x, y, z, includes_behind=self._includes_behind)
        return (u, v) if math.isfinite(u) and math.isfinite(v) else None


class FaceCorners(ProjectedTruth):
    """The projected corners of the top face of a body's local bounding box.

    The top face is the one whose outward normal points most upwards in W when the truth is bound;
    of faces that point equally far upwards, the first of +z, -z, +y, -y, +x, -x. It stays the top
    face however the body turns. When it is first visible, its corners are named NW, NE, SE and SW
    so that they are nearest to the corners of `CornersFromCamera` with these names; each corner
    keeps its name after that.
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
    """Return the local bounding box of a body; for a body without meshes, a point at its origin."""
    return body.box or Box((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def top_face(body: Body) -> Array:
    """Return the corners of the top face of a body in cyclic order, (4, 3) [m] in its frame."""
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
    """A ``<groundTruth type="topic">`` element, which the original UWSim does not have."""

    topic: str
    """The topic of the truth (std_msgs/Float32MultiArray); an empty message states that there is
    no truth."""
    components: str
    """The names of the numbers in a message, separated by blanks: ``x y``."""
    unit: str = element(default="1")  # type: ignore[misc]  # a class variable of the other types
    """The unit of the numbers."""
    publish_on: str | None = element(default=None)
    """The service called with the truth when the measure starts; None: no call."""

    def bind(self, world: World, truth: str = "original") -> TopicTruth:
        """Subscribe to the topic, and hide it from the algorithm under test."""
        world.bus.hide_topic(self.topic)
        inbox = world.bus.inbox(self.topic, Float32MultiArray, latched=True)
        return TopicTruth(self.topic, tuple(self.components.split()), inbox)


class TopicTruth(GroundTruth):
    """The truth in the newest message of a topic; each message counts as an image."""

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
        """Return the truth in the newest message, (k,); None if it has none, or none arrived."""
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
"""The spec of each type of ground truth, in alphabetical order."""
