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
    """One of the results compared."""

    name: str
    """The algorithm; with the directory where two results are of one algorithm."""
    source: str
    """The result directory, with as many parents as make it unique."""
    result: Result
    """What it found."""
    sha256: str
    """Hash of its ``result.json``."""
    unchecked: str | None = None
    """Which of its rows were not checked against journals, and why; None: all were."""


def read_entries(paths: Sequence[Path]) -> tuple[Entry, ...]:
    """Read results, check their rows against the journals, and name them.

    Raises:
        ResultError: one cannot be read, contradicts its journals, or is given twice, or there
            are fewer than two.
    """
    directories = [file_of(path).resolve().parent for path in paths]
    for i, path in enumerate(paths):
        if directories[i] in directories[:i]:
            raise ResultError(f"{path}: given twice; a result is no comparison with itself.")
    results = [load(path) for path in paths]
    if len(paths) < 2:
        raise ResultError("A comparison needs at least two results.")
    checked = [
        check_rows(result, place) for result, place in zip(results, directories, strict=True)
    ]
    sources = _distinct(directories)
    algorithms = [algorithm_of(result) or "no algorithm" for result in results]
    return tuple(
        Entry(
            name=name if algorithms.count(name) == 1 else f"{name} ({source})",
            source=source,
            result=result,
            sha256=hashlib.sha256(file_of(path).read_bytes()).hexdigest(),
            unchecked=unchecked,
        )
        for name, source, result, path, unchecked in zip(
            algorithms, sources, results, paths, checked, strict=True
        )
    )


def shared_column(entries: Sequence[Entry], name: str | None) -> Column:
    """Return the column that is compared: ``name``, else the score.

    Raises:
        UnknownName: a result has no such column.
        ResultError: it holds no numbers, or other units; or the results sweep different things.
    """
    first = entries[0].result
    if name is None:
        scores = first.columns_of_kind("score") + first.columns_of_kind("measure")
        if not scores:
            raise ResultError(f"{entries[0].source}: has neither a score nor a measure.")
        name = scores[0].name
    columns = [entry.result.columns[entry.result.index(name)] for entry in entries]
    if columns[0].kind not in ("score", "measure", "detail", "time"):
        raise ResultError(f"--measure {name}: is a {columns[0].kind}, not something measured.")
    for what, values in (
        (
            "sweep different levels",
            [_labels(entry.result.columns_of_kind("level")) for entry in entries],
        ),
        (f"have {name} in different units", [column.unit or "no unit" for column in columns]),
    ):
        if len(set(values)) > 1:
            raise ResultError(f"These results {what}: {_who(entries, values)}.")
    return replace(columns[0], unit=unit_of(first, columns[0]) or None)


def differences(entries: Sequence[Entry]) -> tuple[str, ...]:
    """Return the differences that make results incomparable."""
    found = []
    for what, value in _EXPERIMENT.items():
        values = [value(entry.result) for entry in entries]
        if len(set(values)) > 1:
            found.append(f"{what}: {_who(entries, values)}")
    found += _few(_said_of_files(entries, "assets", "asset"), "assets")
    found += [line for line in _said_of_files(entries, "plugins", "plugin") if "absent" not in line]
    return tuple(found)


def remarks(entries: Sequence[Entry]) -> tuple[str, ...]:
    """Return remarks on differences that do not forbid a comparison."""
    found = []
    for what in ("version", "physics", "renderer", "numpy"):
        values = [getattr(entry.result.run, what) or "unknown" for entry in entries]
        if len(set(values)) > 1 and not (what == "renderer" and "none" in values):
            found.append(f"run with different versions, {what}: {_who(entries, values)}")
    for entry in entries:
        units = entry.result.run.units
        if units is not None and not entry.result.run.is_finished:
            found.append(f"{entry.name} is not finished: {units[0]} of {units[1]} units finished")
    for what in dict.fromkeys(entry.unchecked for entry in entries if entry.unchecked):
        sources = [entry.source for entry in entries if entry.unchecked == what]
        found.append(f"{' and '.join(sources)}: {what}")
    found += [line for line in _said_of_files(entries, "plugins", "plugin") if "absent" in line]
    for name in dict.fromkeys(algorithm_of(entry.result) for entry in entries):
        alike = [entry for entry in entries if algorithm_of(entry.result) == name]
        found += _few(_said_of_files(alike, ALGORITHM, f"source of {name},"), "sources")
    return tuple(found)


def same_images(first: Result, second: Result) -> tuple[int, int] | None:
    """Return how many image streams both have, and how many of them are identical.

    None where there is none in common: no camera was read, or no seed is shared.
    """
    seen = {(s.seed, s.level, s.topic): s.sha256 for s in first.image_streams}
    shared = [
        seen[key] == s.sha256
        for s in second.image_streams
        if (key := (s.seed, s.level, s.topic)) in seen
    ]
    return (len(shared), sum(shared)) if shared else None


# ---------------------------------------------------------------------------- what is held equal


def _file(file: tuple[str, str] | None) -> str:
    return "unknown" if file is None else f"{file[0]} {short_hash(file[1])}"


def _scene_settings(result: Result) -> str:
    given = result.run.settings or ()
    of_scene = [f"{path}={value}" for path, value in given if not path.startswith("algorithm.")]
    return " ".join(of_scene) or "none"


def _words(value: object) -> str:
    words = value if isinstance(value, tuple) else () if value is None else (value,)
    return " ".join(f"{w:g}" if isinstance(w, float) else str(w) for w in words) or "none"


_EXPERIMENT: dict[str, Callable[[Result], str]] = {
    "benchmark": lambda result: _file(result.inputs.benchmark),
    "scene": lambda result: _file(result.inputs.scene),
    "mode": lambda result: _words(result.run.mode),
    "timestep": lambda result: _words(result.run.timestep),
    "compatibility": lambda result: _words(result.run.compatibility),
    "settings of the scene": _scene_settings,
}
"""What must be equal -> its text in a message."""


def _said_of_files(entries: Sequence[Entry], role: str, what: str) -> list[str]:
    """Name every file of a role that is not the same in all results."""
    tables = [
        {name: digest for of, name, digest in entry.result.inputs.files() if of == role}
        for entry in entries
    ]
    found = []
    for name in dict.fromkeys(name for table in tables for name in table):
        values = [short_hash(table[name]) if name in table else "absent" for table in tables]
        if len(set(values)) > 1:
            found.append(f"{what} {name}: {_who(entries, values)}")
    return found


def _few(found: list[str], what: str) -> list[str]:
    return [*found[:2], f"{len(found) - 2} more {what}"] if len(found) > 3 else found


# ---------------------------------------------------------------------------- wording


def _who(entries: Sequence[Entry], values: Sequence[str]) -> str:
    """``0.002 s in a.result, 0.001 s in b.result and c.result``."""
    parts = []
    for value in dict.fromkeys(values):
        sources = [e.source for e, other in zip(entries, values, strict=True) if other == value]
        parts.append(f"{value} in {' and '.join(sources)}")
    return ", ".join(parts)


def _labels(columns: Sequence[Column]) -> str:
    return " and ".join(column.label for column in columns) or "nothing"


def _distinct(directories: Sequence[Path]) -> list[str]:
    """Shortest unique ends of paths."""
    found = []
    for i, directory in enumerate(directories):
        others = [other for j, other in enumerate(directories) if j != i]
        parts = directory.parts
        n = next(
            (n for n in range(1, len(parts)) if all(o.parts[-n:] != parts[-n:] for o in others)),
            len(parts),
        )
        found.append("/".join(parts[-n:]))
    return found
