"""Checks the rows of a result against the journals of its trials.

``result.json`` is collected from the journals of the trials (`journal`). Where they are in the same
directory, every row has to agree with them. A result without journals can be read, but is not
checked.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from ..errors import ResultError
from .journal import FOLDER, read_any
from .leaves import leaves
from .result import Cell, Column, Result
from .stored.stored_row import Measured, StoredRow

Key = tuple[Cell, ...]
"""The seed of a row, then its levels."""
SHOWN = 3
"""Greatest number of contradictions listed."""


@dataclass(frozen=True)
class Journals:
    """The journals of all trials of a result."""

    rows: dict[Key, tuple[StoredRow, float]]
    """What is stored of each level, and the time since its seed began [s]."""
    ended: tuple[Key, ...]
    """Those of finished trials."""
    n_ended: int
    """How many trials are finished."""


def check_rows(result: Result, directory: Path) -> str | None:
    """Compare every row of a result with the journal of its trial.

    Args:
        result: as it was read.
        directory: where it was read.

    Returns:
        What was not checked, and why; None where every row agrees with its journal.

    Raises:
        ResultError: a row differs from its journal.
    """
    if not (directory / FOLDER).is_dir():
        return f"rows are not checked: there is no {FOLDER}/ next to them" if result.rows else None
    message, without = _compare(result, read_journals(directory))
    if message:
        more = f"; and {len(message) - SHOWN} more" if len(message) > SHOWN else ""
        raise ResultError(
            f"{directory / 'result.json'}: differs from the journals of its trials: "
            f"{'; '.join(message[:SHOWN])}{more}. uwsim verify lists all differences; "
            "uwsim bench --resume writes it anew."
        )
    if without:
        n = len(result.rows)
        return f"{without} of {n} rows are not checked: their trials are not in {FOLDER}/"
    return None


def _compare(result: Result, journals: Journals) -> tuple[list[str], int]:
    """Return the contradictions, and how many rows have no journal."""
    n_ended = _n_ended(result)
    keys = tuple(_keys(result))
    messages, without = [], 0
    for (seed, *level), n in Counter(keys).items():
        if n > 1:
            messages.append(f"seed {seed}, level {', '.join(map(str, level))} is there {n} times")
    for row, key in enumerate(keys):
        stored = journals.rows.get(key)
        if stored is not None:
            counts_time = len(journals.rows) == len(result.rows)
            apart = _apart(result, row, *stored, counts_time=counts_time)
            messages += [f"row {row}, {what}" for what in apart]
        elif journals.n_ended >= n_ended:
            messages.append(f"row {row}: {FOLDER}/ has no such level")
        else:
            without += 1
    if journals.n_ended == n_ended:
        there = set(keys)
        for seed, *level in (key for key in journals.ended if key not in there):
            messages.append(f"it has no row of seed {seed}, level {', '.join(map(str, level))}")
    return messages, without


def read_journals(directory: Path) -> Journals:
    """Read the journals of all trials, in their order; ResultError if a level is there twice."""
    rows: dict[Key, tuple[StoredRow, float]] = {}
    ended: list[Key] = []
    elapsed: dict[Cell, float] = {}
    n_ended = 0
    for path in sorted((directory / FOLDER).glob("*.jsonl"), key=lambda p: (len(p.name), p.name)):
        head, stored = read_any(path)
        n_ended += stored.end is not None
        seed = None if head is None else head.get("seed")
        for row in stored.rows:
            elapsed[seed] = elapsed.get(seed, 0.0) + row.duration
            key = (seed, *row.values)
            if key in rows and seed is not None:
                level = ", ".join(map(str, row.values))
                raise ResultError(f"{path}: level {level} of seed {seed} is there twice.")
            rows[key] = row, elapsed[seed]
            if stored.end is not None:
                ended.append(key)
    return Journals(rows, tuple(ended), n_ended)


def _n_ended(result: Result) -> int:
    """How many trials are finished, according to a result."""
    return 0 if result.run.units is None else result.run.units[0]


def _keys(result: Result) -> Iterator[Key]:
    names = [column.name for column in result.columns]
    levels = [i for i, column in enumerate(result.columns) if column.kind == "level"]
    for row in result.rows:
        seed = row[names.index("seed")] if "seed" in names else result.run.seed
        yield (seed if isinstance(seed, int) else None, *(row[i] for i in levels))


def _apart(
    result: Result, row: int, stored: StoredRow, elapsed: float, *, counts_time: bool
) -> Iterator[str]:
    """Give the cells and reasons of a row that differ from what is stored of it."""
    is_independent = result.run.mode == "independent"
    for column, cell in zip(result.columns, result.rows[row], strict=True):
        if column.kind in ("run", "level") or (column.kind == "time" and not counts_time):
            continue
        known = _cell(stored, column, stored.duration if is_independent else elapsed)
        if column.kind == "time" and leaves(cell) == leaves(elapsed):
            continue  # of independent levels, too, in results of earlier versions
        if leaves(cell) != leaves(known):
            yield f"column {column.name}: {cell!r} there, {known!r} by {FOLDER}/"
        unit = _unit(stored, column)
        if unit is not None and unit != (column.unit or "1"):
            yield f"column {column.name}: in {column.unit or '1'} there, in {unit} by {FOLDER}/"
    names = [column.name for column in result.columns]
    for name in (*stored.measures, *stored.details, "total"):
        if name not in names:
            yield f"there is no column {name}"
    reasons = {note.column: note.why for note in result.missing if note.row == row}
    for name in dict.fromkeys([*reasons, *stored.missing]):
        before, after = reasons.get(name), stored.missing.get(name)
        if before != after:
            yield f"why {name} is missing: {before!r} there, {after!r} by {FOLDER}/"


def _cell(stored: StoredRow, column: Column, ended_at: float) -> Cell:
    match column.kind:
        case "measure" | "detail":
            value, _ = _measured(stored, column.kind).get(column.name, (None, ""))
            return value
        case "score":
            return stored.total
        case "status":
            return stored.status
    return ended_at


def _unit(stored: StoredRow, column: Column) -> str | None:
    """Return the unit of a value that is there; of none it need not be known."""
    if column.kind not in ("measure", "detail"):
        return None
    value, unit = _measured(stored, column.kind).get(column.name, (None, None))
    return None if value is None else unit


def _measured(stored: StoredRow, kind: str) -> Mapping[str, Measured]:
    return stored.measures if kind == "measure" else stored.details
