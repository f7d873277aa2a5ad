"""Tables of numbers in the CSV files of a benchmark: a line of column names, then of numbers."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..assets.find import find
from ..base.files.input_files import read_bytes
from ..base.geometry import Array
from ..errors import AssetError, AssetNotFound, did_you_mean

MAX_BYTES = 64 * 2**20
"""The greatest size of a file [byte]."""
MAX_COLUMNS = 100
"""The greatest number of columns."""


@dataclass(frozen=True, eq=False)
class NumberTable:
    """The columns of numbers in a CSV file."""

    name: str
    """The name of the CSV file as written in the benchmark file."""
    header: tuple[str, ...]
    """The names of the columns, without units."""
    units: tuple[str, ...]
    """The units of the columns (``m`` for the title ``x [m]``); empty for a title without unit."""
    rows: Array
    """The numbers, (n, columns); NaN for a cell that is empty or has no finite number."""
    invalid_cells: Mapping[int, str]
    """The error message for the first invalid cell of a column, by the index of the column."""

    def columns(self, names: Sequence[str], unit: str = "") -> Array:
        """Return the columns with these names, (n, len(names)).

        Args:
            names: the names of the columns.
            unit: the unit that the columns must have, if the file states their units; empty: any.

        Raises:
            AssetError: a column is missing, has another unit, or has a cell that is neither a
                finite number nor empty.
        """
        for name in names:
            if name not in self.header:
                near = did_you_mean(name, self.header)
                raise AssetError(
                    f"{self.name}: has no column {name!r}; it has {', '.join(self.header)}.{near}",
                    name=self.name,
                )
        indices = [self.header.index(name) for name in names]
        for index in indices:
            if unit and self.units[index] not in ("", unit):
                raise AssetError(
                    f"{self.name}: the column {self.header[index]!r} is in "
                    f"{self.units[index][:20]!r}; expected [{unit}].",
                    name=self.name,
                )
            if index in self.invalid_cells:
                raise AssetError(self.invalid_cells[index], name=self.name)
        return self.rows[:, indices]


def read_numbers(name: str, named_by: str, *, max_rows: int) -> NumberTable:
    """Read a table; the hash of the file is recorded among the inputs of the result.

    Args:
        name: the name of the CSV file, relative to the folder of the benchmark file.
        named_by: the path of the benchmark file.
        max_rows: the greatest number of lines with numbers.

    Raises:
        AssetNotFound: the CSV file is not in the folder of the benchmark file.
        AssetError: the CSV file is no table of numbers, or is too large.
    """
    folder = Path(named_by).parent if named_by else Path()
    path = find(name, named_by=folder)
    if path is None:
        raise AssetNotFound(f"{name!r} is not in the folder of {Path(named_by).name}.", name=name)
    text = read_bytes(path, name=name, at_most=MAX_BYTES).decode("utf-8-sig", errors="replace")
    lines = csv.reader(io.StringIO(text))
    try:
        titles = [cell.partition("[") for cell in next(lines, [])]
        header = [title.strip() for title, _, _ in titles]
        units = tuple(unit.partition("]")[0].strip() for _, _, unit in titles)
        if not header or len(header) > MAX_COLUMNS or len(set(header)) < len(header):
            raise AssetError(f"{name}:1: expected a line of different names.", name=name)
        rows: list[list[float]] = []
        errors: dict[int, str] = {}
        for number, line in enumerate(lines, start=2):
            if not line:
                continue
            if len(rows) >= max_rows:
                raise AssetError(f"{name}: has more than {max_rows} lines.", name=name)
            if len(line) != len(header):
                raise AssetError(
                    f"{name}:{number}: has {len(line)} cells; expected {len(header)}.", name=name
                )
            rows.append([_number(cell) for cell in line])
            for index in (i for i, value in enumerate(rows[-1]) if math.isinf(value)):
                rows[-1][index] = math.nan
                cell = f"{line[index][:40]!r} is no finite number"
                errors.setdefault(index, f"{name}:{number}: {cell} (column {header[index]}).")
    except csv.Error as error:
        raise AssetError(f"{name}: is no CSV file: {error}.", name=name) from None
    numbers = np.array(rows, dtype=np.float64).reshape(-1, len(header))
    return NumberTable(name, tuple(header), units, numbers, errors)


def _number(cell: str) -> float:
    """Return the number of a cell; NaN for an empty one, infinite for an invalid one."""
    try:
        return float(cell) if cell.strip() else math.nan
    except ValueError:
        return math.inf
