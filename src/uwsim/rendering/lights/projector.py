r"""A projector of a pattern: a laser that draws it on surfaces, or a lamp that shines through it.

The pattern is an image, of which a point sees the pixel in its direction. Where the pixel is
transparent, something is between, or the surface faces away, nothing is projected. As a laser the
colour of the surface becomes

.. math:: p_c\,e^{-a_c d}

with the pattern's colour :math:`p`, 0 or 1 in each channel (black and pure white draw nothing),
and the water's attenuation :math:`a` along the way :math:`d` from the projector. As a lamp the
pattern adds, with the surface's colour :math:`L`,

.. math:: L_c\,p_c\,\frac{\max(N \cdot L, 0)}{d^2}\,e^{-a_c d}

both on stored values and before the water between surface and camera (`water`). Not modelled:
the width of a beam that spreads, speckle, scattering of the beam in the water.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...base.geometry import Intrinsics, Pose, image_centre

LONGEST_SIDE = 1024
"""Of a projector's shadow map [texels]."""
NEAR, FAR = 0.1, 20.0
"""What is nearer to the projector, its own housing, casts no shadow, nor what is farther [m]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Projector:
    """A pattern that shines along -z, as cameras look."""

    world_from_projector: Pose
    """Where it is; the axes of a camera."""
    fovy: float
    """Its vertical field of view [rad]; the other follows from the pattern's sides."""
    pattern: npt.NDArray[np.uint8]
    """Red, green, blue and opacity, (h, w, 4); row 0 at the top."""
    is_laser: bool
    """Whether it draws the pattern; else it is a lamp."""

    @property
    def pinhole(self) -> Intrinsics:
        """The pinhole that sees what it lights, with the size of its shadow map."""
        rows, columns = self.pattern.shape[:2]
        scale = LONGEST_SIDE / max(rows, columns)
        width, height = max(1, round(scale * columns)), max(1, round(scale * rows))
        half = math.tan(self.fovy / 2.0)
        cx, cy = image_centre(width, height)
        return Intrinsics(
            width=width,
            height=height,
            fx=width / 2.0 / (half * columns / rows),
            fy=height / 2.0 / half,
            cx=cx,
            cy=cy,
            near=NEAR,
            far=FAR,
        )
