"""CSV: the rows of a result, one line for each level and repeat, with units in the head."""

from __future__ import annotations

import csv
from pathlib import Path

from ...results.atomic_file import atomic_write
from ...results.result_file import load
from .csv_tables import check_folder

RESULT_FILE = "result.json"


def is_result(path: Path) -> bool:
    """Return whether a path is a result directory, or its ``result.json``."""
    return path.name == RESULT_FILE or (path / RESULT_FILE).is_file()


def export_rows(result: Path, out: Path) -> int:
    """Write ``rows.csv``; return the number of rows.

    Raises:
        ResultError: the result cannot be read.
        BadSetting: the folder is not empty.
    """
    check_folder(out)
    stored_result = load(result)
    out.mkdir(parents=True, exist_ok=True)
    with (
        atomic_write(out / "rows.csv") as draft,
        draft.open("w", newline="", encoding="utf-8") as stream,
    ):
        table = csv.writer(stream, lineterminator="\n")
        table.writerow([column.label for column in stored_result.columns])
        for row in stored_result.rows:
            table.writerow(["" if cell is None else cell for cell in row])
    return len(stored_result.rows)
