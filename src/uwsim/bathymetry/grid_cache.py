"""The caches of height grids: in memory, and on disk, as a large chart is parsed in seconds.

The key on disk is the hash of the bytes of the files, of the settings, and of the code that reads
them. The bytes of the files are read in any case, so that they are recorded as inputs of a run.
"""

from __future__ import annotations

import hashlib
import io
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..base.files import disk_cache
from ..base.files.code_digest import code_digest
from ..base.files.input_files import InputFile, file_stamps, record, record_inputs
from .height_grid import HeightGrid

CACHE_SIZE = 4
"""The number of height grids in memory."""
PACKAGES = ("numpy", "numba", "scipy")
_ARRAYS = ("west", "south", "spacing", "heights", "classes")


class _Entry(NamedTuple):
    stamps: tuple[tuple[int, int], ...]
    files: tuple[InputFile, ...]
    grid: HeightGrid


_cache: dict[object, _Entry] = {}


def cached_grid(
    key: object, read_files: Callable[[], bytes], build: Callable[[bytes], HeightGrid]
) -> HeightGrid:
    """Return a height grid, from memory or disk if possible.

    Args:
        key: the settings, which can be hashed and have a unique ``repr``.
        read_files: reads the main file by `read_bytes`, and other files on which the grid depends.
        build: makes the grid of the bytes of the main file.
    """
    entry = _cache.get(key)
    if entry is not None and entry.stamps == file_stamps(entry.files):
        record(entry.files)
        return entry.grid
    with record_inputs() as files:
        data = read_files()
    hashes = [file.sha256 for file in files]
    text = f"{key!r} {hashes}"
    folder = Path(__file__).parent
    digest = hashlib.sha256(code_digest([folder, folder.parent / "base"], PACKAGES) + text.encode())
    file = disk_cache.cache_folder("bathymetry") / f"{digest.hexdigest()[:32]}.npz"
    stored_bytes = disk_cache.read(file)
    grid = build(data) if stored_bytes is None else _from_bytes(stored_bytes)
    if stored_bytes is None:
        disk_cache.write(file, _to_bytes(grid))
    while len(_cache) >= CACHE_SIZE:
        del _cache[next(iter(_cache))]
    _cache[key] = _Entry(file_stamps(files), tuple(files), grid)
    return grid


def _to_bytes(grid: HeightGrid) -> bytes:
    arrays = {
        name: np.asarray(value) for name in _ARRAYS if (value := getattr(grid, name)) is not None
    }
    buffer = io.BytesIO()
    np.savez(buffer, **arrays)  # type: ignore[arg-type]  # none is called allow_pickle
    return buffer.getvalue()


def _from_bytes(data: bytes) -> HeightGrid:
    with np.load(io.BytesIO(data), allow_pickle=False) as archive:
        arrays = dict(archive)
    return HeightGrid(
        west=float(arrays["west"]),
        south=float(arrays["south"]),
        spacing=float(arrays["spacing"]),
        heights=arrays["heights"],
        classes=arrays.get("classes"),
    )
