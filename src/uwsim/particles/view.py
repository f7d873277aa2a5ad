"""The view of a camera in which particles are found, and how they move in it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array, Intrinsics, Pose
from ..base.numerics.linear import rotate_back
from .population import SizeClass

MIN_WIDTH = 0.5
"""The width of the smallest image of a particle that is drawn [px]."""


@dataclass(frozen=True, kw_only=True)
class View:
    """The camera for which particles are found."""

    world_from_camera: Pose
    """The pose of the camera; OpenGL axes."""
    intrinsics: Intrinsics
    """The pinhole of the camera."""
    surface_height: float
    """The height z of the water's surface in W [m]."""
    max_range: float
    """The range beyond which no particle is drawn [m]."""
    exposure_time: float = 0.0
    """The time during which a particle moves in the image [s]."""
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The velocity of the camera in W [m/s]."""
    angular_velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The angular velocity of the camera in W [rad/s]."""


@dataclass(frozen=True, kw_only=True)
class Drift:
    """The displacement of the water since the start."""

    displacement: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The displacement by currents and waves in W [m]."""
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The velocity in W [m/s]."""
    time: float = 0.0
    """The time, for particles that sink and rise [s]."""


def find_reach(diameter: float, view: View) -> float:
    """Return the range at which a particle has `MIN_WIDTH` pixels [m]."""
    lens = view.intrinsics
    return diameter * math.sqrt(lens.fx * lens.fy) / MIN_WIDTH


def list_sizes(size_class: SizeClass, view: View) -> Array:
    """List the numbers of a class for compiled code, (6,).

    They are the least and the greatest diameter [m], 1 - s, the reflectance, the kind, and the
    greatest range over the diameter [1].
    """
    return np.array(
        [
            size_class.min_diameter,
            size_class.max_diameter,
            1.0 - size_class.slope,
            size_class.reflectance,
            float(size_class.kind),
            find_reach(1.0, view),
        ]
    )


def find_bounds(view: View, reach: float) -> tuple[Array, Array]:
    """Return the box around the view relative to the camera in W, (2, 3) [m], and the slopes.

    The slopes x / -z and y / -z of the image's edges are left, right, lower and upper, (4,).
    """
    lens, rotation = view.intrinsics, view.world_from_camera.rotation
    top, bottom = (lens.cy + 0.5) / lens.fy, (lens.cy + 0.5 - lens.height) / lens.fy
    skew = abs(lens.skew) / lens.fx * max(abs(top), abs(bottom))
    left = -(lens.cx + 0.5) / lens.fx - skew
    right = (lens.width - 0.5 - lens.cx) / lens.fx + skew
    slopes = np.array([left, right, bottom, top])
    corners = np.zeros((5, 3))
    for index, (x, y) in enumerate(((left, bottom), (left, top), (right, bottom), (right, top))):
        length = math.sqrt(1.0 + x * x + y * y)
        for axis in range(3):
            corners[index + 1, axis] = (
                reach * (rotation[axis, 0] * x + rotation[axis, 1] * y - rotation[axis, 2]) / length
            )
    # the spherical end of the view bulges beyond its corners, at most as far as the axes reach
    ends = [-reach * rotation[:, 2]]
    for axis in range(3):
        for sign in (-1.0, 1.0):
            camera_axis = sign * rotation[axis]  # the axis of W in the camera's frame
            if camera_axis[2] < 0.0:
                x, y = camera_axis[0] / -camera_axis[2], camera_axis[1] / -camera_axis[2]
                if left <= x <= right and bottom <= y <= top:
                    end = np.zeros(3)
                    end[axis] = sign * reach
                    ends.append(end)
    for x, y in ((left, 0.0), (right, 0.0), (0.0, bottom), (0.0, top)):
        length = math.sqrt(1.0 + x * x + y * y)
        direction = rotation[:, 0] * x + rotation[:, 1] * y - rotation[:, 2]
        ends.append(reach * direction / length)
    points = np.concatenate([corners, np.array(ends)])
    margin = 0.02 * reach  # of edges whose farthest point is between the points above
    box = np.stack([points.min(axis=0) - margin, points.max(axis=0) + margin])
    return box, slopes


def find_motions(size_class: SizeClass, view: View, drift: Drift) -> Array:
    """Return the motion during the exposure as rows in the camera's frame, (2, 3).

    The displacement of the particles relative to the camera's place [m], and the rotation of the
    camera [rad].
    """
    velocity = np.array(drift.velocity) - np.array(view.velocity)
    velocity[2] += size_class.rise_speed
    rotation, time = view.world_from_camera.rotation, view.exposure_time
    angular_velocity = np.array(view.angular_velocity)
    return np.stack(
        [time * rotate_back(rotation, velocity), time * rotate_back(rotation, angular_velocity)]
    )
