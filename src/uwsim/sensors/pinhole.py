"""The CameraInfo of pinhole cameras, and images of depth and of surfaces by ray casting."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Intrinsics, Pose
from ..cameras import Lens
from ..cameras.distortion_fit import fit_distortion
from ..messages import CameraInfo, RegionOfInterest, header
from ..world import Rays


def camera_info(
    intrinsics: Intrinsics,
    *,
    time: float,
    frame_id: str,
    principal_point: tuple[float, float] | None = None,
    baseline: float = 0.0,
) -> CameraInfo:
    """Build the CameraInfo of a pinhole camera, with the distortion of its lens if it has one.

    Without a port the distortion is exact; behind one it is fitted
    (`uwsim.cameras.distortion_fit`).

    Args:
        intrinsics: the pinhole model.
        time: the time stamp of the message [s].
        frame_id: the name of the frame of the message.
        principal_point: cx and cy to publish instead of those of the pinhole model [px].
        baseline: the distance to the first camera of a stereo pair: Tx = -fx * baseline [m].
    """
    fx, fy, skew = intrinsics.fx, intrinsics.fy, -intrinsics.skew  # ROS: y points down
    cx, cy = principal_point or (intrinsics.cx, intrinsics.cy)
    model, coefficients = _find_distortion(intrinsics)
    return CameraInfo(
        header=header(time, frame_id),
        height=intrinsics.height,
        width=intrinsics.width,
        distortion_model=model,
        d=coefficients,
        k=np.array([fx, skew, cx, 0.0, fy, cy, 0.0, 0.0, 1.0]),
        r=np.eye(3).reshape(-1),
        p=np.array([fx, skew, cx, -fx * baseline, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0]),
        binning_x=0,
        binning_y=0,
        roi=RegionOfInterest(
            x_offset=0,
            y_offset=0,
            height=intrinsics.height,
            width=intrinsics.width,
            do_rectify=False,
        ),
    )


def _find_distortion(intrinsics: Intrinsics) -> tuple[str, Array]:
    """Return the name of the model of distortion, and its coefficients."""
    lens = intrinsics.lens
    if lens is None:
        return "", np.zeros(4)
    if isinstance(lens, Lens) and lens.port is None:
        return "plumb_bob", np.array(lens.distortion)
    fit = fit_distortion(intrinsics)
    return fit.model, np.array(fit.coefficients)


def cast_depth(rays: Rays, world_from_camera: Pose, intrinsics: Intrinsics) -> Array:
    """Cast a ray through the centre of each pixel; return the depth image, (h, w) [m].

    Depth is the distance along the optical axis. Surfaces nearer than the near plane are invisible.
    The depth is +inf where there is no surface before the far plane.
    """
    return _cast(rays, world_from_camera, intrinsics)[0]


def cast_surfaces(
    rays: Rays, world_from_camera: Pose, intrinsics: Intrinsics
) -> npt.NDArray[np.uint16]:
    """Cast a ray through the centre of each pixel; return the indices of the surfaces, (h, w).

    The index is 0 where `cast_depth` finds no surface.
    """
    depth, surface = _cast(rays, world_from_camera, intrinsics)
    return np.where(np.isfinite(depth), surface, 0).astype(np.uint16)


def _cast(
    rays: Rays, world_from_camera: Pose, intrinsics: Intrinsics
) -> tuple[Array, npt.NDArray[np.int32]]:
    """Return the depth [m] and the surface of each pixel, (h, w) each."""
    directions = intrinsics.rays().reshape(-1, 3)
    ray_lengths = intrinsics.ray_lengths.reshape(-1)
    reach = intrinsics.far * float(ray_lengths.max(initial=1.0))
    hits = rays.cast(
        world_from_camera, directions / ray_lengths[:, None], reach, intrinsics.near * ray_lengths
    )
    depth = hits.distance / ray_lengths
    size = intrinsics.height, intrinsics.width
    image: Array = np.where(depth < intrinsics.far, depth, np.inf).reshape(size)
    return image, hits.surface.reshape(size)
