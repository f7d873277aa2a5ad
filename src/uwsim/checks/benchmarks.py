"""Rules about a benchmark, alone and in its scene."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from pathlib import Path

import numpy as np

from ..algorithms import load_algorithm
from ..benchmark.truth_checks import truth_diagnostics
from ..benchmark.unknown_names import find_unknown_names
from ..benchmark.updater_settings import check_scene_settings
from ..benchmark.updaters import ArmMoveUpdaterSpec, SeaStateUpdaterSpec, chain
from ..errors import BadSetting, Diagnostic
from ..schema import Diagnostics, parse
from .scene.waves import describe_breaking
from .subjects import CheckedBenchmark


def unknown_algorithm(benchmark: CheckedBenchmark) -> Iterator[Diagnostic]:
    """Report an unknown name of an algorithm; a ``module:Class`` is checked only by a run."""
    name = benchmark.spec.algorithm
    if name is not None and ":" not in name:
        try:
            load_algorithm(name, benchmark.tables.algorithms)
        except BadSetting as error:
            yield benchmark.error(benchmark.spec, str(error))


def names_in_scene(benchmark: CheckedBenchmark) -> Iterable[Diagnostic]:
    """Report the names in a benchmark that its scene does not have."""
    return find_unknown_names(benchmark.spec, benchmark.stage, is_whole=benchmark.is_whole)


def arm_positions(benchmark: CheckedBenchmark) -> Iterable[Diagnostic]:
    """Warn of arm positions with too many values, or with values beyond the limits of joints."""
    if not benchmark.is_whole:
        return ()
    vehicles = [vehicle.name for vehicle in benchmark.model.scene.vehicles]
    diagnostics = Diagnostics(benchmark.spec.path)
    nodes = parse(Path(benchmark.spec.path)).root.iter("armMoveUpdater")
    specs = [s for s in chain(benchmark.spec.scene_updater) if isinstance(s, ArmMoveUpdaterSpec)]
    for spec, node in zip(specs, nodes, strict=True):
        if spec.target not in vehicles:
            continue
        joints = benchmark.model.robots[vehicles.index(spec.target)].movable_joints
        for values, parent in zip(spec.arm_position, node.iterfind("armPosition"), strict=True):
            if len(values) > len(joints):
                diagnostics.warning(
                    parent,
                    f"<armPosition> has {len(values)} values for {len(joints)} joints "
                    f"({', '.join(joint.name for joint in joints)}); the rest is not used",
                )
            for joint, value, child in zip(joints, values, parent.iterfind("joint"), strict=False):
                limited_value = joint.clamp(value)
                if limited_value != value:
                    message = f"joint {joint.name!r} at {value:g} is limited to {limited_value:g}"
                    diagnostics.warning(child, message)
    return diagnostics.to_list()


def breaking_levels(benchmark: CheckedBenchmark) -> Iterator[Diagnostic]:
    """Warn of wave heights of levels at which the waves of the scene would break."""
    ocean = benchmark.model.scene.ocean_state
    rng = np.random.default_rng(0)  # only the height of UWSim's ocean depends on it
    heights = [system.components(ocean.sea, rng).significant_height for system in ocean.waves]
    height = math.hypot(*heights)  # of all systems together [m]
    for updater in chain(benchmark.spec.scene_updater):
        if not isinstance(updater, SeaStateUpdaterSpec) or height == 0.0:
            continue
        value = updater.values()[-1]
        texts = (describe_breaking(system, ocean.sea, value / height) for system in ocean.waves)
        if text := next(filter(None, texts), ""):
            message = f"at {updater.parameter} {value:g} m, {text}"
            yield benchmark.warning(updater, message, "finalValue")


def scene_settings(benchmark: CheckedBenchmark) -> Iterable[Diagnostic]:
    """Report the errors of updaters that set numbers of the scene file."""
    is_independent = benchmark.spec.mode == "independent"
    scene = benchmark.model.source
    return check_scene_settings(benchmark.spec, scene, is_independent=is_independent)


def recorded_truths(benchmark: CheckedBenchmark) -> Iterable[Diagnostic]:
    """Compare the recorded ground truths with the ground truths that measures read."""
    if not benchmark.is_whole:
        return ()
    return truth_diagnostics(benchmark.spec, benchmark.stage)
