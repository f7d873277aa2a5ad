"""Generate the tables of ``docs/tasks.md``: the tasks and tracks of the suite ``intervention``.

The page is written by hand; each table is between the marks of `scripts.reference.sensor_tables`.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from uwsim.suites.suite import find_suite, read_suite

from .sensor_tables import TABLE

SUITE = "intervention"
DOCS = Path(__file__).parents[2] / "docs"
HEADING = re.compile(r"^## ([\w-]+)$", re.MULTILINE)
"""A heading of one word, as the name of a task without its version."""


def fill_tables(page: str) -> str:
    """Return the page with new tables; raise KeyError for an unknown table."""
    return TABLE.sub(lambda match: match[1] + TABLES[match[2]]() + match[3], page)


def task_table() -> str:
    """Return the table of the tasks."""
    tasks, sections = read_suite(find_suite(SUITE)).spec.tasks, find_sections()
    rows = [
        (
            link_to_section(task.name, sections.get(task.name.rpartition("-v")[0])),
            task.description,
            f"`{task.benchmark}`",
            ", ".join(f"`{name}`" for name in task.baselines),
            f"`{task.control}`" if task.control else "",
            f"`{task.expert}`" if task.expert else "",
            ", ".join(f"`{status}`" for status in task.failures),
        )
        for task in tasks
    ]
    head = ("task", "goal", "benchmark", "baselines", "control", "expert", "failures")
    return format_table(head, rows)


def find_sections() -> dict[str, str]:
    """Return the address of the section on each task, by the task's name without its version.

    It is the section of a page ``docs/tasks-*.md`` whose heading is the name, in any case.
    """
    return {
        heading.lower(): f"{page.name}#{heading.lower()}"
        for page in sorted(DOCS.glob("tasks-*.md"))
        for heading in HEADING.findall(page.read_text(encoding="utf-8"))
    }


def link_to_section(name: str, address: str | None) -> str:
    """Return the name of a task, linked to its section if it has one."""
    return f"`{name}`" if address is None else f"[`{name}`]({address})"


def track_table() -> str:
    """Return the table of the tracks."""
    tracks = read_suite(find_suite(SUITE)).spec.tracks
    rows = [
        (
            track.name,
            track.description,
            ", ".join(f"`{source}`" for source in track.sources) or "all",
        )
        for track in tracks
    ]
    return format_table(("track", "sensors", "elements of the scene file"), rows)


def format_table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return a table in Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


TABLES: dict[str, Callable[[], str]] = {"tasks": task_table, "tracks": track_table}

if __name__ == "__main__":
    path = Path(sys.argv[1])
    path.write_text(fill_tables(path.read_text()))
