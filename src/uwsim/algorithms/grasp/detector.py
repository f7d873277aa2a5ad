r"""Detection of an orange box in an image by its colour, and of its outline.

The colour score of a pixel is :math:`s = 2R - G - B`. Water reduces the contrast of scores but
keeps their order: fog of the transmission T changes s to :math:`T s` plus an offset that varies
slowly over the image (`Background`, the score of the seabed). A connected region of pixels whose
score is above a threshold is called a blob.

1. The threshold is a fraction of the largest score above the seabed, the peak, which must exceed
   `MIN_CONTRAST` standard deviations of the noise.
2. Blobs far larger than the box, such as the arm in front of the camera, are removed, and the
   threshold is computed again.
3. Gaps due to bands, lettering and the handle are closed.
4. The increase of red in a blob must be at least the fraction `MIN_RED_FRACTION` of its score: a
   dark hull in fog has less green and blue than the water behind it, but hardly more red.
5. The outline of a blob is the support of its convex hull (its largest coordinate) along each of
   `N_DIRECTIONS` directions. The support is unknown in a direction in which the blob ends at the
   border of the image.

Not modelled: other orange objects of the size of the box.
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
"""An image, (h, w, 3) RGB, or a mask, (h, w)."""
N_DIRECTIONS = 32
"""The number of directions along which the support of an outline is computed."""
MIN_CONTRAST = 7.0
"""The minimum peak of the score above the seabed, in standard deviations of the seabed [1]."""
MIN_SCORE = 6.0
"""The minimum peak of the score above the seabed [grey levels]."""
THRESHOLD_FRACTION = 0.17
"""The threshold of the score above the seabed, as a fraction of the peak [1]."""
MIN_RED = 5.0
"""The minimum increase of red from the seabed to a blob [grey levels]."""
MIN_RED_FRACTION = 0.2
"""The minimum increase of red from the seabed to a blob, as a fraction of the increase of its score
[1].

The fraction is 0.3 or more for the box, and 0.15 for a hull in fog."""
DARK_PERCENTILE = 10.0
"""The percentile of the red channel of an image that estimates the red of the water [%]."""
BORDER_WIDTH = 2
"""The width of the border of an image in which an outline is unknown [px]."""
MAX_BLOBS = 3
"""The greatest number of blobs whose outlines are computed."""

_angles = [2.0 * np.pi * k / N_DIRECTIONS for k in range(N_DIRECTIONS)]
DIRECTIONS: Array = np.array([[np.cos(a), np.sin(a)] for a in _angles])
"""The unit vectors (u, v) of the directions in the image, (N_DIRECTIONS, 2)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Outline:
    """The convex outline of a blob in an image."""

    support: Array
    """The support along each of `DIRECTIONS`, from the centre of the top left pixel, (n,) [px]."""
    is_known: npt.NDArray[np.bool_]
    """The mask of the directions with a known support, (n,)."""
    centre: tuple[float, float]
    """The mean u and v of the corners of the convex hull [px]."""
    angle: float
    """The angle of the direction in which the outline is widest, from u towards v [rad]."""
    area: float
    """The area of the convex hull [px^2]."""
    contrast: float
    """The peak of the score above the seabed, in standard deviations of the seabed [1]."""


class Detector(Protocol):
    """A detector of outlines that may be the object; see `Grasp.detector`."""

    def detect(self, image: Pixels, view: View) -> list[Outline]:
        """Return the outlines in an image (h, w, 3) RGB, the largest first; may be empty."""


