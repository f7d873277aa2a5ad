r"""The detection of objects on the bottom in pings of an imaging sonar.

The echo of a level bottom depends on the range only. The contrast of a cell is its amplitude over
the median of all beams at its range. The mean of the contrast over ``window`` cells in range and
azimuth reduces the speckle. Cells above ``threshold`` that touch one another are an echo; its place
is that of the greatest mean contrast. Ranges below ``min_range`` are left out: there the bottom is
below the beams, so that the median is noise.

Not modelled: shadows as evidence, slopes of the bottom, the strength of echoes in absolute units.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...base.geometry import Array
from ...base.numerics.opencv import deterministic_opencv


@dataclass(frozen=True)
class Echo:
    """An echo that is stronger than the bottom at its range."""

    range: float
    """The range [m]."""
    azimuth: float
    """The azimuth, positive to starboard [rad]."""
    contrast: float
    """The greatest mean contrast [1]."""


@dataclass(frozen=True, kw_only=True)
class EchoDetector:
    """A detector of echoes in a ping."""

    threshold: float
    """The smallest mean contrast of an echo [1]."""
    min_range: float
    """The smallest range of an echo [m]."""
    window: int = 3
    """The number of bins and of beams over which contrasts are averaged."""

    @deterministic_opencv()
    def detect(self, amplitudes: Array, ranges: Array, azimuths: Array) -> list[Echo]:
        """Find the echoes in a ping, the strongest first.

        Args:
            amplitudes: the amplitude in each bin and beam, (bins, beams) [Pa].
            ranges: the middles of the bins, (bins,) [m].
            azimuths: the azimuths of the beams, positive to starboard, (beams,) [rad].
        """
        import cv2

        is_far = ranges >= self.min_range
        amplitudes, ranges = amplitudes[is_far], ranges[is_far]
        median = np.median(amplitudes, axis=1, keepdims=True)
        contrast = (amplitudes / np.maximum(median, 1e-12)).astype(np.float32)
        mean = cv2.blur(contrast, (self.window, self.window))
        n, labels, _, _ = cv2.connectedComponentsWithStats((mean > self.threshold).astype(np.uint8))
        echoes = []
        for label in range(1, n):
            peaks = np.where(labels == label, mean, 0.0)
            i, j = np.unravel_index(int(np.argmax(peaks)), peaks.shape)
            echoes.append(Echo(float(ranges[i]), float(azimuths[j]), float(mean[i, j])))
        return sorted(echoes, key=lambda echo: -echo.contrast)
