"""The inputs of a comparison: results of one experiment, with unique names."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ...errors import ResultError
from ...results.inputs import ALGORITHM, short_hash
from ...results.journal_check import check_rows
from ...results.result import Column, Result
from ...results.result_file import file_of, load
from ...results.table import unit_of
from ..plots import algorithm_of


@dataclass(frozen=True, kw_only=True)
class Entry:
    """A result in a comparison, with its name and source."""

    name: str
    """The name of the algorithm; with the directory if two results have the same algorithm."""
    source: str
    """The result directory, with as many parent directories as make it unique."""
    result: Result
    """The content of the result."""
    sha256: str
    """The SHA-256 of ``result.json``."""
    check_note: str | None = None
    """A text on the rows not checked against journals, and why; None if all rows were checked."""


def read_entries(paths: Sequence[Path]) -> tuple[Entry, ...]:
    """Read results, check their rows against the journals, and name them.

    Raises:
        ResultError: a result cannot be read, contradicts its journals or is given twice, or there
            are fewer than two results.
    """
    directories = [file_of(path).resolve().parent for path in paths]
    for i, path in enumerate(paths):
        if directories[i] in directories[:i]:
            raise ResultError(f"{path}: is given twice; expected different results.")
    results = [load(path) for path in paths]
    if len(paths) < 2:
        raise ResultError("A comparison needs at least two results.")
    check_notes = [
        check_rows(result, folder) for result, folder in zip(results, directories, strict=True)
    ]
    sources = _unique_path_ends(directories)
    algorithms = [algorithm_of(result) or "no algorithm" for result in results]
    return tuple(
        Entry(
            name=name if algorithms.count(name) == 1 else f"{name} ({source})",
            source=source,
            result=result,
            sha256=hashlib.sha256(file_of(path).read_bytes()).hexdigest(),
            check_note=check_note,
        )
        for name, source, result, path, check_note in zip(
            algorithms, sources, results, paths, check_notes, strict=True
        )
    )


def shared_column(entries: Sequence[Entry], name: str | None) -> Column:
    """Return the column to compare: ``name``, or by default the score.

    Raises:
        UnknownName: a result has no such column.
        ResultError: the column has no numbers, its units differ, or the results sweep different
            parameters.
    """
    first_result = entries[0].result
    if name is None:
        scores = first_result.columns_of_kind("score") + first_result.columns_of_kind("measure")
        if not scores:
            raise ResultError(f"{entries[0].source}: has no score and no measure to compare.")
        name = scores[0].name
    columns = [entry.result.columns[entry.result.index(name)] for entry in entries]
    if columns[0].kind not in ("score", "measure", "detail", "time"):
        raise ResultError(
            f"--measure {name}: is a {columns[0].kind}; expected a score, measure, detail or time."
        )
    levels = [_labels(entry.result.columns_of_kind("level")) for entry in entries]
    for problem, values in (
        ("sweep different levels", levels),
        (f"have {name} in different units", [column.unit or "no unit" for column in columns]),
    ):
        if len(set(values)) > 1:
            raise ResultError(f"These results {problem}: {_values_by_source(entries, values)}.")
    return replace(columns[0], unit=unit_of(first_result, columns[0]) or None)


def differences(entries: Sequence[Entry]) -> tuple[str, ...]:
    """Return the differences that make results incomparable."""
    texts = []
    for condition, value in _EXPERIMENT_CONDITIONS.items():
        values = [value(entry.result) for entry in entries]
        if len(set(values)) > 1:
            texts.append(f"{condition}: {_values_by_source(entries, values)}")
    texts += _shorten_list(_file_differences(entries, "assets", "asset"), "assets")
    plugins = _file_differences(entries, "plugins", "plugin")
    texts += [text for text in plugins if "absent" not in text]
    return tuple(texts)


def remarks(entries: Sequence[Entry]) -> tuple[str, ...]:
    """Return remarks on differences that still allow a comparison."""
    texts = []
    for subject in ("version", "physics", "renderer", "numpy"):
        values = [getattr(entry.result.run, subject) or "unknown" for entry in entries]
        if len(set(values)) > 1 and not (subject == "renderer" and "none" in values):
            versions = _values_by_source(entries, values)
            texts.append(f"run with different versions, {subject}: {versions}")
    for entry in entries:
        counts = entry.result.run.trial_counts
        if counts is not None and not entry.result.run.is_finished:
            texts.append(
                f"{entry.name} is not finished: {counts[0]} of {counts[1]} trials are finished"
            )
    for subject in dict.fromkeys(entry.check_note for entry in entries if entry.check_note):
        sources = [entry.source for entry in entries if entry.check_note == subject]
        texts.append(f"{' and '.join(sources)}: {subject}")
    texts += [line for line in _file_differences(entries, "plugins", "plugin") if "absent" in line]
    for name in dict.fromkeys(entry.result.run.algorithm or "" for entry in entries):
        same_entries = [entry for entry in entries if (entry.result.run.algorithm or "") == name]
        texts += _shorten_list(
            _file_differences(same_entries, ALGORITHM, f"source of {name},"), "sources"
        )
    return tuple(texts)


def count_same_images(first_result: Result, second_result: Result) -> tuple[int, int] | None:
    """Return the number of image streams that both results have, and how many are identical.

    Returns:
        None if the results have no stream in common: no camera was read, or the seeds differ.
        Streams without images in both do not count.
    """
    streams = {(s.seed, s.level, s.topic): s for s in first_result.image_streams}
    matches = [
        first_stream.sha256 == stream.sha256
        for stream in second_result.image_streams
        if (first_stream := streams.get((stream.seed, stream.level, stream.topic)))
        and max(first_stream.frames, stream.frames) > 0
    ]
    return (len(matches), sum(matches)) if matches else None


# ---------------------------------------------------------------------------- one experiment


def _file_text(file: tuple[str, str] | None) -> str:
    return "unknown" if file is None else f"{file[0]} {short_hash(file[1])}"


def _scene_settings(result: Result) -> str:
    settings = result.run.settings or ()
    texts = [f"{path}={value}" for path, value in settings if not path.startswith("algorithm.")]
    return " ".join(texts) or "none"


def _value_text(value: object) -> str:
    words = value if isinstance(value, tuple) else () if value is None else (value,)
    return " ".join(f"{w:g}" if isinstance(w, float) else str(w) for w in words) or "none"


_EXPERIMENT_CONDITIONS: dict[str, Callable[[Result], str]] = {
    "benchmark": lambda result: _file_text(result.inputs.benchmark),
    "scene": lambda result: _file_text(result.inputs.scene),
    "mode": lambda result: _value_text(result.run.mode),
    "timestep": lambda result: _value_text(result.run.timestep),
    "compatibility": lambda result: _value_text(result.run.compatibility),
    "settings of the scene": _scene_settings,
}
"""The conditions that are the same in all results of an experiment: name -> value as text."""


def _file_differences(entries: Sequence[Entry], role: str, file_kind: str) -> list[str]:
    """Return a text for every file of a role that is not the same in all results."""
    tables = [
        {name: digest for r, name, digest in entry.result.inputs.files() if r == role}
        for entry in entries
    ]
    texts = []
    for name in dict.fromkeys(name for table in tables for name in table):
        values = [short_hash(table[name]) if name in table else "absent" for table in tables]
        if len(set(values)) > 1:
            texts.append(f"{file_kind} {name}: {_values_by_source(entries, values)}")
    return texts


def _shorten_list(texts: list[str], noun: str) -> list[str]:
    return [*texts[:2], f"{len(texts) - 2} more {noun}"] if len(texts) > 3 else texts


# ---------------------------------------------------------------------------- wording


def _values_by_source(entries: Sequence[Entry], values: Sequence[str]) -> str:
    """Return ``0.002 s in a.result, 0.001 s in b.result and c.result``."""
    parts = []
    for value in dict.fromkeys(values):
        sources = [e.source for e, other in zip(entries, values, strict=True) if other == value]
        parts.append(f"{value} in {' and '.join(sources)}")
    return ", ".join(parts)


def _labels(columns: Sequence[Column]) -> str:
    return " and ".join(column.label for column in columns) or "nothing"


def _unique_path_ends(directories: Sequence[Path]) -> list[str]:
    path_ends = []
    for i, directory in enumerate(directories):
        other_parts = [other.parts for j, other in enumerate(directories) if j != i]
        parts, n = directory.parts, 1
        while n < len(parts) and any(other[-n:] == parts[-n:] for other in other_parts):
            n += 1
        path_ends.append("/".join(parts[-n:]))
    return path_ends
