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
from .options.completion import complete_names
from .options.descriptions import describe_family, first_line, head_comment, remove_title
from .options.options import JsonOption, PluginOption
from .output.console import standard_output

if TYPE_CHECKING:
    from ..benchmark.plugin_tables import Tables

COLUMNS = 200
"""The width of the tables if they are not written to a terminal [characters]."""


def list_names(
    kind: Annotated[
        str | None,
        typer.Argument(
            metavar="KIND",
            help="scenes, benchmarks, algorithms, vehicles, measures, triggers, updaters, sensors, "
            "devices, interfaces or waters; without it all of them.",
            autocompletion=lambda incomplete: complete_names(KINDS)(incomplete),
        ),
    ] = None,
    as_json: JsonOption = False,
    plugin: PluginOption = None,
) -> None:
    """List the names that can be used on the command line and in files, with a description of each.

    Elements of a scene that uwsim reads but does not simulate are marked. With --json: {KIND:
    [{"name", "summary", "limit"}]}; "limit" states the limitation of the simulation of an element,
    and is empty if it is fully simulated.
    """
    if kind is not None and kind not in KINDS:
        raise UnknownName("kind of names", kind, KINDS)
    _, tables = read_plugins(plugin)
    kinds = {name: KINDS[name](tables) for name in (KINDS if kind is None else (kind,))}
    if as_json:
        documents = {name: entry_documents(name, kinds[name]) for name in kinds}
        print(json.dumps(documents, indent=1))
        return
    console = standard_output(COLUMNS)
    for name, entries in kinds.items():
        table = Table(box=None, show_header=False, padding=(0, 2, 0, 0), pad_edge=False)
        table.add_column(no_wrap=True, style="bold")
        table.add_column()
        for entry, description in entries.items():
            limitation = find_limitation(name, entry)
            table.add_row(entry, Text(description + (f" [{limitation}]" if limitation else "")))
        if kind is None:
            console.print(name, style="underline")
        console.print(table)
        if kind is None:
            console.print()


def entry_documents(kind: str, entries: Mapping[str, str]) -> list[dict[str, str]]:
    """Return the entries of a kind as JSON documents."""
    return [
        {"name": name, "summary": summary, "limit": find_limitation(kind, name)}
        for name, summary in entries.items()
    ]


def find_limitation(kind: str, name: str) -> str:
    """Return the limitation of the simulation of an element; empty if there is none."""
    from ..scene.unsupported import describe_limitation

    parent = {"sensors": "vehicle", "devices": "vehicle", "interfaces": "rosInterfaces"}.get(kind)
    return "" if parent is None else describe_limitation(parent, qualified_name(name))


def scenes(tables: Tables) -> dict[str, str]:
    """Return bundled scenes, with the first sentence of their head comment."""
    return {name: head_comment(path) for name, path in bundled_files("scenes").items()}


def benchmarks(tables: Tables) -> dict[str, str]:
    """Return bundled benchmarks, with the first sentence of their head comment."""
    return {name: head_comment(path) for name, path in bundled_files("benchmarks").items()}


def vehicles(tables: Tables) -> dict[str, str]:
    """Return bundled robots by file name, with the first sentence of their head comment."""
    robots = bundled_files("scenes", ".urdf") | bundled_files("vehicles", ".urdf")
    return {path.name: head_comment(path) for path in robots.values()}


def algorithms(tables: Tables) -> dict[str, str]:
    """Return the algorithms of uwsim and of plugins."""
    return {name: first_line(algorithm.__doc__) for name, algorithm in tables.algorithms.items()}


def measures(tables: Tables) -> dict[str, str]:
    """Return the measures of benchmark files."""
    return {name: remove_title(line) for name, line in describe_family(tables.measures).items()}


def triggers(tables: Tables) -> dict[str, str]:
    """Return the triggers of benchmark files."""
    return {name: remove_title(line) for name, line in describe_family(tables.triggers).items()}


def updaters(tables: Tables) -> dict[str, str]:
    """Return the scene updaters of benchmark files."""
    return {name: remove_title(line) for name, line in describe_family(tables.updaters).items()}


def sensors(tables: Tables) -> dict[str, str]:
    """Return the sensors of scene files."""
    from ..schema.names import prefixed_name
    from ..sensors import SENSORS

    return {prefixed_name(name): line for name, line in describe_family(SENSORS).items()}


def devices(tables: Tables) -> dict[str, str]:
    """Return the devices and further elements of a vehicle in scene files."""
    from ..devices import DEVICES
    from ..schema.names import prefixed_name

    return {
        prefixed_name(name): remove_title(line) if name.startswith("{") else line
        for name, line in describe_family(DEVICES).items()
    }


def interfaces(tables: Tables) -> dict[str, str]:
    """Return the elements of ``<rosInterfaces>``, which publish on topics or subscribe to them."""
    from ..schema.names import prefixed_name
    from ..topics import INTERFACES

    return {prefixed_name(name): first_line(spec.__doc__) for name, spec in INTERFACES.items()}


def waters(tables: Tables) -> dict[str, str]:
    """Return the named waters of ``<u:water>``, with coefficients at green and their source."""
    from ..optics import WATERS

    return {
        name: f"{water.description}; in green c {water.absorption[1] + b:.4g} and "
        f"b {b:.4g} 1/m. Source: {water.source}."
        for name, water in WATERS.items()
        for b in [water.scattering[1]]
    }


def qualified_name(name: str) -> str:
    """Return the qualified name of an element such as ``u:lamp``, with its namespace."""
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
    "waters": waters,
}
