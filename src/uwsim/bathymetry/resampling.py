"""The cropping and resampling of a chart to a height grid in a scene's frame."""

from __future__ import annotations

import math

import numpy as np

from ..base.geodesy import Geodetic
from ..base.geometry import Array
from ..base.numerics.jit import njit
from ..errors import AssetError
from .chart import Chart
from .coordinates import Projection
from .height_grid import HeightGrid, Heights, check_size

BLOCK_ROWS = 64
"""The number of rows that are converted at once, which limits memory."""
ALIGNMENT = 1e-6
"""The greatest distance of aligned nodes, as a fraction of the spacing [1]."""
Crop = tuple[float, float, float, float]
"""The west, south, east and north limit in W [m]."""


def resample(
    chart: Chart, source: str, origin: Geodetic | None, crop: Crop | None, spacing: float | None
) -> HeightGrid:
    """Return the heights of a chart on a grid in W; NaN at nodes without a height.

    The grid has the nodes of the chart if it has the same axes and spacing. Otherwise heights are
    interpolated linearly between the four nodes of the chart around a point.

    Args:
        chart: the chart.
        source: its file, for errors.
        origin: the position on Earth of the origin of W; None: not known.
        crop: the limits of the grid; None: the largest rectangle within the chart.
        spacing: the distance between nodes [m]; None: that of the chart, the smaller of both axes.

    Raises:
        AssetError: the limits are outside the chart, or the grid is too large.
    """
    if origin is None and (middle := middle_of(chart, source)) is not None:
        latitude, longitude = (math.degrees(a) for a in (middle.latitude, middle.longitude))
        raise AssetError(
            f"{source}: has coordinates on Earth, {chart.system.description}; expected the origin "
            "of the scene, such as the middle of the chart: "
            f"<nedOrigin> <lat>{latitude:.6f}</lat> <lon>{longitude:.6f}</lon> </nedOrigin>."
        )
    projection = Projection(chart.system, origin, source)
    edges = _edges(chart, projection)
    chart_spacing = spacing_of(chart, projection)
    spacing = chart_spacing if spacing is None else spacing
    west, south, east, north = edges if crop is None else crop
    tolerance = 1e-6 * spacing
    if not (west < east and south < north) or (
        crop is not None
        and (
            west < edges[0] - tolerance
            or south < edges[1] - tolerance
            or east > edges[2] + tolerance
            or north > edges[3] + tolerance
        )
    ):
        raise AssetError(
            f"{source}: covers x {edges[0]:.6g} to {edges[2]:.6g} m and y {edges[1]:.6g} to "
            f"{edges[3]:.6g} m of the scene; expected limits within, not "
            f"{west:.6g} {south:.6g} {east:.6g} {north:.6g}."
        )
    columns = math.floor((east - west) / spacing + 1e-9) + 1
    rows = math.floor((north - south) / spacing + 1e-9) + 1
    check_size(rows, columns, source)
    if (
        projection.is_identity
        and (first_node := _find_aligned_node(chart, west, south, spacing)) is not None
    ):
        j, i = first_node
        heights = np.ascontiguousarray(chart.heights[i : i + rows, j : j + columns])
        west, south = chart.x + j * chart.step_x, chart.y + i * chart.step_y
    else:
        heights = _interpolate(chart, projection, (west, south, spacing), (rows, columns))
    return HeightGrid(west=west, south=south, spacing=spacing, heights=heights)


