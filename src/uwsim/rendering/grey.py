"""Grey images, computed as in UWSim."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..base.numerics.jit import njit


@njit
def grey_truncated(rgb: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    """Compute ``int(0.2989 R) + int(0.5870 G) + int(0.1140 B)``, (h, w, 3) to (h, w).

    Each term is truncated: white becomes 76 + 149 + 29 = 254, and grey is 0 to 2 levels too dark.
    """
    height, width, _ = rgb.shape
    grey = np.empty((height, width), np.uint8)
    for row in range(height):
        for column in range(width):
            red, green = np.uint32(rgb[row, column, 0]), np.uint32(rgb[row, column, 1])
            blue = np.uint32(rgb[row, column, 2])
            grey[row, column] = (
                red * np.uint32(2989) // np.uint32(10000)
                + green * np.uint32(5870) // np.uint32(10000)
                + blue * np.uint32(1140) // np.uint32(10000)
            )
    return grey
