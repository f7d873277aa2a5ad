"""The texture of sand in heaps: grains and patches, from a named random stream.

It is a sum of random grids, each smoothed over its cells, in whole numbers: its bytes do not depend
on the processor.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...base.rng import stream
from ..images import PixelImage
from ..mesh import Texture

SIDE = 512
"""The side of the image [px]."""
TILE = 1.2
"""The side of the image on the sand [m]."""
CELLS = ((1, 10), (2, 12), (4, 8), (16, 8), (64, 9), (128, 8))
"""The side of the cells of each grid [px], and its contrast over the whole image."""
MEAN = 205
"""The mean value of the image, 0..255."""


def make_sand_texture() -> Texture:
    """Return a grey texture of sand, whose opposite sides fit together."""
    values: npt.NDArray[np.int64] = np.full((SIDE, SIDE), MEAN, np.int64)
    for cell, contrast in CELLS:
        grid = stream(0, f"assets/sand/{cell}").integers(-128, 128, (SIDE // cell, SIDE // cell))
        smooth_grid = _smooth(np.repeat(np.repeat(grid, cell, axis=0), cell, axis=1), cell)
        values += smooth_grid * contrast * 4 // 256
    grey = np.clip(values, 0, 255).astype(np.uint8)
    return Texture(name="sand", image=PixelImage(np.repeat(grey[..., None], 3, axis=2)))


def _smooth(values: npt.NDArray[np.int64], width: int) -> npt.NDArray[np.int64]:
    """Return the mean of each square of a width, twice, across the borders too."""
    for axis in (0, 1, 0, 1):
        total = sum(np.roll(values, shift, axis=axis) for shift in range(width))
        values = np.asarray(total) // width
    return values
