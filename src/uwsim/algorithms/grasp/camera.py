"""A camera that looks from the vehicle: what it is, and where it was when it took an image."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array, Pose
from ...base.numerics.linear import rotate
from ...messages import CameraInfo


@dataclass(frozen=True, eq=False, kw_only=True)
class Pinhole:
    """A pinhole with OpenCV's axes: x right, y down, z along the view."""

    fx: float
    """Focal length along u [px]."""
    fy: float
    """Focal length along v [px]."""
    cx: float
    """Principal point, u [px]."""
    cy: float
    """Principal point, v [px]."""
    width: int
    """Columns [px]."""
    height: int
    """Rows [px]."""

    @staticmethod
    def from_info(info: CameraInfo) -> Pinhole:
        """From the K of a CameraInfo."""
        fx, cx, fy, cy = (float(info.k[i]) for i in (0, 2, 4, 5))
        return Pinhole(fx=fx, fy=fy, cx=cx, cy=cy, width=int(info.width), height=int(info.height))

    @property
    def numbers(self) -> Array:
        """fx, fy, cx, cy, (4,) [px]."""
        return np.array([self.fx, self.fy, self.cx, self.cy])


@dataclass(frozen=True, eq=False, kw_only=True)
class View:
    """A pinhole, and its pose when it took an image."""

    pinhole: Pinhole
    """The camera."""
    navigation_from_camera: Pose
    """OpenCV's axes in the navigation frame."""
    bottom: float
    """Depth of the sea floor where the box is, or may be [m]."""
    slopes: tuple[float, float] = (0.0, 0.0)
    """Growth of that depth to the north and to the east [1]."""

    def project(self, points: Array) -> Array:
        """Image coordinates (n, 2) [px] of points of the navigation frame (n, 3) [m].

        NaN for those that are not in front of the camera.
        """
        seen = self.navigation_from_camera.inverse().transform(points)
        depth = np.where(seen[:, 2] > 1e-6, seen[:, 2], np.nan)
        found = np.empty((len(points), 2))
        found[:, 0] = self.pinhole.cx + self.pinhole.fx * seen[:, 0] / depth
        found[:, 1] = self.pinhole.cy + self.pinhole.fy * seen[:, 1] / depth
        return found

    def on_plane(self, u: float, v: float, depth: float) -> Array | None:
        """Return the point (3,) [m] that a pixel sees on a horizontal plane at a depth [m].

        None where the ray does not reach it.
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
