"""The interface of trackers of a planar patch, and the test whether the patch is lost."""

from __future__ import annotations

import abc
from dataclasses import dataclass

from ..base.geometry import Array, is_in_image
from .esm.homography import is_convex
from .esm.pyramid import Grey


@dataclass(frozen=True, eq=False)
class Estimate:
    """The estimated position of a patch in an image.

    Coordinates are in pixels from the centre of the top left pixel.
    """

    corners: Array
    """The corners of the patch in the order of the initial quad, (4, 2) [px]."""
    centroid: Array
    """The intersection of the diagonals: the image of the patch's centre, (2,) [px]."""
    zncc: float
    """The correlation of template and image at the estimate, -1..1 (`esm.alignment.zncc`)."""
    is_found: bool = True
    """True if the patch was found; otherwise corners and centroid are the last found ones."""
    iterations: int = 0
    """The number of iterations, over all pyramid levels."""


class Tracker(abc.ABC):
    """A tracker of a planar patch: a function of images, without topics."""

    @abc.abstractmethod
    def step(self, image: Grey) -> Estimate:
        """Find the patch in the next image (h, w) [grey level]."""

    @abc.abstractmethod
    def set_quad(self, quad: Array) -> None:
        """Set the estimate to a convex quad (4, 2) [px]; the template does not change."""


class LossTest:
    """The test whether a tracker has lost its target.

    A target is lost if the zero-mean normalised cross-correlation (ZNCC) is below a threshold, or
    nothing is found, on several consecutive images. It is also lost if its quad is not convex, or
    if the centre of the quad is outside the image.

    Args:
        zncc_threshold: the minimum ZNCC of a good estimate, -1..1.
        frames: the number of consecutive images without a good estimate after which the target is
            lost.
    """

    def __init__(self, *, zncc_threshold: float, frames: int) -> None:
        self._threshold = zncc_threshold
        self._max_low = frames
        self._n_low = 0

    def check(self, estimate: Estimate, width: int, height: int) -> str | None:
        """Return the reason why the target is lost; None if it is not lost."""
        is_good = estimate.is_found and estimate.zncc >= self._threshold
        self._n_low = 0 if is_good else self._n_low + 1
        if self._n_low >= self._max_low:
            reason = f"ZNCC {estimate.zncc:.2f}" if estimate.is_found else "nothing found"
            return f"{reason} on {self._max_low} frames"
        if not estimate.is_found:
            return None
        u, v = estimate.centroid
        if not is_in_image(u, v, width, height):
            return f"the quad's centre ({u:.1f}, {v:.1f}) is outside the {width}x{height} image"
        return _not_convex(estimate.corners)


def quad_error(quad: Array, width: int, height: int) -> str | None:
    """Return the reason why a quad (4, 2) [px] cannot be tracked in an image; None if it can."""
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
