"""The check of a file: it is read, and the rules of the table are applied to it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, groupby
from pathlib import Path
from typing import TYPE_CHECKING

from ..assets.bundled import scene_file
from ..errors import Diagnostic, FileError, PluginError, SceneError, UwsimError
from ..schema import Diagnostics, format_tag, parse
from ..world import TIMESTEP
from .benchmark_tables import read_plugins
from .rule import Need

if TYPE_CHECKING:
    from ..autopilots.ardupilot.frames import Frame
    from ..benchmark.plugin import Plugin
    from ..benchmark.plugin_tables import Tables
    from ..model.scene_model import SceneModel
    from ..scene.spec import SceneSpec
    from .subjects import CheckedBenchmark, CheckedScene

MAX_MACROS = 12
"""The greatest number of macros or properties of a library that are listed."""


@dataclass(frozen=True)
class ArduPilotCheck:
    """The request to check the vehicles of a scene for ArduPilot."""

    frame: Frame | None = None
    """The frame of ArduSub, or the steering of ArduRover; None for the one that fits best."""


def check_file(
    file: Path,
    *,
    is_strict: bool = False,
    data_path: tuple[Path, ...] = (),
    scene: Path | None = None,
    plugins: tuple[tuple[Plugin, ...], Tables] | None = None,
    arguments: Mapping[str, str] | None = None,
    ardupilot: ArduPilotCheck | None = None,
) -> list[Diagnostic]:
    """Return the errors and warnings about a file; its root element determines its kind.

    Names are resolved in the files that the file names; nothing is run.

    Args:
        file: the file.
        is_strict: True to also check the order of elements in the grammar of the original UWSim.
        data_path: the folders that are searched for files.
        scene: the scene of a benchmark; None for the scene that the benchmark names.
        plugins: the result of `read_plugins`; None for the bundled tables.
        arguments: the values of xacro arguments, by name.
        ardupilot: the rules of scenes about ArduPilot that are applied too; None for none of them.
    """
    from ..scene.reader import ROOT
    from ..scene.xacro import library_of

    try:
        node = parse(file).root
    except FileError as error:
        return list(error.diagnostics)
    root = str(node.tag)
    if library := library_of(node):
        return _check_library(file, *library, data_path, arguments)
    if root == "robot":
        from .robots import check_robot
        from .table import ROBOT_RULES

        return check_robot(file, ROBOT_RULES, data_path=data_path, arguments=arguments)
    if root == "benchmark":
        plugin_list, tables = plugins or read_plugins(())
        return _check_benchmark(file, is_strict, scene, data_path, plugin_list, tables, arguments)
    if root == ROOT:
        return _check_scene(file, is_strict, data_path, arguments, ardupilot)
    if root == "hydrodynamics":
        return _check_hydrodynamics(file)
    message = (
        f"the root element is {format_tag(root)}; expected <{ROOT}>, <benchmark>, <robot>, "
        "<hydrodynamics> or <suite>"
    )
    if root.startswith("{") and node.prefix is None:
        message += "; xmlns=... sets a namespace of all elements: write xmlns:u=..."
    return [Diagnostic(file=str(file), line=int(str(node.sourceline)), message=message)]


def _check_scene(
    path: Path,
    is_strict: bool,
    data_path: tuple[Path, ...],
    arguments: Mapping[str, str] | None,
    ardupilot: ArduPilotCheck | None,
) -> list[Diagnostic]:
    from ..scene.reader import read_document
    from ..scene.xacro import parse_expanded
    from .subjects import CheckedScene

    diagnostics = Diagnostics(path, is_strict=is_strict)
    try:
        document = parse_expanded(path, error=SceneError, data_path=data_path, arguments=arguments)
    except SceneError as error:
        return list(error.diagnostics)
    spec = read_document(document, diagnostics)
    if spec is None:
        return [*document.expansion.warnings, *diagnostics.to_list()]
    scene = CheckedScene(spec, data_path, document=document, diagnostics=diagnostics)
    return _apply(scene, ardupilot)


def scene_warnings(
    scene: SceneSpec, data_path: tuple[Path, ...], timestep: float = TIMESTEP
) -> list[Diagnostic]:
    """Return the warnings about a scene that is not compiled, with the lines of its file."""
    from ..model.dynamics import read_dynamics
    from ..model.resolved_scene import ResolvedScene
    from ..model.robots import read_robots
    from .subjects import CheckedScene

    robots = read_robots(scene, data_path)
    dynamics = read_dynamics(ResolvedScene(scene=scene, robots=robots, data_path=data_path))
    return _apply(CheckedScene(scene, data_path, timestep=timestep, parts=(robots, dynamics)))


def model_warnings(model: SceneModel) -> list[Diagnostic]:
    """Return the warnings about a scene that is compiled, with the lines of its file."""
    from .subjects import CheckedScene

    parts = (model.robots, model.dynamics)
    return _apply(
        CheckedScene(model.varied_scene, model.data_path, timestep=model.timestep, parts=parts)
    )


def _apply(scene: CheckedScene, ardupilot: ArduPilotCheck | None = None) -> list[Diagnostic]:
    """Apply the rules in order, each if the input that it needs could be made.

    Diagnostics about the spec are sorted by line, together with the diagnostics of the reader.
    """
    from .table import SCENE_RULES, ardupilot_rules

    rules = [rule for rule in SCENE_RULES if (rule.in_runs if scene.is_run else rule.in_check)]
    rules += () if ardupilot is None else ardupilot_rules(ardupilot.frame)
    diagnostics: list[Diagnostic] = []
    failed_needs: set[Need] = set()
    for need, group in groupby(rules, key=lambda rule: rule.need):
        if need >= Need.VALID and not scene.is_valid:
            continue
        if need is Need.MODEL and Need.VALID in failed_needs:
            continue
        reports = chain.from_iterable(rule.apply(scene) for rule in group)
        if need is Need.SPEC:
            scene.extend(reports)  # one by one: `Diagnostics.suggest` counts them
        need_diagnostics = scene.diagnostics.to_list() if need is Need.SPEC else list(reports)
        if _has_error(need_diagnostics):
            failed_needs.add(need)
        diagnostics += need_diagnostics
    return diagnostics


def _has_error(diagnostics: Iterable[Diagnostic]) -> bool:
    return any(diagnostic.severity == "error" for diagnostic in diagnostics)


def _check_library(
    file: Path,
    kind: str,
    names: Sequence[str],
    data_path: tuple[Path, ...],
    arguments: Mapping[str, str] | None,
) -> list[Diagnostic]:
    """Report the errors of a library of macros or properties, and that it is only a library."""
    from ..scene.xacro import parse_expanded

    try:
        document = parse_expanded(file, data_path=data_path, arguments=arguments)
    except FileError as error:
        return list(error.diagnostics)
    listed_names = ", ".join(names[:MAX_MACROS]) + (", ..." if len(names) > MAX_MACROS else "")
    message = (
        f"a library of xacro {kind}: {listed_names}. It contains nothing to simulate; check a file "
        "that includes it and uses them"
    )
    warning = Diagnostic(file=str(file), line=None, message=message, severity="warning")
    return [*document.expansion.warnings, warning]


def _check_hydrodynamics(file: Path) -> list[Diagnostic]:
    from ..scene.hydrodynamics.vehicle_file import read_vehicle_into

    diagnostics = Diagnostics(file)
    read_vehicle_into(file, None, diagnostics)
    return diagnostics.to_list()


def _check_benchmark(
    file: Path,
    is_strict: bool,
    scene: Path | None,
    data_path: tuple[Path, ...],
    plugins: tuple[Plugin, ...],
    tables: Tables,
    arguments: Mapping[str, str] | None,
) -> list[Diagnostic]:
    from ..benchmark.plugin import attribute_errors_to
    from ..benchmark.reader import check_benchmark
    from .subjects import CheckedBenchmark

    try:
        with attribute_errors_to(plugins):
            diagnostics, spec = check_benchmark(
                file,
                is_strict=is_strict,
                measures=tables.measures,
                triggers=tables.triggers,
                updaters=tables.updaters,
            )
            if spec is not None:
                benchmark = CheckedBenchmark(
                    spec, Diagnostics(file), tables, is_whole=not _has_error(diagnostics)
                )
                diagnostics += _apply_in_scene(benchmark, scene, data_path, plugins, arguments)
    except PluginError as error:
        return list(error.diagnostics)
    return sorted(diagnostics, key=lambda entry: (entry.line is None, entry.line or 0))


def _apply_in_scene(
    benchmark: CheckedBenchmark,
    scene: Path | None,
    data_path: tuple[Path, ...],
    plugins: tuple[Plugin, ...],
    arguments: Mapping[str, str] | None,
) -> list[Diagnostic]:
    """Apply the rules about a benchmark alone, and then the rules about it in its scene."""
    from ..benchmark.plugin import attribute_errors_to
    from ..physics.compile_scene import compile_scene
    from ..scene.reader import read_scene
    from ..simulation import Simulation
    from .table import BENCHMARK_RULES

    def apply(need: Need) -> list[Diagnostic]:
        return [
            diagnostic
            for rule in BENCHMARK_RULES
            if rule.need is need
            for diagnostic in rule.apply(benchmark, attribute_errors_to(plugins))
        ]

    diagnostics, spec = apply(Need.SPEC), benchmark.spec
    scene_name, file = scene or spec.scene, Path(spec.path)
    if scene_name is None:
        return diagnostics
    try:
        named_by = file if scene is None else None
        path = scene_file(str(scene_name), (file.parent, *data_path), named_by=named_by)
        scene_spec = read_scene(path, data_path=data_path, arguments=arguments)
        model = compile_scene(scene_spec, data_path=data_path)
        simulation = Simulation(model, is_blind=True, runs_code=False)
    except FileError:
        if scene is None:
            message = f"the scene {str(scene_name)!r} has errors: uwsim check {scene_name}"
            diagnostics.append(benchmark.error(spec, message))
        return diagnostics
    except UwsimError as error:
        return [*diagnostics, benchmark.error(spec if scene is None else None, str(error))]
    try:
        benchmark.model, benchmark.stage = model, simulation.world.stage_view
        return [*diagnostics, *apply(Need.MODEL)]
    finally:
        simulation.close()
