"""The shared parts of colour and depth cameras: CameraInfo, and ray casting."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Intrinsics, Pose
from ..messages import CameraInfo, RegionOfInterest, header
from ..world import Rays


def camera_info(
    lens: Intrinsics,
    *,
    time: float,
    frame_id: str,
    principal_point: tuple[float, float] | None = None,
    baseline: float = 0.0,
) -> CameraInfo:
    """Build the CameraInfo of a pinhole, stamped ``time`` [s]: no distortion.

    Args:
        lens: the pinhole.
        time: of the message [s].
        frame_id: of the message.
        principal_point: published instead of that of the pinhole [px].
        baseline: distance to the first camera of a stereo pair: Tx = -fx * baseline [m].
    """
    fx, fy, skew = lens.fx, lens.fy, -lens.skew  # ROS: y points down
    cx, cy = principal_point or (lens.cx, lens.cy)
    return CameraInfo(
        header=header(time, frame_id),
        height=lens.height,
        width=lens.width,
        distortion_model="",
        d=np.zeros(4),
        k=np.array([fx, skew, cx, 0.0, fy, cy, 0.0, 0.0, 1.0]),
        r=np.eye(3).reshape(-1),
        p=np.array([fx, skew, cx, -fx * baseline, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0]),
        binning_x=0,
        binning_y=0,
        roi=RegionOfInterest(
            x_offset=0, y_offset=0, height=lens.height, width=lens.width, do_rectify=False
        ),
    )


def cast_depth(rays: Rays, world_from_camera: Pose, lens: Intrinsics) -> Array:
    """Cast a ray through the centre of each pixel; return the depth along the axis, (h, w) [m].

    As in an image, surfaces nearer than the near plane do not count; +inf without a hit before the
    far plane.
    """
    return _cast(rays, world_from_camera, lens)[0]


def cast_surfaces(rays: Rays, world_from_camera: Pose, lens: Intrinsics) -> npt.NDArray[np.uint16]:
    """Cast a ray through the centre of each pixel; return the surface's number, (h, w); 0: none.

    The hits are those of `cast_depth`.
    """
    depth, surface = _cast(rays, world_from_camera, lens)
    return np.where(np.isfinite(depth), surface, 0).astype(np.uint16)


def _cast(
    rays: Rays, world_from_camera: Pose, lens: Intrinsics
) -> tuple[Array, npt.NDArray[np.int32]]:
    """Return the depth [m] and the surface of each pixel, (h, w) each."""
    directions = lens.rays().reshape(-1, 3)
    stretch = lens.ray_lengths.reshape(-1)
    reach = lens.far * float(stretch.max(initial=1.0))
    hits = rays.cast(world_from_camera, directions / stretch[:, None], reach, lens.near * stretch)
    depth = hits.distance / stretch
    size = lens.height, lens.width
    image: Array = np.where(depth < lens.far, depth, np.inf).reshape(size)
    return image, hits.surface.reshape(size)