def spacing_of(chart: Chart, projection: Projection) -> float:
    """Return the smaller distance in W between nodes of a chart, in its middle [m]."""
    rows, columns = chart.shape
    x, y = chart.x + chart.step_x * (columns // 2), chart.y + chart.step_y * (rows // 2)
    if projection.is_identity:
        return min(chart.step_x, chart.step_y)
    points = projection.to_local(
        np.array([x, x + chart.step_x, x]), np.array([y, y, y + chart.step_y])
    )
    distances = [
        math.hypot(float(points[0][k] - points[0][0]), float(points[1][k] - points[1][0]))
        for k in (1, 2)
    ]
    return min(distances)


def _edges(chart: Chart, projection: Projection) -> Crop:
    """Return the limits in W of the largest rectangle within a chart's edges."""
    columns, rows = chart.columns(), chart.rows()
    x, y = np.full(len(rows), columns[0]), np.full(len(columns), rows[0])
    west = projection.to_local(x, rows)[0].max()
    east = projection.to_local(np.full(len(rows), columns[-1]), rows)[0].min()
    south = projection.to_local(columns, y)[1].max()
    north = projection.to_local(columns, np.full(len(columns), rows[-1]))[1].min()
    return float(west), float(south), float(east), float(north)


def _find_aligned_node(
    chart: Chart, west: float, south: float, spacing: float
) -> tuple[int, int] | None:
    """Return the column and row of a chart's node at a point; None if the grids differ."""
    if max(abs(chart.step_x - spacing), abs(chart.step_y - spacing)) > ALIGNMENT * spacing / max(
        chart.shape
    ):
        return None
    j, i = (west - chart.x) / spacing, (south - chart.y) / spacing
    if max(abs(j - round(j)), abs(i - round(i))) > ALIGNMENT:
        return None
    return round(j), round(i)


def _interpolate(
    chart: Chart,
    projection: Projection,
    frame: tuple[float, float, float],
    shape: tuple[int, int],
) -> Heights:
    """Return the heights at the nodes of a grid, (rows, columns) [m].

    Args:
        chart: the chart.
        projection: its relation to W.
        frame: the x and y of the first node, and the distance between nodes [m].
        shape: the number of rows and of columns.
    """
    west, south, spacing = frame
    rows, columns = shape
    heights = np.empty(shape, np.float32)
    x = west + spacing * np.arange(columns)
    chart_frame = np.array([chart.x, chart.y, chart.step_x, chart.step_y])
    for start in range(0, rows, BLOCK_ROWS):
        n = min(BLOCK_ROWS, rows - start)
        y = south + spacing * (start + np.arange(n))
        points = projection.from_local(np.tile(x, n), np.repeat(y, columns))
        interpolate_linearly(chart.heights, chart_frame, *points, heights[start : start + n])
    return heights


@njit
def interpolate_linearly(
    heights: Heights, frame: Array, x: Array, y: Array, values: Heights
) -> None:
    """Interpolate the heights of a chart at points; NaN outside and beside missing heights.

    Args:
        heights: the heights of the chart, (rows, columns) [m].
        frame: its first x and y, and its steps, (4,).
        x: the x of each point, (n,).
        y: the y of each point, (n,).
        values: receives the heights; n numbers in any shape of two axes [m].
    """
    rows, columns = heights.shape
    row_values = values.reshape(-1)
    tolerance = 1e-6
    for n in range(len(x)):
        u, v = (x[n] - frame[0]) / frame[2], (y[n] - frame[1]) / frame[3]
        row_values[n] = np.nan
        if not (-tolerance <= u <= columns - 1 + tolerance):
            continue
        if not (-tolerance <= v <= rows - 1 + tolerance):
            continue
        j, i = min(max(int(u), 0), columns - 2), min(max(int(v), 0), rows - 2)
        u, v = min(max(u - j, 0.0), 1.0), min(max(v - i, 0.0), 1.0)
        total = 0.0
        for k in range(4):
            row, column = k // 2, k % 2
            weight = (v if row else 1.0 - v) * (u if column else 1.0 - u)
            if weight > 0.0:
                total += weight * heights[i + row, j + column]
        row_values[n] = total


def middle_of(chart: Chart, source: str) -> Geodetic | None:
    """Return the position on Earth about which a chart has the least distortion.

    It is the centre of its orthographic projection, else its middle; None for local coordinates.
    """
    if chart.system.kind == "local":
        return None
    if chart.system.centre is not None:
        return chart.system.centre
    rows, columns = chart.shape
    any_origin = Geodetic(latitude=0.0, longitude=0.0)
    return Projection(chart.system, any_origin, source).geodetic_centre(
        chart.x + 0.5 * chart.step_x * (columns - 1), chart.y + 0.5 * chart.step_y * (rows - 1)
    )
