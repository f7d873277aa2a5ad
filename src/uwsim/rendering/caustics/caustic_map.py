r"""Maps of caustics: the sun's light below a tile of the moving surface, in several depths.

Each node of the tile sends a ray down, whose light is that which enters there (`refraction`). It
meets the plane in the depth :math:`d` at :math:`x + d\, u(s)`, and its light is divided among the
nine nearest texels by a quadratic spline (forward photon mapping; J. Arvo, *Backward Ray Tracing*,
SIGGRAPH 1986 course notes). Where the light of a ray spreads, by the sum of squares of the
derivatives of its place by the node, the ray is split into four, each of which falls on four
texels. Else dark cells of the pattern would show single rays. No light is lost, and the mean over
the tile is that below a level surface. Positions are relative to those below a level surface,
:math:`d\, u(0)`: the map at the point :math:`(p, d)` is looked up at :math:`p - d\, u(0)`, along
the refracted beam.

The sun's disc and ripples that are shorter than the tile's texels blur the map in the depth
:math:`d` by a Gaussian with the covariance :math:`d^2 (C_{disc} + \sigma^2 M M^T)`. It is left out
where its standard deviation is below `LEAST_BLUR`; the spline has one of 0.5 texels.

Not modelled: the height of the waves of the tile, which is small against the depth; the colours of
refraction; light that surfaces below reflect.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...base.numerics.elementwise import exp
from ...base.numerics.jit import njit
from ...base.numerics.linear import product
from ..physical.daylight_field import REFRACTIVE_INDEX
from .refraction import Beam, refract
from .wave_tile import N_NODES, NODE_SPACING, TILE_EDGE, ComplexGrid, TileWaves

MIN_DEPTH = 0.6
"""The least depth of a map [m]."""
FEW_SLICES, MANY_SLICES, MAX_RATIO = 4, 6, 2.1
"""The numbers of depths, and the largest ratio of successive ones of a few [1]."""

SHIFT = 8 * N_NODES
"""A number of texels that makes all places positive; it is a number of tiles."""
MAX_SPREAD = 3.5
"""The largest spread of the light of a ray that is not split: the sum of squares of four
derivatives, 2 below a level surface [1]."""
LEAST_BLUR, SMOOTH_BLUR = 0.6, 1.0
"""The standard deviations of the least blur that is computed, and of one that makes single rays
invisible [texels]."""
MAP_BLUR = 0.5
"""The standard deviation that a computed blur has in all directions, against overshoot [texels]."""

FloatMaps = npt.NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class CausticOptics:
    """The inputs of maps that do not change in time."""

    beam: Beam
    """The beam of the sun."""
    depths: tuple[float, ...]
    """The depths of the slices below the surface, rising by a constant factor [m]."""
    unresolved_slope: float
    """The standard deviation of slopes that the tile does not have [1]."""
    transfer: FloatMaps
    """The transfer of the blur in each of the last depths times the number of nodes, (blurred
    slices, rows, half the columns + 1). The slices before them have no blur."""
    max_spreads: tuple[float, ...]
    """The largest spread of the light of a ray that is not split in each depth [1]."""


def make_optics(beam: Beam, max_depth: float, unresolved_slope: float) -> CausticOptics:
    """Return the inputs of four or six maps down to a depth [m], which is that of the last."""
    n_slices = FEW_SLICES if max_depth <= MIN_DEPTH * MAX_RATIO ** (FEW_SLICES - 1) else MANY_SLICES
    ratio = (max_depth / MIN_DEPTH) ** (1.0 / (n_slices - 1))
    depths = tuple(MIN_DEPTH * ratio**i for i in range(n_slices))
    spread = product(beam.slope_matrix, beam.slope_matrix.T)
    covariance = beam.disc_covariance + unresolved_slope**2 * spread
    blur = math.sqrt(0.5 * float(covariance[0, 0] + covariance[1, 1])) / NODE_SPACING
    unit = 2.0 * math.pi / TILE_EDGE
    rows = unit * np.fft.fftfreq(N_NODES, 1.0 / N_NODES)[:, None]
    columns = unit * np.arange(N_NODES // 2 + 1)[None, :]
    form = (
        covariance[0, 0] * columns * columns
        + 2.0 * covariance[0, 1] * rows * columns
        + covariance[1, 1] * rows * rows
    )
    squares = np.array([depth**2 for depth in depths if depth * blur >= LEAST_BLUR])
    exponent = squares[:, None, None] * form + (MAP_BLUR * NODE_SPACING) ** 2 * (
        rows**2 + columns**2
    )
    transfer = N_NODES**2 * exp(np.maximum(-0.5 * exponent, -30.0))
    max_spreads = tuple(MAX_SPREAD if depth * blur < SMOOTH_BLUR else math.inf for depth in depths)
    return CausticOptics(beam, depths, unresolved_slope, transfer.astype(np.float32), max_spreads)


class CausticMapper:
    """A computation of maps of one beam, with its working memory.

    Args:
        optics: the beam, the depths and the blur.
    """

    def __init__(self, optics: CausticOptics) -> None:
        self.optics = optics
        """The beam, the depths and the blur."""
        shape = (N_NODES, N_NODES)
        self._slopes = np.zeros(shape, np.complex64)
        self._drifts = np.zeros((2, *shape), np.float32)
        self._lights = np.zeros(shape, np.float32)
        self._spreads = np.zeros((2, *shape), np.float32)
        self._maps = np.zeros((len(optics.depths), *shape), np.float32)
        self._spectra = np.zeros(optics.transfer.shape, np.complex64)

    def compute(self, waves: TileWaves, time: float) -> FloatMaps:
        """Compute the gain of the sun's beam minus 1 in each depth, (slices, rows, columns).

        The array is overwritten by the next call.

        Args:
            waves: the waves of the tile.
            time: the simulation time [s].
        """
        waves.compute_slopes(time, self._slopes)
        self.trace(self._slopes)
        spectra = self._spectra
        if len(spectra) > 0:
            maps = self._maps[-len(spectra) :]
            fft: Any = np.fft  # its types know no single precision
            # numpy is several times faster in single precision where it divides by the number
            fft.rfft(maps, axis=2, norm="forward", out=spectra)
            fft.fft(spectra, axis=1, norm="forward", out=spectra)
            spectra *= self.optics.transfer
            fft.ifft(spectra, axis=1, out=spectra)
            fft.irfft(spectra, n=N_NODES, axis=2, out=maps)
        self._maps -= np.float32(1.0)
        return self._maps

    def trace(self, slopes: ComplexGrid) -> FloatMaps:
        """Trace a ray from each node to each depth; return the gain, (slices, rows, columns).

        The array is overwritten by the next call.
        """
        beam, drifts, lights = self.optics.beam, self._drifts, self._lights
        spreads = self._spreads
        _refract_all(
            beam.towards_sun.astype(np.float32),
            beam.level_drift.astype(np.float32),
            slopes,
            np.float32(REFRACTIVE_INDEX),
            drifts,
            lights,
        )
        lights *= np.float32(slopes.size / lights.sum(dtype=np.float64))
        self._maps[:] = 0.0
        _compute_spreads(drifts, spreads)
        for level, depth, max_spread in zip(
            self._maps, self.optics.depths, self.optics.max_spreads, strict=True
        ):
            step = np.float32(depth / NODE_SPACING)
            _deposit(level, step, drifts, lights, spreads, np.float32(max_spread))
        return self._maps


@njit
def _refract_all(
    sun: FloatMaps,
    level_drift: FloatMaps,
    slopes: ComplexGrid,
    index: Any,
    drifts: FloatMaps,
    lights: FloatMaps,
) -> None:
    """Write the drift against that of a level surface, and the light of each ray."""
    towards_sun = (sun[0], sun[1], sun[2])
    level_x, level_y, unit = level_drift[0], level_drift[1], index / index
    n_rows, n_columns = slopes.shape
    for row in range(n_rows):
        row_slopes, row_lights = slopes[row], lights[row]
        row_x, row_y = drifts[0, row], drifts[1, row]
        for column in range(n_columns):
            slope = row_slopes[column]
            x, y, light = refract(towards_sun, slope.real, slope.imag, index, unit)
            row_x[column] = x - level_x
            row_y[column] = y - level_y
            row_lights[column] = light


@njit
def _compute_spreads(drifts: FloatMaps, spreads: FloatMaps) -> None:
    """Write the trace and the sum of squares of the derivatives of the drift by the node."""
    _, n_rows, n_columns = drifts.shape
    for row in range(n_rows):
        for column in range(n_columns):
            xx, yx, xy, yy = _compute_derivative(drifts, row, column)
            spreads[0, row, column] = xx + yy
            spreads[1, row, column] = xx * xx + yx * yx + xy * xy + yy * yy


@njit
def _compute_derivative(
    drifts: FloatMaps, row: int, column: int
) -> tuple[np.float32, np.float32, np.float32, np.float32]:
    """Compute the derivatives of the drift along x, then along y."""
    _, n_rows, n_columns = drifts.shape
    half = np.float32(0.5)
    left, right = (column - 1) & (n_columns - 1), (column + 1) & (n_columns - 1)
    row_before, row_after = (row - 1) & (n_rows - 1), (row + 1) & (n_rows - 1)
    return (
        half * (drifts[0, row, right] - drifts[0, row, left]),
        half * (drifts[1, row, right] - drifts[1, row, left]),
        half * (drifts[0, row_after, column] - drifts[0, row_before, column]),
        half * (drifts[1, row_after, column] - drifts[1, row_before, column]),
    )


@njit
def _deposit(
    level: FloatMaps,
    step: np.float32,
    drifts: FloatMaps,
    lights: FloatMaps,
    spreads: FloatMaps,
    max_spread: np.float32,
) -> None:
    """Add the light of each ray to the texels of a level; step is in texels."""
    n_rows, n_columns = lights.shape
    unit, double, shift = np.float32(1.0), np.float32(2.0), np.float32(SHIFT)
    for row in range(n_rows):
        for column in range(n_columns):
            x = np.float32(column) + step * drifts[0, row, column] + shift
            y = np.float32(row) + step * drifts[1, row, column] + shift
            spread = step * (double * spreads[0, row, column] + step * spreads[1, row, column])
            if double + spread < max_spread:
                _add_spline(level, x, y, lights[row, column])
            else:
                xx, yx, xy, yy = _compute_derivative(drifts, row, column)
                edges = unit + step * xx, step * yx, step * xy, unit + step * yy
                _add_tents(level, x, y, edges, lights[row, column])


@njit
def _add_spline(level: FloatMaps, x: np.float32, y: np.float32, light: np.float32) -> None:
    """Add light to the nine nearest texels."""
    n_rows, n_columns = level.shape
    half, three_quarters = np.float32(0.5), np.float32(0.75)
    x, y = x + half, y + half
    middle, centre = np.int32(x), np.int32(y)  # rounded down: x and y are positive
    u, v = x - np.float32(middle) - half, y - np.float32(centre) - half
    left_share, right_share = half * (half - u) * (half - u), half * (half + u) * (half + u)
    middle_share = three_quarters - u * u
    left = (middle - 1) & (n_columns - 1)
    right = (middle + 1) & (n_columns - 1)
    middle &= n_columns - 1
    share = light * half * (half - v) * (half - v)
    target = level[(centre - 1) & (n_rows - 1)]
    target[left] += share * left_share
    target[middle] += share * middle_share
    target[right] += share * right_share
    share = light * (three_quarters - v * v)
    target = level[centre & (n_rows - 1)]
    target[left] += share * left_share
    target[middle] += share * middle_share
    target[right] += share * right_share
    share = light * half * (half + v) * (half + v)
    target = level[(centre + 1) & (n_rows - 1)]
    target[left] += share * left_share
    target[middle] += share * middle_share
    target[right] += share * right_share


@njit
def _add_tents(
    level: FloatMaps,
    x: np.float32,
    y: np.float32,
    edges: tuple[np.float32, np.float32, np.float32, np.float32],
    light: np.float32,
) -> None:
    """Add a quarter of the light in each quarter of a parallelogram, to the four nearest texels."""
    n_rows, n_columns = level.shape
    quarter, unit = np.float32(0.25), np.float32(1.0)
    xx, yx, xy, yy = edges
    quarter_light = quarter * light
    for i in range(4):
        a = quarter if i & 1 else -quarter
        b = quarter if i & 2 else -quarter
        part_x, part_y = x + a * xx + b * xy, y + a * yx + b * yy
        left, low = np.int32(part_x), np.int32(part_y)
        u, v = part_x - np.float32(left), part_y - np.float32(low)
        right = (left + 1) & (n_columns - 1)
        left &= n_columns - 1
        lower, upper = level[low & (n_rows - 1)], level[(low + 1) & (n_rows - 1)]
        low_light, high_light = quarter_light * (unit - v), quarter_light * v
        lower[left] += low_light * (unit - u)
        lower[right] += low_light * u
        upper[left] += high_light * (unit - u)
        upper[right] += high_light * u
