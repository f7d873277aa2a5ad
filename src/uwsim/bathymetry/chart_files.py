"""Files with charts, by suffix."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ..base.files.input_files import read_bytes
from ..errors import AssetError
from . import esri_ascii, geotiff, netcdf, xyz
from .chart import Chart

READERS: dict[str, Callable[[Path, bytes], Chart]] = {
    ".asc": esri_ascii.read,
    ".tif": geotiff.read,
    ".tiff": geotiff.read,
    ".nc": netcdf.read,
    ".grd": netcdf.read,
    ".xyz": xyz.read,
    ".txt": xyz.read,
    ".csv": xyz.read,
}
"""The reader of each suffix."""
WRITERS: dict[str, Callable[[Path, Chart], None]] = {
    ".asc": esri_ascii.write,
    ".tif": geotiff.write,
    ".tiff": geotiff.write,
    ".nc": netcdf.write,
    ".grd": netcdf.write,
    ".xyz": xyz.write,
    ".txt": xyz.write,
    ".csv": xyz.write,
}
"""The writer of each suffix."""


def has_chart_format(path: Path) -> bool:
    """Return whether the suffix of a file is that of a chart."""
    return path.suffix.lower() in READERS


def read_chart(path: Path, data: bytes | None = None) -> Chart:
    """Read a chart.

    Args:
        path: the file.
        data: its bytes; None: they are read.

    Raises:
        AssetError: the file cannot be read, or is invalid.
    """
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        raise AssetError(_unknown_suffix(path))
    try:
        return reader(path, read_bytes(path) if data is None else data)
    except OSError as error:
        raise AssetError(f"{path}: cannot be read ({error.strerror or error}).") from error
    except MemoryError as error:
        raise AssetError(f"{path}: is larger than the memory.") from error


def write_chart(path: Path, chart: Chart) -> None:
    """Write a chart in the format of the file's suffix; raise AssetError for another suffix."""
    writer = WRITERS.get(path.suffix.lower())
    if writer is None:
        raise AssetError(_unknown_suffix(path))
    writer(path, chart)


def _unknown_suffix(path: Path) -> str:
    return f"{path}: the suffix is {path.suffix or 'missing'}; expected one of {', '.join(READERS)}"
