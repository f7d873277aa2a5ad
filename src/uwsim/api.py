"""The functions of the Python interface: `load`, `bench`, `check`, `compare`, `gap`, `read_result`.

Files are found as by the command line: a path, a name in a search folder, or a bundled name. All
functions take `str` or `Path`. They raise an `UwsimError` of one or more lines, which states the
file, the line and the nearest valid name.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from numbers import Integral, Real
from pathlib import Path
from typing import TYPE_CHECKING, cast

from .errors import BadSetting, Diagnostic, ErrorCollector, short_repr
from .world import TIMESTEP

if TYPE_CHECKING:
    from .algorithms.policy import Policy
    from .analysis.comparison.model import Comparison
    from .bus import Algorithm
    from .editing import Benchmark, Scene
    from .editing.run_files import RunFiles
    from .logs import VehicleLog
    from .reality_gap import Gap
    from .results.result import Result
    from .runs.planning.plan_request import PlanRequest
    from .scene.spec import SceneSpec
    from .simulation import Simulation

Setting = str | float | int
OnProgress = Callable[[int, int], object]
"""A function that is called with the number of finished levels and the number of all levels."""


def load(
    scene: str | Path | Scene | SceneSpec,
    *,
    seed: int = 0,
    timestep: float = TIMESTEP,
    settings: Mapping[str, Setting] | None = None,
    data_path: Sequence[str | Path] = (),
    udp_address: str | None = None,
    is_blind: bool = False,
) -> Simulation:
    """Open a scene at step 0; the first `advance` publishes the first messages.

    Args:
        scene: a scene file, a bundled name (``uwsim list scenes``), a `Scene`, or its spec.
        seed: the seed of all random streams, and of the variations of the scene (``<u:vary>``).
        timestep: the length of a physics step [s].
        settings: values of the scene to change, as ``--set`` names them:
            ``{"oceanState.fog.density": 0.4}``; ``{"xacro.depth": 3}`` is a xacro argument.
        data_path: more folders in which files are searched.
        udp_address: the address of this computer at which vehicles with ``<fdm>`` receive UDP
            packets, such as ``127.0.0.1``; None: they receive none, so that runs are repeatable.
        is_blind: True to publish black images on topics, and to render nothing for them.

    Raises:
        UwsimError: a file, a name or a setting is invalid; the error message has all errors of the
            file.
    """
    from .assets.bundled import scene_file
    from .physics.compile_scene import compile_scene
    from .scene.reader import read_scene
    from .scene.settings import apply_setting, xacro_arguments
    from .scene.spec import SceneSpec
    from .simulation import Simulation
    from .simulation.access.arguments import check_seed

    folders = _folders_of(data_path)
    settings = _checked_settings(settings)
    if isinstance(scene, str | Path):
        arguments = xacro_arguments(settings.items())
        path_of_scene = scene_file(str(scene), folders)
        scene = read_scene(path_of_scene, data_path=folders, arguments=arguments)
    elif not isinstance(scene, SceneSpec):
        scene = scene.checked_spec()
    for path, value in settings.items():
        scene = apply_setting(scene, path, str(value))
    model = compile_scene(
        scene, seed=check_seed(seed, "load"), timestep=timestep, data_path=folders
    )
    return Simulation(model, udp_address=udp_address, is_blind=is_blind)


def bench(
    benchmark: str | Path | Benchmark,
    *,
    scene: str | Path | Scene | None = None,
    algorithm: str | type[Algorithm] | type[Policy] | None = None,
    seeds: Sequence[int] = (0,),
    levels: Mapping[str, Sequence[float]] | None = None,
    settings: Mapping[str, Setting] | None = None,
    data_path: Sequence[str | Path] = (),
    workers: int = 0,
    out: str | Path | None = None,
    on_progress: OnProgress | None = None,
) -> Result:
    """Run a benchmark as ``uwsim bench`` does.

    With the same options ``out`` has the same files with the same bytes, except for values in which
    two runs of the command differ, too: date, durations and load in ``provenance.json`` and
    ``report.html``. The command in ``provenance.json`` is empty. Warnings about files, and the
    Python code that they name, are printed on standard error.

    Args:
        benchmark: a benchmark file, a bundled name, or a `Benchmark`.
        scene: the scene; None: the scene that the benchmark names. A `Benchmark` or a `Scene` is
            written as a file, which ``out`` keeps in its folder ``inputs``.
        algorithm: a name (``uwsim list algorithms``), ``module:Class``, or a class of algorithms or
            policies; a class runs in the process of the simulation, as with ``--in-process``.
        seeds: the seeds of the repeats; consecutive, such as ``range(6)``.
        levels: the levels of the sweep to run, as numbers: ``{"fog": [0.0, 1 / 3]}``.
        settings: values to change, as ``--set`` names them; ``algorithm.kp`` is a parameter.
        data_path: more folders in which files are searched.
        workers: the number of processes; 0 runs everything in this process, including the control
            (a run of an algorithm that does nothing) and the report. With more, the program needs
            ``if __name__ == "__main__":``.
        out: the result directory, which is empty or does not exist. It receives all files that
            ``uwsim bench`` writes, including those of the control and the report. None: no files
            remain; only the result is returned.
        on_progress: a function that is called with the number of finished levels and the number of
            all levels, at the beginning and after each level.

    Raises:
        UwsimError: an input is invalid, or a run failed as in the command; also if a simulation
            failed, or the algorithm failed in every row. Finished rows remain in ``out``.
    """
    from .editing.run_files import locate_errors, write_run_files
    from .runs.planning.plan_request import PlanRequest

    name, algorithm_class = _name_and_class(algorithm)
    if out is not None and not isinstance(out, str | os.PathLike):
        raise BadSetting(f"out={short_repr(out)}: expected a directory, as 'one.result', or None.")
    if on_progress is not None and not callable(on_progress):
        raise BadSetting(f"on_progress={short_repr(on_progress)}: expected a function, or None.")
    first_seed = _first_seed(seeds)
    with tempfile.TemporaryDirectory(prefix="uwsim-") as folder:
        files = write_run_files(benchmark, scene, Path(folder))
        request = PlanRequest(
            benchmark=files.benchmark,
            scene=files.scene,
            algorithm=name,
            algorithm_class=algorithm_class,
            in_process=algorithm_class is not None,
            seed=first_seed,
            repeat=len(seeds),
            levels=_pairs_of({} if levels is None else levels),
            settings=[f"{path}={value}" for path, value in _checked_settings(settings).items()],
            data_path=(*_folders_of(data_path), *files.folders),
            plugins=files.plugins,
        )
        with locate_errors(files):
            return _execute_request(request, files, workers, out, on_progress)


def _execute_request(
    request: PlanRequest,
    files: RunFiles,
    workers: int,
    out: str | Path | None,
    on_progress: OnProgress | None,
) -> Result:
    """Run a request in the directory ``out``, or in a temporary one that is removed."""
    from .analysis.load_reporter import load_reporter
    from .editing.run_files import keep_run_files
    from .results.directory import check as check_directory
    from .results.directory import prepare_directory
    from .runs.execute import Callbacks, execute, plan_all, prepare_execution
    from .runs.executors.background import BackgroundProcess, JobRunner
    from .runs.executors.choose import CALLBACK_LIMIT

    with tempfile.TemporaryDirectory(prefix="uwsim-") as scratch:
        directory = Path(scratch) / "result" if out is None else Path(out)
        errors = ErrorCollector()
        executor, plans = plan_all([request], str(workers), CALLBACK_LIMIT, errors)
        with errors.collect():
            check_directory(directory, resume=False, overwrite=False)
        errors.raise_errors()
        execution = prepare_execution(plans, executor, directory, workers=str(workers))
        open_runner = partial(BackgroundProcess if workers else JobRunner, load_reporter)
        (result,) = execute(
            execution,
            keep_run_files(
                prepare_directory(directory, resume=False, overwrite=False), directory, files
            ),
            None if out is None else open_runner,
            Callbacks(progress=partial(_count_levels, on_progress)),
        )
    return result


def _name_and_class(
    algorithm: str | type[Algorithm] | type[Policy] | None,
) -> tuple[str | None, type[Algorithm] | None]:
    """Return the name of an algorithm, and the class if one is given; raise BadSetting."""
    if algorithm is None or isinstance(algorithm, str):
        return algorithm, None
    if not isinstance(algorithm, type):
        raise BadSetting(
            f"algorithm={short_repr(algorithm)}: expected a name, 'module:Class', or a class, not "
            "an object."
        )
    algorithm_class = cast("type[Algorithm]", algorithm)  # the plan makes one of a policy
    return f"{algorithm.__module__}:{algorithm.__qualname__}", algorithm_class


@contextmanager
def _count_levels(
    on_progress: OnProgress | None, title: str, total: int, n_finished: int
) -> Iterator[Callable[[], None]]:
    """Yield a function that counts a finished level and calls ``on_progress``."""

    def on_level() -> None:
        nonlocal n_finished
        n_finished += 1
        report(n_finished, total)

    report = on_progress or (lambda n_finished, total: None)
    report(n_finished, total)
    yield on_level


def _checked_settings(settings: Mapping[str, Setting] | None) -> Mapping[str, Setting]:
    """Return settings, empty for None; raise BadSetting if they are not a mapping."""
    if settings is None or isinstance(settings, Mapping):
        return settings or {}
    raise BadSetting(
        f"settings={settings!r}: expected a dictionary, as {{'oceanState.fog.density': 0.4}}."[:300]
    )


def _folders_of(data_path: Sequence[str | Path]) -> tuple[Path, ...]:
    """Return folders as paths; raise BadSetting if they are not a collection of paths."""
    if isinstance(data_path, str) or not isinstance(data_path, Collection):
        raise BadSetting(f"data_path={short_repr(data_path)}: expected folders, as ['meshes'].")
    for folder in data_path:
        if not isinstance(folder, str | os.PathLike):
            raise BadSetting(f"data_path=[{short_repr(folder)}]: expected folders, as ['meshes'].")
    return tuple(Path(folder) for folder in data_path)


def _pairs_of(levels: Mapping[str, Sequence[float]]) -> list[tuple[str, float]]:
    """Return the names and values of levels; raise BadSetting if a value is not a number."""
    pairs: list[tuple[str, float]] = []
    if not isinstance(levels, Mapping) or not all(
        isinstance(name, str) and isinstance(values, Collection) for name, values in levels.items()
    ):
        raise BadSetting(
            f"levels={short_repr(levels)}: expected names and lists, as {{'fog': [0.5]}}."
        )
    for name, values in levels.items():
        numbers = [_finite_number(value) for value in values]
        for value, number in zip(values, numbers, strict=True):
            if number is None:
                raise BadSetting(f"levels={{{name!r}: [{short_repr(value)}]}}: expected numbers.")
            pairs.append((name, number))
        if not numbers:
            raise BadSetting(f"levels={{{name!r}: []}}: expected one number at least.")
    return pairs


def _finite_number(value: object) -> float | None:
    """Return a number as a float; None for other types, and for numbers that no float holds."""
    from .base.external_values import finite_float

    if not isinstance(value, Real) or isinstance(value, bool):
        return None
    return finite_float(value)


def _first_seed(seeds: Sequence[int]) -> int:
    """Return the first of consecutive seeds; raise BadSetting if they are not consecutive."""
    if isinstance(seeds, int):
        seed_text = short_repr(seeds)
        raise BadSetting(
            f"seeds={seed_text}: expected a sequence, such as ({seed_text},) or range(6)."
        )
    seed_list = list(seeds) if isinstance(seeds, Collection) else []
    are_integers = all(isinstance(s, Integral) and not isinstance(s, bool) for s in seed_list)
    first_seed = int(seed_list[0]) if seed_list and are_integers else -1
    if first_seed < 0 or seed_list != list(range(first_seed, first_seed + len(seed_list))):
        raise BadSetting(
            f"seeds={short_repr(seeds)}: expected consecutive seeds >= 0, such as (0,) or range(6)."
        )
    return first_seed


def read_result(path: str | Path) -> Result:
    """Read a result directory, or a ``result.json``, of any format version up to the present.

    Raises:
        ResultError: the result does not exist, is incomplete, or has another format.
    """
    from .results.result_file import load as load_result

    return load_result(path)


def compare(
    *results: str | Path, column: str | None = None, higher_is_better: bool = False
) -> Comparison:
    """Compare results of one experiment by the paired statistics of ``uwsim compare``.

    Args:
        results: the result directories, at least two.
        column: the column to compare, such as ``total`` or ``corners.max``; None: the score.
        higher_is_better: a higher value is better; not so for errors.

    Raises:
        ResultError: a result cannot be read, or the results cannot be compared.
    """
    from .analysis.comparison import compare_files

    for result in results:
        if not isinstance(result, str | Path):
            raise BadSetting(
                f"compare({type(result).__name__}): expected the directories of results."
            )
    paths = [Path(path) for path in results]
    return compare_files(paths, column=column, higher_is_better=higher_is_better)


def check(
    *paths: str | Path,
    data_path: Sequence[str | Path] = (),
    arguments: Mapping[str, Setting] | None = None,
) -> tuple[Diagnostic, ...]:
    """Return the errors and warnings about scene, benchmark, robot and hydrodynamics files.

    Each contains the file, the line and the severity. There are none about a valid file.

    Args:
        paths: the files, or names of bundled scenes and benchmarks.
        data_path: more folders in which files are searched.
        arguments: the values of xacro arguments by name.
    """
    from .assets.bundled import resolve_bundled
    from .checks import check_file

    folders = _folders_of(data_path)
    argument_texts = {name: str(value) for name, value in (arguments or {}).items()}
    return tuple(
        diagnostic
        for path in paths
        for diagnostic in check_file(
            resolve_bundled(Path(path)), data_path=folders, arguments=argument_texts
        )
    )


def gap(
    log: str | Path | VehicleLog,
    scene: str | Path | SceneSpec,
    *,
    mapping: str | Path | None = None,
    vehicle: str | None = None,
    windows: int = 60,
    horizons: Sequence[float] = (1.0, 5.0, 20.0),
    seed: int = 0,
    open_water: bool = False,
    attribution: bool = True,
    data_path: Sequence[str | Path] = (),
    out: str | Path | None = None,
) -> Gap:
    """Measure the error of the simulation of a log, as ``uwsim gap`` does.

    Args:
        log: a log, or its file: CSV, MCAP, bag, ``.bin`` or ``.tlog``.
        scene: a scene file, a bundled name, or a spec, with the vehicle of the log.
        mapping: the mapping file of the log; None: the defaults of its format.
        vehicle: the name of the vehicle; None: the only one.
        windows: the greatest number of windows.
        horizons: the times after the beginning of a window at which the error is taken [s].
        seed: the seed of the scene's variations and of the intervals' resamples.
        open_water: True to leave out the objects of the scene, such as floor and walls.
        attribution: True to search for the coefficient that explains the error.
        data_path: more folders in which files are searched.
        out: the directory of the report, which is empty or does not exist; None: no files.

    Raises:
        UwsimError: a file is invalid, or the log does not fit the scene.
    """
    from .assets.bundled import scene_file
    from .logs import VehicleLog, read_log
    from .physics.compile_scene import compile_scene
    from .reality_gap import GapSettings, measure_gap, remove_objects
    from .reality_gap.report import write_gap
    from .scene.reader import read_scene
    from .simulation.access.arguments import check_seed

    folders = _folders_of(data_path)
    settings = GapSettings(
        n_windows=windows,
        horizons=tuple(float(horizon) for horizon in horizons),
        seed=check_seed(seed, "gap"),
        has_attribution=attribution,
    )
    if not isinstance(log, VehicleLog):
        log = read_log(log, mapping=mapping, vehicle=vehicle)
    if isinstance(scene, str | Path):
        scene = read_scene(scene_file(str(scene), folders), data_path=folders)
    if open_water:
        scene = remove_objects(scene)
    model = compile_scene(scene, seed=settings.seed, data_path=folders)
    measured_gap = measure_gap(log, model, vehicle=vehicle, settings=settings)
    if out is not None:
        write_gap(measured_gap, Path(out))
    return measured_gap
