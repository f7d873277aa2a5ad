"""ESRI ASCII grids (``.asc``): a header, then rows of heights from north to south.

.. code-block:: text

    ncols 4
    nrows 3
    xllcorner 0
    yllcorner 0
    cellsize 5
    NODATA_value -9999
    -10.1 -10.2 -10.4 -10.3
    ...

A value is that of the centre of its cell. GDAL's ``dx`` and ``dy`` may replace ``cellsize``. A file
of the same name with the suffix ``.prj`` has the coordinate system as a WKT; without one,
coordinates are metres of the scene.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..base.files.input_files import read_bytes
from ..errors import AssetError
from .chart import Chart
from .coordinates import LOCAL_SYSTEM, CoordinateSystem, parse_wkt, wkt_of
from .height_grid import check_size
from .number_text import parse_numbers

NO_DATA = -9999.0
"""The value of nodes without a height in files that are written, and by default in those read."""
_KEYS = (
    *("ncols", "nrows", "xllcorner", "yllcorner", "xllcenter", "yllcenter"),
    *("cellsize", "dx", "dy", "nodata_value"),
)
MAX_HEADER_LINES = 12
MAX_PRJ_BYTES = 100_000


def read(path: Path, data: bytes) -> Chart:
    """Read a chart from the bytes of an ESRI ASCII grid; raise AssetError."""
    header, start, line = _read_header(path, data)
    missing_keys = [key for key in ("ncols", "nrows") if key not in header]
    if missing_keys or not ("cellsize" in header or {"dx", "dy"} <= set(header)):
        raise AssetError(
            f"{path}: its header lacks {(missing_keys or ['cellsize'])[0]}; expected ncols, nrows, "
            "xllcorner, yllcorner and cellsize."
        )
    columns, rows = (_whole_number(path, key, header[key]) for key in ("ncols", "nrows"))
    step_x, step_y = (header.get(key, header.get("cellsize", 0.0)) for key in ("dx", "dy"))
    if not (step_x > 0.0 and step_y > 0.0):
        raise AssetError(f"{path}: cellsize is {step_x:g}; expected a number above 0.")
    check_size(rows, columns, str(path))
    values = parse_numbers(path, data[start:], line, rows * columns)
    heights = values.astype(np.float32).reshape(rows, columns)[::-1]
    heights = np.ascontiguousarray(heights)
    heights[heights == np.float32(header.get("nodata_value", NO_DATA))] = np.nan
    x = header.get("xllcenter", header.get("xllcorner", 0.0) + 0.5 * step_x)
    y = header.get("yllcenter", header.get("yllcorner", 0.0) + 0.5 * step_y)
    return Chart(x=x, y=y, step_x=step_x, step_y=step_y, heights=heights, system=read_system(path))


def read_system(path: Path) -> CoordinateSystem:
    """Return the coordinate system in the ``.prj`` file beside a file; local without one."""
    file = path.with_suffix(".prj")
    if not file.is_file():
        return LOCAL_SYSTEM
    text = read_bytes(file, at_most=MAX_PRJ_BYTES).decode("utf-8", errors="replace")
    return parse_wkt(text)


def write(path: Path, chart: Chart) -> None:
    """Write a chart, and its coordinate system beside it."""
    rows, columns = chart.shape
    step_x, step_y = float(chart.step_x), float(chart.step_y)
    x, y = float(chart.x) - 0.5 * step_x, float(chart.y) - 0.5 * step_y
    size = f"cellsize {step_x!r}" if step_x == step_y else f"dx {step_x!r}\ndy {step_y!r}"
    with path.open("w", encoding="ascii") as file:
        file.write(f"ncols {columns}\nnrows {rows}\nxllcorner {x!r}\nyllcorner {y!r}\n{size}\n")
        file.write(f"NODATA_value {NO_DATA:g}\n")
        for row in chart.heights[::-1]:
            texts = ["-9999" if value != value else f"{value:.9g}" for value in row.tolist()]
            file.write(" ".join(texts) + "\n")
    write_system(path, chart.system)


def write_system(path: Path, system: CoordinateSystem) -> None:
    """Write the ``.prj`` file beside a file, unless coordinates are local."""
    if wkt := wkt_of(system):
        path.with_suffix(".prj").write_text(wkt + "\n", encoding="utf-8")


def _read_header(path: Path, data: bytes) -> tuple[dict[str, float], int, int]:
    """Return the numbers of the header, the first byte after it, and the number of that line."""
    header: dict[str, float] = {}
    start = 0
    for line in range(1, MAX_HEADER_LINES + 1):
        end = data.find(b"\n", start)
        end = len(data) if end < 0 else end
        words = data[start : min(end, start + 200)].decode("ascii", errors="replace").split()
        key = words[0].lower() if words else ""
        if key and (key[0].isdigit() or key[0] in "+-."):
            return header, start, line
        if words and (len(words) != 2 or key not in _KEYS):
            raise AssetError(
                f"{path}:{line}: {' '.join(words)[:60]!r}; expected one of {', '.join(_KEYS)} with "
                "its number, or heights."
            )
        if words:
            try:
                header[key] = float(words[1])
            except ValueError as error:
                raise AssetError(
                    f"{path}:{line}: {key} is {words[1]!r}; expected a number."
                ) from error
        start = end + 1
        if start >= len(data):
            break
    raise AssetError(f"{path}: has no heights after its header; is it an ESRI ASCII grid?")


def _whole_number(path: Path, key: str, value: float) -> int:
    if not (value == int(value) if abs(value) < 1e12 else False):
        raise AssetError(f"{path}: {key} is {value:g}; expected a whole number.")
    return int(value)
