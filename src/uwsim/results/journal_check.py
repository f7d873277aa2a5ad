"""The comparison of the rows of a result with the journals of its trials.

``result.json`` is collected from the journals of the trials (`journal`). If the journals are in the
same directory, every row must agree with them. A result without journals can be read, but is not
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
from .stored.stored_row import StoredRow, ValueWithUnit

Key = tuple[Cell, ...]
"""The seed of a row, then the values of its level."""
MAX_LISTED = 3
"""The greatest number of contradictions that are listed."""


@dataclass(frozen=True)
class Journals:
    """The journals of all trials of a result."""

    rows: dict[Key, tuple[StoredRow, float]]
    """The stored row of each key, and the simulation time from the start of its seed to its end
    [s]."""
    ended_keys: tuple[Key, ...]
    """The keys of the rows of finished trials."""
    n_ended: int
    """The number of finished trials."""


def check_rows(result: Result, directory: Path) -> str | None:
    """Compare every row of a result with the journal of its trial.

    Args:
        result: the result as read from the directory.
        directory: the result directory.

    Returns:
        A text on the rows that are not checked and the reason; None if all rows are checked.

    Raises:
        ResultError: a row differs from its journal.
    """
    if not (directory / FOLDER).is_dir():
        return f"rows are not checked: there is no {FOLDER}/ next to them" if result.rows else None
    messages, n_without_journal = _compare(result, read_journals(directory))
    if messages:
        rest = f"; and {len(messages) - MAX_LISTED} more" if len(messages) > MAX_LISTED else ""
        raise ResultError(
            f"{directory / 'result.json'}: differs from the journals of its trials: "
            f"{'; '.join(messages[:MAX_LISTED])}{rest}. uwsim verify lists all differences; "
            "uwsim bench --resume writes it anew."
        )
    if n_without_journal:
        n = len(result.rows)
        return f"{n_without_journal} of {n} rows are not checked: their trials are not in {FOLDER}/"
    return None


def _compare(result: Result, journals: Journals) -> tuple[list[str], int]:
    """Return the contradictions, and the number of rows without a journal."""
    n_ended = _n_ended(result)
    keys = tuple(_keys(result))
    messages, n_without_journal = [], 0
    for (seed, *level), n in Counter(keys).items():
        if n > 1:
            messages.append(f"seed {seed}, level {', '.join(map(str, level))} occurs {n} times")
    for row, key in enumerate(keys):
        entry = journals.rows.get(key)
        if entry is not None:
            counts_time = len(journals.rows) == len(result.rows)
            differences = _row_differences(result, row, *entry, counts_time=counts_time)
            messages += [f"row {row}, {difference}" for difference in differences]
        elif journals.n_ended >= n_ended:
            messages.append(f"row {row}: {FOLDER}/ has no such level")
        else:
            n_without_journal += 1
    if journals.n_ended == n_ended:
        result_keys = set(keys)
        for seed, *level in (key for key in journals.ended_keys if key not in result_keys):
            messages.append(f"it has no row of seed {seed}, level {', '.join(map(str, level))}")
    return messages, n_without_journal


def read_journals(directory: Path) -> Journals:
    """Read the journals of all trials, in order; raise ResultError if a level occurs twice."""
    rows: dict[Key, tuple[StoredRow, float]] = {}
    ended_keys: list[Key] = []
    elapsed_times: dict[Cell, float] = {}
    n_ended = 0
    for path in sorted((directory / FOLDER).glob("*.jsonl"), key=lambda p: (len(p.name), p.name)):
        head, content = read_any(path)
        n_ended += content.end is not None
        seed = None if head is None else head.get("seed")
        for row in content.rows:
            elapsed_times[seed] = elapsed_times.get(seed, 0.0) + row.duration
            key = (seed, *row.values)
            if key in rows and seed is not None:
                level = ", ".join(map(str, row.values))
                raise ResultError(f"{path}: level {level} of seed {seed} occurs twice.")
            rows[key] = row, elapsed_times[seed]
            if content.end is not None:
                ended_keys.append(key)
    return Journals(rows, tuple(ended_keys), n_ended)


def _n_ended(result: Result) -> int:
    return 0 if result.run.trial_counts is None else result.run.trial_counts[0]


def _keys(result: Result) -> Iterator[Key]:
    names = [column.name for column in result.columns]
    levels = [i for i, column in enumerate(result.columns) if column.kind == "level"]
    for row in result.rows:
        seed = row[names.index("seed")] if "seed" in names else result.run.seed
        yield (seed if isinstance(seed, int) else None, *(row[i] for i in levels))


def _row_differences(
    result: Result, row: int, entry: StoredRow, elapsed_time: float, *, counts_time: bool
) -> Iterator[str]:
    """Yield the cells and reasons of a row that differ from its journal."""
    is_independent = result.run.mode == "independent"
    for column, cell in zip(result.columns, result.rows[row], strict=True):
        if column.kind in ("run", "level") or (column.kind == "time" and not counts_time):
            continue
        stored_cell = _cell(entry, column, entry.duration if is_independent else elapsed_time)
        if column.kind == "time" and leaves(cell) == leaves(elapsed_time):
            continue  # results of earlier versions sum the time of independent levels, too
        if leaves(cell) != leaves(stored_cell):
            yield f"column {column.name}: {cell!r} there, {stored_cell!r} by {FOLDER}/"
        unit = _unit(entry, column)
        if unit is not None and unit != (column.unit or "1"):
            yield f"column {column.name}: in {column.unit or '1'} there, in {unit} by {FOLDER}/"
    names = [column.name for column in result.columns]
    for name in (*entry.measures, *entry.details, "total"):
        if name not in names:
            yield f"there is no column {name}"
    reasons = {note.column: note.reason for note in result.missing_values if note.row == row}
    for name in dict.fromkeys([*reasons, *entry.missing]):
        result_reason, stored_reason = reasons.get(name), entry.missing.get(name)
        if result_reason != stored_reason:
            yield f"why {name} is missing: {result_reason!r} there, {stored_reason!r} by {FOLDER}/"


def _cell(entry: StoredRow, column: Column, ended_at: float) -> Cell:
    match column.kind:
        case "measure" | "detail":
            value, _ = _values_of_kind(entry, column.kind).get(column.name, (None, ""))
            return value
        case "score":
            return entry.total
        case "status":
            return entry.status
    return ended_at


def _unit(entry: StoredRow, column: Column) -> str | None:
    """Return the unit of a value; None if there is no value, as its unit may be unknown."""
    if column.kind not in ("measure", "detail"):
        return None
    value, unit = _values_of_kind(entry, column.kind).get(column.name, (None, None))
    return None if value is None else unit


def _values_of_kind(entry: StoredRow, kind: str) -> Mapping[str, ValueWithUnit]:
    return entry.measures if kind == "measure" else entry.details
