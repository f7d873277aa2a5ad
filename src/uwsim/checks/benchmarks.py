"""Rules about a benchmark, alone and in its scene."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from ..algorithms import load_algorithm
from ..benchmark.truth_checks import truth_diagnostics
from ..benchmark.unknown_names import find_unknown_names
from ..benchmark.updaters import ArmMoveUpdaterSpec, chain
from ..errors import BadSetting, Diagnostic
from ..schema import Diagnostics, parse
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


def recorded_truths(benchmark: CheckedBenchmark) -> Iterable[Diagnostic]:
    """Compare the recorded ground truths with the ground truths that measures read."""
    if not benchmark.is_whole:
        return ()
    return truth_diagnostics(benchmark.spec, benchmark.stage)
