r"""The vignetting of a lens: the illumination of a pixel relative to the axis.

The natural law of an ideal lens is :math:`\cos^4 \theta`, with the angle :math:`\theta` of the ray
from the axis in front of the lens, in the air behind a port. A data sheet gives the relative
illumination over the image height instead: with :math:`r = 1` in the farthest corner of a centred
image,

.. math:: V = 1 + a_2 r^2 + a_4 r^4 + a_6 r^6
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Intrinsics
from .lens import Lens

NO_VIGNETTING = (0.0, 0.0, 0.0)
"""The coefficients of an image without vignetting."""


@lru_cache(maxsize=16)
def compute_falloff(
    camera: Intrinsics, coefficients: tuple[float, ...] | None
) -> npt.NDArray[np.float32]:
    """Compute the relative illumination of each pixel, (h, w); read-only.

    Args:
        camera: the camera, with its lens.
        coefficients: a2, a4 and a6; None: the natural law.
    """
    u = np.arange(camera.width, dtype=np.float64)[None, :] - camera.cx
    v = np.arange(camera.height, dtype=np.float64)[:, None] - camera.cy
    if coefficients is None:
        y = np.broadcast_to(v / camera.fy, (camera.height, camera.width))
        x = (u + camera.skew * y) / camera.fx
        tangents = np.sqrt(x * x + y * y)
        if isinstance(camera.lens, Lens):
            tangents = camera.lens.compute_air_tangents(x, y)
        squares = 1.0 / (1.0 + tangents * tangents)
        falloff = squares * squares
    else:
        falloff = evaluate_polynomial(coefficients, (u * u + v * v) / _square_of_corner(camera))
    stored_falloff: npt.NDArray[np.float32] = falloff.astype(np.float32)
    stored_falloff.flags.writeable = False
    return stored_falloff


def evaluate_polynomial(coefficients: tuple[float, ...], squares: Array) -> Array:
    """Return the relative illumination at squares of the image height r, not below 0."""
    a2, a4, a6 = coefficients
    illumination: Array = 1.0 + squares * (a2 + squares * (a4 + squares * a6))
    return np.maximum(illumination, 0.0)


def _square_of_corner(camera: Intrinsics) -> float:
    return 0.25 * float(camera.width**2 + camera.height**2)
