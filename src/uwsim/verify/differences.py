"""Differences between a stored trial and its replay: cells of rows, log samples, motion.

Stored JSON is split into its leaves (numbers and texts), each with its path. Leaves are compared as
text: -0.0 differs from 0.0, and records that were tampered with can be compared, too.
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
    """A difference between a stored result and what it should be."""

    location: str
    """The file, or the trial and level, in which the difference is."""
    description: str
    """The column, sample, topic or step that differs, with the stored and the expected value."""

    def __str__(self) -> str:
        return f"{self.location}: {self.description}"


def differing_leaves(
    old_value: Any, new_value: Any
) -> Iterator[tuple[tuple[str | int, ...], str, str]]:
    """Yield the path, the stored text and the new text of every leaf that differs.

    The text of an absent leaf is ``nothing``.
    """
    old_leaves, new_leaves = leaves(old_value), leaves(new_value)
    for path in dict.fromkeys([*old_leaves, *new_leaves]):
        old_text, new_text = old_leaves.get(path, "nothing"), new_leaves.get(path, "nothing")
        if old_text != new_text:
            yield path, old_text, new_text


def row_differences(old_row: Record, new_row: Record) -> list[str]:
    """Return the differences between two records of a level: a line for each column and log."""
    messages: dict[str, str] = {}
    for path, old_text, new_text in differing_leaves(old_row, new_row):
        name = _name(path, old_row, new_row)
        if name is not None:
            group = " ".join(map(str, path[:2])) if path[0] == "logs" else name
            messages.setdefault(group, f"{name}: stored {old_text}, replayed {new_text}")
    return list(messages.values())


def _name(path: tuple[str | int, ...], old_row: Record, new_row: Record) -> str | None:
    """Return the name in messages of a leaf of a level's record; None for the fingerprint."""
    match path:
        case ("fingerprint",):
            return None  # `compare_checkpoints` states the step at which the fingerprints differ
        case ("measures" | "details", name, 0, *_):
            return f"column {name}"
        case ("measures" | "details", name, *_):
            return f"unit of column {name}"
        case ("missing", name, *_):
            return f"why column {name} is null"
        case ("total" | "status" | "ended_at" as name, *_):
            return f"column {name}"
        case ("logs", name, int(sample), *_):
            n_before, n_after = (len(_log(record, name)) for record in (old_row, new_row))
            lengths = "" if n_before == n_after else f" ({n_before} samples stored, {n_after} now)"
            return f"log of {name}, first at sample {sample}{_time(new_row, name, sample)}{lengths}"
    return " ".join(map(str, path[:2]))


def _log(record: Record, name: str | int) -> list[Any]:
    logs = record.get("logs")
    log = logs.get(name) if isinstance(logs, dict) else None
    return log if isinstance(log, list) else []


def _time(record: Record, name: str | int, sample: int) -> str:
    log = _log(record, name)
    entry = log[sample] if sample < len(log) else None
    return f" ({entry[0]:g} s)" if isinstance(entry, list) and entry else ""


def end_differences(old_end: Record, new_end: Record) -> list[str]:
    """Return the differences between two end records of a trial, without their traces.

    An end record has the hashes of images, the constants and the parameters of the trial.
    """
    messages: dict[str, str] = {}
    for path, old_text, new_text in differing_leaves(_drop_trace(old_end), _drop_trace(new_end)):
        name = " ".join(map(str, path[:2]))
        if path[0] == "streams" and isinstance(path[-1], int):
            topics = [s[0] for s in new_end.get("streams", []) if isinstance(s, list) and s]
            index = int(path[1]) if len(path) > 1 else 0
            topic = topics[index] if index < len(topics) else index
            name = f"images on {topic}"
            if path[-1] == 1:
                old_text, new_text = f"{old_text} frames", f"{new_text} frames"
        messages.setdefault(name, f"{name}: stored {old_text}, replayed {new_text}")
    return list(messages.values())


def _drop_trace(end: Record) -> Record:
    return {key: value for key, value in end.items() if key != "trace"}


@dataclass(frozen=True, kw_only=True)
class FingerprintComparison:
    """The comparison of the fingerprints of a stored trial and its replay."""

    message: str | None
    """A sentence about the steps between which the two diverge; None if they do not."""
    parts: tuple[str, ...] = ()
    """The bodies, and the topics of images, that differ first."""
    is_known: bool = True
    """True if both runs have fingerprints."""


def compare_checkpoints(
    old_trial: StoredTrial, new_trial: StoredTrial, timestep: float
) -> FingerprintComparison:
    """Compare the fingerprints of a stored trial and its replay; ``timestep`` is in seconds."""
    traces = [None if trial.end is None else trial.end.trace for trial in (old_trial, new_trial)]
    old_marks, new_marks = (Checkpoints.from_dict(trace) for trace in traces)
    if old_marks is None or new_marks is None:
        return FingerprintComparison(message=None, is_known=False)
    split = divergence(old_marks, new_marks)
    if split is None:
        fingerprints = [[row.fingerprint for row in trial.rows] for trial in (old_trial, new_trial)]
        levels = [
            n for n, pair in enumerate(zip(*fingerprints, strict=False)) if pair[0] != pair[1]
        ]
        if not levels:
            return FingerprintComparison(message=None)
        return FingerprintComparison(
            message=f"the fingerprint of its level {levels[0]} differs, no mark does"
        )
    span = (
        f"the same up to step {split.last_equal} ({split.last_equal * timestep:g} s), "
        f"no more at step {split.first_different} ({split.first_different * timestep:g} s)"
    )
    suffix = f"; first differs: {', '.join(split.parts)}" if split.parts else ""
    return FingerprintComparison(message=f"motion and images are {span}{suffix}", parts=split.parts)


def text_difference(old_text: str, new_text: str) -> str | None:
    """Return the first difference between two text files with tables; None if they are equal."""
    if old_text == new_text:
        return None
    old_lines, new_lines = old_text.split("\n"), new_text.split("\n")
    separator = "\t" if "\t" in new_lines[0] else ","
    header = new_lines[0].split(separator)
    for number, (old_line, new_line) in enumerate(zip(old_lines, new_lines, strict=False), start=1):
        if old_line == new_line:
            continue
        cells = [
            next(csv.reader(io.StringIO(line), delimiter=separator), [])
            for line in (old_line, new_line)
        ]
        for i, (a, b) in enumerate(zip(*cells, strict=False)):
            if a != b:
                column = f", column {header[i]}" if i < len(header) and number > 1 else ""
                return f"line {number}{column}: {a!r} there, {b!r} expected"
        return f"line {number}: {old_line[:80]!r} there, {new_line[:80]!r} expected"
    return f"{len(old_lines)} lines there, {len(new_lines)} expected"
