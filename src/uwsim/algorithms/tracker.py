"""The interface of trackers, and the test whether a tracker is lost."""

from __future__ import annotations

import abc
from dataclasses import dataclass

from ..base.geometry import Array, is_in_image
from .esm.homography import is_convex
from .esm.pyramid import Grey


@dataclass(frozen=True, eq=False)
class Estimate:
    """A tracker's estimate of the patch in an image, in pixels from the centre of the first."""

    corners: Array
    """The corners in the order they were handed in, (4, 2) [px]."""
    centroid: Array
    """Where the diagonals of the corners cross: the image of the patch's centre, (2,) [px]."""
    zncc: float
    """Correlation of template and image there, -1..1 (`esm.alignment.zncc`)."""
    found: bool = True
    """False when the method itself gave up; corners and centroid are then the last ones."""
    iterations: int = 0
    """Steps taken, over all pyramid levels."""


class Tracker(abc.ABC):
    """A tracker of a planar patch, independent of the bus."""

    @abc.abstractmethod
    def step(self, image: Grey) -> Estimate:
        """Find the patch in the next image (h, w) [grey level]."""

    @abc.abstractmethod
    def place(self, quad: Array) -> None:
        """Set the estimate to the convex ``quad`` (4, 2) [px]; the template stays."""


class LossTest:
    """The test whether a tracker is lost.

    Lost is: a ZNCC below the threshold (or nothing found) on so many images in a row; or a quad
    that is not convex; or one that has left the image: its centre is outside, so about half of it
    is. Images in between may still be low.
    """

    def __init__(self, *, zncc_threshold: float, frames: int) -> None:
        self._threshold = zncc_threshold
        self._frames = frames
        self._low = 0

    def check(self, estimate: Estimate, width: int, height: int) -> str | None:
        """Why the tracker is lost with this estimate; None when it is not."""
        good = estimate.found and estimate.zncc >= self._threshold
        self._low = 0 if good else self._low + 1
        if self._low >= self._frames:
            what = f"ZNCC {estimate.zncc:.2f}" if estimate.found else "nothing found"
            return f"{what} on {self._frames} frames"
        if not estimate.found:
            return None
        u, v = estimate.centroid
        if not is_in_image(u, v, width, height):
            return f"the quad's centre ({u:.1f}, {v:.1f}) is outside the {width}x{height} image"
        return _not_convex(estimate.corners)


def quad_error(quad: Array, width: int, height: int) -> str | None:
    """What makes a quad (4, 2) [px] impossible to follow in an image; None when nothing does."""
    names = ("NW", "NE", "SE", "SW")
    for name, (u, v) in zip(names, quad, strict=True):
        if not is_in_image(u, v, width, height):
            return f"corner {name} ({u:.1f}, {v:.1f}) is outside the {width}x{height} image"
    return _not_convex(quad)


def _not_convex(quad: Array) -> str | None:
    if not is_convex(quad):
        corners = " ".join(f"({u:.1f}, {v:.1f})" for u, v in quad)
        return f"the quad {corners} is not convex"
    return None
