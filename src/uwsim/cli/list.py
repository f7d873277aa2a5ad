"""``uwsim list``: names for the command line and for files, with descriptions."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table
from rich.text import Text

from ..assets.bundled import bundled_files
from ..checks.benchmark_tables import read_plugins
from ..errors import UnknownName
from .options.completion import one_of
from .options.descriptions import family, first_line, head_comment, without_title
from .options.options import JsonOption, PluginOption
from .output.console import standard_output

if TYPE_CHECKING:
    from ..benchmark.plugin_tables import Tables

COLUMNS = 200
"""Width of the tables where standard output is no terminal."""


def list_names(
    kind: Annotated[
        str | None,
        typer.Argument(
            metavar="KIND",
            help="scenes, benchmarks, algorithms, vehicles, measures, triggers, updaters, sensors, "
            "devices or interfaces; all of them when left out.",
            autocompletion=lambda incomplete: one_of(KINDS)(incomplete),
        ),
    ] = None,
    as_json: JsonOption = False,
    plugin: PluginOption = None,
) -> None:
    """List the names that can be used on the command line and in files, with a description of each.

    Elements of a scene that uwsim reads and does not simulate are marked. With --json: {KIND:
    [{"name", "summary", "limit"}]}; limit is empty where the element is fully simulated.
    """
    if kind is not None and kind not in KINDS:
        raise UnknownName("kind of thing to list", kind, KINDS)
    _, tables = read_plugins(plugin)
    found = {name: KINDS[name](tables) for name in (KINDS if kind is None else (kind,))}
    if as_json:
        print(json.dumps({name: documents(name, each) for name, each in found.items()}, indent=1))
        return
    console = standard_output(COLUMNS)
    for name, entries in found.items():
        table = Table(box=None, show_header=False, padding=(0, 2, 0, 0), pad_edge=False)
        table.add_column(no_wrap=True, style="bold")
        table.add_column()
        for entry, description in entries.items():
            limit = limit_in(name, entry)
            table.add_row(entry, Text(description + (f" [{limit}]" if limit else "")))
        if kind is None:
            console.print(name, style="underline")
        console.print(table)
        if kind is None:
            console.print()


def documents(kind: str, entries: Mapping[str, str]) -> list[dict[str, str]]:
    """Return what is listed of one kind, for a program."""
    return [
        {"name": name, "summary": summary, "limit": limit_in(kind, name)}
        for name, summary in entries.items()
    ]


def limit_in(kind: str, name: str) -> str:
    """Say how far something is simulated; an empty text: wholly, or it is nothing to simulate."""
    from ..scene.unsupported import describe_limit

    parent = {"sensors": "vehicle", "devices": "vehicle", "interfaces": "rosInterfaces"}.get(kind)
    return "" if parent is None else describe_limit(parent, clark(name))


def scenes(tables: Tables) -> dict[str, str]:
    """Bundled scenes, with the first sentence of the comment at their head."""
    return {name: head_comment(path) for name, path in bundled_files("scenes").items()}


def benchmarks(tables: Tables) -> dict[str, str]:
    """Bundled benchmarks, with the first sentence of the comment at their head."""
    return {name: head_comment(path) for name, path in bundled_files("benchmarks").items()}


def vehicles(tables: Tables) -> dict[str, str]:
    """Bundled robots, as ``<file>`` names them, with the first sentence of their head comment."""
    robots = bundled_files("scenes", ".urdf") | bundled_files("vehicles", ".urdf")
    return {path.name: head_comment(path) for path in robots.values()}


def algorithms(tables: Tables) -> dict[str, str]:
    """Algorithms under test: those that come with uwsim, and those of plugins."""
    return {name: first_line(algorithm.__doc__) for name, algorithm in tables.algorithms.items()}


def measures(tables: Tables) -> dict[str, str]:
    """Measures that a benchmark file may use."""
    return {name: without_title(line) for name, line in family(tables.measures).items()}


def triggers(tables: Tables) -> dict[str, str]:
    """Triggers that a benchmark file may use."""
    return {name: without_title(line) for name, line in family(tables.triggers).items()}


def updaters(tables: Tables) -> dict[str, str]:
    """Scene updaters that a benchmark file may use."""
    return {name: without_title(line) for name, line in family(tables.updaters).items()}


def sensors(tables: Tables) -> dict[str, str]:
    """Sensors that a scene file may use."""
    from ..schema.names import prefixed_name
    from ..sensors import SENSORS

    return {prefixed_name(name): line for name, line in family(SENSORS).items()}


def devices(tables: Tables) -> dict[str, str]:
    """Devices that a scene file may use, and what else it may give a vehicle."""
    from ..devices import DEVICES
    from ..schema.names import prefixed_name

    return {
        prefixed_name(name): without_title(line) if name.startswith("{") else line
        for name, line in family(DEVICES).items()
    }


def interfaces(tables: Tables) -> dict[str, str]:
    """Elements of ``<rosInterfaces>``: topics in and out of a scene."""
    from ..schema.names import prefixed_name
    from ..topics import INTERFACES

    return {prefixed_name(name): first_line(spec.__doc__) for name, spec in INTERFACES.items()}


def clark(name: str) -> str:
    """Return a name as tables have it: ``u:lamp`` with its namespace written out."""
    from ..schema import NAMESPACE

    return f"{{{NAMESPACE}}}{name[2:]}" if name.startswith("u:") else name


KINDS: dict[str, Callable[[Tables], dict[str, str]]] = {
    "scenes": scenes,
    "benchmarks": benchmarks,
    "algorithms": algorithms,
    "vehicles": vehicles,
    "measures": measures,
    "triggers": triggers,
    "updaters": updaters,
    "sensors": sensors,
    "devices": devices,
    "interfaces": interfaces,
}
