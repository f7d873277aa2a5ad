"""Tables of numbers in CSV files that a benchmark names: a line of names, then lines of numbers."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..assets.find import find
from ..base.files.input_files import read_bytes
from ..base.geometry import Array
from ..errors import AssetError, AssetNotFound, did_you_mean

MAX_BYTES = 64 * 2**20
"""The greatest size of a file."""
MAX_COLUMNS = 100
"""The greatest number of columns."""


@dataclass(frozen=True, eq=False)
class NumberTable:
    """The numbers of a file."""

    name: str
    """What the benchmark calls the file."""
    header: tuple[str, ...]
    """Names of the columns, without units."""
    rows: Array
    """The numbers, (n, columns); NaN in empty cells."""

    def columns(self, names: Sequence[str]) -> Array:
        """Return some columns, (n, len(names)); AssetError names the nearest of a missing one."""
        for name in names:
            if name not in self.header:
                near = did_you_mean(name, self.header)
                raise AssetError(
                    f"{self.name}: has no column {name!r}; it has {', '.join(self.header)}.{near}",
                    name=self.name,
                )
        return self.rows[:, [self.header.index(name) for name in names]]


def read_numbers(name: str, named_by: str, *, at_most: int) -> NumberTable:
    """Read a table; its hash becomes an input of the result.

    Args:
        name: of the file, relative to the folder of the file that names it.
        named_by: the benchmark file.
        at_most: the greatest number of lines.

    Raises:
        AssetNotFound: it is not in the folder of the benchmark.
        AssetError: it is no table of numbers, or is too large.
    """
    folder = Path(named_by).parent if named_by else Path()
    path = find(name, named_by=folder)
    if path is None:
        raise AssetNotFound(f"{name!r} is not in the folder of {Path(named_by).name}.", name=name)
    text = read_bytes(path, name=name, at_most=MAX_BYTES).decode("utf-8-sig", errors="replace")
    lines = csv.reader(io.StringIO(text))
    try:
        header = [cell.partition("[")[0].strip() for cell in next(lines, [])]
        if not header or len(header) > MAX_COLUMNS or len(set(header)) < len(header):
            raise AssetError(f"{name}:1: expected a line of different names.", name=name)
        rows: list[list[float]] = []
        for number, line in enumerate(lines, start=2):
            if not line:
                continue
            if len(rows) >= at_most:
                raise AssetError(f"{name}: has more than {at_most} lines.", name=name)
            rows.append(_numbers(name, number, line, len(header)))
    except csv.Error as error:
        raise AssetError(f"{name}: is no CSV file: {error}.", name=name) from None
    return NumberTable(
        name, tuple(header), np.array(rows, dtype=np.float64).reshape(-1, len(header))
    )


def _numbers(name: str, line: int, cells: Sequence[str], n: int) -> list[float]:
    """Return the numbers of a line; NaN for empty cells."""
    if len(cells) != n:
        raise AssetError(f"{name}:{line}: has {len(cells)} cells; expected {n}.", name=name)
    numbers = []
    for cell in cells:
        try:
            number = float(cell) if cell.strip() else math.nan
        except ValueError:
            number = math.inf
        if math.isinf(number):
            raise AssetError(f"{name}:{line}: {cell[:40]!r} is no finite number.", name=name)
        numbers.append(number)
    return numbers
