"""Lists of soundings (``.xyz``, ``.txt``, ``.csv``): lines of x, y and z.

Numbers are separated by blanks, tabs or commas. Lines that begin with ``#``, and a first line of
names, are left out. The points are the nodes of a regular grid, in any order; nodes without a point
have no height. Scattered soundings are refused: GDAL's ``gdal_grid`` or GMT's ``surface`` grid
them. The coordinate system is that of a ``.prj`` file of the same name, if there is one.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..base.geometry import Array
from ..errors import AssetError
from .chart import Chart
from .esri_ascii import read_system, write_system
from .height_grid import check_size
from .number_text import parse_numbers

REGULARITY = 0.01
"""The greatest deviation of a point from a node, as a fraction of the step [1]."""


def read(path: Path, data: bytes) -> Chart:
    """Read a chart from the bytes of a list of points; raise AssetError."""
    start, line = 0, 1
    while start < len(data):
        end = data.find(b"\n", start)
        end = len(data) if end < 0 else end
        head = data[start : min(end, start + 200)].strip()
        is_names = line == 1 and head[:1].isalpha()
        if head and not head.startswith(b"#") and not is_names:
            break
        start, line = end + 1, line + 1
    values = parse_numbers(path, data[start:].replace(b",", b" "), line)
    if len(values) == 0 or len(values) % 3:
        raise AssetError(f"{path}: has {len(values)} numbers; expected x, y and z in each line.")
    points = values.reshape(-1, 3)
    (x, step_x, columns), (y, step_y, rows) = (
        _regular_axis(path, name, points[:, k]) for k, name in enumerate("xy")
    )
    check_size(rows, columns, str(path))
    j, i = (points[:, 0] - x) / step_x, (points[:, 1] - y) / step_y
    column, row = np.rint(j).astype(np.int64), np.rint(i).astype(np.int64)
    if np.abs(j - column).max() > REGULARITY or np.abs(i - row).max() > REGULARITY:
        raise AssetError(f"{path}: {_NO_GRID_ADVICE}")
    heights = np.full((rows, columns), np.nan, np.float32)
    heights[row, column] = points[:, 2]
    return Chart(x=x, y=y, step_x=step_x, step_y=step_y, heights=heights, system=read_system(path))


_NO_GRID_ADVICE = (
    "its points are no regular grid; expected x and y at equal steps. Grid the soundings first, "
    "for example with `gdal_grid` or `gmt surface`."
)


def _regular_axis(path: Path, name: str, values: Array) -> tuple[float, float, int]:
    """Return the least coordinate, the step and the number of nodes along an axis."""
    sorted_values = np.unique(values)
    extent = float(sorted_values[-1] - sorted_values[0])
    steps = np.diff(sorted_values)
    steps = steps[steps > 1e-9 * extent]
    if not len(steps):
        raise AssetError(f"{path}: all points have the same {name}; expected a grid.")
    min_step = float(steps.min())
    n = round(extent / min_step) + 1
    if n > 4 * len(sorted_values) + 4:
        raise AssetError(f"{path}: {_NO_GRID_ADVICE}")
    return float(sorted_values[0]), extent / (n - 1), n


def write(path: Path, chart: Chart) -> None:
    """Write the nodes of a chart that have a height, from south to north."""
    columns = chart.columns().tolist()
    with path.open("w", encoding="ascii") as file:
        for y, heights in zip(chart.rows().tolist(), chart.heights.tolist(), strict=True):
            for x, z in zip(columns, heights, strict=True):
                if z == z:
                    file.write(f"{x!r} {y!r} {z:.9g}\n")
    write_system(path, chart.system)
