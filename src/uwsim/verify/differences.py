"""Differences between two executions of one trial: cells, first log sample, first step.

What is stored as JSON is taken apart into its leaves, each with its path, and compared leaf by leaf
as text: -0.0 is not 0.0, and a record that was tampered with is compared like any other.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ..results.journal import StoredTrial
from ..results.leaves import leaves
from ..results.stored.stored_row import Record
from ..runs.trial.fingerprint import Checkpoints, divergence


@dataclass(frozen=True, kw_only=True)
class Difference:
    """A difference."""

    where: str
    """File, or trial and level."""
    what: str
    """Column, sample, topic or steps; what is stored, what came out."""

    def __str__(self) -> str:
        return f"{self.where}: {self.what}"


def apart(stored: Any, again: Any) -> Iterator[tuple[tuple[str | int, ...], str, str]]:
    """Yield path, stored text and new text of every leaf that differs; ``nothing`` for none."""
    one, other = leaves(stored), leaves(again)
    for path in dict.fromkeys([*one, *other]):
        before, after = one.get(path, "nothing"), other.get(path, "nothing")
        if before != after:
            yield path, before, after


def of_row(stored: Record, again: Record) -> list[str]:
    """Return the differences in the record of a level, a line for each column and log."""
    messages: dict[str, str] = {}
    for path, before, after in apart(stored, again):
        name = _name(path, stored, again)
        if name is not None:
            group = " ".join(map(str, path[:2])) if path[0] == "logs" else name
            messages.setdefault(group, f"{name}: stored {before}, replayed {after}")
    return list(messages.values())


def _name(path: tuple[str | int, ...], stored: Record, again: Record) -> str | None:
    """The name of a leaf of a record in the result."""
    match path:
        case ("fingerprint",):
            return None  # the trace says more
        case ("measures" | "details", name, 0, *_):
            return f"column {name}"
        case ("measures" | "details", name, *_):
            return f"unit of column {name}"
        case ("missing", name, *_):
            return f"why column {name} is null"
        case ("total" | "status" | "ended_at" as name, *_):
            return f"column {name}"
        case ("logs", name, int(sample), *_):
            n_before, n_after = (len(_log(record, name)) for record in (stored, again))
            lengths = "" if n_before == n_after else f" ({n_before} samples stored, {n_after} now)"
            return f"log of {name}, first at sample {sample}{_time(again, name, sample)}{lengths}"
    return " ".join(map(str, path[:2]))


def _log(record: Record, name: str | int) -> list[Any]:
    logs = record.get("logs")
    log = logs.get(name) if isinstance(logs, dict) else None
    return log if isinstance(log, list) else []


def _time(record: Record, name: str | int, sample: int) -> str:
    log = _log(record, name)
    taken = log[sample] if sample < len(log) else None
    return f" ({taken[0]:g} s)" if isinstance(taken, list) and taken else ""


def of_end(stored: Record, again: Record) -> list[str]:
    """Return the differences in the end of a trial: images, constants, parameters; no trace."""
    messages: dict[str, str] = {}
    for path, before, after in apart(_without_checkpoints(stored), _without_checkpoints(again)):
        name = " ".join(map(str, path[:2]))
        if path[0] == "streams" and isinstance(path[-1], int):
            topics = [s[0] for s in again.get("streams", []) if isinstance(s, list) and s]
            number = int(path[1]) if len(path) > 1 else 0
            topic = topics[number] if number < len(topics) else number
            name = f"images on {topic}"
            if path[-1] == 1:
                before, after = f"{before} frames", f"{after} frames"
        messages.setdefault(name, f"{name}: stored {before}, replayed {after}")
    return list(messages.values())


def _without_checkpoints(end: Record) -> Record:
    return {key: value for key, value in end.items() if key != "trace"}


@dataclass(frozen=True, kw_only=True)
class FingerprintComparison:
    """The comparison of the fingerprints of a trial."""

    message: str | None
    """Where two runs part, in words; None if they do not."""
    parts: tuple[str, ...] = ()
    """What differs first."""
    is_known: bool = True
    """Whether both have fingerprints."""


def of_checkpoints(
    stored: StoredTrial, again: StoredTrial, timestep: float
) -> FingerprintComparison:
    """Compare the fingerprints of two executions of one trial."""
    traces = [None if each.end is None else each.end.trace for each in (stored, again)]
    one, other = (Checkpoints.of(trace) for trace in traces)
    if one is None or other is None:
        return FingerprintComparison(message=None, is_known=False)
    found = divergence(one, other)
    if found is None:
        fingerprints = [[row.fingerprint for row in each.rows] for each in (stored, again)]
        differs = [
            n for n, pair in enumerate(zip(*fingerprints, strict=False)) if pair[0] != pair[1]
        ]
        if not differs:
            return FingerprintComparison(message=None)
        return FingerprintComparison(
            message=f"the fingerprint of its level {differs[0]} differs, no mark does"
        )
    span = (
        f"the same up to step {found.after} ({found.after * timestep:g} s), "
        f"no more at step {found.until} ({found.until * timestep:g} s)"
    )
    what = f"; first differs: {', '.join(found.parts)}" if found.parts else ""
    return FingerprintComparison(message=f"motion and images are {span}{what}", parts=found.parts)


def of_text(stored: str, again: str) -> str | None:
    """Return where two tables of text first differ, by line and column; None if they are equal."""
    if stored == again:
        return None
    before, after = stored.split("\n"), again.split("\n")
    separator = "\t" if "\t" in after[0] else ","
    header = after[0].split(separator)
    for number, (one, other) in enumerate(zip(before, after, strict=False), start=1):
        if one == other:
            continue
        cells = [
            next(csv.reader(io.StringIO(line), delimiter=separator), []) for line in (one, other)
        ]
        for i, (a, b) in enumerate(zip(*cells, strict=False)):
            if a != b:
                column = f", column {header[i]}" if i < len(header) and number > 1 else ""
                return f"line {number}{column}: {a!r} there, {b!r} expected"
        return f"line {number}: {one[:80]!r} there, {other[:80]!r} expected"
    return f"{len(before)} lines there, {len(after)} expected"
