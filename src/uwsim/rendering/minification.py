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

import math

import numpy as np
import numpy.typing as npt

from ..geometry import Array, Intrinsics, Pose
from ..numerics.jit import njit

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
    focal = min(intrinsics.fx, intrinsics.fy)
    place, turn = world_from_camera.position, np.ascontiguousarray(world_from_camera.rotation)
    chosen = np.empty(len(densities), dtype=bool)
    _choose(densities, normals, corners, place, turn, focal, chosen)
    return chosen


@njit
def _choose(
    densities: Array,
    normals: Array,
    corners: Array,
    place: Array,
    turn: Array,
    focal: float,
    chosen: npt.NDArray[np.bool_],
) -> None:
    """Do as `needs_no_copies`, into ``chosen``; the camera is at ``place`` with axes ``turn``."""
    facing, point = np.empty(3), np.empty(3)
    for m in range(len(densities)):
        for k in range(3):
            facing[k] = 0.0
            for j in range(3):
                facing[k] += normals[m, j] * turn[j, k]
        away, farthest, least, most = np.inf, 0.0, np.inf, -np.inf  # from plane, camera; depths [m]
        for c in range(8):
            for k in range(3):
                point[k] = 0.0
                for j in range(3):
                    point[k] += (corners[m, c, j] - place[j]) * turn[j, k]
            above = facing[0] * point[0] + facing[1] * point[1] + facing[2] * point[2]
            away = min(away, abs(above))
            squares = point[0] * point[0] + point[1] * point[1] + point[2] * point[2]
            farthest = max(farthest, math.sqrt(squares))
            least, most = min(least, -point[2]), max(most, -point[2])
        is_flat = normals[m, 0] != 0.0 or normals[m, 1] != 0.0 or normals[m, 2] != 0.0
        chosen[m] = False
        if is_flat and least > 0.0 and densities[m] > 0.0 and away > 0.0:
            leaning = math.hypot(facing[0], facing[1])
            footprint = most / focal * (1.0 + leaning * farthest / away)  # [m]
            chosen[m] = densities[m] * footprint <= MAX_TEXELS
