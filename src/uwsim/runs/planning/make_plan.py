"""The construction of a plan from a request: reads the files and reports all errors together."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from ...assets.bundled import benchmark_file, scene_file
from ...base.terminal import print_warnings
from ...checks.benchmark_tables import read_plugins
from ...errors import AssetNotFound, BadSetting, BenchmarkError, ErrorCollector
from ...scene.settings import XACRO_PREFIX, xacro_arguments
from ...schema.source_line import line_of
from ...world import TIMESTEP
from ..foreign_code import announce, code_refusal, refuse_code
from ..named_plugins import named_plugins
from ..own_process.facts import AlgorithmFacts
from ..program import load_program
from ..substituted_files import warn_of_substituted_files
from .ardupilot_scene import connect_ardupilot, exchange_timestep
from .isolated_algorithm import IsolatedAlgorithm, isolated_algorithm
from .option_values import compatibility_of, levels_of, mode_of, number_or_text, pairs_of
from .plan_request import PlanRequest
from .px4_scene import connect_px4
from .stored_pilot import PREFIX, with_stored_pilot

if TYPE_CHECKING:
    from ...benchmark.plugin import Plugin
    from ...benchmark.plugin_tables import Tables
    from ...benchmark.spec import BenchmarkSpec
    from ...bus import Algorithm
    from ...scene.spec import SceneSpec
    from .plan import Mode, Plan

MAX_REPEATS = 10_000
ALGORITHM_PREFIX = "algorithm."
"""The prefix of ``--set`` for parameters of the algorithm."""
MAX_TIME = 1e8
"""The longest simulation time of a benchmark; a longer one is taken for a typing error [s]."""


@dataclass(frozen=True, kw_only=True)
class _Files:
    """The content of the files of a request; None for a file with errors."""

    plugins: tuple[Plugin, ...] = ()
    tables: Tables | None = None
    benchmark: BenchmarkSpec | None = None
    scene: SceneSpec | None = None


def make_plan(request: PlanRequest) -> Plan:
    """Read the files of a request and make the plan.

    Code that the files name is announced before it runs, or refused.

    Raises:
        UwsimError: a file, a name or a setting is invalid; SeveralErrors if there are several.
    """
    from .plan import AlgorithmUnderTest, Plan

    errors = ErrorCollector()
    inputs: dict[int, bytes] = {}
    with errors.collect():
        request, inputs = with_stored_pilot(request)
    pairs = pairs_of(request.settings, errors)
    files = _read_files(request, xacro_arguments(pairs), errors)
    parameters = {
        name.removeprefix(ALGORITHM_PREFIX): number_or_text(value)
        for name, value in pairs
        if name.startswith(ALGORITHM_PREFIX)
    }
    files = _apply_settings(files, pairs, errors)
    spec, scene = files.benchmark, files.scene
    algorithm_class: type[Algorithm] | AlgorithmFacts | None = None
    isolated_program: IsolatedAlgorithm | None = None
    with errors.collect():
        if scene is not None and request.no_code:
            refuse_code(scene)
    with errors.collect():
        algorithm_class = request.algorithm_class
        name = request.algorithm or ""
        # a name that still has the prefix has an error, which has been collected
        if algorithm_class is None and not name.startswith(PREFIX):
            isolated_program = isolated_algorithm(
                request, _algorithm_name(request, spec), parameters
            )
            algorithm_class = (
                _algorithm(request, files)
                if isolated_program is None
                else isolated_program.description.facts
            )
    with errors.collect():
        if scene is not None and request.udp_address is not None:
            scene = (
                connect_px4(scene)
                if request.has_px4
                else connect_ardupilot(scene, ends_on_restart=True)
            )
    with errors.collect():
        check_client(request, parameters)
    refusals = {} if isolated_program is None else isolated_program.description.refusals
    check_parameters(algorithm_class, parameters, errors, refusals)
    mode: Mode = "sequential"
    with errors.collect():
        mode = mode_of(request.mode or (None if spec is None else spec.mode))
    with errors.collect():
        if spec is not None and scene is not None:
            _check_scene_settings(spec, scene, mode)
    file_quirks = () if spec is None else spec.compatibility
    quirks = compatibility_of([*file_quirks, *request.compat], errors)
    levels = levels_of(request.levels, spec, errors)
    with errors.collect():
        check_length(spec, levels, request.repeat)
    errors.raise_errors()
    assert spec is not None
    assert scene is not None
    assert algorithm_class is not None
    return Plan(
        benchmark=spec,
        scene=scene,
        algorithm=AlgorithmUnderTest(
            cls=algorithm_class,
            name=_algorithm_name(request, spec),
            parameters=parameters,
            own_process=request.client is None
            and not request.in_process
            and algorithm_class not in _bundled_algorithms(_algorithm_name(request, spec)),
            client=request.client,
            folder=None if isolated_program is None else isolated_program.folder,
            sources=None if isolated_program is None else isolated_program.description.sources,
        ),
        settings=tuple(pairs),
        mode=mode,
        seed=request.seed,
        repeats=request.repeat,
        track=request.track,
        level_choices=levels,
        timestep=_timestep_of(spec, scene, request),
        udp_address=request.udp_address,
        has_px4=request.has_px4,
        compatibility=quirks,
        data_path=tuple(request.data_path),
        inputs=inputs,
        plugins=(
            _add_program(files.plugins, _algorithm_name(request, spec))
            if isolated_program is None
            else (*files.plugins, *isolated_program.plugins)
        ),
    )


def _check_scene_settings(spec: BenchmarkSpec, scene: SceneSpec, mode: Mode) -> None:
    """Raise BenchmarkError for an updater that cannot set its number of the scene."""
    from ...benchmark.updater_settings import check_scene_settings

    if diagnostics := check_scene_settings(spec, scene, is_independent=mode == "independent"):
        raise BenchmarkError(diagnostics)


def _timestep_of(spec: BenchmarkSpec, scene: SceneSpec, request: PlanRequest) -> float:
    """Return the length of a step [s]: that of the file, or the one that suits ArduPilot."""
    if spec.timestep is not None:
        return spec.timestep
    if request.udp_address is None or request.has_px4:
        return TIMESTEP
    return exchange_timestep(scene)


def _add_program(plugins: tuple[Plugin, ...], algorithm: str) -> tuple[Plugin, ...]:
    """Add the file of an algorithm ``FILE.py:Class``, so that other processes can import it."""
    file = algorithm.partition(":")[0]
    if not file.endswith(".py"):
        return plugins
    from ...benchmark.plugin import read_plugin

    program = read_plugin(Path(file))
    names = [plugin.module_name for plugin in plugins]
    return plugins if program.module_name in names else (*plugins, program)


def _bundled_algorithms(name: str) -> tuple[type[Algorithm], ...]:
    """Return the bundled algorithm that this name selects; empty if there is none."""
    from ...algorithms import ALGORITHMS

    return (ALGORITHMS[name],) if name in ALGORITHMS else ()


def _read_files(
    request: PlanRequest, arguments: Mapping[str, str], errors: ErrorCollector
) -> _Files:
    """Read plugins, benchmark and scene; collect their errors.

    Args:
        request: the request.
        arguments: the xacro arguments of the scene.
        errors: the collection of errors.
    """
    plugins: tuple[Plugin, ...] = ()
    tables: Tables | None = None
    path: Path | None = None
    spec: BenchmarkSpec | None = None
    scene: SceneSpec | None = None
    data_path = tuple(request.data_path)
    with errors.collect():
        plugins, tables = read_plugins(request.plugins)
    with errors.collect():
        path = benchmark_file(request.benchmark, data_path)
        if tables is not None:
            if named_paths := named_plugins(path, request):
                plugins, tables = read_plugins([*request.plugins, *named_paths])
            spec = benchmark_of(path, plugins, tables)
    with errors.collect():
        scene = scene_of(request.scene, path, spec, data_path, arguments)
    return _Files(plugins=plugins, tables=tables, benchmark=spec, scene=scene)


def _apply_settings(
    files: _Files, pairs: Sequence[tuple[str, str]], errors: ErrorCollector
) -> _Files:
    """Apply the ``--set`` pairs of updaters and scene; collect errors."""
    from ...benchmark.updater_settings import (
        apply_updater_setting,
        check_path_start,
        is_updater_path,
    )
    from ...scene.settings import apply_setting

    spec, scene = files.benchmark, files.scene
    for name, value in pairs:
        with errors.collect():
            if name.startswith((ALGORITHM_PREFIX, XACRO_PREFIX)):
                continue
            if spec is not None and is_updater_path(spec, name):
                spec = apply_updater_setting(spec, name, value)
            elif scene is not None:
                if spec is not None:
                    check_path_start(spec, scene, name, value)
                scene = apply_setting(scene, name, value)
    return replace(files, benchmark=spec, scene=scene)


def _algorithm_name(request: PlanRequest, spec: BenchmarkSpec | None) -> str:
    if request.client is not None:
        return request.client.name
    return request.algorithm or (None if spec is None else spec.algorithm) or ""


def _algorithm(request: PlanRequest, files: _Files) -> type[Algorithm] | None:
    """Find the algorithm; announce or refuse a class that a file names."""
    from ...middleware.lockstep.client import LockStepClient

    if request.client is not None:
        return LockStepClient
    name, spec = _algorithm_name(request, files.benchmark), files.benchmark
    file = request.algorithm_is_from or ("" if request.algorithm or spec is None else spec.path)
    if file and ":" in name:
        if request.no_code:
            raise code_refusal(name, file)
        announce(name, file)
    try:
        return algorithm_of(name, spec, files.tables)
    except BadSetting as error:
        if not name or request.algorithm or spec is None:
            raise
        raise BadSetting(f"{spec.path}:{line_of(spec)}: {error}") from error


def print_scene_warnings(plan: Plan) -> None:
    """Print warnings about bundled files that replace missing files, and about unlikely values."""
    from ...checks import scene_warnings

    warn_of_substituted_files(plan.scene, plan.data_path)
    print_warnings(scene_warnings(plan.scene, plan.data_path, plan.timestep))


def benchmark_of(path: Path, plugins: Sequence[Plugin], tables: Tables) -> BenchmarkSpec:
    """Read the benchmark, with the entries that plugins have added to the tables."""
    from ...benchmark.plugin import attribute_errors_to
    from ...benchmark.reader import read_benchmark

    with attribute_errors_to(plugins):
        return read_benchmark(
            path, measures=tables.measures, triggers=tables.triggers, updaters=tables.updaters
        )


def scene_of(
    scene: str | None,
    benchmark: Path | None,
    spec: BenchmarkSpec | None,
    data_path: tuple[Path, ...],
    arguments: Mapping[str, str],
) -> SceneSpec | None:
    """Read the scene; return None if the benchmark that names it could not be read.

    Raises:
        BadSetting: no scene is named.
        AssetNotFound: its file is not found.
        SceneError: its file is invalid.
    """
    from ...scene.reader import read_scene

    name = scene or (None if spec is None else spec.scene)
    if name is None:
        if spec is None:
            return None
        raise BadSetting(
            f"{benchmark}: the benchmark does not name its scene (u:scene); give it with --scene."
        )
    folders = data_path if benchmark is None else (benchmark.parent, *data_path)
    try:
        path = scene_file(name, folders, named_by=None if scene else benchmark)
        return read_scene(path, data_path=folders, arguments=arguments)
    except AssetNotFound:
        if benchmark is None:
            return None  # it may be next to the benchmark, which was not found
        raise


def algorithm_of(
    name: str, spec: BenchmarkSpec | None, tables: Tables | None
) -> type[Algorithm] | None:
    """Find the algorithm; return None if the file that names it could not be read.

    Raises:
        BadSetting: no algorithm is named, or none has that name.
    """
    if not name and spec is not None:
        raise BadSetting(
            f"{spec.path}: the benchmark does not name an algorithm (u:algorithm); "
            "give one with --algorithm."
        )
    if not name or tables is None:
        return None
    return load_program(name, tables.algorithms)


def check_client(request: PlanRequest, parameters: Mapping[str, float | str]) -> None:
    """Raise BadSetting for options that cannot be combined with an external program."""
    if request.client is None:
        return
    name = request.client.name
    if request.algorithm:
        raise BadSetting(f"--algorithm {request.algorithm}: the algorithm is --client {name}.")
    if parameters:
        raise BadSetting(
            f"--set {ALGORITHM_PREFIX}{next(iter(parameters))}: "
            f"the parameters of --client {name} are its own."
        )


def check_parameters(
    algorithm_class: type[Algorithm] | AlgorithmFacts | None,
    parameters: Mapping[str, float | str],
    errors: ErrorCollector,
    refusals: Mapping[str, str] = MappingProxyType({}),
) -> None:
    """Collect errors for parameters that the algorithm does not have.

    Args:
        algorithm_class: the class, or facts of it; None for an algorithm that was not found.
        parameters: the parameters.
        errors: the collection of errors.
        refusals: the errors that an isolated algorithm has found, by parameter.
    """
    from ... import algorithms
    from ...simulation import latency_of

    for name, value in parameters.items():
        with errors.collect():
            latency_of({name: value})
            if name in refusals:
                raise BadSetting(refusals[name])
            if algorithm_class is not None and not isinstance(algorithm_class, AlgorithmFacts):
                algorithms.check_parameters(algorithm_class, {name: value})


def check_length(
    spec: BenchmarkSpec | None, level_choices: Sequence[tuple[str, float]], repeat: int
) -> None:
    """Raise BadSetting if a benchmark simulates more than `MAX_TIME` or has too many repeats."""
    from ...benchmark import updaters
    from .plan import chosen_levels

    if repeat > MAX_REPEATS:
        raise BadSetting(f"--repeat {repeat}: at most {MAX_REPEATS}.")
    if spec is None:
        return
    settling = max(updater.settling_time for updater in updaters.chain(spec.scene_updater))
    length = (updaters.interval(spec.scene_updater) or 0.0) + settling
    n_levels = len(chosen_levels(updaters.levels(spec.scene_updater), level_choices))
    total = length * n_levels * repeat
    if total > MAX_TIME:
        raise BadSetting(
            f"The benchmark would simulate {total:.3g} s; at most {MAX_TIME:g} s are allowed."
        )
