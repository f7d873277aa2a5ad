"""A rendered image: colour, range and ids."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from ..base.geometry import Intrinsics, Pose

ImageModel = Literal["uwsim", "physical"]
"""The models of water in images."""


class PixelBox(NamedTuple):
    """A box in an image: columns ``left <= u < right`` and rows ``top <= v < bottom`` [px]."""

    left: int
    """The first column."""
    top: int
    """The first row."""
    right: int
    """The column after the last."""
    bottom: int
    """The row after the last."""


@dataclass(frozen=True, eq=False, kw_only=True)
class RenderedImage:
    """The arrays of one rendered image, row 0 at the top; None: the target was not requested."""

    intrinsics: Intrinsics
    """The pinhole of the camera."""
    colour: npt.NDArray[np.uint8] | npt.NDArray[np.uint16] | npt.NDArray[np.float32] | None = None
    """The colours before noise: (h, w, 3) uint8; (h, w, 4) uint16 for ``linear16``; (h, w, 4)
    float32 for ``light``."""
    range: npt.NDArray[np.float32] | None = None
    """The distance to the surface along the ray of each pixel, (h, w) [m]; inf: no surface."""
    ids: npt.NDArray[np.uint16] | None = None
    """The id of the visible link or object in each pixel, (h, w); 0: no surface."""
    image_model: ImageModel = "uwsim"
    """The model of the water in the colours: ``uwsim``, its fog law, or ``physical``."""
    names: Mapping[int, str] = field(default_factory=dict)
    """The name of each id in the scene: ``vehicle/link``, or the name of an object. The second
    vehicle or object of one name has the suffix ``#2`` (``vehicle#2/link``)."""
    world_from_camera: Pose | None = None
    """The pose of the camera in W, with OpenGL axes (x right, y up, looking along -z)."""

    @property
    def n_bytes(self) -> int:
        """The size of the arrays [bytes]."""
        arrays = self.colour, self.range, self.ids
        return sum(array.nbytes for array in arrays if array is not None)

    def copy(self) -> RenderedImage:
        """Return a copy with copied arrays."""
        return replace(
            self,
            colour=None if self.colour is None else self.colour.copy(),
            range=None if self.range is None else self.range.copy(),
            ids=None if self.ids is None else self.ids.copy(),
        )

    def crop(self, intrinsics: Intrinsics, columns: int, rows: int) -> RenderedImage:
        """Return the image without a margin of columns and rows on each side.

        Args:
            intrinsics: the pinhole of the image without its margin.
            columns: the number of columns to remove on the left and on the right.
            rows: the number of rows to remove above and below.
        """
        if columns == rows == 0:
            return self
        part = slice(rows, rows + intrinsics.height), slice(columns, columns + intrinsics.width)
        return replace(
            self,
            intrinsics=intrinsics,
            colour=None if self.colour is None else self.colour[part].copy(),
            range=None if self.range is None else self.range[part].copy(),
            ids=None if self.ids is None else self.ids[part].copy(),
        )

    @property
    def depth(self) -> npt.NDArray[np.float32]:
        """The distance along the optical axis (h, w) [m]; inf: no surface.

        Raises:
            ValueError: the range was not requested.
        """
        if self.range is None:
            raise ValueError("the image was drawn without its range")
        lengths = self.intrinsics.ray_lengths
        depth: npt.NDArray[np.float32] = (self.range / lengths).astype(np.float32)
        return depth

    @property
    def boxes(self) -> dict[str, PixelBox]:
        """The smallest box in the image around the visible pixels of each name.

        Raises:
            ValueError: the ids were not requested.
        """
        if self.ids is None:
            raise ValueError("the image was drawn without its ids")
        boxes: dict[str, PixelBox] = {}
        for number in np.unique(self.ids).tolist():
            if number not in self.names:
                continue
            mask = self.ids == number
            rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
            box = PixelBox(int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1)
            boxes[self.names[number]] = box
        return boxes
