r"""Selection of flat pieces without mipmaps: a pixel covers at most `MAX_TEXELS` along its side.

In a software rasteriser, blending the mipmaps of a texture takes most of the time of a large
floor. It has an effect only where a pixel covers many texels. For a flat piece of a model, the
largest footprint of a pixel can be bounded before the piece is drawn: on the plane
:math:`n \cdot X = d` of the camera's frame, at the planar depth :math:`t`,

.. math:: \left| \frac{\partial X}{\partial u} \right|
          \le \frac{t}{f} \left( 1 + \frac{|n_{xy}| |X|}{|d|} \right)

from :math:`X = t\,(x, y, -1)` with :math:`x = (u - c_x)/f`, :math:`t = d / (n \cdot (x, y, -1))`.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Intrinsics, Pose
from ..base.numerics.jit import njit
from ..base.numerics.linear import product
from .bounds import transform_from_world

MAX_TEXELS = 2.0**0.5
"""The largest number of texels that a pixel may cover along its longer side: half a mipmap
level."""


def needs_no_mipmaps(
    densities: Array,
    normals: Array,
    corners: Array,
    world_from_camera: Pose,
    intrinsics: Intrinsics,
) -> npt.NDArray[np.bool_]:
    """Return a flag for each piece: True if it is flat, textured and needs no mipmaps, (m,).

    Args:
        densities: the largest number of texels per metre, (m,) [1/m]; 0 without a texture.
        normals: the normals of flat pieces in W, (m, 3); 0 for non-planar pieces.
        corners: the corners of the boxes around the pieces in W, (m, 8, 3) [m].
        world_from_camera: the pose of the camera; OpenGL axes.
        intrinsics: the intrinsics of the camera.
    """
    focal = min(intrinsics.fx, intrinsics.fy)
    position = world_from_camera.position
    rotation = np.ascontiguousarray(world_from_camera.rotation)
    flags = np.empty(len(densities), dtype=bool)
    _compute_flags(densities, product(normals, rotation), corners, position, rotation, focal, flags)
    return flags


@njit
def _compute_flags(
    densities: Array,
    normals: Array,
    corners: Array,
    position: Array,
    rotation: Array,
    focal: float,
    flags: npt.NDArray[np.bool_],
) -> None:
    """Compute `needs_no_mipmaps` into ``flags``; position and rotation are those of the camera.

    Normals are in its frame. Non-planar pieces have the normal 0, and thus no distance to a plane.
    """
    point = np.empty(3)
    for m in range(len(densities)):
        x, y, z = normals[m]
        offset, reach, near, far = np.inf, 0.0, np.inf, -np.inf  # from plane, camera; depths [m]
        for c in range(8):
            transform_from_world(corners[m, c], position, rotation, point)
            offset = min(offset, abs(x * point[0] + y * point[1] + z * point[2]))
            squares = point[0] * point[0] + point[1] * point[1] + point[2] * point[2]
            reach = max(reach, math.sqrt(squares))
            near, far = min(near, -point[2]), max(far, -point[2])
        flags[m] = False
        if offset > 0.0 and near > 0.0 and densities[m] > 0.0:
            footprint = far / focal * (1.0 + math.hypot(x, y) * reach / offset)  # [m]
            flags[m] = densities[m] * footprint <= MAX_TEXELS
