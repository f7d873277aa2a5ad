"""The functions of the Python interface that `import uwsim` offers.

Files are found as the command line finds them: a path, a name in a search folder, or a bundled
name. Everything takes `str` or `Path`, and what goes wrong is an `UwsimError` of one or more lines
that names the file, the line and the nearest right name.
"""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import replace
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING

from .errors import BadSetting, Diagnostic, RunFailed
from .world import TIMESTEP

if TYPE_CHECKING:
    from .analysis.comparison.model import Comparison
    from .bus import Algorithm
    from .results.result import Result
    from .runs.run import Run
    from .runs.timing import Stopwatch
    from .scene.spec import SceneSpec
    from .simulation import Simulation

Setting = str | float | int


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

    folders = tuple(Path(folder) for folder in data_path)
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
) -> Result:
    """Run a benchmark as ``uwsim bench`` does, with the same numbers in the same bytes.

    Args:
        benchmark: a benchmark file or a bundled name.
        scene: the scene; without it the one that the benchmark names.
        algorithm: a name (``uwsim list algorithms``), ``module:Class``, or a class.
        seeds: of the repeats; consecutive, such as ``range(6)``.
        levels: only these levels of the sweep, as numbers: ``{"fog": [0.0, 0.5]}``.
        settings: values to change, as ``--set`` names them; ``algorithm.kp`` is a parameter.
        data_path: more folders in which files are looked for.
        workers: processes to use; 0 runs everything in this process.
        out: the result directory, which must be empty or not there yet: it receives all files that
            ``uwsim bench`` writes, the report included. Without it nothing is kept but what is
            returned.

    Raises:
        UwsimError: an input is wrong, or a run failed; finished rows are kept in ``out``.
    """
    from .results.directory import check as check_directory
    from .runs.executors.choose import CALLBACK_LIMIT, executor_of
    from .runs.executors.executor import run_all
    from .runs.planning.make_plan import make_plan
    from .runs.planning.plan_request import PlanRequest
    from .runs.prepare import prepare_run
    from .runs.timing import Stopwatch

    request = PlanRequest(
        benchmark=str(benchmark),
        scene=None if scene is None else str(scene),
        algorithm=algorithm if isinstance(algorithm, str) else None,
        seed=_first_of(seeds),
        repeat=len(seeds),
        levels=_texts_of(levels or {}),
        settings=[f"{path}={value}" for path, value in _checked_settings(settings).items()],
        data_path=tuple(Path(folder) for folder in data_path),
    )
    plan = make_plan(request)
    if algorithm is not None and not isinstance(algorithm, str):
        name = f"{algorithm.__module__}:{algorithm.__qualname__}"
        plan = replace(plan, algorithm=replace(plan.algorithm, cls=algorithm, name=name))
    executor = executor_of(str(workers), CALLBACK_LIMIT)
    with tempfile.TemporaryDirectory(prefix="uwsim-") as scratch:
        directory = Path(scratch) / "result" if out is None else Path(out)
        check_directory(directory, resume=False, overwrite=False, results=[])
        run, watch = prepare_run(plan, directory), Stopwatch()
        (result,) = run_all([run], executor)
        if out is not None:
            _write_report(run, watch, workers)
    return result


def _checked_settings(settings: Mapping[str, Setting] | None) -> Mapping[str, Setting]:
    """Refuse settings that are no mapping; raises BadSetting."""
    if settings is None or isinstance(settings, Mapping):
        return settings or {}
    raise BadSetting(
        f"settings={settings!r}: expected a dictionary, as {{'oceanState.fog.density': 0.4}}."[:300]
    )


def _write_report(run: Run, watch: Stopwatch, workers: int) -> None:
    """Run the control, and write the provenance and the report, as ``uwsim bench`` does."""
    from .analysis.report import write_report
    from .base.terminal import warn
    from .results.provenance import save_provenance
    from .runs.control import CONTROL, control_of, wants_control
    from .runs.executors.executor import run_all
    from .runs.timing import Timing

    if wants_control(run.plan):
        try:
            run_all([control_of(run)])
        except (RunFailed, OSError) as error:
            warn(f"the report lacks the control {CONTROL!r}, which failed: {error}")
    timing = Timing(
        began=watch.began, wall=watch.passed(), workers=str(workers), command=(), runs=[run]
    )
    save_provenance(timing.provenance(run), run.out)
    write_report(run.out)


def _texts_of(levels: Mapping[str, Sequence[float]]) -> list[str]:
    """Return levels as ``NAME=VALUE``, with all digits; BadSetting if one is not a number."""
    texts: list[str] = []
    if not isinstance(levels, Mapping) or any(isinstance(v, Real) for v in levels.values()):
        raise BadSetting(f"levels={levels!r:.200}: expected names and lists, as {{'fog': [0.5]}}.")
    for name, values in levels.items():
        for value in values:
            if isinstance(value, bool) or not isinstance(value, Real):
                raise BadSetting(f"levels={{{name!r}: [{value!r}]}}: expected numbers.")
            texts.append(f"{name}={float(value)!r}")
    return texts


def _first_of(seeds: Sequence[int]) -> int:
    """Return the first of some consecutive seeds; BadSetting if they are not."""
    if isinstance(seeds, int):
        raise BadSetting(f"seeds={seeds}: expected a sequence, such as ({seeds},) or range(6).")
    first = next(iter(seeds), -1)
    if first < 0 or list(seeds) != list(range(first, first + len(seeds))):
        raise BadSetting(
            f"seeds={list(seeds)[:10]}: expected consecutive seeds >= 0, such as (0,) or range(6)."
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
    from .assets.bundled import bundled_or
    from .checks import check_file

    folders = tuple(Path(folder) for folder in data_path)
    given = {name: str(value) for name, value in (arguments or {}).items()}
    return tuple(
        diagnostic
        for path in paths
        for diagnostic in check_file(bundled_or(Path(path)), data_path=folders, arguments=given)
    )
