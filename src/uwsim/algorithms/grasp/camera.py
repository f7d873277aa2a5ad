"""A pinhole camera: its intrinsics, and its pose at the time of an image.

The camera has the axes of OpenCV (x right, y down, z forward). The navigation frame has the axes
north, east and down, so that z is the depth.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...base.deprecation import deprecated_name
from ...base.geometry import Array, Pose
from ...base.numerics.linear import rotate
from ...messages import CameraInfo


@dataclass(frozen=True, eq=False, kw_only=True)
class Pinhole:
    """The intrinsics of a pinhole camera; (0, 0) is the centre of the upper left pixel."""

    fx: float
    """The focal length along u [px]."""
    fy: float
    """The focal length along v [px]."""
    cx: float
    """The coordinate u of the principal point [px]."""
    cy: float
    """The coordinate v of the principal point [px]."""
    width: int
    """The width of the image [px]."""
    height: int
    """The height of the image [px]."""

    @staticmethod
    def from_info(info: CameraInfo) -> Pinhole:
        """Read the intrinsics from a CameraInfo."""
        fx, cx, fy, cy = (float(info.k[i]) for i in (0, 2, 4, 5))
        return Pinhole(fx=fx, fy=fy, cx=cx, cy=cy, width=int(info.width), height=int(info.height))

    @property
    def intrinsics(self) -> Array:
        """The intrinsics fx, fy, cx, cy, (4,) [px]."""
        return np.array([self.fx, self.fy, self.cx, self.cy])


@dataclass(frozen=True, eq=False, kw_only=True)
class View:
    """A camera with its pose at the time of an image, and the seabed below it."""

    pinhole: Pinhole
    """The intrinsics of the camera."""
    navigation_from_camera: Pose
    """The pose of the camera (OpenCV's axes) in the navigation frame."""
    seabed_depth: float
    """The depth of the seabed at the estimated position of the box; without an estimate, on the
    axis of the camera [m]."""
    slopes: tuple[float, float] = (0.0, 0.0)
    """The slopes of the seabed's depth to the north and to the east [1]."""

    @property
    @deprecated_name("seabed_depth")
    def bottom(self) -> float:
        """The deprecated name of `seabed_depth`."""
        return self.seabed_depth

    def project(self, points: Array) -> Array:
        """Project points of the navigation frame (n, 3) [m] to the image, (n, 2) [px].

        The coordinates of points that are not in front of the camera are NaN.
        """
        camera_points = self.navigation_from_camera.inverse().transform(points)
        depth = np.where(camera_points[:, 2] > 1e-6, camera_points[:, 2], np.nan)
        pixels = np.empty((len(points), 2))
        pixels[:, 0] = self.pinhole.cx + self.pinhole.fx * camera_points[:, 0] / depth
        pixels[:, 1] = self.pinhole.cy + self.pinhole.fy * camera_points[:, 1] / depth
        return pixels

    def intersect_plane(self, u: float, v: float, depth: float) -> Array | None:
        """Return the point in which the ray of a pixel meets a horizontal plane, (3,) [m].

        Args:
            u: the image coordinate to the right [px].
            v: the image coordinate down [px].
            depth: the depth of the plane [m].

        Returns:
            The point in the navigation frame; None if the ray does not meet the plane.
        """
        ray = rotate(
            self.navigation_from_camera.rotation,
            np.array(
                [
                    (u - self.pinhole.cx) / self.pinhole.fx,
                    (v - self.pinhole.cy) / self.pinhole.fy,
                    1.0,
                ]
            ),
        )
        height = depth - float(self.navigation_from_camera.position[2])
        if ray[2] < 1e-3 or height <= 0.0:
            return None
        point: Array = self.navigation_from_camera.position + ray * (height / ray[2])
        return point
