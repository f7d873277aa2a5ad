"""``uwsim list``: everything that has a name, with a line about each."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from ..errors import UnknownName
from .files import bundled

UNWRAPPED = 200
"""Columns for a reader that is a program: wide enough to leave every line whole."""


def list_names(
    kind: Annotated[
        str | None,
        typer.Argument(
            help="scenes, benchmarks, algorithms, vehicles, measures, triggers, updaters or "
            "sensors; all of them when left out."
        ),
    ] = None,
) -> None:
    """List what can be named on the command line and in files, with a line about each."""
    if kind is not None and kind not in KINDS:
        raise UnknownName("kind of thing to list", kind, KINDS)
    console = Console(highlight=False, width=None if sys.stdout.isatty() else UNWRAPPED)
    for name in KINDS if kind is None else (kind,):
        table = Table(box=None, show_header=False, padding=(0, 2, 0, 0), pad_edge=False)
        table.add_column(no_wrap=True, style="bold")
        table.add_column()
        for entry, description in KINDS[name]().items():
            table.add_row(entry, description)
        if kind is None:
            console.print(name, style="underline")
        console.print(table)
        if kind is None:
            console.print()


def scenes() -> dict[str, str]:
    """Bundled scenes, with the first sentence of the comment at their head."""
    return {name: head_comment(path) for name, path in bundled("scenes").items()}


def benchmarks() -> dict[str, str]:
    """Bundled benchmarks, with the first sentence of the comment at their head."""
    return {name: head_comment(path) for name, path in bundled("benchmarks").items()}


def vehicles() -> dict[str, str]:
    """Bundled robots, with the first sentence of the comment at their head."""
    return {name: head_comment(path) for name, path in bundled("scenes", ".urdf").items()}


def algorithms() -> dict[str, str]:
    """Algorithms under test that come with uwsim."""
    from ..algorithms import ALGORITHMS

    return {name: first_line(algorithm.__doc__) for name, algorithm in ALGORITHMS.items()}


def measures() -> dict[str, str]:
    """Measures that a benchmark file may use."""
    from ..benchmark.measures import MEASURES

    return {name: without_title(line) for name, line in family(MEASURES).items()}


def triggers() -> dict[str, str]:
    """Triggers that a benchmark file may use."""
    from ..benchmark.triggers import TRIGGERS

    return {name: without_title(line) for name, line in family(TRIGGERS).items()}


def updaters() -> dict[str, str]:
    """Scene updaters that a benchmark file may use."""
    from ..benchmark.updaters import UPDATERS

    return {name: without_title(line) for name, line in family(UPDATERS).items()}


def sensors() -> dict[str, str]:
    """Sensors that a scene file may use."""
    from ..sensors import SENSORS

    return family(SENSORS)


KINDS: dict[str, Callable[[], dict[str, str]]] = {
    "scenes": scenes,
    "benchmarks": benchmarks,
    "algorithms": algorithms,
    "vehicles": vehicles,
    "measures": measures,
    "triggers": triggers,
    "updaters": updaters,
    "sensors": sensors,
}


def family(table: Mapping[str, type]) -> dict[str, str]:
    """Describe a family by the first line of each member's module: there it says what it is."""
    return {name: first_line(sys.modules[spec.__module__].__doc__) for name, spec in table.items()}


def without_title(line: str) -> str:
    """``Distance: how far a body went.`` becomes ``How far a body went.``."""
    told = line.partition(": ")[2] or line
    return told[:1].upper() + told[1:]


def first_line(doc: str | None) -> str:
    """Return the first line of a docstring without its marks of code."""
    return (doc or "").strip().split("\n")[0].replace("``", "")


def head_comment(path: Path) -> str:
    """Return the first sentence of the comment at the head of an XML file."""
    text = path.read_text(encoding="utf-8")
    comment = re.search(r"<!--(.*?)-->", text, re.DOTALL)
    words = " ".join(comment[1].split()) if comment else ""
    return re.split(r"(?<=\.)\s", words)[0]
