r"""The detection of a dark line of known width on bright ground, in an image.

A camera above level ground looks forward and down by the angle :math:`\tau`. The ray through a
pixel with the normalized coordinates :math:`x_n, y_n` meets the ground, h below the camera, at

.. math:: z = \frac{h}{\sin\tau + y_n \cos\tau}, \qquad
    x = z\,(\cos\tau - y_n \sin\tau), \qquad y = z\,x_n

forward and to starboard of the camera, at the depth z along its axis. In each band of rows a line
of width w covers :math:`f w / z` pixels. The contrast of a place is the mean brightness on both its
sides, of the same width, less that of the place. The place of greatest contrast is a candidate if
it exceeds ``threshold`` times the median of the magnitudes of the contrasts in the band. A straight
line in the ground that the greatest number of candidates lie near is then fitted to these by least
squares. Not modelled: the slope of the ground, roll and pitch, curvature of the line.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Intrinsics

N_BANDS = 20
"""The number of bands of rows."""
MAX_RANGE = 4.0
"""The greatest distance ahead at which the line is looked for [m]."""
MIN_CONTRAST = 2.0
"""The smallest contrast of a candidate [grey levels]."""


@dataclass(frozen=True)
class DetectedLine:
    """A line in the ground, in axes forward and to starboard of the camera."""

    offset: float
    """The place to starboard at which it crosses the axis abeam of the camera [m]."""
    slope: float
    """The distance to starboard that it gains in a metre forward [1]."""
    share: float
    """The share of the bands whose candidate lies near it [1]."""


@dataclass(frozen=True, kw_only=True)
class LineDetector:
    """A detector of a line in images of a camera that looks forward and down."""

    intrinsics: Intrinsics
    """The intrinsics of the camera."""
    tilt: float
    """The angle of the optical axis below the horizon [rad]."""
    width: float
    """The width of the line [m]."""
    threshold: float
    """The smallest contrast, in medians of the magnitudes of contrasts [1]."""
    min_share: float
    """The smallest share of bands with a candidate near the line [1]."""
    tolerance: float
    """The greatest distance of a candidate from the line [m]."""

    def detect(self, image: npt.NDArray[np.uint8], height: float) -> DetectedLine | None:
        """Find the line in an image (h, w, 3) from a height above the ground [m]; None if none."""
        grey = image.astype(np.int64).sum(axis=2)  # 0..765, (h, w)
        rows = grey.shape[0] // N_BANDS
        candidates = []
        for band in range(N_BANDS):
            strip = grey[band * rows : (band + 1) * rows].sum(axis=0)  # (w,)
            row = (band + 0.5) * rows - 0.5
            candidate = self._find_candidate(strip / (3.0 * rows), row, height)
            if candidate is not None:
                candidates.append(candidate)
        return self._fit(candidates)

    def _find_candidate(
        self, strip: Array, row: float, height: float
    ) -> tuple[float, float] | None:
        """Return the place forward and to starboard of the greatest contrast in a band [m]."""
        lens = self.intrinsics
        sine, cosine = math.sin(self.tilt), math.cos(self.tilt)
        row_slope = (row - lens.cy) / lens.fy
        drop = sine + row_slope * cosine  # of the ray, for each metre along the axis
        if drop <= 0.0:
            return None
        depth = height / drop
        forward = depth * (cosine - row_slope * sine)
        n = round(lens.fx * self.width / depth)
        if forward > MAX_RANGE or n < 3 or 3 * n >= len(strip):
            return None
        sums = np.concatenate([[0.0], np.cumsum(strip)])
        means = (sums[n:] - sums[:-n]) / n  # of n pixels from each on
        contrast = 0.5 * (means[: -2 * n] + means[2 * n :]) - means[n:-n]
        i = int(np.argmax(contrast))
        noise = float(np.median(np.abs(contrast)))
        if contrast[i] < max(MIN_CONTRAST, self.threshold * noise):
            return None
        column = i + n + (n - 1) / 2.0
        return forward, depth * (column - lens.cx) / lens.fx

    def _fit(self, candidates: list[tuple[float, float]]) -> DetectedLine | None:
        """Fit the line near which the greatest number of candidates lie."""
        largest_set: list[tuple[float, float]] = []
        for i, (x1, y1) in enumerate(candidates):
            for x2, y2 in candidates[i + 1 :]:
                slope = (y2 - y1) / (x2 - x1)
                if abs(slope) > MAX_SLOPE:
                    continue
                members = [
                    (x, y) for x, y in candidates if abs(y - y1 - slope * (x - x1)) < self.tolerance
                ]
                if len(members) > len(largest_set):
                    largest_set = members
        if len(largest_set) < max(3.0, self.min_share * N_BANDS):
            return None
        offset, slope = fit_line(largest_set)
        return DetectedLine(offset, slope, len(largest_set) / N_BANDS)


MAX_SLOPE = 3.0
"""The greatest slope of a line [1]."""


def fit_line(points: list[tuple[float, float]]) -> tuple[float, float]:
    """Return the offset [m] and the slope [1] of the least-squares line through places (x, y) [m].

    At least two of the places have different x.
    """
    n = len(points)
    mean_x, mean_y = sum(x for x, _ in points) / n, sum(y for _, y in points) / n
    square = sum((x - mean_x) ** 2 for x, _ in points)
    slope = sum((x - mean_x) * (y - mean_y) for x, y in points) / square
    return mean_y - slope * mean_x, slope
