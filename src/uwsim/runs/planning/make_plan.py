"""Making a plan from a request: reads the files and reports all errors together."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from ...assets.bundled import benchmark_file, scene_file
from ...base.terminal import print_warnings
from ...checks.benchmark_tables import read_plugins
from ...errors import AssetNotFound, BadSetting, ErrorCollector
from ...scene.settings import OF_XACRO, xacro_arguments
from ...schema.source_line import line_of
from ...world import TIMESTEP
from ..foreign_code import announce, refuse_code, refused
from ..named_plugins import named_plugins
from ..program import load_program
from ..stand_ins import warn_of_stand_ins
from .option_values import compatibility_of, levels_of, mode_of, number_or_text, pairs_of
from .plan_request import PlanRequest
from .stored_pilot import PREFIX, with_stored_pilot

if TYPE_CHECKING:
    from ...benchmark.plugin import Plugin
    from ...benchmark.plugin_tables import Tables
    from ...benchmark.spec import BenchmarkSpec
    from ...bus import Algorithm
    from ...scene.spec import SceneSpec
    from .plan import Mode, Plan

MAX_REPEATS = 10_000
OF_ALGORITHM = "algorithm."
"""Begins the ``--set`` that are parameters of the algorithm."""
MAX_TIME = 1e8
"""A benchmark that would simulate longer than this is taken for a typing error [s]."""


@dataclass(frozen=True, kw_only=True)
class _Files:
    """The files read; None for those with errors."""

    plugins: tuple[Plugin, ...] = ()
    tables: Tables | None = None
    benchmark: BenchmarkSpec | None = None
    scene: SceneSpec | None = None


def make_plan(request: PlanRequest) -> Plan:
    """Read the files and make the plan.

    Code that they name is announced before it runs, or refused.

    Raises:
        UwsimError: a file, a name or a setting that is wrong; or SeveralErrors, with all of them.
    """
    from .plan import AlgorithmUnderTest, Plan

    wrong = ErrorCollector()
    inputs: dict[int, bytes] = {}
    with wrong.collect():
        request, inputs = with_stored_pilot(request)
    pairs = pairs_of(request.settings, wrong)
    read = _read_files(request, xacro_arguments(pairs), wrong)
    parameters = {
        name.removeprefix(OF_ALGORITHM): number_or_text(value)
        for name, value in pairs
        if name.startswith(OF_ALGORITHM)
    }
    read = _with_settings(read, pairs, wrong)
    spec, scene = read.benchmark, read.scene
    kind: type[Algorithm] | None = None
    with wrong.collect():
        if scene is not None and request.no_code:
            refuse_code(scene)
    with wrong.collect():
        kind = request.algorithm_class
        name = request.algorithm or ""
        if kind is None and not name.startswith(PREFIX):  # else it has been said what is wrong
            kind = _algorithm(request, read)
    with wrong.collect():
        check_client(request, parameters)
    check_parameters(kind, parameters, wrong)
    mode: Mode = "sequential"
    with wrong.collect():
        mode = mode_of(request.mode or (None if spec is None else spec.mode))
    of_file = () if spec is None else spec.compatibility
    quirks = compatibility_of([*of_file, *request.compat], wrong)
    chosen = levels_of(request.levels, spec, wrong)
    with wrong.collect():
        check_length(spec, chosen, request.repeat)
    wrong.raise_errors()
    assert spec is not None
    assert scene is not None
    assert kind is not None
    return Plan(
        benchmark=spec,
        scene=scene,
        algorithm=AlgorithmUnderTest(
            cls=kind,
            name=_wanted(request, spec),
            parameters=parameters,
            own_process=request.client is None
            and not request.in_process
            and kind not in _bundled_algorithms(_wanted(request, spec)),
            client=request.client,
        ),
        settings=tuple(pairs),
        mode=mode,
        seed=request.seed,
        repeats=request.repeat,
        chosen=chosen,
        timestep=TIMESTEP if spec.timestep is None else spec.timestep,
        compatibility=quirks,
        data_path=tuple(request.data_path),
        inputs=inputs,
        plugins=_with_program(read.plugins, _wanted(request, spec)),
    )


def _with_program(plugins: tuple[Plugin, ...], algorithm: str) -> tuple[Plugin, ...]:
    """Add the file of an algorithm ``FILE.py:Class``: other processes import it as a plugin."""
    file = algorithm.partition(":")[0]
    if not file.endswith(".py"):
        return plugins
    from ...benchmark.plugin import read_plugin

    own = read_plugin(Path(file))
    return plugins if own.module_name in [each.module_name for each in plugins] else (*plugins, own)


def _bundled_algorithms(name: str) -> tuple[type[Algorithm], ...]:
    """Return the bundled algorithm of this name, if there is one; ``module:Class`` is none."""
    from ...algorithms import ALGORITHMS

    return (ALGORITHMS[name],) if name in ALGORITHMS else ()


def _read_files(
    request: PlanRequest, arguments: Mapping[str, str], wrong: ErrorCollector
) -> _Files:
    """Read plugins, benchmark and scene, with xacro arguments; collects their errors."""
    plugins: tuple[Plugin, ...] = ()
    tables: Tables | None = None
    path: Path | None = None
    spec: BenchmarkSpec | None = None
    scene: SceneSpec | None = None
    data_path = tuple(request.data_path)
    with wrong.collect():
        plugins, tables = read_plugins(request.plugins)
    with wrong.collect():
        path = benchmark_file(request.benchmark, data_path)
        if tables is not None:
            if named := named_plugins(path, request):
                plugins, tables = read_plugins([*request.plugins, *named])
            spec = benchmark_of(path, plugins, tables)
    with wrong.collect():
        scene = scene_of(request.scene, path, spec, data_path, arguments)
    return _Files(plugins=plugins, tables=tables, benchmark=spec, scene=scene)


def _with_settings(read: _Files, pairs: Sequence[tuple[str, str]], wrong: ErrorCollector) -> _Files:
    """Apply every ``--set`` of scene and updaters; collects errors."""
    from ...benchmark.updater_settings import (
        apply_updater_setting,
        check_begin,
        leads_to_updater,
    )
    from ...scene.settings import apply_setting

    spec, scene = read.benchmark, read.scene
    for name, value in pairs:
        with wrong.collect():
            if name.startswith((OF_ALGORITHM, OF_XACRO)):
                continue
            if spec is not None and leads_to_updater(spec, name):
                spec = apply_updater_setting(spec, name, value)
            elif scene is not None:
                if spec is not None:
                    check_begin(spec, scene, name, value)
                scene = apply_setting(scene, name, value)
    return replace(read, benchmark=spec, scene=scene)


def _wanted(request: PlanRequest, spec: BenchmarkSpec | None) -> str:
    """Return the name of the algorithm; empty where none is given."""
    if request.client is not None:
        return request.client.name
    return request.algorithm or (None if spec is None else spec.algorithm) or ""


def _algorithm(request: PlanRequest, read: _Files) -> type[Algorithm] | None:
    """Find the algorithm; a class that a file names is announced, or refused."""
    from ...middleware.lockstep.client import LockStepClient

    if request.client is not None:
        return LockStepClient
    wanted, spec = _wanted(request, read.benchmark), read.benchmark
    file = request.algorithm_is_from or ("" if request.algorithm or spec is None else spec.path)
    if file and ":" in wanted:
        if request.no_code:
            raise refused(wanted, file)
        announce(wanted, file)
    try:
        return algorithm_of(wanted, spec, read.tables)
    except BadSetting as error:
        if not wanted or request.algorithm or spec is None:
            raise
        raise BadSetting(f"{spec.path}:{line_of(spec)}: {error}") from error


def say_warnings(plan: Plan) -> None:
    """Print warnings about stand-ins for missing files and about unlikely values."""
    from ...checks import scene_warnings

    warn_of_stand_ins(plan.scene, plan.data_path)
    print_warnings(scene_warnings(plan.scene, plan.data_path, plan.timestep))


def benchmark_of(path: Path, own: Sequence[Plugin], tables: Tables) -> BenchmarkSpec:
    """Read the benchmark, with what plugins have added to the tables."""
    from ...benchmark.plugin import attribute_errors_to
    from ...benchmark.reader import read_benchmark

    with attribute_errors_to(own):
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
    """Read the scene; None where the benchmark that names it could not be read.

    Raises:
        BadSetting: no scene is given.
        AssetNotFound: it is nowhere.
        SceneError: it is wrong.
    """
    from ...scene.reader import read_scene

    named = scene or (None if spec is None else spec.scene)
    if named is None:
        if spec is None:
            return None
        raise BadSetting(
            f"{benchmark}: the benchmark does not name its scene (u:scene); give it with --scene."
        )
    folders = data_path if benchmark is None else (benchmark.parent, *data_path)
    try:
        path = scene_file(named, folders, named_by=None if scene else benchmark)
        return read_scene(path, data_path=folders, arguments=arguments)
    except AssetNotFound:
        if benchmark is None:
            return None  # it may be next to the benchmark, which was not found
        raise


def algorithm_of(
    wanted: str, spec: BenchmarkSpec | None, tables: Tables | None
) -> type[Algorithm] | None:
    """Find the algorithm; None where the file that names it could not be read.

    Raises:
        BadSetting: none is given, or there is none of that name.
    """
    if not wanted and spec is not None:
        raise BadSetting(
            f"{spec.path}: the benchmark does not name an algorithm (u:algorithm); "
            "give one with --algorithm."
        )
    if not wanted or tables is None:
        return None
    return load_program(wanted, tables.algorithms)


def check_client(request: PlanRequest, parameters: Mapping[str, float | str]) -> None:
    """Refuse what does not go together with a client outside; raises BadSetting."""
    if request.client is None:
        return
    name = request.client.name
    if request.algorithm:
        raise BadSetting(f"--algorithm {request.algorithm}: the algorithm is --client {name}.")
    if parameters:
        raise BadSetting(
            f"--set {OF_ALGORITHM}{next(iter(parameters))}: the parameters of --client {name} are "
            "its own."
        )


def check_parameters(
    kind: type[Algorithm] | None, parameters: Mapping[str, float | str], wrong: ErrorCollector
) -> None:
    """Collect errors for parameters that the algorithm does not have."""
    from ... import algorithms
    from ...simulation import latency_of

    for name, value in parameters.items():
        with wrong.collect():
            latency_of({name: value})
            if kind is not None:
                algorithms.check_parameters(kind, {name: value})


def check_length(
    spec: BenchmarkSpec | None, chosen: Sequence[tuple[str, float]], repeat: int
) -> None:
    """Refuse a benchmark of excessive length; raises BadSetting."""
    from ...benchmark import updaters
    from .plan import chosen_levels

    if repeat > MAX_REPEATS:
        raise BadSetting(f"--repeat {repeat}: at most {MAX_REPEATS}.")
    if spec is None:
        return
    settling = max(each.settling_time for each in updaters.chain(spec.scene_updater))
    length = (updaters.interval(spec.scene_updater) or 0.0) + settling
    n_levels = len(chosen_levels(updaters.levels(spec.scene_updater), chosen))
    total = length * n_levels * repeat
    if total > MAX_TIME:
        raise BadSetting(
            f"The benchmark would simulate {total:.3g} s; at most {MAX_TIME:g} s are allowed."
        )
