r"""Statistics of a chart: heights, slopes, and the exponent of its spectrum.

The two-dimensional spectrum is estimated from the heights without their mean plane, under a window
of Hann on both axes, as the mean over rings of the wavenumber k. The exponent :math:`\gamma` of
:math:`P(k) \propto k^{-\gamma}` is fitted to the logarithms of the rings between the wavelengths
of `MAX_WAVELENGTH` and `MIN_WAVELENGTH` nodes. Slopes are those between neighbours.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array
from ..base.numerics.elementwise import log10
from .height_grid import HeightGrid

MIN_WAVELENGTH, MAX_WAVELENGTH = 4.0, 40.0
"""The wavelengths between which the exponent is fitted, as multiples of the spacing [1]."""
N_RINGS = 24
"""The number of rings between these wavelengths."""
MAX_SIDE = 2048
"""The greatest number of rows and columns, in the middle of a chart, whose spectrum is computed."""


@dataclass(frozen=True, kw_only=True)
class ChartStatistics:
    """The statistics of a chart."""

    least_height: float
    """The height of the deepest node, z up [m]."""
    greatest_height: float
    """The height of the shallowest node [m]."""
    mean_height: float
    """The mean height [m]."""
    rms_height: float
    """The root mean square of the heights about their mean plane [m]."""
    mean_slope: float
    """The slope of the mean plane [deg]."""
    rms_slope: float
    """The root mean square of the slope, as the angle of its tangent [deg]."""
    exponent: float | None
    """The exponent of the two-dimensional spectrum; None: the chart is too small or flat."""


def compute_statistics(grid: HeightGrid) -> ChartStatistics:
    """Compute the statistics of a height grid without holes."""
    heights = grid.heights.astype(np.float64)
    low, high = grid.height_range
    rest, slope_x, slope_y = remove_plane(heights)
    along_x, along_y = np.diff(heights, axis=1), np.diff(heights, axis=0)
    square = float((along_x * along_x).mean()) + float((along_y * along_y).mean())
    return ChartStatistics(
        least_height=low,
        greatest_height=high,
        mean_height=float(heights.mean()),
        rms_height=math.sqrt(float((rest * rest).mean())),
        mean_slope=_degrees(math.hypot(slope_x, slope_y) / grid.spacing),
        rms_slope=_degrees(math.sqrt(square) / grid.spacing),
        exponent=find_exponent(rest),
    )


def remove_plane(heights: Array) -> tuple[Array, float, float]:
    """Return heights without the plane of least squares, and its rises per column and per row."""
    rows, columns = heights.shape
    x = np.arange(columns) - 0.5 * (columns - 1)
    y = np.arange(rows) - 0.5 * (rows - 1)
    slope_x = float((heights * x).sum() / (rows * (x * x).sum()))
    slope_y = float((heights * y[:, None]).sum() / (columns * (y * y).sum()))
    return heights - heights.mean() - slope_x * x - slope_y * y[:, None], slope_x, slope_y


def find_exponent(heights: Array) -> float | None:
    """Return the exponent of the spectrum of heights without a plane; None without a fit."""
    rows, columns = (min(n, MAX_SIDE) for n in heights.shape)
    if min(rows, columns) < 2.0 * MAX_WAVELENGTH:
        return None
    i, j = (heights.shape[0] - rows) // 2, (heights.shape[1] - columns) // 2
    windows = [
        0.5 - 0.5 * np.cos(2.0 * math.pi * (np.arange(n) + 0.5) / n) for n in (rows, columns)
    ]
    part = heights[i : i + rows, j : j + columns] * windows[0][:, None] * windows[1]
    transform = np.fft.rfft2(part)
    spectrum = transform.real**2 + transform.imag**2
    k_y, k_x = np.fft.fftfreq(rows)[:, None], np.fft.rfftfreq(columns)
    wavenumber = np.sqrt(k_x * k_x + k_y * k_y)  # in cycles per node
    first, step = -math.log10(MAX_WAVELENGTH), math.log10(MAX_WAVELENGTH / MIN_WAVELENGTH) / N_RINGS
    wavenumber[0, 0] = 1.0
    ring = np.floor((log10(wavenumber) - first) / step).astype(np.int64)
    is_inside = (ring >= 0) & (ring < N_RINGS)
    sums = np.bincount(ring[is_inside], spectrum[is_inside], N_RINGS)
    counts = np.bincount(ring[is_inside], minlength=N_RINGS)
    has_power = (counts > 0) & (sums > 0.0)
    if has_power.sum() < N_RINGS // 2:
        return None
    x = first + step * (np.arange(N_RINGS)[has_power] + 0.5)
    y = log10(sums[has_power] / counts[has_power])
    x = x - x.mean()
    return -float((x * (y - y.mean())).sum() / (x * x).sum())


def _degrees(tangent: float) -> float:
    return math.degrees(math.atan(tangent))
