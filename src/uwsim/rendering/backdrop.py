"""What stands still behind all that moves, for a camera that stands still.

The batches that are drawn last, terrain above all, are most of an image. While they and the camera
stay where they are, their colours are kept, without shadows. Then only what is in front is shaded.
Of the backdrop's batches the depths are drawn, which cost little, and their colours where shadows
may fall on them, in a rectangle of the image. Pixels in which nothing was shaded are taken from the
backdrop: the image has the bytes of one that is drawn as a whole.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.jit import njit
from .instance import Instances, Numbers

Colours = npt.NDArray[np.uint8] | npt.NDArray[np.uint16]
"""Red, green, blue and alpha, (h, w, 4)."""


class Backdrop:
    """The backdrop of a camera in its place; what it depends on but for poses stays as it is."""

    def __init__(self) -> None:
        self.colours: Colours | None = None
        """Its colours; None before they are drawn."""
        self.tiles: Array = np.zeros((0, 0, 2, 3))
        """Bounds of what is in its tiles (`shadow_region`)."""
        self._arrangement = self._version = -1  # of the instances in the last image
        self._drawn = b"", -1  # numbers of its batches in order, and version of the instances

    def find(self, instances: Instances, seen: Numbers) -> Numbers:
        """Return the batches that it has, the last of those in view.

        Without colours it has those that did not move since the last image: they are to be drawn.
        All that are seen are opaque, else there are none.

        Args:
            instances: all there are.
            seen: numbers of the batches in view, in the order of drawing.
        """
        before, self._version = self._version, instances.version
        if instances.arrangement != self._arrangement or not instances.are_opaque(seen):
            self._arrangement, self.colours = instances.arrangement, None
            return seen[:0]
        moved = instances.moved[instances.owners[seen]]
        numbers, version = self._drawn
        first = len(seen) - len(numbers) // seen.itemsize
        is_whole = first >= 0 and seen[first:].tobytes() == numbers
        if self.colours is not None and is_whole and (moved[first:] <= version).all():
            return seen[first:]
        self.colours = None
        others = np.flatnonzero(moved > before)
        return seen[others[-1] + 1 if len(others) else 0 :]

    def keep(self, colours: Colours, tiles: Array, members: Numbers) -> None:
        """Keep its colours and tiles, which were drawn of some batches."""
        self.colours, self.tiles = colours, tiles
        self._drawn = members.tobytes(), self._version


@njit
def fill(colours: Colours, behind: Colours) -> None:
    """Put the colours of the backdrop where alpha is 0, (h, w, 4) each."""
    height, width, _ = colours.shape
    for row in range(height):
        for column in range(width):
            if colours[row, column, 3] == 0:
                for channel in range(4):
                    colours[row, column, channel] = behind[row, column, channel]
