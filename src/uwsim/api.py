"""The functions of the Python interface that `import uwsim` offers.

Files are found as the command line finds them: a path, a name in a search folder, or a bundled
name. Everything takes `str` or `Path`, and what goes wrong is an `UwsimError` of one or more lines
that names the file, the line and the nearest right name.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from numbers import Integral, Real
from pathlib import Path
from typing import TYPE_CHECKING

from .errors import BadSetting, Diagnostic, ErrorCollector, short_repr
from .world import TIMESTEP

if TYPE_CHECKING:
    from .analysis.comparison.model import Comparison
    from .bus import Algorithm
    from .results.result import Result
    from .runs.planning.plan_request import PlanRequest
    from .scene.spec import SceneSpec
    from .simulation import Simulation

Setting = str | float | int
OnProgress = Callable[[int, int], object]
"""Takes the number of finished levels, and that of all levels."""


def load(
    scene: str | Path | SceneSpec,
    *,
    seed: int = 0,
    timestep: float = TIMESTEP,
    settings: Mapping[str, Setting] | None = None,
    data_path: Sequence[str | Path] = (),
    udp_address: str | None = None,
    is_blind: bool = False,
) -> Simulation:
    """Open a scene at step 0; its first messages go out with the first `advance`.

    Args:
        scene: a scene file, a bundled name (``uwsim list scenes``), or what `read_scene` returned.
        seed: of every random stream, and of what varies in the scene (``<u:vary>``).
        timestep: length of a physics step [s].
        settings: values of the scene to change, as ``--set`` names them:
            ``{"oceanState.fog.density": 0.4}``; ``{"xacro.depth": 3}`` is a xacro argument.
        data_path: more folders in which files are looked for.
        udp_address: of this computer, at which vehicles with ``<fdm>`` take UDP packets, for
            example ``127.0.0.1``; without it they take none, and the run can be repeated.
        is_blind: images on topics are black, and nothing is drawn for them.

    Raises:
        UwsimError: a file, a name or a setting is wrong; names all errors of the file.
    """
    from .assets.bundled import scene_file
    from .physics.compile_scene import compile_scene
    from .scene.reader import read_scene
    from .scene.settings import apply_setting, xacro_arguments
    from .simulation import Simulation
    from .simulation.access.arguments import checked_seed

    folders = _folders_of(data_path)
    settings = _checked_settings(settings)
    if isinstance(scene, str | Path):
        arguments = xacro_arguments(settings.items())
        path_of_scene = scene_file(str(scene), folders)
        scene = read_scene(path_of_scene, data_path=folders, arguments=arguments)
    for path, value in settings.items():
        scene = apply_setting(scene, path, str(value))
    model = compile_scene(
        scene, seed=checked_seed(seed, "load"), timestep=timestep, data_path=folders
    )
    return Simulation(model, udp_address=udp_address, is_blind=is_blind)


def bench(
    benchmark: str | Path,
    *,
    scene: str | Path | None = None,
    algorithm: str | type[Algorithm] | None = None,
    seeds: Sequence[int] = (0,),
    levels: Mapping[str, Sequence[float]] | None = None,
    settings: Mapping[str, Setting] | None = None,
    data_path: Sequence[str | Path] = (),
    workers: int = 0,
    out: str | Path | None = None,
    on_progress: OnProgress | None = None,
) -> Result:
    """Run a benchmark as ``uwsim bench`` does.

    With the same options ``out`` has the same files with the same bytes, but for what two runs of
    the command do not share either: date, durations and load in ``provenance.json``, where the
    typed command is empty here, and the same facts in ``report.html``. Warnings about files, and
    the Python code that they name, are printed on standard error.

    Args:
        benchmark: a benchmark file or a bundled name.
        scene: the scene; without it the one that the benchmark names.
        algorithm: a name (``uwsim list algorithms``), ``module:Class``, or a class; a class runs in
            the process of the simulation, as with ``--in-process``.
        seeds: of the repeats; consecutive, such as ``range(6)``.
        levels: only these levels of the sweep, as numbers: ``{"fog": [0.0, 1 / 3]}``.
        settings: values to change, as ``--set`` names them; ``algorithm.kp`` is a parameter.
        data_path: more folders in which files are looked for.
        workers: processes to use; 0 runs everything in this process, the control and the report
            included. A program that uses more needs ``if __name__ == "__main__":``.
        out: the result directory, which must be empty or not there yet: it receives all files that
            ``uwsim bench`` writes, the control and the report included. Without it nothing is kept
            but what is returned.
        on_progress: called with the number of finished levels and that of all levels: at the
            beginning, and after each level.

    Raises:
        UwsimError: an input is wrong, or a run failed as it does with the command: also if a
            simulation failed, or the algorithm in every row. Finished rows are kept in ``out``.
    """
    from .runs.planning.plan_request import PlanRequest

    name, kind = _name_and_class(algorithm)
    if out is not None and not isinstance(out, str | os.PathLike):
        raise BadSetting(f"out={short_repr(out)}: expected a directory, as 'one.result', or None.")
    if on_progress is not None and not callable(on_progress):
        raise BadSetting(f"on_progress={short_repr(on_progress)}: expected a function, or None.")
    first_seed = _first_of(seeds)
    request = PlanRequest(
        benchmark=str(benchmark),
        scene=None if scene is None else str(scene),
        algorithm=name,
        algorithm_class=kind,
        in_process=kind is not None,
        seed=first_seed,
        repeat=len(seeds),
        levels=_pairs_of({} if levels is None else levels),
        settings=[f"{path}={value}" for path, value in _checked_settings(settings).items()],
        data_path=_folders_of(data_path),
    )
    return _execute_request(request, workers, out, on_progress)


def _execute_request(
    request: PlanRequest, workers: int, out: str | Path | None, on_progress: OnProgress | None
) -> Result:
    """Run what is requested, in a result directory that is kept if ``out`` names it."""
    from .analysis.load_reporter import load_reporter
    from .results.directory import check as check_directory
    from .results.directory import prepare_directory
    from .runs.execute import Callbacks, execute, plan_all, prepare_execution
    from .runs.executors.background import BackgroundProcess, Jobs
    from .runs.executors.choose import CALLBACK_LIMIT

    with tempfile.TemporaryDirectory(prefix="uwsim-") as scratch:
        directory = Path(scratch) / "result" if out is None else Path(out)
        wrong = ErrorCollector()
        executor, plans = plan_all([request], str(workers), CALLBACK_LIMIT, wrong)
        with wrong.collect():
            check_directory(directory, resume=False, overwrite=False)
        wrong.raise_errors()
        execution = prepare_execution(plans, executor, directory, workers=str(workers))
        open_jobs = partial(BackgroundProcess if workers else Jobs, load_reporter)
        (result,) = execute(
            execution,
            prepare_directory(directory, resume=False, overwrite=False),
            None if out is None else open_jobs,
            Callbacks(progress=partial(_counted, on_progress)),
        )
    return result


def _name_and_class(
    algorithm: str | type[Algorithm] | None,
) -> tuple[str | None, type[Algorithm] | None]:
    """Return the name of an algorithm, and its class if that is given; BadSetting if none is."""
    if algorithm is None or isinstance(algorithm, str):
        return algorithm, None
    if not isinstance(algorithm, type):
        raise BadSetting(
            f"algorithm={short_repr(algorithm)}: expected a name, 'module:Class', or a class, not "
            "an object."
        )
    return f"{algorithm.__module__}:{algorithm.__qualname__}", algorithm


@contextmanager
def _counted(
    on_progress: OnProgress | None, title: str, total: int, done: int
) -> Iterator[Callable[[], None]]:
    """Call a function with the numbers of finished levels and of all levels."""

    def on_level() -> None:
        nonlocal done
        done += 1
        report(done, total)

    report = on_progress or (lambda done, total: None)
    report(done, total)
    yield on_level


def _checked_settings(settings: Mapping[str, Setting] | None) -> Mapping[str, Setting]:
    """Refuse settings that are no mapping; raises BadSetting."""
    if settings is None or isinstance(settings, Mapping):
        return settings or {}
    raise BadSetting(
        f"settings={settings!r}: expected a dictionary, as {{'oceanState.fog.density': 0.4}}."[:300]
    )


def _folders_of(data_path: Sequence[str | Path]) -> tuple[Path, ...]:
    """Return folders in which files are looked for; BadSetting if these are none."""
    if isinstance(data_path, str) or not isinstance(data_path, Collection):
        raise BadSetting(f"data_path={short_repr(data_path)}: expected folders, as ['meshes'].")
    for folder in data_path:
        if not isinstance(folder, str | os.PathLike):
            raise BadSetting(f"data_path=[{short_repr(folder)}]: expected folders, as ['meshes'].")
    return tuple(Path(folder) for folder in data_path)


def _pairs_of(levels: Mapping[str, Sequence[float]]) -> list[tuple[str, float]]:
    """Return the names and values of levels; BadSetting if one has none, or not a number."""
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
    """Return a number as a float; None for what is none, or not finite, or too great."""
    from .base.external_values import finite_float

    if not isinstance(value, Real) or isinstance(value, bool):
        return None
    return finite_float(value)


def _first_of(seeds: Sequence[int]) -> int:
    """Return the first of some consecutive seeds; BadSetting if they are not."""
    if isinstance(seeds, int):
        given = short_repr(seeds)
        raise BadSetting(f"seeds={given}: expected a sequence, such as ({given},) or range(6).")
    given_seeds = list(seeds) if isinstance(seeds, Collection) else []
    are_whole = all(isinstance(s, Integral) and not isinstance(s, bool) for s in given_seeds)
    first = int(given_seeds[0]) if given_seeds and are_whole else -1
    if first < 0 or given_seeds != list(range(first, first + len(given_seeds))):
        raise BadSetting(
            f"seeds={short_repr(seeds)}: expected consecutive seeds >= 0, such as (0,) or range(6)."
        )
    return first


def read_result(path: str | Path) -> Result:
    """Read a result: its directory or its ``result.json``, of any format version.

    Raises:
        ResultError: it does not exist, is incomplete, or is not a result.
    """
    from .results.result_file import load as load_result

    return load_result(path)


def compare(
    *results: str | Path, column: str | None = None, higher_is_better: bool = False
) -> Comparison:
    """Compare results of one experiment by the paired statistics of ``uwsim compare``.

    Args:
        results: result directories, two at least.
        column: what is compared: a column, as ``total`` or ``corners.max``; without it the score.
        higher_is_better: more of it is better; errors are not so.

    Raises:
        ResultError: a result cannot be read, or the results cannot be compared.
    """
    from .analysis.comparison import compare_files

    for given in results:
        if not isinstance(given, str | Path):
            raise BadSetting(
                f"compare({type(given).__name__}): expected the directories of results."
            )
    paths = [Path(path) for path in results]
    return compare_files(paths, column=column, higher_is_better=higher_is_better)


def check(
    *paths: str | Path,
    data_path: Sequence[str | Path] = (),
    arguments: Mapping[str, Setting] | None = None,
) -> tuple[Diagnostic, ...]:
    """Return the errors and warnings of scene, benchmark, robot and hydrodynamics files.

    Errors come with their file, line and severity; a file without any gives none.

    Args:
        paths: the files, or names of bundled scenes and benchmarks.
        data_path: more folders in which files are looked for.
        arguments: values of their xacro arguments, by name.
    """
    from .assets.bundled import resolve_bundled
    from .checks import check_file

    folders = _folders_of(data_path)
    given = {name: str(value) for name, value in (arguments or {}).items()}
    return tuple(
        diagnostic
        for path in paths
        for diagnostic in check_file(
            resolve_bundled(Path(path)), data_path=folders, arguments=given
        )
    )
