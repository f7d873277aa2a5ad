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

from ..base.geometry import Array, Intrinsics, Pose
from ..base.numerics.jit import njit
from ..base.numerics.linear import product
from .bounds import seen_from

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
    _choose(densities, product(normals, turn), corners, place, turn, focal, chosen)
    return chosen


@njit
def _choose(
    densities: Array,
    facing: Array,
    corners: Array,
    place: Array,
    turn: Array,
    focal: float,
    chosen: npt.NDArray[np.bool_],
) -> None:
    """Do as `needs_no_copies`, into ``chosen``; the camera is at ``place`` with axes ``turn``.

    Normals are in its frame; bent pieces, whose normals are 0, are at no distance from their plane.
    """
    point = np.empty(3)
    for m in range(len(densities)):
        x, y, z = facing[m]
        away, farthest, least, most = np.inf, 0.0, np.inf, -np.inf  # from plane, camera; depths [m]
        for c in range(8):
            seen_from(corners[m, c], place, turn, point)
            away = min(away, abs(x * point[0] + y * point[1] + z * point[2]))
            squares = point[0] * point[0] + point[1] * point[1] + point[2] * point[2]
            farthest = max(farthest, math.sqrt(squares))
            least, most = min(least, -point[2]), max(most, -point[2])
        chosen[m] = False
        if away > 0.0 and least > 0.0 and densities[m] > 0.0:
            footprint = most / focal * (1.0 + math.hypot(x, y) * farthest / away)  # [m]
            chosen[m] = densities[m] * footprint <= MAX_TEXELS
