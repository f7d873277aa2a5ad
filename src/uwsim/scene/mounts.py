"""Poses and viewing directions of sensors and devices on their links.

A mount is fixed: ``<u:lookAt>`` is worked out once, for the vehicle where the file puts it and its
joints as in the file, and then moves with its link as ``<orientation>`` would.
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
from ..sensors.sensor import LookAt, Mounted
from ..sensors.sonar.spec import SonarSpec
from .urdf.kinematics import link_poses
from .urdf.robot import RobotSpec
from .vehicle import VehicleSpec

ALONG_X = (RangeSensorSpec, ObjectPickerSpec, SonarSpec)
"""These look along +x, a DVL along +z, the others along -z."""
STRAIGHT = 1e-3
"""Sine of the angle to the vertical below which a camera looks straight up or down."""


@dataclass(frozen=True, eq=False)
class MountFrames:
    """A vehicle at its pose in the file, from which mounts are computed.

    Args:
        vehicle: its spec.
        robot: its links and joints.
        world_from_localized: the scene's offset.
    """

    vehicle: VehicleSpec
    robot: RobotSpec
    world_from_localized: Pose
    _of_parts: dict[tuple[int, bool], Pose] = field(default_factory=dict, init=False)

    @cached_property
    def world_from_base(self) -> Pose:
        """Where its base is, without its scale."""
        return self.world_from_localized @ self.vehicle.localized_from_base

    @cached_property
    def directions(self) -> dict[str, Array]:
        """Unit vectors in W of what the words mean: each is one of the base's axes.

        Forward is +x. Down is +z or -z, whichever of them points down as the vehicle stands, so
        that the words hold for bases with z down and with z up.
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
        """Where a link is, without any scale; its visual frame if asked for."""
        base_from_link = self._base_from_links[link]
        return self.world_from_base @ base_from_link @ link_from_frame(self.robot, link, visual)

    @cached_property
    def _base_from_links(self) -> dict[str, Pose]:
        return link_poses(self.robot, self.vehicle.joint_values)

    @cached_property
    def _parts(self) -> frozenset[int]:
        """The identities of what the vehicle carries: the same as long as there is this object."""
        return frozenset(map(id, self.vehicle.parts))

    def link_from_mounted(self, spec: Mounted, *, visual: bool = False) -> Pose:
        """Its pose in its link's frame; of a part of the vehicle it is computed once.

        Args:
            spec: of what is mounted.
            visual: whether the file gives its place in the visual frame of the link.

        Raises:
            KeyError: there is no such link.
        """
        if (key := (id(spec), visual)) in self._of_parts:
            return self._of_parts[key]
        link_from_part = link_from_frame(
            self.robot, spec.relative_to, visual
        ) @ self.frame_from_mounted(spec, visual=visual)
        if id(spec) in self._parts:
            self._of_parts[key] = link_from_part
        return link_from_part

    def frame_from_mounted(self, spec: Mounted, *, visual: bool = False) -> Pose:
        """Its pose in its link's frame, or in the link's visual frame.

        Raises:
            KeyError: there is no such link.
        """
        look_at: LookAt = getattr(spec, "look_at", None)
        if look_at is None:
            return Pose.from_rpy(spec.position, spec.orientation)
        world_from_frame = self.world_from_link(spec.relative_to, visual=visual)
        eye = world_from_frame.transform(np.array([spec.position]))[0]  # W, without scale
        ahead, top = self._view(self._scaled(eye), look_at)
        axes = camera_axes(ahead, top)
        if isinstance(spec, ALONG_X):
            axes = axes_along_x(ahead, top)
        elif isinstance(spec, DvlSensorSpec):
            axes = axes_along_z(ahead, top)
        return Pose(np.array(spec.position), product(world_from_frame.rotation.T, axes))

    def _scaled(self, point: Array) -> Array:
        """A point of the vehicle without its scale, where its scale puts it, in W, (3,) [m]."""
        base, scale = self.world_from_base, np.array(self.vehicle.scale_factor)
        own = rotate_back(base.rotation, point - base.position)
        placed: Array = base.position + rotate(base.rotation, scale * own)
        return placed

    def world_axes(self, spec: Mounted, *, visual: bool = False) -> Array:
        """Axes of its frame in W, as columns, (3, 3)."""
        frame = self.world_from_link(spec.relative_to, visual=visual).rotation
        return product(frame, self.frame_from_mounted(spec, visual=visual).rotation)

    def world_from_mounted(self, spec: Mounted) -> Pose:
        """Where it is, with the scale of its vehicle."""
        link = self.world_from_link(spec.relative_to)
        place = link.transform(np.array([spec.position]))[0]
        return Pose(self._scaled(place), self.world_axes(spec))

    def looks(self, spec: Mounted, *, visual: bool = False) -> tuple[Array, Array]:
        """Unit vectors in W: where it looks, and the top of its image, (3,) each.

        Of a DVL the second is its x axis.
        """
        axes = self.world_axes(spec, visual=visual)
        if isinstance(spec, DvlSensorSpec):
            return axes[:, 2], axes[:, 0]
        return (axes[:, 0], axes[:, 2]) if isinstance(spec, ALONG_X) else (-axes[:, 2], axes[:, 1])

    def _view(self, eye: Array, look_at: LookAt) -> tuple[Array, Array]:
        """Where to look and what is up there, in W, (3,) each."""
        words = self.directions
        if isinstance(look_at, str):
            ahead = words[look_at]
            return ahead, _top(look_at, words)
        point = self.world_from_localized.transform(np.array([look_at]))[0]
        apart = point - eye
        distance = length(apart)
        if distance == 0.0:
            return words["forward"], words["up"]
        ahead = apart / distance
        if math.hypot(*ahead[:2].tolist()) < STRAIGHT:
            return ahead, _top("up" if ahead[2] > 0.0 else "down", words)
        return ahead, np.array([0.0, 0.0, 1.0])


