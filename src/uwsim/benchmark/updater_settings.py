"""One value of a scene updater: drawn for each seed (``u:vary``), or set with ``--set``.

A path begins with the name of the updater's element, however deep it is nested:
``currentForceUpdater.timeOffset``. What decides the levels, or how long they last, is the plan of a
benchmark and stays as the file says.
"""

from __future__ import annotations

import dataclasses
from typing import Any

from ..errors import BadSetting, did_you_mean
from ..scene.settings import Place, Step, locate, overlaps
from ..scene.spec import SceneSpec
from ..scene.variation import Draw, apply_variations, draw
from ..schema import fields_of
from .spec import BenchmarkSpec
from .updaters import UPDATERS, SceneUpdaterSpec, chain, interval
from .updaters import levels as levels_of


def element_of(updater: SceneUpdaterSpec) -> str:
    """Return the name of an updater's element; of a plugin's that of its column."""
    names = {kind: name for name, kind in UPDATERS.items()}
    return names.get(type(updater), updater.name)


def leads_to_updater(benchmark: BenchmarkSpec, path: str) -> bool:
    """Whether a path begins with the name of one of its updaters."""
    return path.partition(".")[0] in [element_of(each) for each in chain(benchmark.scene_updater)]


def check_begin(benchmark: BenchmarkSpec, scene: SceneSpec, path: str, value: str) -> None:
    """Raise BadSetting if a path begins with nothing that can be set; names all that can."""
    first = path.partition(".")[0].partition("[")[0].removeprefix("u:")
    known = [field.label.removeprefix("u:") for field in fields_of(type(scene))]
    known += map(element_of, chain(benchmark.scene_updater))
    known.append("algorithm")
    if first and first not in known:
        raise BadSetting(
            f"--set {path}={value}: there is no <{first}>.{did_you_mean(first, known)} "
            f"There are: {', '.join(known)}."
        )


def locate_in_benchmark(benchmark: Any, path: str) -> Place:
    """Find the field of a path; raises BadSetting for an unknown path."""
    first, _, rest = path.partition(".")
    steps: list[Step] = []
    outer, field = benchmark, "scene_updater"
    updater: SceneUpdaterSpec | None = benchmark.scene_updater
    while updater is not None:
        is_it = element_of(updater) == first
        steps.append(Step(outer, field, None, first if is_it else ""))
        if is_it:
            inner = locate(updater, rest)
            return Place((*steps, *inner.steps), inner.leaf, inner.field, inner.rest)
        outer, field, updater = updater, "child", updater.child
    known = [element_of(each) for each in chain(benchmark.scene_updater)]
    raise BadSetting(
        f"the benchmark has no updater <{first}>.{did_you_mean(first, known)} "
        f"There are: {', '.join(known)}."
    )


def same_levels(benchmark: BenchmarkSpec, changed: BenchmarkSpec) -> None:
    """Refuse a change of the levels; raises BadSetting."""
    before, after = benchmark.scene_updater, changed.scene_updater
    for updater in chain(after):
        for wrong in updater.errors():
            raise BadSetting(wrong)
    if levels_of(before) != levels_of(after) or interval(before) != interval(after):
        raise BadSetting("it decides the levels, or how long they last; change the file.")


def apply_updater_setting(benchmark: BenchmarkSpec, path: str, value: str) -> BenchmarkSpec:
    """Return a copy with another value; a variation of it is dropped.

    Raises:
        BadSetting: an unknown path, or an invalid value.
    """
    try:
        place = locate_in_benchmark(benchmark, path)
        changed: BenchmarkSpec = place.with_value(value)
        same_levels(benchmark, changed)
    except BadSetting as error:
        raise BadSetting(f"--set {path}={value}: {error}") from None
    kept = tuple(
        each
        for each in benchmark.vary
        if not overlaps(locate_in_benchmark(benchmark, each.path), place)
    )
    return dataclasses.replace(changed, vary=kept)


def benchmark_of_seed(benchmark: BenchmarkSpec, seed: int) -> BenchmarkSpec:
    """Return the benchmark with what varies drawn for a seed."""
    return apply_variations(benchmark, seed, find=locate_in_benchmark)


def updater_draws(benchmark: BenchmarkSpec, seed: int) -> tuple[Draw, ...]:
    """Return what was drawn for a seed."""
    return draw(benchmark, seed, find=locate_in_benchmark)
