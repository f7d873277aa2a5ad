r"""Which surfaces need no mipmaps: those of which a pixel covers less than two texels.

Blending the smaller copies (mip maps) of a texture is what a pixel of a large floor costs most of
its time for in a software rasteriser. It matters where a pixel covers many texels. For a flat
piece of a model the largest footprint of a pixel is known before it is drawn: on the plane
:math:`n \cdot X = d` of the camera's frame, at the planar depth :math:`t`,

.. math:: \left| \frac{\partial X}{\partial u} \right|
          \le \frac{t}{f} \left( 1 + \frac{|n_{xy}| |X|}{|d|} \right)

from :math:`X = t\,(x, y, -1)` with :math:`x = (u - c_x)/f`, :math:`t = d / (n \cdot (x, y, -1))`.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..geometry import Array, Intrinsics, Pose
from ..numerics.linear import product

MAX_TEXELS = 2.0**0.5
"""A pixel may cover so many, along its longer side: half a level of the smaller copies."""


def needs_no_copies(
    densities: Array,
    normals: Array,
    corners: Array,
    world_from_camera: Pose,
    intrinsics: Intrinsics,
) -> npt.NDArray[np.bool_]:
    """Return which pieces look right without mipmaps, (m,).

    Args:
        densities: texels along a metre at most, (m,) [1/m]; 0 without a texture.
        normals: of flat pieces in W, (m, 3); 0 for those that are bent.
        corners: of the boxes around them in W, (m, 8, 3) [m].
        world_from_camera: where the camera is; OpenGL axes.
        intrinsics: its pinhole.
    """
    points = product(corners - world_from_camera.position, world_from_camera.rotation)
    facing = product(normals, world_from_camera.rotation)  # (m, 3), camera frame
    depths = -points[:, :, 2]
    away = np.abs(np.einsum("mi,mki->mk", facing, points)).min(axis=1)  # from the plane [m]
    farthest = np.sqrt(np.square(points).sum(axis=2).max(axis=1))
    leaning = np.hypot(facing[:, 0], facing[:, 1])
    focal = min(intrinsics.fx, intrinsics.fy)
    with np.errstate(divide="ignore", invalid="ignore"):
        footprint = depths.max(axis=1) / focal * (1.0 + leaning * farthest / away)  # [m]
        is_small = densities * footprint <= MAX_TEXELS
    is_flat = np.square(normals).sum(axis=1) > 0.0
    is_ahead = depths.min(axis=1) > 0.0
    chosen: npt.NDArray[np.bool_] = is_small & is_flat & is_ahead & (densities > 0.0)
    return chosen