def link_from_frame(robot: RobotSpec, link: str, visual: bool) -> Pose:
    """The frame of a mount on a link: the link's own, or its visual one."""
    found = robot.link(link)
    if not visual or found is None or found.visual is None:
        return Pose.identity()
    return Pose.from_rpy(found.visual.position, found.visual.rpy)


def camera_axes(ahead: Array, top: Array) -> Array:
    """Axes of a camera, as columns, (3, 3): it looks along -z, up in its image is ``top``."""
    right = np.cross(ahead, top)
    if length(right) < STRAIGHT:  # the top is where it looks: any other will do
        right = np.cross(ahead, np.eye(3)[int(np.argmin(np.abs(ahead)))])
    right /= length(right)
    return np.column_stack([right, np.cross(right, ahead), -ahead])


def axes_along_x(ahead: Array, top: Array) -> Array:
    """Axes of what looks along +x, as columns, (3, 3); ``top`` is on the side of +z."""
    right, up, _ = camera_axes(ahead, top).T
    return np.column_stack([ahead, -right, up])


def axes_along_z(ahead: Array, top: Array) -> Array:
    """Axes of what looks along +z, as columns, (3, 3); ``top`` is on the side of +x."""
    right, up, _ = camera_axes(ahead, top).T
    return np.column_stack([up, right, ahead])


def _top(word: str, words: dict[str, Array]) -> Array:
    """The top of the image of a camera that is nodded from forward to where it looks."""
    return words[{"down": "forward", "up": "aft"}.get(word, "up")]


def in_words(ahead: Array, directions: dict[str, Array]) -> str:
    """Where a unit vector points: ``down``, ``down, 2 deg off`` or ``between down and port``."""
    angles = {
        word: math.degrees(math.acos(min(max(dot(ahead, axis), -1.0), 1.0)))
        for word, axis in directions.items()
    }
    first, second = sorted(angles, key=lambda word: angles[word])[:2]
    off = round(angles[first])
    if off == 0:
        return first
    return f"{first}, {off} deg off" if off <= 30 else f"between {first} and {second}"
