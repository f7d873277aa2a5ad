"""``summary.csv``: every level over all repeats.

.. code-block:: text

    fog [1/m],column,unit,n,mean,std,low,high,n_missing,n_ok,n_repeats,rate_low,rate_high,seeds
    0.0,corners,px,10,0.138,0.002,0.137,0.14,0,10,10,0.692,1.0,1 2 3 4 5 6 7 8 9 10

There is a line for the total and for each measure at each level. ``low`` and ``high`` are the 95 %
confidence limits of the mean, ``rate_low`` and ``rate_high`` the limits of the rate of repeats that
ended ``ok`` (``docs/statistics.md``). A field without a value is empty, such as the standard
deviation of one repeat.
"""

from __future__ import annotations

import csv
import io
from pathlib import Path

from .atomic_file import write_text
from .per_level import intervals_of, success_rates
from .result import Result
from .table import unit_of

FILE = "summary.csv"
HEADER = (
    "column", "unit", "n", "mean", "std", "low", "high", "n_missing",
    "n_ok", "n_repeats", "rate_low", "rate_high", "seeds",
)  # fmt: skip


def summary_text(result: Result) -> str:
    """Return the text of ``summary.csv``."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow([*(column.label for column in result.columns_of_kind("level")), *HEADER])
    level_rates = success_rates(result)
    columns = result.columns_of_kind("score") + result.columns_of_kind("measure")
    column_intervals = [intervals_of(result, column.name) for column in columns]
    for i, level_rate in enumerate(level_rates):
        success = level_rate.success
        rate_cells: tuple[object, ...] = ("", len(level_rate.seeds), "", "")
        if success is not None:
            rate_cells = (success.successes, success.n, success.low, success.high)
        seeds = " ".join(str(seed) for seed in level_rate.seeds if seed is not None)
        for column, entries in zip(columns, column_intervals, strict=True):
            entry = entries[i].interval
            numbers = (entry.n, entry.mean, entry.std, entry.low, entry.high)
            n_missing = entries[i].n_missing
            cells = (unit_of(result, column), *numbers, n_missing, *rate_cells, seeds)
            level = map(repr, level_rate.level)
            writer.writerow([*level, column.name, *("" if c is None else c for c in cells)])
    return stream.getvalue()


def save_summary(result: Result, directory: Path) -> Path:
    """Write ``summary.csv`` into the result directory atomically."""
    path = directory / FILE
    write_text(path, summary_text(result))
    return path
