r"""Directions of the rays of a ping, and how each beam weights them.

Rays are in columns of one azimuth. Columns are at most `COLUMNS_A_WIDTH` to the width of a beam
apart, whatever the spacing of the beams: beams that are close together share columns, and beams
that are far apart have several columns each, or columns of their own.

The rows of a column are closest in the middle of the beam. They reach the first null of the
vertical pattern, or straight up and down:

.. math:: e(t) = c t + (H - c) t^5, \quad -1 < t < 1 ,

with :math:`c` of `CORE` vertical apertures and the highest elevation :math:`H`.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.jit import njit
from .kernel import BLOCK
from .spec import SonarSpec

MARGIN = 1.25
"""A beam is summed up so many of its widths to either side."""
COLUMNS_A_WIDTH = 2.5
"""At least so many columns are in the width of a beam."""
WIDEST = math.radians(3.0)
"""The greatest distance of two columns, for the glint of a smooth surface [rad]."""
CORE = 0.6
"""Rows are evenly spaced over about so many vertical apertures up and down from the middle."""
LINE_WIDTH = 0.4429
"""Half width of a line array at half power is the arc sine of this, in wave lengths over length."""


class RayGrid:
    """The rays of a ping in columns and rows.

    Args:
        spec: of the sonar.
        azimuths: of its beams at equal steps, positive to port, (n,) [rad].
        step: between beams, positive; of a single beam any [rad].
        highest: elevation up to which there are rays [rad]; None for the first null.
    """

    def __init__(
        self, spec: SonarSpec, azimuths: Array, step: float, highest: float | None = None
    ) -> None:
        width, aperture = math.radians(spec.beam_width), math.radians(spec.vertical_aperture)
        n_phases, self.stride, apart = _columns(width, step, len(azimuths))
        n_side = max(1, math.ceil(MARGIN * width / apart))
        n_taps = 2 * n_side + (2 if n_phases > 1 else 1)
        phases = np.arange(min(n_phases, len(azimuths)))
        off = np.arange(-n_side, n_taps - n_side) * apart - phases[:, None] * step
        powers = [[beam_pattern(angle, width) for angle in line] for line in off.tolist()]
        self.patterns = np.array(powers, dtype=np.float32)
        """Of the beams over neighbouring columns, (phases, taps)."""
        if self.stride > n_taps:  # no two beams share a column
            self.stride = n_taps
            around = azimuths[:, None] + apart * np.arange(-n_side, n_side + 1)
            self.azimuths: Array = around.reshape(-1)
        else:
            n = (len(azimuths) - 1) // n_phases * self.stride + n_taps
            self.azimuths = azimuths[0] + apart * np.arange(-n_side, n - n_side)
        self.apart = apart
        """Between columns of one beam [rad]."""
        self.highest = first_null(aperture) if highest is None else highest
        """No ray is higher or lower [rad]."""
        self._core = min(CORE * aperture, self.highest)
        ts: Array = np.arange(spec.rows + 1, dtype=np.float64) * (2.0 / spec.rows) - 1.0
        edges = self._elevations(ts)
        elevations = self._elevations(0.5 * (ts[1:] + ts[:-1]))
        self._between_rows = 2.0 / spec.rows
        self.directions = _directions(self.azimuths, elevations)
        """Of the rays in the sonar's frame, in the order of `add_echoes`, (n k, 3)."""
        pattern, ends = (
            np.array([line_pattern(angle, aperture) ** 4 for angle in each.tolist()])
            for each in (elevations, edges)
        )
        weights = pattern * np.cos(elevations) * np.diff(edges) * apart
        rises = 0.5 * np.diff(ends) / np.maximum(pattern, 1e-12)
        self.rows = np.stack([weights, rises], axis=1)
        """Pattern times solid angle of the rays of each row [sr], and the share by which the
        pattern rises from its middle to its upper end, (k, 2)."""

    def _elevations(self, t: Array) -> Array:
        """Elevations at -1 < t < 1, any shape [rad]."""
        square = t * t
        found: Array = t * (self._core + (self.highest - self._core) * square * square)
        return found

    def spacing(self, elevation: Array) -> Array:
        """Greatest distance of neighbouring rays at some elevations (n,) [rad], (n,) [rad]."""
        rest, wanted = self.highest - self._core, np.minimum(np.abs(elevation), self.highest)
        t = wanted / self.highest
        for _ in range(8):  # Newton's method; the polynomial rises everywhere
            fourth = (t * t) * (t * t)
            t = t - (t * (self._core + rest * fourth) - wanted) / (self._core + 5.0 * rest * fourth)
        rows = self._between_rows * (self._core + 5.0 * rest * (t * t) * (t * t))
        found: Array = np.maximum(rows, self.apart)
        return found


def n_columns(beam_width: float, step: float, n_beams: int) -> int:
    """How many columns some beams need.

    Args:
        beam_width: between the points of half power [rad].
        step: between beams [rad].
        n_beams: how many there are.
    """
    n_phases, stride, apart = _columns(beam_width, step, n_beams)
    n_taps = 2 * max(1, math.ceil(MARGIN * beam_width / apart)) + 1
    return n_beams // n_phases * min(stride, n_taps)


def _columns(width: float, step: float, n_beams: int) -> tuple[int, int, float]:
    """Beams to a column, or columns from beam to beam; and the distance of columns [rad]."""
    finest = min(width / COLUMNS_A_WIDTH, WIDEST)
    n_phases = max(1, int(finest / step))
    stride = 1 if n_beams == 1 else max(1, math.ceil(step / finest - 1e-9))
    return n_phases, stride, (min(step, finest) if n_beams == 1 else n_phases * step / stride)


def first_null(aperture: float) -> float:
    """Elevation of the first null of a line array; straight up where it has none [rad]."""
    sine = math.sin(0.5 * aperture) / LINE_WIDTH
    return math.asin(sine) if sine < 1.0 else 0.5 * math.pi


@njit
def beam_pattern(angle: float, width: float) -> float:
    """Power of a beam that has half of it at half of ``width`` [rad]; 0 beyond the margin."""
    share: float = 2.0 ** (-((2.0 * angle / width) ** 2))
    return share if abs(angle) <= MARGIN * width * (1.0 + 1e-9) else 0.0


@njit
def line_pattern(angle: float, width: float) -> float:
    """Amplitude of a uniform line array that has half its power at half of ``width`` [rad]."""
    u = math.pi * LINE_WIDTH * math.sin(angle) / math.sin(0.5 * width)
    amplitude: float = math.sin(u) / u if u != 0.0 else 1.0
    return amplitude


def _directions(azimuths: Array, elevations: Array) -> npt.NDArray[np.float64]:
    """Unit vectors: x ahead, y to port, z up, in the order of `add_echoes`, (n k, 3)."""
    azimuth, elevation = np.meshgrid(azimuths, elevations)
    x, y = np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth)
    rows = np.stack([x, y, np.sin(elevation)], axis=2)
    blocks = [rows[:, k : k + BLOCK].reshape(-1, 3) for k in range(0, len(azimuths), BLOCK)]
    return np.concatenate(blocks)
