"""``uwsim check``: all errors of scene, robot, hydrodynamics and benchmark files."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from ..assets.bundled import resolve_bundled
from ..autopilots.ardupilot.frames import FRAMES, find_frame
from ..base.terminal import clean_text
from ..checks import ArduPilotCheck, check_file
from ..checks.benchmark_tables import read_plugins
from ..errors import Diagnostic, ErrorCollector
from ..runs.planning.option_values import pairs_of
from ..scene.settings import xacro_arguments
from ..suites.suite import check_suite
from .exit_status import INVALID_INPUT
from .options.completion import checked_names, complete_names, scene_names
from .options.help_texts import INPUT, option
from .options.options import DataPathOption, JsonOption, PluginOption, XacroOption, xacro_settings


def check(
    files: Annotated[
        list[Path],
        typer.Argument(
            metavar="FILE.xml",
            help="Scenes, robots, hydrodynamics files of vehicles, benchmarks; or bundled names.",
            autocompletion=checked_names,
        ),
    ],
    scene: Annotated[
        Path | None,
        option(
            INPUT,
            "--scene",
            metavar="SCENE.xml",
            help="The scene of the benchmarks.",
            autocompletion=scene_names,
        ),
    ] = None,
    is_strict: Annotated[
        bool,
        option(
            INPUT,
            "--strict",
            help="Also check the order of elements, which the original UWSim prescribes.",
        ),
    ] = False,
    is_for_ardupilot: Annotated[
        bool,
        option(
            INPUT,
            "--ardupilot",
            help="Also check the vehicles of scenes against ArduPilot: thrusters, axes, sensors.",
        ),
    ] = False,
    frame: Annotated[
        str | None,
        option(
            INPUT,
            "--frame",
            metavar="FRAME",
            help="The frame of ArduPilot (vectored_6dof, ..., skid_steering), or FRAME_CONFIG; "
            "by default the one that fits best. Implies --ardupilot.",
            autocompletion=complete_names(tuple(entry.name for entry in FRAMES)),
        ),
    ] = None,
    xacro: XacroOption = None,
    as_json: JsonOption = False,
    plugin: PluginOption = None,
    data_path: DataPathOption = None,
) -> None:
    """Report all errors of scene, robot, hydrodynamics, benchmark and suite files, with lines.

    With --ardupilot, mirrored, exchanged and reversed thrusters of a vehicle are errors, too.

    Python code that these files name is located but not run; the code of a --plugin is run.

    The exit status is 0 without errors, else 2; an element that is read but not simulated yet is a
    warning. With --json: {"files": [{"file", "diagnostics": [{"file", "line", "severity",
    "message"}]}], "n_errors"}.
    """
    folders = tuple(data_path or ())
    plugins = read_plugins(plugin)
    arguments = xacro_arguments(pairs_of(xacro_settings(xacro), ErrorCollector()))
    ardupilot = None
    if frame is not None or is_for_ardupilot:
        ardupilot = ArduPilotCheck(None if frame is None else find_frame(frame))
    paths = [resolve_bundled(file) for file in files]
    scene = None if scene is None else resolve_bundled(scene)
    reports = {
        str(file): errors
        if (errors := check_suite(file)) is not None
        else check_file(
            file,
            is_strict=is_strict,
            data_path=folders,
            scene=scene,
            plugins=plugins,
            arguments=arguments,
            ardupilot=ardupilot,
        )
        for file in [*paths, *([scene] if scene is not None and scene not in paths else [])]
    }
    n_errors = sum(
        diagnostic.severity == "error"
        for diagnostics in reports.values()
        for diagnostic in diagnostics
    )
    typer.echo(format_json(reports, n_errors) if as_json else format_lines(reports))
    if n_errors:
        raise typer.Exit(INVALID_INPUT)


def format_lines(file_diagnostics: Mapping[str, Sequence[Diagnostic]]) -> str:
    """Return one line for each error, warning and note, and a count; the notes are last."""
    lines: list[str] = []
    for file, diagnostics in file_diagnostics.items():
        lines += map(str, sorted(diagnostics, key=lambda item: item.severity == "note"))
        n_errors = sum(diagnostic.severity == "error" for diagnostic in diagnostics)
        lines.append(f"{file}: {_format_count(n_errors)}")
    return clean_text("\n".join(lines))


def format_json(file_diagnostics: Mapping[str, Sequence[Diagnostic]], n_errors: int) -> str:
    """Return the errors and warnings as JSON."""
    files = [
        {"file": file, "diagnostics": [asdict(diagnostic) for diagnostic in diagnostics]}
        for file, diagnostics in file_diagnostics.items()
    ]
    return json.dumps({"files": files, "n_errors": n_errors}, indent=1)


def _format_count(number: int) -> str:
    return {0: "no errors", 1: "1 error"}.get(number, f"{number} errors")
