"""From the words of a command line to what is to be played, or to all that is wrong with them."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ..assets.bundled import benchmark_file, scene_file
from ..errors import AllErrors, AssetNotFound, BadSetting, did_you_mean
from ..terminal import say_notices
from .foreign_code import announce, refuse_code, refused
from .stand_ins import warn_of_stand_ins
from .tables import read_plugins

if TYPE_CHECKING:
    from ..benchmark.plugin import Plugin, Tables
    from ..benchmark.spec import BenchmarkSpec
    from ..bus import Algorithm
    from ..scene.spec import SceneSpec
    from .plan import Mode, Plan

MAX_REPEATS = 10_000
OF_ALGORITHM = "algorithm."
"""Begins the ``--set`` that are parameters of the algorithm."""
LONGEST = 1e8
"""A benchmark that would simulate longer than this is taken for a typing error [s]."""


def make_plan(
    benchmark: str,
    *,
    scene: str | None,
    algorithm: str | None,
    seed: int,
    repeat: int,
    mode: str | None,
    levels: list[str],
    settings: list[str],
    compat: list[str],
    data_path: tuple[Path, ...],
    plugins: Sequence[Path] = (),
    no_code: bool = False,
    algorithm_is_from: str = "",
) -> Plan:
    """Read the files and put together what is to be played.

    Code that they name is announced before it runs, or refused (``no_code``). An ``algorithm`` that
    the user did not type is from a file: ``algorithm_is_from`` is its name.

    Raises:
        UwsimError: a file, a name or a setting that is wrong; or SeveralErrors, with all of them.
    """
    from ..benchmark.updater_settings import apply_updater_setting, leads_to_updater
    from ..scene.settings import apply_setting
    from .plan import Plan

    wrong = AllErrors()
    own: tuple[Plugin, ...] = ()
    tables: Tables | None = None
    with wrong.kept():
        own, tables = read_plugins(plugins)
    path: Path | None = None
    spec: BenchmarkSpec | None = None
    with wrong.kept():
        path = benchmark_file(benchmark, data_path)
        spec = None if tables is None else benchmark_of(path, own, tables)
    scene_spec: SceneSpec | None = None
    with wrong.kept():
        scene_spec = scene_of(scene, path, spec, data_path)
    pairs = pairs_of(settings, wrong)
    parameters = {
        name.removeprefix(OF_ALGORITHM): number_or_text(value)
        for name, value in pairs
        if name.startswith(OF_ALGORITHM)
    }
    for name, value in pairs:
        with wrong.kept():
            if name.startswith(OF_ALGORITHM):
                continue
            if spec is not None and leads_to_updater(spec, name):
                spec = apply_updater_setting(spec, name, value)
            elif scene_spec is not None:
                scene_spec = apply_setting(scene_spec, name, value)
    kind: type[Algorithm] | None = None
    wanted = algorithm or (None if spec is None else spec.algorithm) or ""
    with wrong.kept():
        if scene_spec is not None and no_code:
            refuse_code(scene_spec)
    with wrong.kept():
        file = algorithm_is_from or ("" if algorithm or spec is None else spec.path)
        if file and ":" in wanted:
            if no_code:
                raise refused(wanted, file)
            announce(wanted, file)
        kind = algorithm_of(wanted, spec, tables)
    check_parameters(kind, parameters, wrong)
    chosen_mode: Mode = "sequential"
    with wrong.kept():
        chosen_mode = mode_of(mode or (None if spec is None else spec.mode))
    of_file = () if spec is None else spec.compatibility
    quirks = compatibility_of([*of_file, *compat], wrong)
    chosen = levels_of(levels, spec, wrong)
    with wrong.kept():
        check_length(spec, chosen, repeat)
    wrong.check()
    assert spec is not None
    assert scene_spec is not None
    assert kind is not None
    return Plan(
        benchmark=spec,
        scene=scene_spec,
        algorithm=kind,
        algorithm_name=wanted,
        parameters=parameters,
        settings=tuple(pairs),
        mode=chosen_mode,
        seed=seed,
        repeats=repeat,
        chosen=chosen,
        compatibility=quirks,
        data_path=data_path,
        plugins=own,
    )


def say_warnings(plan: Plan) -> None:
    """Say on standard error what stands for lost files, and what seems not to be meant."""
    from ..simulation.checks.plausibility import warnings_of

    warn_of_stand_ins(plan.scene, plan.data_path)
    say_notices(warnings_of(plan.scene, plan.data_path))


def benchmark_of(path: Path, own: Sequence[Plugin], tables: Tables) -> BenchmarkSpec:
    """Read the benchmark, with what plugins have added to the tables."""
    from ..benchmark.plugin import attribute_errors_to
    from ..benchmark.reader import read_benchmark

    with attribute_errors_to(own):
        return read_benchmark(
            path, measures=tables.measures, triggers=tables.triggers, updaters=tables.updaters
        )


def scene_of(
    scene: str | None,
    benchmark: Path | None,
    spec: BenchmarkSpec | None,
    data_path: tuple[Path, ...],
) -> SceneSpec | None:
    """Read the scene; None where a benchmark that could not be read would have to say which.

    Raises:
        BadSetting: nobody says which.
        AssetNotFound: it is nowhere.
        SceneError: it is wrong.
    """
    from ..scene.reader import read_scene

    named = scene or (None if spec is None else spec.scene)
    if named is None:
        if spec is None:
            return None
        raise BadSetting(
            f"{benchmark}: the benchmark does not name its scene (u:scene); give it with --scene."
        )
    beside = data_path if benchmark is None else (benchmark.parent, *data_path)
    try:
        return read_scene(scene_file(named, beside, named_by=None if scene else benchmark))
    except AssetNotFound:
        if benchmark is None:
            return None  # it may lie beside the benchmark, wherever that is
        raise


def pairs_of(settings: Sequence[str], wrong: AllErrors) -> list[tuple[str, str]]:
    """Cut every ``--set``; keeps each that cannot be."""
    pairs = []
    for setting in settings:
        with wrong.kept():
            pairs.append(split(setting, "--set"))
    return pairs


def algorithm_of(
    wanted: str, spec: BenchmarkSpec | None, tables: Tables | None
) -> type[Algorithm] | None:
    """Find the algorithm; None where what could not be read would have to say which.

    Raises:
        BadSetting: nobody says which, or there is none of that name.
    """
    from ..algorithms import load_algorithm

    if not wanted and spec is not None:
        raise BadSetting(
            f"{spec.path}: the benchmark does not name an algorithm (u:algorithm); "
            "give one with --algorithm."
        )
    if not wanted or tables is None:
        return None
    if ":" in wanted and "" not in sys.path and str(Path.cwd()) not in sys.path:
        sys.path.insert(0, str(Path.cwd()))  # module:Class may lie where the user stands
    return load_algorithm(wanted, tables.algorithms)


def check_parameters(
    kind: type[Algorithm] | None, parameters: Mapping[str, float | str], wrong: AllErrors
) -> None:
    """Keep every parameter that the algorithm has no use for."""
    from .. import algorithms
    from ..simulation import latency_of

    for name, value in parameters.items():
        with wrong.kept():
            latency_of({name: value})
            if kind is not None:
                algorithms.check_parameters(kind, {name: value})


def mode_of(mode: str | None) -> Mode:
    """Return how levels follow each other; raises BadSetting."""
    if mode is None or mode == "sequential":
        return "sequential"
    if mode == "independent":
        return "independent"
    near = did_you_mean(mode, ("sequential", "independent"))
    raise BadSetting(f"--mode is {mode!r}; expected sequential or independent.{near}")


def compatibility_of(compat: Sequence[str], wrong: AllErrors) -> frozenset[str]:
    """Return the quirks of ``--compat``; an unknown name goes into ``wrong``."""
    from ..compatibility import compatibility

    found: frozenset[str] = frozenset()
    for name in [word for words in compat for word in words.replace(",", " ").split()]:
        with wrong.kept():
            found |= compatibility([name])
    return found


def levels_of(
    texts: Sequence[str], spec: BenchmarkSpec | None, wrong: AllErrors
) -> tuple[tuple[str, float], ...]:
    """Read ``--level``; keeps each that is wrong, or that the sweep does not have."""
    from ..benchmark import updaters
    from .plan import chosen_levels

    levels = () if spec is None or not texts else updaters.levels(spec.scene_updater)
    chosen = []
    for text in texts:
        with wrong.kept():
            pair = chosen_level(text)
            if levels:
                chosen_levels(levels, [pair])
            chosen.append(pair)
    return tuple(chosen)


def check_length(
    spec: BenchmarkSpec | None, chosen: Sequence[tuple[str, float]], repeat: int
) -> None:
    """Refuse what nobody can mean to wait for; raises BadSetting."""
    from ..benchmark import updaters
    from .plan import chosen_levels

    if repeat > MAX_REPEATS:
        raise BadSetting(f"--repeat {repeat}: at most {MAX_REPEATS}.")
    if spec is None:
        return
    settling = max(each.settling_time for each in updaters.chain(spec.scene_updater))
    length = (updaters.interval(spec.scene_updater) or 0.0) + settling
    n_levels = len(chosen_levels(updaters.levels(spec.scene_updater), chosen))
    total = length * n_levels * repeat
    if total > LONGEST:
        raise BadSetting(
            f"The benchmark would simulate {total:.3g} s; at most {LONGEST:g} s can be asked for."
        )


def split(setting: str, option: str) -> tuple[str, str]:
    """Cut ``NAME=VALUE``; raises BadSetting."""
    name, equals, value = setting.partition("=")
    if not equals or not name.strip():
        raise BadSetting(f"{option} {setting!r}: expected NAME=VALUE.")
    return name.strip(), value.strip()


def chosen_level(text: str) -> tuple[str, float]:
    """Read ``fog=0.5``; raises BadSetting."""
    name, value = split(text, "--level")
    number = number_or_text(value)
    if isinstance(number, str):
        raise BadSetting(f"--level {text!r}: expected a number behind {name!r}.")
    return name, number


def number_or_text(text: str) -> float | str:
    """Return a finite number where the text is one, else the text."""
    try:
        number = float(text)
    except ValueError:
        return text
    return number if abs(number) < float("inf") else text
