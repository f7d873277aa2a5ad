"""``uwsim suite list``: the bundled suites, or the tasks and tracks of one."""

from __future__ import annotations

import json
from typing import Annotated

import typer
from rich.table import Table
from rich.text import Text

from ...assets.bundled import bundled_files
from ...suites.suite import Suite, find_suite, read_suite
from ..list import COLUMNS
from ..options.completion import suite_names
from ..options.options import JsonOption
from ..output.console import standard_output

SuiteArgument = Annotated[
    str,
    typer.Argument(
        metavar="SUITE",
        help="A suite file, or a bundled name (uwsim suite list).",
        autocompletion=suite_names,
    ),
]


def list_tasks(
    suite: Annotated[
        str | None,
        typer.Argument(metavar="SUITE", help="A suite; without it the bundled suites are listed."),
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """List the bundled suites, or the tasks and tracks of one.

    For each task: its benchmark, the baselines, the control condition and the scripted expert.
    """
    suites = [read_suite(path) for path in bundled_files("suites").values()]
    if suite is not None:
        suites = [read_suite(find_suite(suite))]
    if as_json:
        print(json.dumps([suite_document(entry) for entry in suites], indent=1))
        return
    console = standard_output(COLUMNS)
    for entry in suites:
        n = len(entry.spec.tasks)
        console.print(f"{entry.spec.name}: {entry.spec.description} {n} tasks.", markup=False)
        if suite is not None:
            for table in (task_table(entry), track_table(entry), split_table(entry)):
                console.print()
                console.print(table)


def task_table(suite: Suite) -> Table:
    """Return the table of the tasks of a suite."""
    table = _table("task", "benchmark", "baselines", "control", "expert", "to do")
    for task in suite.spec.tasks:
        cells = (task.benchmark, ", ".join(task.baselines), task.control or "", task.expert or "")
        table.add_row(task.name, *cells, Text(task.description))
    return table


def track_table(suite: Suite) -> Table:
    """Return the table of the tracks of a suite."""
    table = _table("track", "sensors", "elements of the scene file")
    for track in suite.spec.tracks:
        table.add_row(track.name, track.description, ", ".join(track.sources) or "all")
    return table


def split_table(suite: Suite) -> Table:
    """Return the table of the public seeds of a suite."""
    table = _table("split", "seeds")
    for split in suite.spec.splits:
        table.add_row(split.name, f"{split.first} to {split.first + split.count - 1}")
    return table


def suite_document(suite: Suite) -> dict[str, object]:
    """Return a suite as a JSON document."""
    spec = suite.spec
    return {
        "name": spec.name,
        "description": spec.description,
        "sha256": suite.sha256,
        "splits": [{"name": s.name, "first": s.first, "count": s.count} for s in spec.splits],
        "tracks": [
            {"name": t.name, "description": t.description, "sources": list(t.sources)}
            for t in spec.tracks
        ],
        "tasks": [
            {
                "name": task.name,
                "benchmark": task.benchmark,
                "description": task.description,
                "levels": list(task.levels),
                "failures": list(task.failures),
                "baselines": list(task.baselines),
                "control": task.control,
                "expert": task.expert,
            }
            for task in spec.tasks
        ],
    }


def _table(*columns: str) -> Table:
    table = Table(box=None, padding=(0, 2, 0, 0), pad_edge=False, header_style="bold")
    for i, name in enumerate(columns):
        table.add_column(name, no_wrap=i == 0)
    return table
