"""A rendered image: colour, range and ids."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..geometry import Intrinsics


@dataclass(frozen=True, eq=False, kw_only=True)
class RenderedImage:
    """The arrays of one rendered image, row 0 at the top; None for targets not requested."""

    intrinsics: Intrinsics
    """The camera's pinhole."""
    colour: npt.NDArray[np.uint8] | npt.NDArray[np.uint16] | None = None
    """Stored values before noise: (h, w, 3) uint8, or (h, w, 4) uint16 for ``linear16``."""
    range: npt.NDArray[np.float32] | None = None
    """Distance along the ray of each pixel (h, w) [m]; inf = nothing there."""
    ids: npt.NDArray[np.uint16] | None = None
    """Number of the instance seen (h, w); 0 = nothing there."""

    @property
    def depth(self) -> npt.NDArray[np.float32]:
        """Distance along the optical axis (h, w) [m]; inf = nothing there.

        Raises:
            ValueError: the range was not requested.
        """
        if self.range is None:
            raise ValueError("the image was drawn without its range")
        stretch = np.linalg.norm(self.intrinsics.rays(), axis=2)  # (h, w)
        planar: npt.NDArray[np.float32] = (self.range / stretch).astype(np.float32)
        return planar
