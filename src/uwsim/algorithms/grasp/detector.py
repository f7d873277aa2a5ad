r"""Finding the outline of an orange box in an image: no weights, nothing learned.

The colour score of a pixel is :math:`s = 2R - G - B`. Water takes contrast away but not the order:
fog of transmission T leaves :math:`T s` of a score, plus an offset that changes slowly over the
image (`Background`). So the threshold is relative: a share of the way between the bottom and the
brightest spot, provided that this stands out from the noise by `CONTRAST` deviations. A blob whose
score does not come from its red, by a share of `RED_SHARE`, is none: in fog a dark hull has less
green and blue than the water behind it, and hardly more red. What is far larger than the box, as
the arm before the camera, is left out, and the threshold is that of the rest. The blobs above it
are closed over bands, lettering and handle. What is returned is, for each, the support function of
its convex hull: how far it reaches along `N_DIRECTIONS` directions. It is all that a convex outline
has, and is not known where the blob ends at the rim of the image.

Not modelled: other orange things of the size of the box.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.linear import product
from ...base.numerics.opencv import deterministic_opencv
from .background import Background, Layer
from .camera import View

Pixels = npt.NDArray[np.uint8]
N_DIRECTIONS = 32
CONTRAST = 7.0
"""Least height of a blob over the bottom, in deviations of the bottom."""
LEAST = 6.0
"""Least height of a blob over the bottom [grey levels of the score]."""
SHARE = 0.17
"""Where the threshold is between the bottom (0) and the brightest spot (1)."""
REDDER = 5.0
"""Least height of the red of a blob over that of the bottom [grey levels]."""
RED_SHARE = 0.2
"""Least height of its red, as a share of that of its score: 0.3 and more for the box, 0.15 for a
hull in fog [1]."""
DARKEST = 10.0
"""Where there is nothing but water, the red is that of this darkest part of an image [%]."""
RIM = 2
"""Pixels at the rim of the image where an outline is not known [px]."""
MAX_BLOBS = 3

_angles = [2.0 * np.pi * k / N_DIRECTIONS for k in range(N_DIRECTIONS)]
DIRECTIONS: Array = np.array([[np.cos(a), np.sin(a)] for a in _angles])
"""Unit vectors in the image, (n, 2)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Outline:
    """A convex outline in an image."""

    support: Array
    """How far it reaches along each of `DIRECTIONS` from the first pixel's centre, (n,) [px]."""
    is_known: npt.NDArray[np.bool_]
    """Where that is known, (n,)."""
    middle: tuple[float, float]
    """Of the blob [px]."""
    angle: float
    """Of its long axis, from u to v [rad]."""
    area: float
    """Of its hull [px^2]."""
    contrast: float
    """Its height over the bottom, in deviations of the bottom [1]."""


class Detector(Protocol):
    """Finds outlines of what may be the box; one of your own goes to `Grasp.detector`."""

    def detect(self, image: Pixels, view: View) -> list[Outline]:
        """Return outlines in an image (h, w, 3) RGB, the largest first; none if there is none."""