class ColourDetector:
    """A detector of orange blobs and of their outlines."""

    def __init__(self, *, band: float = 0.03, min_size: float = 0.1, max_size: float = 0.4) -> None:
        """Create a detector for objects of some size on the seabed.

        Args:
            band: the width of gaps that are closed [m].
            min_size: the minimum root of the area of an object [m].
            max_size: the largest root of the area of an object [m].
        """
        self._band, self._min_size, self._max_size = band, min_size, max_size

    @deterministic_opencv()
    def detect(self, image: Pixels, view: View) -> list[Outline]:
        """Return the outlines, the largest first; see `Detector`.

        Blobs are detected in an image of every second pixel; their outlines are computed from all
        pixels around them.
        """
        import cv2

        height = view.seabed_depth - float(view.navigation_from_camera.position[2])
        if height <= 0.1:
            return []
        scale = view.pinhole.fx / height  # [px/m] on the seabed
        half = image[::2, ::2]
        score = cv2.blur(colour_score(half), (3, 3)).astype(np.float32)
        background = Background.fit(score, 2)
        excess = score - background.evaluate(score.shape, step=2)
        threshold, blobs = self._blobs(excess, background.deviation, scale / 2.0)
        if not blobs:
            return []
        red = Background.fit(half[:, :, 0].astype(np.float32), 2)
        min_red = float(np.percentile(half[::3, ::3, 0], DARK_PERCENTILE))
        contrast = float(excess.max()) / background.deviation
        hulls: list[tuple[float, Array]] = []
        for left, top, right, bottom in blobs:
            part, corner = image[top:bottom, left:right], (top, left)
            red_layer = red.evaluate(part.shape, corner).clip(min_red)
            layers = background.evaluate(part.shape, corner), red_layer
            hull = self._hull(part, layers, threshold, scale)
            if hull is not None:
                hulls.append((hull[0], hull[1] + np.array([left, top])))
        hulls.sort(key=lambda entry: -entry[0])
        return [outline_of(hull, image.shape, area, contrast) for area, hull in hulls]

    def _blobs(
        self, excess: Layer, noise: float, scale: float
    ) -> tuple[float, list[tuple[int, int, int, int]]]:
        """Return the threshold of the score, and the bounding boxes of the blobs.

        A bounding box is left, top, right, bottom in the whole image [px], with a margin.

        Args:
            excess: the score of every second pixel minus the score of the seabed; large blobs in it
                are set to 0.
            noise: the standard deviation of the seabed's score.
            scale: the number of these pixels in a metre of the seabed [px/m].
        """
        import cv2

        min_area, max_area = (0.25 * (self._min_size * scale) ** 2, (self._max_size * scale) ** 2)
        margin = round(self._band * scale) + 3
        while True:
            peak = float(excess.max())
            if peak < max(MIN_CONTRAST * noise, MIN_SCORE):
                return 0.0, []
            threshold = max(THRESHOLD_FRACTION * peak, 2.5 * noise)
            mask = self._close_gaps(excess > threshold, scale)
            _, labels, stats, _ = cv2.connectedComponentsWithStats(mask)
            large_labels = 1 + np.flatnonzero(stats[1:, cv2.CC_STAT_AREA] > max_area)
            if not len(large_labels):
                break
            excess[np.isin(labels, large_labels)] = 0.0
        blobs = []
        for left, top, width, height, area in np.asarray(stats)[1:].tolist():
            if area > min_area:
                corner = max(left - margin, 0), max(top - margin, 0)
                far = left + width + margin, top + height + margin
                blobs.append((area, (2 * corner[0], 2 * corner[1], 2 * far[0], 2 * far[1])))
        blobs.sort(key=lambda entry: -entry[0])
        return threshold, [box for _, box in blobs[:MAX_BLOBS]]

    def _hull(
        self, part: Pixels, background: tuple[Layer, Layer], threshold: float, scale: float
    ) -> tuple[float, Array] | None:
        """Return the area [px^2] and corners (n, 2) [px] of the largest convex hull of a blob.

        The result is None if the hull is too small or too large, or not redder than the seabed.

        Args:
            part: a part of the image around the blob, (h, w, 3).
            background: the score and the red of the seabed in this part, (h, w) each.
            threshold: the threshold of the score above the seabed.
            scale: the number of pixels in a metre of the seabed [px/m].
        """
        import cv2

        excess = cv2.blur(colour_score(part), (3, 3)) - background[0]
        orange = excess > threshold
        if not orange.any():
            return None
        layers = excess, part[:, :, 0] - background[1]
        score, red = (float(np.percentile(layer[orange], 90)) for layer in layers)
        if red < max(MIN_RED_FRACTION * score, MIN_RED):
            return None
        mask = self._close_gaps(orange, scale)
        contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
        hulls = [cv2.convexHull(contour) for contour in contours if len(contour) > 8]
        sized_hulls = [(float(cv2.contourArea(hull)), hull) for hull in hulls]
        if not sized_hulls:
            return None
        area, hull = max(sized_hulls, key=lambda entry: entry[0])
        if not (self._min_size * scale) ** 2 <= area <= (self._max_size * scale) ** 2:
            return None
        return area, hull[:, 0, :].astype(np.float64)

    def _close_gaps(self, mask: npt.NDArray[np.bool_], scale: float) -> Pixels:
        import cv2

        gap = max(int(self._band * scale) | 1, 3)
        kernel = np.ones((gap, gap), np.uint8)
        return cv2.morphologyEx(mask.astype(np.uint8), cv2.MORPH_CLOSE, kernel).astype(np.uint8)


def colour_score(image: Pixels) -> npt.NDArray[np.float32]:
    """Return the score ``2R - G - B`` of an RGB image (h, w, 3), (h, w)."""
    channels = image.astype(np.int16)
    score: npt.NDArray[np.float32] = (
        2 * channels[:, :, 0] - channels[:, :, 1] - channels[:, :, 2]
    ).astype(np.float32)
    return score


def outline_of(hull: Array, shape: tuple[int, ...], area: float, contrast: float) -> Outline:
    """Return the outline of a convex hull.

    Args:
        hull: the corners of the hull, which are centres of pixels, (n, 2) [px].
        shape: the shape of the image, which begins with (h, w).
        area: the area of the hull [px^2].
        contrast: the contrast of the outline; see `Outline`.
    """
    extents = product(hull, DIRECTIONS.T)  # (n, directions)
    ends = hull[extents.argmax(axis=0)]
    height, width = shape[:2]
    is_inside = (
        (ends[:, 0] >= BORDER_WIDTH)
        & (ends[:, 1] >= BORDER_WIDTH)
        & (ends[:, 0] <= width - 1 - BORDER_WIDTH)
        & (ends[:, 1] <= height - 1 - BORDER_WIDTH)
    )
    # The outline is a quarter of a pixel beyond the outermost pixel centres, along u and v.
    support = extents.max(axis=0) + 0.25 * np.abs(DIRECTIONS).sum(axis=1)
    widths = support + np.roll(support, N_DIRECTIONS // 2)
    longest_index = int(widths[: N_DIRECTIONS // 2].argmax())
    mean = hull.mean(axis=0)
    return Outline(
        support=support,
        is_known=is_inside,
        centre=(float(mean[0]), float(mean[1])),
        angle=float(_angles[longest_index]),
        area=area,
        contrast=contrast,
    )
