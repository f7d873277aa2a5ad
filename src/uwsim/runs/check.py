"""All errors and warnings of scene, robot, hydrodynamics and benchmark files.

`diagnostics_of` is what ``uwsim check`` and `uwsim.check` report. Names are looked up in the files
that a file names; nothing is run.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from ..assets.bundled import scene_file
from ..errors import BadSetting, Diagnostic, FileError, PluginError, UwsimError
from .tables import read_plugins

if TYPE_CHECKING:
    from ..benchmark.plugin import Plugin
    from ..benchmark.plugin_tables import Tables
    from ..benchmark.spec import BenchmarkSpec
    from ..scene.spec import SceneSpec


MAX_MACROS = 12
"""Macros or properties of a library that are listed."""


def diagnostics_of(
    file: Path,
    *,
    strict: bool = False,
    data_path: tuple[Path, ...] = (),
    scene: Path | None = None,
    own: tuple[tuple[Plugin, ...], Tables] | None = None,
    arguments: Mapping[str, str] | None = None,
) -> list[Diagnostic]:
    """Return everything wrong or worth knowing about a file; its root element says its kind.

    A benchmark is checked with ``scene``, or with the scene that it names; it may use
    what plugins have brought (``own``: they, and the tables with what they add). ``arguments``
    are values of xacro arguments, by name.
    """
    from ..scene.reader import ROOT, check_robot, check_scene
    from ..scene.xacro import library_of
    from ..schema import parse, shown_tag

    try:
        node = parse(file).root
    except FileError as error:
        return list(error.diagnostics)
    root = str(node.tag)
    library = _Folders(data_path)
    if library_has := library_of(node):
        return _of_library(file, *library_has, data_path, arguments)
    if root == "robot":
        return check_robot(file, library=library, data_path=data_path, arguments=arguments)
    if root == "benchmark":
        plugins, tables = own or read_plugins(())
        return _of_benchmark(file, strict, scene, data_path, plugins, tables, arguments)
    if root == ROOT:
        return check_scene(
            file,
            strict=strict,
            library=library,
            further=partial(_of_simulated, data_path=data_path),
            settled=partial(_settled, data_path=data_path),
            data_path=data_path,
            arguments=arguments,
        )
    if root == "hydrodynamics":
        return _of_hydrodynamics_file(file)
    message = (
        f"the root element is {shown_tag(root)}; expected <{ROOT}>, <benchmark>, <robot> or "
        "<hydrodynamics>"
    )
    if root.startswith("{") and node.prefix is None:
        message += "; xmlns=... puts all elements in a namespace: write xmlns:u=..."
    return [Diagnostic(file=str(file), line=int(str(node.sourceline)), message=message)]


def _of_library(
    file: Path,
    kind: str,
    names: Sequence[str],
    data_path: tuple[Path, ...],
    arguments: Mapping[str, str] | None,
) -> list[Diagnostic]:
    """State that a file is a library of macros or properties; with errors of its expansion."""
    from ..scene.xacro import parse_expanded

    try:
        document = parse_expanded(file, data_path=data_path, arguments=arguments)
    except FileError as error:
        return list(error.diagnostics)
    listed = ", ".join(names[:MAX_MACROS]) + (", ..." if len(names) > MAX_MACROS else "")
    message = (
        f"a library of xacro {kind}: {listed}. It has nothing to simulate by itself; check a file "
        "that includes it and uses them"
    )
    whole = Diagnostic(file=str(file), line=None, message=message, severity="warning")
    return [*document.expansion.warnings, whole]


def _of_hydrodynamics_file(file: Path) -> list[Diagnostic]:
    """Return everything wrong with a hydrodynamics file; its links are looked up with a scene."""
    from ..scene.hydrodynamics.vehicle_file import read_vehicle_into
    from ..schema import Diagnostics

    diagnostics = Diagnostics(file)
    read_vehicle_into(file, None, diagnostics)
    return diagnostics.all()


def _of_simulated(scene: SceneSpec, data_path: tuple[Path, ...]) -> list[Diagnostic]:
    """Return everything wrong with what of a scene is simulated; the engine is heavy to load."""
    from ..scene.spec import stands_on_floor
    from ..topics.thruster_commands import AutopilotTopicSpec

    if not (
        scene.ocean_state.currents
        or scene.vehicles
        or scene.has_uwsim_physics
        or stands_on_floor(scene)
        or any(isinstance(interface, AutopilotTopicSpec) for interface in scene.ros_interfaces)
    ):
        return []
    from ..simulation.checks.scene_checks import check_simulated

    return check_simulated(scene, data_path)


def _settled(scene: SceneSpec, data_path: tuple[Path, ...]) -> SceneSpec:
    """Return the scene with everything placed on its floor; unchanged where that fails."""
    from ..scene.spec import stands_on_floor

    if not stands_on_floor(scene):
        return scene
    from ..model.placement import set_on_floor
    from ..model.robots import read_robots

    try:
        return set_on_floor(scene, read_robots(scene, data_path), data_path)
    except UwsimError:  # said where floors and robots are checked
        return scene


def _of_benchmark(
    file: Path,
    strict: bool,
    scene: Path | None,
    data_path: tuple[Path, ...],
    plugins: tuple[Plugin, ...],
    tables: Tables,
    arguments: Mapping[str, str] | None,
) -> list[Diagnostic]:
    """Return everything wrong or worth knowing about a benchmark and about plugins in it."""
    from ..benchmark.plugin import attribute_errors_to
    from ..benchmark.reader import check_benchmark

    try:
        with attribute_errors_to(plugins):
            found, spec = check_benchmark(
                file,
                strict=strict,
                measures=tables.measures,
                triggers=tables.triggers,
                updaters=tables.updaters,
            )
            if spec is not None:
                is_whole = not any(diagnostic.severity == "error" for diagnostic in found)
                found += _unknown_names(
                    spec, scene, data_path, tables, arguments, is_whole=is_whole
                )
    except PluginError as error:
        return list(error.diagnostics)
    return sorted(found, key=lambda each: (each.line is None, each.line or 0))


def _unknown_names(
    benchmark: BenchmarkSpec,
    scene: Path | None,
    data_path: tuple[Path, ...],
    tables: Tables,
    arguments: Mapping[str, str] | None,
    *,
    is_whole: bool,
) -> list[Diagnostic]:
    """Look up every name of a benchmark in its scene, and the algorithm in the table."""
    from ..algorithms import load_algorithm
    from ..benchmark import unknown_names as names
    from ..benchmark.truth_checks import truth_diagnostics
    from ..benchmark.warnings import arm_warnings
    from ..physics.compile_scene import compile_scene
    from ..scene.reader import read_scene
    from ..schema import Diagnostics
    from ..simulation import Simulation

    file = Path(benchmark.path)
    diagnostics = Diagnostics(file)
    if benchmark.algorithm is not None and ":" not in benchmark.algorithm:
        try:
            load_algorithm(benchmark.algorithm, tables.algorithms)
        except BadSetting as error:
            diagnostics.error(benchmark, str(error))
    wanted = scene or benchmark.scene
    if wanted is None:
        return diagnostics.all()
    try:
        named_by = file if scene is None else None
        path = scene_file(str(wanted), (file.parent, *data_path), named_by=named_by)
        spec = read_scene(path, data_path=data_path, arguments=arguments)
        model = compile_scene(spec, data_path=data_path)
        simulation = Simulation(model, is_blind=True, runs_code=False)
    except FileError:
        if scene is None:
            message = f"the scene {str(wanted)!r} has errors: uwsim check {wanted}"
            diagnostics.error(benchmark, message)
    except UwsimError as error:
        diagnostics.error(benchmark if scene is None else None, str(error))
    else:
        try:
            world = simulation.world
            arms = arm_warnings(benchmark, world.vehicles, world.robots) if is_whole else ()
            found = names.unknown_names(benchmark, world, is_whole=is_whole)
            truths = truth_diagnostics(benchmark, world) if is_whole else ()
            return [*diagnostics.all(), *found, *arms, *truths]
        finally:
            simulation.close()
    return diagnostics.all()


class _Folders:
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

    def bundled_robots(self) -> tuple[str, ...]:
        """Return the file names of the bundled robots."""
        from ..assets import bundled_robots

        return bundled_robots()

    def unreadable(self, name: str, named_by: Path) -> str:
        """Return why the file of a model cannot be read here; empty if it can, or is not there."""
        from ..assets import why_unreadable

        return why_unreadable(name, named_by=named_by, data_path=self._data_path)

    def has_model(self, name: str, named_by: Path) -> bool:
        """Whether there is a model of that name: its file, one of the same stem, or a stand-in."""
        from ..assets import has_model

        return has_model(name, named_by=named_by, data_path=self._data_path)

    def doubtful_size(self, name: str, scale: tuple[float, float, float], named_by: Path) -> str:
        """Return why a robot's mesh is likely not in metres; empty if it may be."""
        from ..assets.doubtful_size import doubtful_size

        return doubtful_size(name, scale, named_by=named_by, data_path=self._data_path)

    def place_remark(self, name: str, named_by: Path) -> str:
        """Return that a file is found elsewhere than its name states, with the place."""
        from ..assets import place_remark

        path = self.find(name, named_by)
        return place_remark(name, path, named_by=named_by, data_path=self._data_path)

    def model_place_remark(self, name: str, named_by: Path) -> str:
        """Return that a model is found elsewhere than its name states, with the place."""
        from ..assets import model_place_remark

        return model_place_remark(name, named_by=named_by, data_path=self._data_path)

    def model_remarks(self, name: str, named_by: Path) -> tuple[str, ...]:
        """Return what of the file of a model cannot be read, though the rest of it can."""
        from ..assets import model_remarks

        return model_remarks(name, named_by=named_by, data_path=self._data_path)

    def package_remark(self, name: str, named_by: Path) -> str:
        """Return that the package of a name is not found, or where it is."""
        from ..assets import package_remark

        return package_remark(name, named_by=named_by, data_path=self._data_path)

    def searched(self, name: str, named_by: Path) -> str:
        """Return that the package of a name is not found, else the folders that were searched."""
        from ..assets import searched_for

        return searched_for(name, named_by=named_by, data_path=self._data_path)
