r"""Maps of caustics: the sun's light below a tile of the moving surface, in several depths.

Each node of the tile sends a ray down, whose light is that which enters there (`refraction`). It
meets the plane in the depth :math:`d` at :math:`x + d\, u(s)`, and its light is divided among the
nine nearest texels by a quadratic spline (forward photon mapping; J. Arvo, *Backward Ray Tracing*,
SIGGRAPH 1986 course notes). So no light is lost, and the mean over the tile is that below a level
surface. Positions are relative to those below a level surface, :math:`d\, u(0)`: the map at the
point :math:`(p, d)` is looked up at :math:`p - d\, u(0)`, along the refracted beam.

The sun's disc and ripples that are shorter than the tile's texels blur the map in the depth
:math:`d` by a Gaussian with the covariance :math:`d^2 (C_{disc} + \sigma^2 M M^T)`. All maps have a
blur of half a texel against the pattern of the rays.

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

N_SLICES = 6
"""The number of depths."""
MIN_DEPTH = 0.6
"""The least of them [m]."""

SHIFT = 64 * N_NODES
"""A number of texels that makes all places positive; it is a number of tiles."""
MAP_BLUR = 0.5
"""The standard deviation of a blur of all maps against the pattern of the rays [texels]."""

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
    """The transfer of the blur in each depth times the number of nodes, (slices, rows, half the
    columns + 1)."""


def make_optics(beam: Beam, max_depth: float, unresolved_slope: float) -> CausticOptics:
    """Return the inputs of maps down to a depth [m]."""
    ratio = (max_depth / MIN_DEPTH) ** (1.0 / (N_SLICES - 1))
    depths = tuple(MIN_DEPTH * ratio**i for i in range(N_SLICES))
    spread = product(beam.slope_matrix, beam.slope_matrix.T)
    covariance = beam.disc_covariance + unresolved_slope**2 * spread
    unit = 2.0 * math.pi / TILE_EDGE
    rows = unit * np.fft.fftfreq(N_NODES, 1.0 / N_NODES)[:, None]
    columns = unit * np.arange(N_NODES // 2 + 1)[None, :]
    form = (
        covariance[0, 0] * columns * columns
        + 2.0 * covariance[0, 1] * rows * columns
        + covariance[1, 1] * rows * rows
    )
    squares = np.array(depths)[:, None, None] ** 2
    exponent = squares * form + (MAP_BLUR * NODE_SPACING) ** 2 * (rows**2 + columns**2)
    transfer = N_NODES**2 * exp(np.maximum(-0.5 * exponent, -30.0))
    return CausticOptics(beam, depths, unresolved_slope, transfer.astype(np.float32))


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
        maps, spectra = self._maps, self._spectra
        fft: Any = np.fft  # its types know no single precision
        # numpy is several times faster in single precision where it divides by the number of nodes
        fft.rfft(maps, axis=2, norm="forward", out=spectra)
        fft.fft(spectra, axis=1, norm="forward", out=spectra)
        spectra *= self.optics.transfer
        spectra[:, 0, 0] = 0.0
        fft.ifft(spectra, axis=1, out=spectra)
        fft.irfft(spectra, n=N_NODES, axis=2, out=maps)
        return maps

    def trace(self, slopes: ComplexGrid) -> FloatMaps:
        """Trace a ray from each node to each depth; return the gain, (slices, rows, columns).

        The array is overwritten by the next call.
        """
        beam, drifts, lights = self.optics.beam, self._drifts, self._lights
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
        for level, depth in zip(self._maps, self.optics.depths, strict=True):
            _deposit(level, np.float32(depth / NODE_SPACING), drifts, lights)
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
def _deposit(level: FloatMaps, step: np.float32, drifts: FloatMaps, lights: FloatMaps) -> None:
    """Add the light of each ray to the nine nearest texels of a level; step is in texels."""
    n_rows, n_columns = lights.shape
    half, three_quarters, shift = np.float32(0.5), np.float32(0.75), np.float32(SHIFT + 0.5)
    for row in range(n_rows):
        for column in range(n_columns):
            x = np.float32(column) + step * drifts[0, row, column] + shift
            y = np.float32(row) + step * drifts[1, row, column] + shift
            middle, centre = np.int32(x), np.int32(y)  # rounded down: x and y are positive
            u, v = x - np.float32(middle) - half, y - np.float32(centre) - half
            left_share, right_share = half * (half - u) * (half - u), half * (half + u) * (half + u)
            middle_share = three_quarters - u * u
            left = (middle - 1) & (n_columns - 1)
            right = (middle + 1) & (n_columns - 1)
            middle &= n_columns - 1
            light = lights[row, column]
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
