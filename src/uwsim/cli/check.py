"""``uwsim check``: all errors of scene, robot, hydrodynamics and benchmark files."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..assets.bundled import bundled, scene_file
from ..errors import BadSetting, Diagnostic, FileError, PluginError, UwsimError
from ..runs.tables import read_plugins
from ..terminal import printable
from .completion import checked_names, scene_names
from .exit_status import WRONG_INPUT
from .options import DataPathOption, JsonOption, PluginOption
from .taught import INPUT, in_group

if TYPE_CHECKING:
    from ..benchmark.plugin import Plugin
    from ..benchmark.plugin_tables import Tables
    from ..scene.spec import SceneSpec


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
        in_group(
            INPUT,
            "--scene",
            metavar="SCENE.xml",
            help="The scene that the benchmarks are run in.",
            autocompletion=scene_names,
        ),
    ] = None,
    strict: Annotated[
        bool,
        in_group(INPUT, "--strict", help="Also compare files with the original's order."),
    ] = False,
    as_json: JsonOption = False,
    plugin: PluginOption = None,
    data_path: DataPathOption = None,
) -> None:
    """Report all errors of scene, robot, hydrodynamics and benchmark files, with line numbers.

    Python code that these files name is located but not run; the code of a --plugin is run.

    Exit status 0 without errors, else 2; an element that is read and not simulated yet is a
    warning. With --json: {"files": [{"file", "diagnostics": [{"file", "line", "severity",
    "message"}]}], "n_errors"}.
    """
    folders = tuple(data_path or ())
    own = read_plugins(plugin)
    named = [bundled_or(file) for file in files]
    scene = None if scene is None else bundled_or(scene)
    found = {
        str(file): diagnostics_of(file, strict=strict, data_path=folders, scene=scene, own=own)
        for file in [*named, *([scene] if scene is not None and scene not in named else [])]
    }
    n_errors = sum(
        diagnostic.severity == "error"
        for diagnostics in found.values()
        for diagnostic in diagnostics
    )
    typer.echo(json_of(found, n_errors) if as_json else lines_of(found))
    if n_errors:
        raise typer.Exit(WRONG_INPUT)


def lines_of(found: Mapping[str, Sequence[Diagnostic]]) -> str:
    """Return one line for each error and warning, and a count for each file."""
    lines = []
    for file, diagnostics in found.items():
        for diagnostic in diagnostics:
            mark = "" if diagnostic.severity == "error" else " (warning)"
            lines.append(f"{diagnostic}{mark}")
        lines.append(
            f"{file}: {_count(sum(diagnostic.severity == 'error' for diagnostic in diagnostics))}"
        )
    return printable("\n".join(lines))


def json_of(found: Mapping[str, Sequence[Diagnostic]], n_errors: int) -> str:
    """Return the same for a program."""
    files = [
        {"file": file, "diagnostics": [asdict(diagnostic) for diagnostic in diagnostics]}
        for file, diagnostics in found.items()
    ]
    return json.dumps({"files": files, "n_errors": n_errors}, indent=1)


def bundled_or(file: Path) -> Path:
    """Return the bundled scene or benchmark of that bare name, where there is no such file."""
    if file.exists():
        return file
    return {**bundled("scenes"), **bundled("benchmarks")}.get(str(file), file)


def diagnostics_of(
    file: Path,
    *,
    strict: bool = False,
    data_path: tuple[Path, ...] = (),
    scene: Path | None = None,
    own: tuple[tuple[Plugin, ...], Tables] | None = None,
) -> list[Diagnostic]:
    """Return everything wrong or worth knowing about a file; its root element says its kind.

    A benchmark is checked with ``scene``, or with the scene that it names; it may use
    what plugins have brought (``own``: they, and the tables with what they add).
    """
    from ..scene.reader import ROOT, check_robot, check_scene
    from ..schema import parse, shown_tag

    try:
        node = parse(file).root
    except FileError as error:
        return list(error.diagnostics)
    root = str(node.tag)
    library = Folders(data_path)
    if root == "robot":
        return check_robot(file, library=library)
    if root == "benchmark":
        plugins, tables = own or read_plugins(())
        return diagnostics_of_benchmark(file, strict, scene, data_path, plugins, tables)
    if root == ROOT:
        return check_scene(
            file,
            strict=strict,
            library=library,
            further=partial(diagnostics_of_dynamics, data_path=data_path),
            settled=partial(settled, data_path=data_path),
        )
    if root == "hydrodynamics":
        return diagnostics_of_hydrodynamics_file(file)
    message = (
        f"the root element is {shown_tag(root)}; expected <{ROOT}>, <benchmark>, <robot> or "
        "<hydrodynamics>"
    )
    return [Diagnostic(file=str(file), line=int(str(node.sourceline)), message=message)]


def diagnostics_of_hydrodynamics_file(file: Path) -> list[Diagnostic]:
    """Return everything wrong with a hydrodynamics file; its links are looked up with a scene."""
    from ..physics.vehicle_file import read_vehicle_into
    from ..schema import Diagnostics

    diagnostics = Diagnostics(file)
    read_vehicle_into(file, None, diagnostics)
    return diagnostics.all()


def diagnostics_of_dynamics(scene: SceneSpec, data_path: tuple[Path, ...]) -> list[Diagnostic]:
    """Return everything wrong with what of a scene is simulated; the engine is heavy to load."""
    from ..scene.spec import stands_on_floor
    from ..topics.thruster_commands import AutopilotTopicSpec

    if not (
        scene.ocean_state.currents
        or scene.vehicles
        or stands_on_floor(scene)
        or any(isinstance(interface, AutopilotTopicSpec) for interface in scene.ros_interfaces)
    ):
        return []
    from ..simulation.checks.scene_checks import check_simulated

    return check_simulated(scene, data_path)


def settled(scene: SceneSpec, data_path: tuple[Path, ...]) -> SceneSpec:
    """Return the scene with everything placed on its floor; unchanged where that fails."""
    from ..scene.spec import stands_on_floor

    if not stands_on_floor(scene):
        return scene
    from ..simulation.bodies import read_robots
    from ..simulation.floor import set_on_floor

    try:
        return set_on_floor(scene, read_robots(scene, data_path), data_path)
    except UwsimError:  # said where floors and robots are checked
        return scene


def diagnostics_of_benchmark(
    file: Path,
    strict: bool,
    scene: Path | None,
    data_path: tuple[Path, ...],
    plugins: tuple[Plugin, ...],
    tables: Tables,
) -> list[Diagnostic]:
    """Return everything wrong or worth knowing about a benchmark and about plugins in it."""
    from ..benchmark.plugin import attribute_errors_to
    from ..benchmark.reader import check_benchmark

    try:
        with attribute_errors_to(plugins):
            found = check_benchmark(
                file,
                strict=strict,
                measures=tables.measures,
                triggers=tables.triggers,
                updaters=tables.updaters,
            )
            if not any(diagnostic.severity == "error" for diagnostic in found):
                found += unknown_names(file, scene, data_path, tables)
    except PluginError as error:
        return list(error.diagnostics)
    return found


def unknown_names(
    file: Path, scene: Path | None, data_path: tuple[Path, ...], tables: Tables
) -> list[Diagnostic]:
    """Look up every name of a benchmark in its scene, and the algorithm in the table."""
    from ..algorithms import load_algorithm
    from ..benchmark import unknown_names as names
    from ..benchmark.reader import read_benchmark
    from ..benchmark.warnings import arm_warnings
    from ..scene.reader import read_scene
    from ..schema import Diagnostics
    from ..simulation import Simulation

    benchmark = read_benchmark(
        file, measures=tables.measures, triggers=tables.triggers, updaters=tables.updaters
    )
    diagnostics = Diagnostics(file)
    if benchmark.algorithm is not None and ":" not in benchmark.algorithm:
        try:
            load_algorithm(benchmark.algorithm, tables.algorithms)
        except BadSetting as error:
            diagnostics.error(root_line(file), str(error))
    wanted = scene or benchmark.scene
    if wanted is None:
        return diagnostics.all()
    try:
        named_by = file if scene is None else None
        path = scene_file(str(wanted), (file.parent, *data_path), named_by=named_by)
        spec = read_scene(path)
        simulation = Simulation(spec, data_path=data_path, is_blind=True, runs_code=False)
    except FileError:
        if scene is None:
            message = f"the scene {str(wanted)!r} has errors: uwsim check {wanted}"
            diagnostics.error(root_line(file), message)
    except UwsimError as error:
        diagnostics.error(root_line(file) if scene is None else None, str(error))
    else:
        try:
            return [
                *diagnostics.all(),
                *names.unknown_names(benchmark, simulation.world),
                *arm_warnings(benchmark, simulation.world.vehicles, simulation.world.robots),
            ]
        finally:
            simulation.close()
    return diagnostics.all()


def root_line(file: Path) -> int:
    """Return the line of the root element, where a benchmark names scene and algorithm."""
    from ..schema import parse

    return int(str(parse(file).root.sourceline))


class Folders:
    """Files and models in the folders that `uwsim.assets` searches."""

    def __init__(self, data_path: tuple[Path, ...]) -> None:
        self._data_path = data_path

    def find(self, name: str, named_by: Path) -> Path | None:
        """Return the file ``name``, which the file ``named_by`` names."""
        from ..assets import find

        return find(name, named_by=named_by, data_path=self._data_path)

    def find_robot(self, name: str, named_by: Path) -> Path | None:
        """Return the robot file ``name``, or else the bundled one of the same file name."""
        from ..assets import bundled_robot

        return self.find(name, named_by) or bundled_robot(name)

    def unreadable(self, name: str, named_by: Path) -> str:
        """Return why the file of a model cannot be read here; empty if it can, or is not there."""
        from ..assets import why_unreadable

        return why_unreadable(name, named_by=named_by, data_path=self._data_path)

    def has_model(self, name: str, named_by: Path) -> bool:
        """Whether there is a model of that name: its file, one of the same stem, or a stand-in."""
        from ..assets import has_model

        return has_model(name, named_by=named_by, data_path=self._data_path)

    def searched(self, named_by: Path) -> str:
        """Return the folders that were searched, those that exist."""
        from ..assets import folders_searched

        folders = folders_searched(named_by=named_by, data_path=self._data_path)
        return ", ".join(str(folder) for folder in folders if folder.is_dir())


def _count(number: int) -> str:
    return {0: "no errors", 1: "1 error"}.get(number, f"{number} errors")
