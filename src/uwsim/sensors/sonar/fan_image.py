r"""Grey images of echoes: levels in dB, and fans of beams seen from above.

Spreading and absorption are compensated (time-varying gain): an image shows the target strength
of what is in each bin, :math:`EL - SL + 2 (20 \log r + \alpha r)`, with the echo level EL, the
source level SL, the range r and the absorption :math:`\alpha`.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.elementwise import arctan2, log10
from .echoes import MICROPASCAL
from .kernel import Singles
from .spec import SonarSpec

Pixels = npt.NDArray[np.uint8]
MAX_PIXELS = 2048
"""The largest width or height of an image; pixels become larger to stay within it [px]."""


class GreyLevels:
    """A table of grey values by the level of an echo.

    Args:
        spec: the spec of the sonar.
        ranges: the middles of its range bins, (bins,) [m].
    """

    def __init__(self, spec: SonarSpec, ranges: Array) -> None:
        self._ranges = ranges
        self._spreading = 40.0 * log10(np.maximum(ranges, 1e-3)) - spec.source_level - MICROPASCAL
        # the floats by their high 16 bits, which are the indices of the table
        high_halves = (np.arange(1, 0x7F80, dtype=np.uint32) << 16).view(np.float32)
        level = 20.0 * log10(high_halves.astype(np.float64))
        grey = 255.0 * (level - spec.image_floor) / spec.image_range
        self._greys = np.zeros(0x10000, dtype=np.uint8)
        self._greys[1:0x7F80] = np.clip(np.round(grey), 0.0, 255.0).astype(np.uint8)

    def to_grey(self, amplitude: Singles, absorption: float) -> Pixels:
        """Return the grey values of amplitudes, (bins, n), with an error of at most 0.07 dB.

        Args:
            amplitude: the amplitude in each bin and beam, (bins, n) [Pa].
            absorption: the absorption of sound in the water [dB/m].
        """
        gain = self._spreading + 2.0 * absorption * self._ranges  # [dB]
        factors = np.array(
            [10.0 ** (0.05 * decibels) for decibels in gain.tolist()], dtype=np.float32
        )
        amplitudes = np.ascontiguousarray(amplitude * factors[:, None])
        greys: Pixels = self._greys[amplitudes.view(np.uint32) >> 16]
        return greys


class FanImage:
    """The bin of each pixel in an image of a fan: ahead is up, port is left.

    Args:
        azimuths: the azimuths of the beams, at equal steps, positive to port, (n,) [rad].
        ranges: the middles of the range bins, (bins,) [m].
    """

    def __init__(self, azimuths: Array, ranges: Array) -> None:
        bin_size = ranges[1] - ranges[0] if len(ranges) > 1 else 2.0 * ranges[0]
        max_range = ranges[-1] + 0.5 * bin_size
        arc = np.linspace(azimuths[0], azimuths[-1], 721)
        x, y = max_range * np.cos(arc), max_range * np.sin(arc)
        front, back = max(float(x.max()), 0.0), max(-float(x.min()), 0.0)
        port, starboard = max(float(y.max()), 0.0), max(-float(y.min()), 0.0)
        self.pixel = max(bin_size, (front + back) / MAX_PIXELS, (port + starboard) / MAX_PIXELS)
        """The size of a pixel [m]."""
        n_rows = max(1, math.ceil((front + back) / self.pixel))
        n_columns = max(1, math.ceil((port + starboard) / self.pixel))
        forward = front - self.pixel * (np.arange(n_rows) + 0.5)
        left = port - self.pixel * (np.arange(n_columns) + 0.5)
        x, y = np.meshgrid(forward, left, indexing="ij")
        bins = np.floor((np.sqrt(x * x + y * y) - ranges[0]) / bin_size + 0.5).astype(np.intp)
        step = azimuths[1] - azimuths[0] if len(azimuths) > 1 else 2.0 * math.pi
        positions = (arctan2(y, x) - azimuths[0]) / step
        full_turn = 2.0 * math.pi / abs(step)
        positions = np.where(positions < -0.5, positions + full_turn, positions)
        beams = np.floor(
            np.where(positions >= full_turn - 0.5, positions - full_turn, positions) + 0.5
        ).astype(np.intp)
        self._is_inside = (
            (bins >= 0) & (bins < len(ranges)) & (beams >= 0) & (beams < len(azimuths))
        )
        self._bin_indices = (bins * len(azimuths) + beams)[self._is_inside]

    def draw(self, greys: Pixels) -> Pixels:
        """Return the image (h, w) of grey values (bins, n), black outside the fan."""
        pixels = np.zeros(self._is_inside.shape, dtype=np.uint8)
        pixels[self._is_inside] = greys.reshape(-1)[self._bin_indices]
        return pixels
