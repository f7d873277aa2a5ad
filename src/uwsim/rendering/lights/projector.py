r"""A projector of a pattern: a laser projector, or a lamp with a slide.

The pattern is an image; a point is lit by the pixel in its direction. Nothing is projected where
the pixel is transparent, the point is in shadow, or the surface faces away. A laser changes the
colour of the surface to

.. math:: p_c\,e^{-a_c d}

with the pattern's colour :math:`p`, 0 or 1 in each channel (black and pure white draw nothing), the
distance :math:`d` from the projector, and the water's attenuation :math:`a` along this path. A lamp
adds to the light of a surface with the colour :math:`L_c` and the unit normal :math:`N`

.. math:: L_c\,p_c\,\frac{\max(N \cdot D, 0)}{d^2}\,e^{-a_c d}

with the unit vector :math:`D` from the surface to the projector. Both are computed on stored values
and before the water between surface and camera (`water`). Not modelled: the growing width of a
beam, speckle, scattering of the beam in the water.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...base.geometry import Intrinsics, Pose, image_centre

LONGEST_SIDE = 1024
"""The longest side of a projector's shadow map [texels]."""
NEAR, FAR = 0.1, 20.0
"""The distances from the projector between which bodies cast shadows [m]; the projector's own
housing is nearer."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Projector:
    """A pattern projected along the projector's -z axis, as cameras look."""

    world_from_projector: Pose
    """The pose of the projector in W; OpenGL axes: it projects along -z, with y up."""
    fovy: float
    """The vertical field of view [rad]; the horizontal one follows from the pattern's sides."""
    pattern: npt.NDArray[np.uint8]
    """The red, green, blue and opacity values, (h, w, 4); row 0 is at the top."""
    is_laser: bool
    """True if a laser projects the pattern, False if a lamp does."""

    @property
    def pinhole(self) -> Intrinsics:
        """The pinhole whose image is the lit region, with the size of the shadow map."""
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
