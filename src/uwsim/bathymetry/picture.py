"""The picture of a chart: depth as colour, shaded relief, and contours."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..base.geometry import Array
from .height_grid import HeightGrid

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MAX_PIXELS = 900
"""The greatest number of rows and columns that are drawn."""
SUN = np.array([-0.5, 0.5, 0.70710678])
"""The direction of the light, from the north-west, 45 degrees high."""
CONTOUR_NODES = 120
"""The greatest number of nodes of contours along an axis."""
N_CONTOURS = 10
"""The number of contours, about."""


def draw_chart(grid: HeightGrid, title: str) -> Figure:
    """Draw a chart as a figure of matplotlib; x and y are those of the scene [m]."""
    from matplotlib import colormaps
    from matplotlib.colors import Normalize
    from matplotlib.figure import Figure
    from matplotlib.ticker import MaxNLocator

    step = max(1, math.ceil(max(grid.shape) / MAX_PIXELS))
    rows, columns = grid.shape
    part = grid.part(slice(0, rows), slice(0, columns), step)
    heights = part.heights.astype(np.float64)
    low, high = np.percentile(heights, [0.5, 99.5]).tolist()
    scale = Normalize(low, max(high, low + 1e-6))
    colours = colormaps["viridis"](scale(heights))[..., :3]
    exaggeration = min(10.0, max(1.0, 0.06 * max(grid.shape) * grid.spacing / (high - low + 1e-6)))
    shade = shaded_relief(heights * exaggeration, part.spacing)[..., None]
    image = np.clip(colours * (0.35 + 0.9 * shade), 0.0, 1.0)
    figure = Figure(figsize=(7.0, 6.0), layout="constrained")
    axes = figure.add_subplot()
    extent = (part.west, part.east, part.south, part.north)
    axes.imshow(image, origin="lower", extent=extent, interpolation="bilinear")
    levels = MaxNLocator(N_CONTOURS).tick_values(low, high)
    smooth_heights, width = _block_means(heights)
    x, y = (
        start + part.spacing * (width * np.arange(n) + 0.5 * (width - 1))
        for start, n in ((part.west, smooth_heights.shape[1]), (part.south, len(smooth_heights)))
    )
    contours = axes.contour(
        x, y, smooth_heights, levels=levels, colors="black", linewidths=0.5, alpha=0.7
    )
    axes.clabel(contours, fontsize=6, fmt="%g")
    axes.set(xlabel="x, east [m]", ylabel="y, north [m]", title=title)
    colour_map = axes.get_images()[0]
    colour_map.set_norm(scale)
    figure.colorbar(colour_map, ax=axes, label="height [m]", shrink=0.85)
    return figure


def _block_means(heights: Array) -> tuple[Array, int]:
    """Return the means of square blocks, for smooth contours, and the width of a block."""
    width = max(1, math.ceil(max(heights.shape) / CONTOUR_NODES))
    rows, columns = (n // width for n in heights.shape)
    blocks = heights[: rows * width, : columns * width].reshape(rows, width, columns, width)
    means: Array = blocks.mean(axis=(1, 3))
    return means, width


def shaded_relief(heights: Array, spacing: float) -> Array:
    """Return the brightness 0..1 of a surface under `SUN`, by Lambert's law, (rows, columns)."""
    slope_y, slope_x = np.gradient(heights, spacing)
    size = np.sqrt(1.0 + slope_x * slope_x + slope_y * slope_y)
    brightness: Array = (SUN[2] - SUN[0] * slope_x - SUN[1] * slope_y) / size
    return np.clip(brightness, 0.0, 1.0)
