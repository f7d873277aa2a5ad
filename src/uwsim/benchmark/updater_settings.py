"""Changing one value of a scene updater: at random for each seed (``u:vary``), or with ``--set``.

The path of a value begins with the name of the updater's element, at any depth of nesting:
``currentForceUpdater.timeOffset``. Values that determine the levels or their duration cannot be
changed.
"""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

from ..errors import BadSetting, Diagnostic, did_you_mean
from ..scene.settings import Step, ValueLocation, check_effect, locate, overlaps
from ..scene.spec import SceneSpec
from ..scene.variation import Draw, apply_variations, draw
from ..schema import Diagnostics, fields_of
from .spec import BenchmarkSpec
from .updaters import (
    UPDATERS,
    Level,
    SceneUpdaterSpec,
    SettingUpdaterSpec,
    chain,
    interval,
)
from .updaters import levels as levels_of


def updater_element(updater: SceneUpdaterSpec) -> str:
    """Return the name of an updater's element; for a plugin's updater, the name of its column."""
    names = {kind: name for name, kind in UPDATERS.items()}
    return names.get(type(updater), updater.name)


def updater_path(updater: SceneUpdaterSpec) -> str:
    """Return the first name of the paths of an updater's values: its element without ``u:``."""
    return updater_element(updater).removeprefix("u:")


def is_updater_path(benchmark: BenchmarkSpec, path: str) -> bool:
    """Return whether a path begins with the name of one of the benchmark's updaters."""
    return path.partition(".")[0] in map(updater_path, chain(benchmark.scene_updater))


def check_path_start(benchmark: BenchmarkSpec, scene: SceneSpec, path: str, value: str) -> None:
    """Raise BadSetting, with a list of the valid names, if the first name of a path is unknown."""
    name = path.partition(".")[0].partition("[")[0].removeprefix("u:")
    known_names = [field.label.removeprefix("u:") for field in fields_of(type(scene))]
    known_names += map(updater_path, chain(benchmark.scene_updater))
    known_names.append("algorithm")
    if name and name not in known_names:
        raise BadSetting(
            f"--set {path}={value}: there is no <{name}>.{did_you_mean(name, known_names)} "
            f"There are: {', '.join(known_names)}."
        )


def locate_in_benchmark(benchmark: Any, path: str) -> ValueLocation:
    """Find the field of an updater by its path; raises BadSetting for an unknown path."""
    name, _, rest = path.partition(".")
    steps: list[Step] = []
    owner, field = benchmark, "scene_updater"
    updater: SceneUpdaterSpec | None = benchmark.scene_updater
    while updater is not None:
        is_found = updater_path(updater) == name
        steps.append(Step(owner, field, None, name if is_found else ""))
        if is_found:
            location = locate(updater, rest)
            return ValueLocation(
                (*steps, *location.steps), location.owner, location.field, location.components
            )
        owner, field, updater = updater, "child", updater.child
    known_names = [*map(updater_path, chain(benchmark.scene_updater))]
    raise BadSetting(
        f"the benchmark has no updater <{name}>.{did_you_mean(name, known_names)} "
        f"There are: {', '.join(known_names)}."
    )


def check_same_levels(benchmark: BenchmarkSpec, changed_benchmark: BenchmarkSpec) -> None:
    """Raise BadSetting if a changed benchmark is invalid, or has other levels or durations."""
    old_spec, new_spec = benchmark.scene_updater, changed_benchmark.scene_updater
    for updater in chain(new_spec):
        for error in updater.errors():
            raise BadSetting(error)
    if levels_of(old_spec) != levels_of(new_spec) or interval(old_spec) != interval(new_spec):
        raise BadSetting("it determines the levels or their duration; change the file.")


def apply_updater_setting(benchmark: BenchmarkSpec, path: str, value: str) -> BenchmarkSpec:
    """Return a copy of a benchmark with one value changed; a variation of the value is removed.

    Raises:
        BadSetting: the path is unknown, or the value is invalid.
    """
    try:
        place = locate_in_benchmark(benchmark, path)
        changed_benchmark: BenchmarkSpec = place.with_value(value)
        check_same_levels(benchmark, changed_benchmark)
    except BadSetting as error:
        raise BadSetting(f"--set {path}={value}: {error}") from None
    variations = tuple(
        variation
        for variation in benchmark.vary
        if not overlaps(locate_in_benchmark(benchmark, variation.path), place)
    )
    return dataclasses.replace(changed_benchmark, vary=variations)


def benchmark_of_seed(benchmark: BenchmarkSpec, seed: int) -> BenchmarkSpec:
    """Return the benchmark with the values that ``u:vary`` draws for a seed."""
    return apply_variations(benchmark, seed, find=locate_in_benchmark)


def updater_draws(benchmark: BenchmarkSpec, seed: int) -> tuple[Draw, ...]:
    """Return the paths and values that ``u:vary`` draws for a seed."""
    return draw(benchmark, seed, find=locate_in_benchmark)


def scene_of_level(scene: SceneSpec, updater: SceneUpdaterSpec, level: Level) -> SceneSpec:
    """Return the scene with the values that each ``<u:settingUpdater>`` has in a level.

    Args:
        scene: the scene of the benchmark.
        updater: the outermost updater.
        level: the level.

    Raises:
        BadSetting: a path is unknown, its value is not one number, or ``<u:vary>`` draws it.
    """
    for spec, (_, value) in zip(chain(updater), level.values, strict=True):
        if isinstance(spec, SettingUpdaterSpec):
            scene = set_number(scene, spec.path, value)
    return scene


def set_number(scene: SceneSpec, path: str, value: float) -> SceneSpec:
    """Return the scene with another number at a path.

    Raises:
        BadSetting: the path is unknown, its value is not one number, or ``<u:vary>`` draws it.
    """
    location = locate(scene, path)
    check_effect(location)
    if not location.is_number:
        raise BadSetting(f"it is {location.kind}; expected the path of one number.")
    if any(overlaps(locate(scene, item.path), location) for item in scene.vary):
        raise BadSetting("<u:vary> of the scene draws it; remove one of the two.")
    text = str(round(value)) if location.is_integer and float(value).is_integer() else repr(value)
    new_scene: SceneSpec = location.with_value(text)
    return new_scene


def check_scene_settings(
    benchmark: BenchmarkSpec, scene: SceneSpec, *, is_independent: bool
) -> list[Diagnostic]:
    """Return the errors of each ``<u:settingUpdater>``: its path and values, and dependent levels.

    Args:
        benchmark: the benchmark.
        scene: its scene.
        is_independent: true if the levels are independent.
    """
    diagnostics = Diagnostics(Path(benchmark.path))
    for updater in chain(benchmark.scene_updater):
        if not isinstance(updater, SettingUpdaterSpec):
            continue
        if not is_independent:
            diagnostics.error(
                updater, 'its levels open the scene anew; expected <benchmark u:mode="independent">'
            )
        try:
            for value in updater.values():
                set_number(scene, updater.path, value)
        except BadSetting as error:
            diagnostics.error(updater, f"<path> {updater.path}: {error}".rstrip("."))
    return diagnostics.to_list()
