"""Poses and viewing directions of sensors and devices (mounted parts) on their links.

A mounted part is fixed to its link. The direction to a ``<u:lookAt>`` is computed once, for the
pose and joint values of the vehicle in the scene file; afterwards the part moves with the link.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ..base.geometry import Array, Pose
from ..base.numerics.linear import dot, length, product, rotate, rotate_back
from ..devices.object_picker import ObjectPickerSpec
from ..sensors.dvl_sensor import DvlSensorSpec
from ..sensors.range_sensor import RangeSensorSpec
from ..sensors.sensor import LookAt, MountedPart
from ..sensors.sonar.spec import SonarSpec
from .urdf.kinematics import link_poses
from .urdf.robot import RobotSpec
from .vehicle import VehicleSpec

X_FORWARD_SPECS = (RangeSensorSpec, ObjectPickerSpec, SonarSpec)
"""The specs of parts that point along +x; a DVL points along +z, all others along -z."""
MIN_TILT_SINE = 1e-3
"""The sine of the angle to the vertical below which a camera looks straight up or down."""


@dataclass(frozen=True, eq=False)
class MountFrames:
    """The frames of a vehicle at its pose in the scene file, for computing poses of mounted parts.

    Args:
        vehicle: the spec of the vehicle.
        robot: the links and joints of the vehicle.
        world_from_localized: the pose of L, the frame of the scene file, in W.
    """

    vehicle: VehicleSpec
    robot: RobotSpec
    world_from_localized: Pose
    _part_poses: dict[tuple[int, bool], Pose] = field(default_factory=dict, init=False)

    @cached_property
    def world_from_base(self) -> Pose:
        """The pose of the base in W, without scale."""
        return self.world_from_localized @ self.vehicle.localized_from_base

    @cached_property
    def directions(self) -> dict[str, Array]:
        """The unit vectors in W for direction words, such as ``down``: axes of the base, (3,) each.

        Forward is +x. Down is +z or -z, whichever points downwards at the pose of the vehicle, so
        that the words are correct for bases with z down and with z up.
        """
        axes = self.world_from_base.rotation
        forward = axes[:, 0]
        down = axes[:, 2] if axes[2, 2] < 0.0 else -axes[:, 2]
        starboard = np.cross(down, forward)
        return {
            "forward": forward,
            "aft": -forward,
            "starboard": starboard,
            "port": -starboard,
            "down": down,
            "up": -down,
        }

    def world_from_link(self, link: str, *, visual: bool = False) -> Pose:
        """Return the pose in W of a link, or of its visual frame, without scale."""
        base_from_link = self._base_from_links[link]
        return self.world_from_base @ base_from_link @ link_from_frame(self.robot, link, visual)

    @cached_property
    def _base_from_links(self) -> dict[str, Pose]:
        return link_poses(self.robot, self.vehicle.joint_values)

    @cached_property
    def _parts(self) -> frozenset[int]:
        """The ``id()`` of each part of the vehicle, which this object keeps alive."""
        return frozenset(map(id, self.vehicle.parts))

    def link_from_mounted(self, spec: MountedPart, *, visual: bool = False) -> Pose:
        """Return the pose of a mounted part in its link's frame, cached for parts of the vehicle.

        Args:
            spec: the spec of the part.
            visual: True if the spec gives the pose in the visual frame of the link.

        Raises:
            KeyError: there is no such link.
        """
        if (key := (id(spec), visual)) in self._part_poses:
            return self._part_poses[key]
        link_from_part = link_from_frame(
            self.robot, spec.relative_to, visual
        ) @ self.frame_from_mounted(spec, visual=visual)
        if id(spec) in self._parts:
            self._part_poses[key] = link_from_part
        return link_from_part

    def frame_from_mounted(self, spec: MountedPart, *, visual: bool = False) -> Pose:
        """Return the pose of a mounted part in its link's frame, or in the link's visual frame.

        Raises:
            KeyError: there is no such link.
        """
        look_at: LookAt = getattr(spec, "look_at", None)
        if look_at is None:
            return Pose.from_rpy(spec.position, spec.orientation)
        world_from_frame = self.world_from_link(spec.relative_to, visual=visual)
        eye = world_from_frame.transform(np.array([spec.position]))[0]  # in W, without scale [m]
        forward, top = self._view(self._apply_scale(eye), look_at)
        axes = camera_axes(forward, top)
        if isinstance(spec, X_FORWARD_SPECS):
            axes = axes_along_x(forward, top)
        elif isinstance(spec, DvlSensorSpec):
            axes = axes_along_z(forward, top)
        return Pose(np.array(spec.position), product(world_from_frame.rotation.T, axes))

    def _apply_scale(self, point: Array) -> Array:
        """Apply the vehicle's scale to a point on the vehicle; both points are in W, (3,) [m]."""
        base, scale = self.world_from_base, np.array(self.vehicle.scale_factor)
        base_point = rotate_back(base.rotation, point - base.position)
        scaled_point: Array = base.position + rotate(base.rotation, scale * base_point)
        return scaled_point

    def world_axes(self, spec: MountedPart, *, visual: bool = False) -> Array:
        """Return the axes of a mounted part in W, as columns, (3, 3)."""
        frame = self.world_from_link(spec.relative_to, visual=visual).rotation
        return product(frame, self.frame_from_mounted(spec, visual=visual).rotation)

    def world_from_mounted(self, spec: MountedPart) -> Pose:
        """Return the pose of a mounted part in W, at its position with the vehicle's scale."""
        world_from_link = self.world_from_link(spec.relative_to)
        position = world_from_link.transform(np.array([spec.position]))[0]
        return Pose(self._apply_scale(position), self.world_axes(spec))

    def viewing_axes(self, spec: MountedPart, *, visual: bool = False) -> tuple[Array, Array]:
        """Return unit vectors in W: the viewing direction, and the image's upward direction, (3,).

        For a DVL the second vector is its x axis.
        """
        axes = self.world_axes(spec, visual=visual)
        if isinstance(spec, DvlSensorSpec):
            return axes[:, 2], axes[:, 0]
        if isinstance(spec, X_FORWARD_SPECS):
            return axes[:, 0], axes[:, 2]
        return -axes[:, 2], axes[:, 1]

    def _view(self, eye: Array, look_at: LookAt) -> tuple[Array, Array]:
        """Return the viewing direction and the image's upward direction, in W, (3,) each."""
        words = self.directions
        if isinstance(look_at, str):
            forward = words[look_at]
            return forward, _top(look_at, words)
        point = self.world_from_localized.transform(np.array([look_at]))[0]
        offset = point - eye
        distance = length(offset)
        if distance == 0.0:
            return words["forward"], words["up"]
        forward = offset / distance
        if math.hypot(*forward[:2].tolist()) < MIN_TILT_SINE:
            return forward, _top("up" if forward[2] > 0.0 else "down", words)
        return forward, np.array([0.0, 0.0, 1.0])


