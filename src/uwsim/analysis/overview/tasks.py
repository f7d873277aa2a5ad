"""The tasks of an overview: the results of each benchmark, and their success rates by level."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ...errors import ResultError
from ...results.per_level import round_level, success_rates
from ...results.result import Column
from ...results.table import exact_decimals, number_text
from ...statistics import Rate
from ..comparison import Entry, differences, read_entries
from ..plots import OverviewRow, algorithm_of, level_label, levels_text

Level = tuple[float, ...]


@dataclass(frozen=True, kw_only=True)
class OverviewTask:
    """The results of one benchmark, one for each algorithm."""

    name: str
    """The name of the benchmark file without its suffix."""
    entries: tuple[Entry, ...]
    """The results, with names that are unique in the task."""
    experiment_differences: tuple[str, ...] = ()
    """The differences between the results that make them incomparable."""

    def rates(self) -> dict[str, dict[Level, Rate]]:
        """Return the success rate at each level, by the name of the algorithm."""
        return {
            entry.name: {
                round_level(level_rate.level): level_rate.success
                for level_rate in success_rates(entry.result)
                if level_rate.success is not None
            }
            for entry in self.entries
        }


def read_tasks(
    paths: Sequence[Path], *, folders: Sequence[str] | None = None, force: bool = False
) -> tuple[OverviewTask, ...]:
    """Read results of several benchmarks, and group them by benchmark.

    A result is named by its algorithm. The results of a folder that has one result for each of
    several benchmarks are named by the folder: they are the entry of one author, whose algorithms
    may have other names in each task. Two results of one name in the same task have their directory
    in their names.

    Args:
        paths: result directories, or their ``result.json``; at least two.
        folders: the name of the folder of each result; empty for a result that is named by its
            algorithm. None for all.
        force: True to accept results of one benchmark that are of different experiments.

    Raises:
        ResultError: a result cannot be read, or has no status or no rows, or results of one
            benchmark differ in their scene, mode, timestep or settings.
    """
    groups: dict[str, list[Entry]] = {}
    for entry in _name_entries(read_entries(paths), folders or [""] * len(paths)):
        if not entry.result.columns_of_kind("status"):
            raise ResultError(f"{entry.source}: has no status; expected a result of a benchmark.")
        if not entry.result.rows:
            raise ResultError(f"{entry.source}: has no rows; expected one or more finished trials.")
        groups.setdefault(entry.result.inputs.title, []).append(entry)
    tasks = tuple(
        OverviewTask(
            name=name,
            entries=_distinguish_entries(entries),
            experiment_differences=differences(entries),
        )
        for name, entries in groups.items()
    )
    for task in tasks:
        if task.experiment_differences and not force:
            raise ResultError(
                f"The results of {task.name} are not of one experiment: "
                f"{'; '.join(task.experiment_differences)}. Use --force to show them anyway."
            )
    return tasks


def algorithm_names(tasks: Sequence[OverviewTask]) -> tuple[str, ...]:
    """Return the names of all algorithms, in the order of the results."""
    return tuple(dict.fromkeys(entry.name for task in tasks for entry in task.entries))


def overview_rows(tasks: Sequence[OverviewTask]) -> tuple[OverviewRow, ...]:
    """Return the rows of the heat map: one for each task and value of its outer parameters.

    Parameters with one value in all results of a task are left out, unless all have one.
    """
    rows: list[OverviewRow] = []
    for task in tasks:
        rates = task.rates()
        columns = task.entries[0].result.columns_of_kind("level")
        all_levels = sorted({level for levels in rates.values() for level in levels})
        indices = [i for i in range(len(columns)) if len({level[i] for level in all_levels}) > 1]
        outer_levels: dict[Level, list[Level]] = {}
        for level in all_levels:
            outer_levels.setdefault(tuple(level[i] for i in indices[:-1]), []).append(level)
        for outer_level, levels in outer_levels.items():
            values = [level[indices[-1]] for level in levels] if indices else []
            decimals = exact_decimals(values)
            rows.append(
                OverviewRow(
                    task=task.name,
                    parameter=level_label(columns[indices[-1]])
                    if indices
                    else _only_level(columns, all_levels),
                    outer_level=levels_text([columns[i] for i in indices[:-1]], outer_level)
                    if outer_level
                    else "",
                    levels=tuple(number_text(value, decimals) for value in values) or ("",),
                    rates={
                        name: tuple(level_rates.get(level) for level in levels)
                        for name, level_rates in rates.items()
                    },
                )
            )
    return tuple(rows)


def _only_level(columns: Sequence[Column], levels: Sequence[Level]) -> str:
    """Return the values of all parameters of a task with one level; empty without parameters."""
    has_parameters = any(column.name != "none" for column in columns)
    return levels_text(columns, levels[0]) if has_parameters and levels else ""


def _name_entries(entries: Sequence[Entry], folders: Sequence[str]) -> tuple[Entry, ...]:
    """Name each result by its algorithm, or by a folder with one result of several benchmarks."""
    titles: dict[str, list[str]] = {}
    for entry, folder in zip(entries, folders, strict=True):
        titles.setdefault(folder, []).append(entry.result.inputs.title)
    return tuple(
        replace(
            entry,
            name=folder
            if folder and 1 < len(titles[folder]) == len(set(titles[folder]))
            else algorithm_of(entry.result) or "no algorithm",
        )
        for entry, folder in zip(entries, folders, strict=True)
    )


def _distinguish_entries(entries: Sequence[Entry]) -> tuple[Entry, ...]:
    """Add the directory to the names of results with equal names."""
    names = [entry.name for entry in entries]
    return tuple(
        replace(entry, name=f"{entry.name} ({entry.source})")
        if names.count(entry.name) > 1
        else entry
        for entry in entries
    )
