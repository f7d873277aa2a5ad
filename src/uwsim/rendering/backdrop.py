"""The backdrop: the part of a scene at rest behind all moving instances, for a camera at rest.

The batches that are drawn last, mainly terrain, cover most of an image. While they and the camera
are at rest, their colours without shadows are stored, and only the batches in front are shaded in
each image. Of the backdrop, the depths are drawn, which takes little time, and the colours in the
rectangle where shadows may fall. Pixels in which nothing was shaded get the stored colours: the
image has the same bytes as one in which all batches are drawn.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.jit import njit
from .instance import Indices, Instances
from .physical.view import View

Colours = npt.NDArray[np.uint8] | npt.NDArray[np.uint16] | npt.NDArray[np.float32]
"""The red, green, blue and alpha values, (h, w, 4)."""


class Backdrop:
    """The backdrop of one view: the camera, water, light and hidden instances do not change."""

    def __init__(self) -> None:
        self.colours: Colours | None = None
        """The colours of the backdrop; None before they are drawn."""
        self.tiles: Array = np.zeros((0, 0, 2, 3))
        """The bounds of the surfaces in the tiles of the image (`shadow_region`)."""
        self._arrangement = (
            self._version
        ) = -1  # `Instances.arrangement`, `version` at the last image
        self._members_key = b"", -1  # numbers of its batches in order, and `Instances.version`

    def find(self, instances: Instances, visible_batches: Indices) -> Indices:
        """Return the indices of the batches of the backdrop: the last of those in view.

        If `colours` is None then, these are batches that did not move since the last image, and the
        caller draws and stores them. The result is empty if a batch in view is transparent.

        Args:
            instances: all instances.
            visible_batches: the indices of the batches in view, in the order of drawing.
        """
        last_version, self._version = self._version, instances.version
        if instances.arrangement != self._arrangement or not instances.are_opaque(visible_batches):
            self._arrangement, self.colours = instances.arrangement, None
            return visible_batches[:0]
        versions = instances.moved_versions[instances.owners[visible_batches]]
        index_bytes, version = self._members_key
        start = len(visible_batches) - len(index_bytes) // visible_batches.itemsize
        is_whole = start >= 0 and visible_batches[start:].tobytes() == index_bytes
        if self.colours is not None and is_whole and (versions[start:] <= version).all():
            return visible_batches[start:]
        self.colours = None
        moving_rows = np.flatnonzero(versions > last_version)
        return visible_batches[moving_rows[-1] + 1 if len(moving_rows) else 0 :]

    def store(self, colours: Colours, tiles: Array, members: Indices) -> None:
        """Store the colours and the tiles of the backdrop, and the numbers of its batches."""
        self.colours, self.tiles = colours, tiles
        self._members_key = members.tobytes(), self._version


class Backdrops:
    """The backdrops of recent views.

    Args:
        n_max: the maximum number of backdrops; the oldest are removed first.
        max_bytes: the size of the largest image that has a backdrop [bytes].
    """

    def __init__(self, n_max: int, max_bytes: int) -> None:
        self._n_max, self._max_bytes = n_max, max_bytes
        self._backdrops: dict[object, Backdrop] = {}  # the newest last

    def find(self, view: View, instances: Instances) -> Backdrop | None:
        """Return the backdrop of a view; None if the view cannot have one."""
        intrinsics, bytes_per_pixel = view.intrinsics, 4 if view.colour_format == "uint8" else 8
        is_small = bytes_per_pixel * intrinsics.width * intrinsics.height <= self._max_bytes
        has_own_lights = bool(view.lamps) or view.projector is not None
        if not is_small or view.targets != {"colour"} or has_own_lights or view.is_physical:
            return None
        if instances.has_holes:  # the backdrop's depths are drawn without textures
            return None
        key = view.pose, intrinsics, view.water, view.light, view.hidden_ids, view.colour_format
        backdrop = self._backdrops.pop(key, None) or Backdrop()
        self._backdrops[key] = backdrop
        if len(self._backdrops) > self._n_max:
            del self._backdrops[next(iter(self._backdrops))]
        return backdrop

    def clear(self) -> None:
        """Remove every backdrop."""
        self._backdrops.clear()


@njit
def fill(colours: Colours, background: Colours) -> None:
    """Copy a background into the pixels of an image whose alpha is 0; both are (h, w, 4)."""
    height, width, _ = colours.shape
    for row in range(height):
        for column in range(width):
            if colours[row, column, 3] == 0:
                for channel in range(4):
                    colours[row, column, channel] = background[row, column, channel]
