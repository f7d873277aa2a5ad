"""The box that is looked for: its shape, its colour and its handle."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array, Pose, rotation_x, rotation_y, rotation_z
from ...base.numerics.linear import product, rotate


@dataclass(frozen=True, kw_only=True)
class BoxSpec:
    """A box with a handle on its top; the known model of what is grasped.

    Top, bottom and long sides are painted; the ends are bare metal, and so is the handle. Its
    frame: origin in the middle of the body, y along the long edges, z out of the top face.
    """

    size: tuple[float, float, float] = (0.15, 0.32, 0.14)
    """Edges along x, y, z [m]."""
    handle: float = 0.128
    """Height of the handle's bar, which runs along y, over the middle [m]."""
    bar: float = 0.008
    """Radius of the bar [m]."""

    @property
    def corners(self) -> Array:
        """Of the body, (8, 3) [m]."""
        half = np.array(self.size) / 2.0
        signs = [(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)]
        return np.array(signs) * half

    @property
    def face(self) -> Array:
        """Corners of the top face, in order around it, (4, 3) [m]."""
        x, y, z = (edge / 2.0 for edge in self.size)
        return np.array([[-x, -y, z], [-x, y, z], [x, y, z], [x, -y, z]])

    def grip(self, pose: BoxPose) -> Array:
        """Middle of the handle's bar in the navigation frame, (3,) [m]."""
        place: Array = pose.place + rotate(pose.rotation, np.array([0.0, 0.0, self.handle]))
        return place

    def closes(self, pose: BoxPose) -> float:
        """Return the heading of the axis across the handle, modulo half a turn [rad]."""
        return half_turn(pose.heading)


@dataclass(frozen=True, eq=False, kw_only=True)
class BoxPose:
    """Where a box is in the navigation frame (north, east, down)."""

    place: Array
    """Middle of its body, (3,) [m]."""
    heading: float
    """Of its x axis, across it, from north towards east [rad]; its front and back look alike."""
    lean: tuple[float, float] = (0.0, 0.0)
    """By how much it is tilted about its own x and y axes [rad]."""

    @property
    def rotation(self) -> Array:
        """Axes of the box in the navigation frame, (3, 3); its z is up when it lies flat."""
        flat = product(rotation_z(self.heading), rotation_x(math.pi))
        return product(flat, product(rotation_x(self.lean[0]), rotation_y(self.lean[1])))

    @property
    def numbers(self) -> Array:
        """Place, heading and lean, (6,) [m, rad]."""
        return np.array([*self.place.tolist(), self.heading, *self.lean])

    @staticmethod
    def from_numbers(numbers: Array) -> BoxPose:
        """From place, heading and lean, (6,) [m, rad]."""
        x, y, z, heading, about_x, about_y = numbers.tolist()
        return BoxPose(place=np.array([x, y, z]), heading=heading, lean=(about_x, about_y))

    @staticmethod
    def from_pose(pose: Pose) -> BoxPose:
        """From a pose ``navigation_from_box``; the lean about y is within a quarter of a turn."""
        along = pose.rotation[:, 1]
        heading = math.atan2(float(along[0]), -float(along[1]))
        flat = product(rotation_z(heading), rotation_x(math.pi))
        turn = product(flat.T, pose.rotation)
        lean_y = math.atan2(float(turn[0, 2]), float(turn[0, 0]))
        lean_x = math.atan2(float(turn[2, 1]), float(turn[1, 1]))
        return BoxPose(place=pose.position.copy(), heading=heading, lean=(lean_x, lean_y))


def half_turn(angle: float) -> float:
    """Bring a heading that is the same after half a turn between -pi/2 and pi/2 [rad]."""
    return angle - math.pi * math.floor(angle / math.pi + 0.5)
