r"""The directions of the rays of a ping, and the weights of each beam.

Rays are in columns of one azimuth. There are at least `COLUMNS_PER_BEAM_WIDTH` columns in the width
of a beam, whatever the spacing of the beams: beams that are close together share columns, and beams
that are far apart have several columns each, or columns of their own.

The rays of a column are closest in the middle of the beam. Their elevations e reach the first null
of the vertical pattern, or straight up and down:

.. math:: e(t) = c t + (H - c) t^5, \quad -1 < t < 1 ,

where :math:`c` is `CORE` times the vertical aperture, and :math:`H` the highest elevation.
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
"""The angle from the axis of a beam up to which it receives echoes, to either side, in beam
widths."""
COLUMNS_PER_BEAM_WIDTH = 2.5
"""The minimum number of columns in the width of a beam."""
MAX_COLUMN_SPACING = math.radians(3.0)
"""The greatest angle between two columns, which the glint of a smooth surface needs [rad]."""
CORE = 0.6
"""The vertical apertures up and down from the middle over which rows are about evenly spaced."""
LINE_WIDTH = 0.4429
"""The sine of the angle at which the pattern of a line array is -3 dB, times its length in wave
lengths."""


class RayGrid:
    """The rays of a ping in columns and rows.

    Args:
        spec: the spec of the sonar.
        azimuths: the azimuths of its beams, at equal steps, positive to port, (n,) [rad].
        step: the angle between beams, positive [rad]; for a single beam, the greatest angle between
            its columns.
        max_elevation: the elevation up to which there are rays [rad]; None for the first null.
    """

    def __init__(
        self, spec: SonarSpec, azimuths: Array, step: float, max_elevation: float | None = None
    ) -> None:
        width, aperture = math.radians(spec.beam_width), math.radians(spec.vertical_aperture)
        n_phases, self.stride, spacing = _columns(width, step, len(azimuths))
        n_side = max(1, math.ceil(MARGIN * width / spacing))
        n_taps = 2 * n_side + (2 if n_phases > 1 else 1)
        phases = np.arange(min(n_phases, len(azimuths)))
        offsets = np.arange(-n_side, n_taps - n_side) * spacing - phases[:, None] * step
        powers = [[beam_pattern(angle, width) for angle in line] for line in offsets.tolist()]
        self.patterns = np.array(powers, dtype=np.float32)
        """The patterns of the beams over neighbouring columns, as for `compute_amplitudes`."""
        if self.stride > n_taps:  # no two beams share a column
            self.stride = n_taps
            beam_columns = azimuths[:, None] + spacing * np.arange(-n_side, n_side + 1)
            self.azimuths: Array = beam_columns.reshape(-1)
        else:
            n = (len(azimuths) - 1) // n_phases * self.stride + n_taps
            self.azimuths = azimuths[0] + spacing * np.arange(-n_side, n - n_side)
        self.column_spacing = spacing
        """The angle between columns of one beam [rad]."""
        self.max_elevation = first_null(aperture) if max_elevation is None else max_elevation
        """The greatest elevation of a ray, up or down [rad]."""
        self._core = min(CORE * aperture, self.max_elevation)
        ts: Array = np.arange(spec.rows + 1, dtype=np.float64) * (2.0 / spec.rows) - 1.0
        edges = self._elevations(ts)
        elevations = self._elevations(0.5 * (ts[1:] + ts[:-1]))
        self._between_rows = 2.0 / spec.rows
        self.directions = _directions(self.azimuths, elevations)
        """The directions of the rays, sonar's frame, in the order of `add_echoes`, (n k, 3)."""
        pattern, ends = (
            np.array([line_pattern(angle, aperture) ** 4 for angle in angles.tolist()])
            for angles in (elevations, edges)
        )
        weights = pattern * np.cos(elevations) * np.diff(edges) * spacing
        rises = 0.5 * np.diff(ends) / np.maximum(pattern, 1e-12)
        self.rows = np.stack([weights, rises], axis=1)
        """The pattern times the solid angle of each row's rays [sr], and the fraction by which the
        pattern rises from its middle to its upper end, (k, 2)."""

    def _elevations(self, t: Array) -> Array:
        """Return the elevations e(t) at -1 < t < 1, of any shape [rad]."""
        square = t * t
        elevations: Array = t * (self._core + (self.max_elevation - self._core) * square * square)
        return elevations

    def spacing(self, elevation: Array) -> Array:
        """Return the greatest angle between adjacent rays at elevations (n,) [rad], (n,) [rad]."""
        rest, target = (
            self.max_elevation - self._core,
            np.minimum(np.abs(elevation), self.max_elevation),
        )
        t = target / self.max_elevation
        for _ in range(8):  # Newton's method; the polynomial rises everywhere
            fourth = (t * t) * (t * t)
            t = t - (t * (self._core + rest * fourth) - target) / (self._core + 5.0 * rest * fourth)
        rows = self._between_rows * (self._core + 5.0 * rest * (t * t) * (t * t))
        spacing: Array = np.maximum(rows, self.column_spacing)
        return spacing


def n_columns(beam_width: float, step: float, n_beams: int) -> int:
    """Return the number of columns of rays that a number of beams needs.

    Args:
        beam_width: the width of a beam at -3 dB [rad].
        step: the angle between beams [rad].
        n_beams: the number of beams.
    """
    n_phases, stride, spacing = _columns(beam_width, step, n_beams)
    n_taps = 2 * max(1, math.ceil(MARGIN * beam_width / spacing)) + 1
    return n_beams // n_phases * min(stride, n_taps)


def _columns(width: float, step: float, n_beams: int) -> tuple[int, int, float]:
    """Return the beams per column, the columns per beam, and the angle between columns [rad]."""
    max_spacing = min(width / COLUMNS_PER_BEAM_WIDTH, MAX_COLUMN_SPACING)
    n_phases = max(1, int(max_spacing / step))
    stride = 1 if n_beams == 1 else max(1, math.ceil(step / max_spacing - 1e-9))
    return n_phases, stride, (min(step, max_spacing) if n_beams == 1 else n_phases * step / stride)


def first_null(aperture: float) -> float:
    """Return the elevation of the first null of a line array [rad]; 90 degrees without a null."""
    sine = math.sin(0.5 * aperture) / LINE_WIDTH
    return math.asin(sine) if sine < 1.0 else 0.5 * math.pi


@njit
def beam_pattern(angle: float, width: float) -> float:
    """Return the power pattern of a beam of a width at -3 dB [rad]; 0 beyond `MARGIN`."""
    power: float = 2.0 ** (-((2.0 * angle / width) ** 2))
    return power if abs(angle) <= MARGIN * width * (1.0 + 1e-9) else 0.0


@njit
def line_pattern(angle: float, width: float) -> float:
    """Return the amplitude pattern of a uniform line array of a width at -3 dB [rad]."""
    u = math.pi * LINE_WIDTH * math.sin(angle) / math.sin(0.5 * width)
    amplitude: float = math.sin(u) / u if u != 0.0 else 1.0
    return amplitude


def _directions(azimuths: Array, elevations: Array) -> npt.NDArray[np.float64]:
    """Return unit vectors: x ahead, y to port, z up, in the order of `add_echoes`, (n k, 3)."""
    azimuth, elevation = np.meshgrid(azimuths, elevations)
    x, y = np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth)
    rows = np.stack([x, y, np.sin(elevation)], axis=2)
    blocks = [rows[:, k : k + BLOCK].reshape(-1, 3) for k in range(0, len(azimuths), BLOCK)]
    return np.concatenate(blocks)
