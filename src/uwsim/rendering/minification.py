r"""Selection of the flat pieces that can be drawn without mipmaps.

In a software rasteriser, blending the mipmaps of a texture takes most of the time of drawing a
large floor. It has an effect only where a pixel covers many texels. For a flat piece of a model,
the largest footprint of a pixel can be bounded before the piece is drawn: on the plane
:math:`n \cdot X = d` in the camera's frame, at the planar depth :math:`t`,

.. math:: \left| \frac{\partial X}{\partial u} \right|
          \le \frac{t}{f} \left( 1 + \frac{|n_{xy}| |X|}{|d|} \right)

from :math:`X = t\,(x, y, -1)` with :math:`x = (u - c_x)/f`, :math:`t = d / (n \cdot (x, y, -1))`.
A piece is drawn without mipmaps if this footprint has at most `MAX_TEXELS` along its side.
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


def can_skip_mipmaps(
    densities: Array,
    normals: Array,
    corners: Array,
    world_from_camera: Pose,
    intrinsics: Intrinsics,
) -> npt.NDArray[np.bool_]:
    """Return for each piece True if it is flat, textured and can be drawn without mipmaps, (m,).

    Args:
        densities: the largest number of texels per metre, (m,) [1/m]; 0 without a texture.
        normals: the normals of flat pieces in W, (m, 3); 0 for pieces that are not flat.
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
    """Compute `can_skip_mipmaps` into ``flags``; normals are in the camera's frame.

    ``position`` and ``rotation`` are the pose of the camera in W. Pieces that are not flat have the
    normal 0, so the distance of their plane is 0.
    """
    point = np.empty(3)
    for m in range(len(densities)):
        x, y, z = normals[m]
        plane_distance, max_distance, near, far = np.inf, 0.0, np.inf, -np.inf  # near, far: depths
        for c in range(8):
            transform_from_world(corners[m, c], position, rotation, point)
            plane_distance = min(plane_distance, abs(x * point[0] + y * point[1] + z * point[2]))
            squares = point[0] * point[0] + point[1] * point[1] + point[2] * point[2]
            max_distance = max(max_distance, math.sqrt(squares))
            near, far = min(near, -point[2]), max(far, -point[2])
        flags[m] = False
        if plane_distance > 0.0 and near > 0.0 and densities[m] > 0.0:
            tilt = math.hypot(x, y)
            footprint = far / focal * (1.0 + tilt * max_distance / plane_distance)  # [m]
            flags[m] = densities[m] * footprint <= MAX_TEXELS
