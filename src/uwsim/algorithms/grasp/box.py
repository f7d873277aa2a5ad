"""The box that is grasped, a flight recorder: its shape, its handle and its pose.

The navigation frame has the axes north, east and down. The frame of the box has z up if the box
lies on a level seabed, so its pose vector has the order north, east, depth, heading, tilt about x,
tilt about y.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array, Pose, rotation_x, rotation_y, rotation_z
from ...base.numerics.linear import product, rotate


@dataclass(frozen=True, kw_only=True)
class BoxSpec:
    """The model of the grasped object: a box with a handle, a bar parallel to y, over its top.

    Top, bottom and long sides are painted; the short sides and the handle are bare metal. The frame
    of the box has its origin at the centre of the body, y along the long edges and z out of the top
    face.
    """

    size: tuple[float, float, float] = (0.15, 0.32, 0.14)
    """The lengths of the edges along x, y, z [m]."""
    handle_height: float = 0.128
    """The height of the handle's bar over the centre of the box [m]."""
    bar_radius: float = 0.008
    """The radius of the handle's bar [m]."""

    @property
    def corners(self) -> Array:
        """The corners of the body in the frame of the box, (8, 3) [m]."""
        half = np.array(self.size) / 2.0
        signs = [(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)]
        return np.array(signs) * half

    @property
    def top_face(self) -> Array:
        """The corners of the top face in cyclic order, in the frame of the box, (4, 3) [m]."""
        x, y, z = (edge / 2.0 for edge in self.size)
        return np.array([[-x, -y, z], [-x, y, z], [x, y, z], [x, -y, z]])

    def grasp_point(self, pose: BoxPose) -> Array:
        """Return the centre of the handle's bar in the navigation frame, (3,) [m]."""
        position: Array = pose.position + rotate(
            pose.rotation, np.array([0.0, 0.0, self.handle_height])
        )
        return position

    def closing_heading(self, pose: BoxPose) -> float:
        """Return the heading of the axis across the handle, along which the jaw closes [rad].

        It is between -pi/2 and pi/2, as the opposite heading is equivalent.
        """
        return wrap_half_turn(pose.heading)


@dataclass(frozen=True, eq=False, kw_only=True)
class BoxPose:
    """The pose of a box in the navigation frame (north, east, down)."""

    position: Array
    """The position of the centre of the body, (3,) [m]."""
    heading: float
    """The heading of the x axis, from north towards east [rad]; the opposite heading is equivalent,
    as front and back look the same."""
    tilt: tuple[float, float] = (0.0, 0.0)
    """The tilt about the x and y axes of the box [rad]."""

    @property
    def rotation(self) -> Array:
        """The rotation ``navigation_from_box``, (3, 3); without a tilt, z of the box is up."""
        level_rotation = product(rotation_z(self.heading), rotation_x(math.pi))
        return product(level_rotation, product(rotation_x(self.tilt[0]), rotation_y(self.tilt[1])))

    @property
    def vector(self) -> Array:
        """The pose vector: position, heading and tilts about x and y, (6,) [m, rad]."""
        return np.array([*self.position.tolist(), self.heading, *self.tilt])

    @staticmethod
    def from_vector(vector: Array) -> BoxPose:
        """Make a pose from a pose vector: position, heading and tilts, (6,) [m, rad]."""
        x, y, z, heading, about_x, about_y = vector.tolist()
        return BoxPose(position=np.array([x, y, z]), heading=heading, tilt=(about_x, about_y))

    @staticmethod
    def from_pose(pose: Pose) -> BoxPose:
        """Convert a pose ``navigation_from_box``; the tilt about y is in (-pi/2, pi/2)."""
        y_axis = pose.rotation[:, 1]
        heading = math.atan2(float(y_axis[0]), -float(y_axis[1]))
        level_rotation = product(rotation_z(heading), rotation_x(math.pi))
        relative_rotation = product(level_rotation.T, pose.rotation)
        tilt_y = math.atan2(float(relative_rotation[0, 2]), float(relative_rotation[0, 0]))
        tilt_x = math.atan2(float(relative_rotation[2, 1]), float(relative_rotation[1, 1]))
        return BoxPose(position=pose.position.copy(), heading=heading, tilt=(tilt_x, tilt_y))


def wrap_half_turn(angle: float) -> float:
    """Add half turns to an angle until it is between -pi/2 and pi/2 [rad]."""
    return angle - math.pi * math.floor(angle / math.pi + 0.5)