def link_from_frame(robot: RobotSpec, link: str, visual: bool) -> Pose:
    """Return the pose, in the link's kinematic frame, of that frame or of the visual frame."""
    link_spec = robot.link(link)
    if not visual or link_spec is None or link_spec.visual is None:
        return Pose.identity()
    return Pose.from_rpy(link_spec.visual.position, link_spec.visual.rpy)


def camera_axes(forward: Array, top: Array) -> Array:
    """Return the axes of a camera, as columns, (3, 3): z is opposite to ``forward``, y is upwards.

    Args:
        forward: the viewing direction, a unit vector (3,).
        top: a vector (3,) towards the top of the image.
    """
    right = np.cross(forward, top)
    if (
        length(right) < MIN_TILT_SINE
    ):  # `top` is parallel to the viewing direction: choose another direction
        right = np.cross(forward, np.eye(3)[int(np.argmin(np.abs(forward)))])
    right /= length(right)
    return np.column_stack([right, np.cross(right, forward), -forward])


def axes_along_x(forward: Array, top: Array) -> Array:
    """Return the axes of a part that points along +x, as columns, (3, 3), with +z near ``top``."""
    right, up, _ = camera_axes(forward, top).T
    return np.column_stack([forward, -right, up])


def axes_along_z(forward: Array, top: Array) -> Array:
    """Return the axes of a part that points along +z, as columns, (3, 3), with +x near ``top``."""
    right, up, _ = camera_axes(forward, top).T
    return np.column_stack([up, right, forward])


def _top(word: str, words: dict[str, Array]) -> Array:
    """Return the image's upward direction of a camera that is pitched from forward."""
    return words[{"down": "forward", "up": "aft"}.get(word, "up")]


def describe_axis(vector: Array, directions: dict[str, Array]) -> str:
    """Describe a unit vector in words: ``down``, ``down, 2 deg off``, ``between down and port``."""
    angles = {
        word: math.degrees(math.acos(min(max(dot(vector, axis), -1.0), 1.0)))
        for word, axis in directions.items()
    }
    word_1, word_2 = sorted(angles, key=lambda word: angles[word])[:2]
    angle = round(angles[word_1])
    if angle == 0:
        return word_1
    return f"{word_1}, {angle} deg off" if angle <= 30 else f"between {word_1} and {word_2}"