class ColourDetector:
    """Finds blobs that are more orange than the rest."""

    def __init__(
        self, *, band: float = 0.03, least_size: float = 0.1, most_size: float = 0.4
    ) -> None:
        """Set its sizes.

        Args:
            band: gaps as wide as this are closed [m].
            least_size: what is smaller on the bottom is nothing [m].
            most_size: what is larger on the bottom is something else [m].
        """
        self._band, self._least_size, self._most_size = band, least_size, most_size

    @deterministic_opencv()
    def detect(self, image: Pixels, view: View) -> list[Outline]:
        """Return the outlines, the largest first.

        Blobs are looked for in every second pixel, and outlined in all pixels around each.
        """
        import cv2

        height = view.bottom - float(view.navigation_from_camera.position[2])
        if height <= 0.1:
            return []
        scale = view.pinhole.fx / height  # [px/m] on the bottom
        half = image[::2, ::2]
        score = cv2.blur(colour_score(half), (3, 3)).astype(np.float32)
        bottom = Background.of(score, 2)
        over = score - bottom.over(score.shape, step=2)
        level, blobs = self._blobs(over, bottom.deviation, scale / 2.0)
        if not blobs:
            return []
        red = Background.of(half[:, :, 0].astype(np.float32), 2)
        darkest = float(np.percentile(half[::3, ::3, 0], DARKEST))
        contrast = float(over.max()) / bottom.deviation
        found: list[tuple[float, Array]] = []
        for left, above, right, below in blobs:
            part, corner = image[above:below, left:right], (above, left)
            own = bottom.over(part.shape, corner), red.over(part.shape, corner).clip(darkest)
            hull = self._hull(part, own, level, scale)
            if hull is not None:
                found.append((hull[0], hull[1] + np.array([left, above])))
        found.sort(key=lambda one: -one[0])
        return [outline_of(hull, image.shape, area, contrast) for area, hull in found]

    def _blobs(
        self, over: Layer, noise: float, scale: float
    ) -> tuple[float, list[tuple[int, int, int, int]]]:
        """The threshold, and left, top, right, bottom of where to look closer [px].

        Args:
            over: scores of every second pixel over the bottom; what is too large is taken out.
            noise: deviation of the bottom's score.
            scale: of these pixels on the bottom [px/m].
        """
        import cv2

        least, most = (0.25 * (self._least_size * scale) ** 2, (self._most_size * scale) ** 2)
        margin = round(self._band * scale) + 3
        while True:
            top = float(over.max())
            if top < max(CONTRAST * noise, LEAST):
                return 0.0, []
            level = max(SHARE * top, 2.5 * noise)
            closed = self._closed(over > level, scale)
            _, labels, stats, _ = cv2.connectedComponentsWithStats(closed)
            large = 1 + np.flatnonzero(stats[1:, cv2.CC_STAT_AREA] > most)
            if not len(large):
                break
            over[np.isin(labels, large)] = 0.0
        found = []
        for left, above, width, height, area in np.asarray(stats)[1:].tolist():
            if area > least:
                corner = max(left - margin, 0), max(above - margin, 0)
                far = left + width + margin, above + height + margin
                found.append((area, (2 * corner[0], 2 * corner[1], 2 * far[0], 2 * far[1])))
        found.sort(key=lambda one: -one[0])
        return level, [place for _, place in found[:MAX_BLOBS]]

    def _hull(
        self, part: Pixels, bottom: tuple[Layer, Layer], level: float, scale: float
    ) -> tuple[float, Array] | None:
        """Area [px^2] and corners (n, 2) [px] of the largest hull in a part of the image.

        None where it is too small, too large, or not redder than the bottom; ``bottom`` has score
        and red of that, (h, w) each.
        """
        import cv2

        over = cv2.blur(colour_score(part), (3, 3)) - bottom[0]
        orange = over > level
        if not orange.any():
            return None
        score, red = (
            float(np.percentile(each[orange], 90)) for each in (over, part[:, :, 0] - bottom[1])
        )
        if red < max(RED_SHARE * score, REDDER):
            return None
        mask = self._closed(orange, scale)
        contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
        hulls = [cv2.convexHull(contour) for contour in contours if len(contour) > 8]
        sized = [(float(cv2.contourArea(hull)), hull) for hull in hulls]
        if not sized:
            return None
        area, hull = max(sized, key=lambda one: one[0])
        if not (self._least_size * scale) ** 2 <= area <= (self._most_size * scale) ** 2:
            return None
        return area, hull[:, 0, :].astype(np.float64)

    def _closed(self, mask: npt.NDArray[np.bool_], scale: float) -> Pixels:
        """The mask without gaps as wide as the band."""
        import cv2

        gap = max(int(self._band * scale) | 1, 3)
        kernel = np.ones((gap, gap), np.uint8)
        return cv2.morphologyEx(mask.astype(np.uint8), cv2.MORPH_CLOSE, kernel).astype(np.uint8)


def colour_score(image: Pixels) -> npt.NDArray[np.float32]:
    """``2R - G - B`` of an RGB image (h, w, 3), (h, w)."""
    wide = image.astype(np.int16)
    score: npt.NDArray[np.float32] = (2 * wide[:, :, 0] - wide[:, :, 1] - wide[:, :, 2]).astype(
        np.float32
    )
    return score


def outline_of(hull: Array, shape: tuple[int, ...], area: float, contrast: float) -> Outline:
    """Return the outline of a hull (n, 2) [px] of pixel centres in an image of a shape (h, w)."""
    reach = product(hull, DIRECTIONS.T)  # (n, directions)
    ends = hull[reach.argmax(axis=0)]
    height, width = shape[:2]
    inside = (
        (ends[:, 0] >= RIM)
        & (ends[:, 1] >= RIM)
        & (ends[:, 0] <= width - 1 - RIM)
        & (ends[:, 1] <= height - 1 - RIM)
    )
    # a pixel reaches half a pixel beyond its centre, along the axes
    support = reach.max(axis=0) + 0.25 * np.abs(DIRECTIONS).sum(axis=1)
    widths = support + np.roll(support, N_DIRECTIONS // 2)
    longest = int(widths[: N_DIRECTIONS // 2].argmax())
    mean = hull.mean(axis=0)
    return Outline(
        support=support,
        is_known=inside,
        middle=(float(mean[0]), float(mean[1])),
        angle=float(_angles[longest]),
        area=area,
        contrast=contrast,
    )
