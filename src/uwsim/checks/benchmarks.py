"""Rules about a benchmark, alone and in its scene."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from ..algorithms import load_algorithm
from ..benchmark.truth_checks import truth_diagnostics
from ..benchmark.unknown_names import unknown_names
from ..benchmark.updaters import ArmMoveUpdaterSpec, chain
from ..errors import BadSetting, Diagnostic
from ..schema import Diagnostics, parse
from .subjects import CheckedBenchmark


def unknown_algorithm(benchmark: CheckedBenchmark) -> Iterator[Diagnostic]:
    """Report an algorithm that is in no table; a class of a module is looked up by a run."""
    name = benchmark.spec.algorithm
    if name is not None and ":" not in name:
        try:
            load_algorithm(name, benchmark.tables.algorithms)
        except BadSetting as error:
            yield benchmark.error(benchmark.spec, str(error))


def names_in_scene(benchmark: CheckedBenchmark) -> Iterable[Diagnostic]:
    """Look up every name in the scene."""
    return unknown_names(benchmark.spec, benchmark.stage, is_whole=benchmark.is_whole)


def arm_positions(benchmark: CheckedBenchmark) -> Iterable[Diagnostic]:
    """Warn of values for joints that do not exist, and of those beyond the limits of joints."""
    if not benchmark.is_whole:
        return ()
    vehicles = [vehicle.name for vehicle in benchmark.model.scene.vehicles]
    diagnostics = Diagnostics(benchmark.spec.path)
    nodes = parse(Path(benchmark.spec.path)).root.iter("armMoveUpdater")
    specs = [s for s in chain(benchmark.spec.scene_updater) if isinstance(s, ArmMoveUpdaterSpec)]
    for spec, node in zip(specs, nodes, strict=True):
        if spec.target not in vehicles:
            continue
        joints = benchmark.model.robots[vehicles.index(spec.target)].movable
        for given, place in zip(spec.arm_position, node.iterfind("armPosition"), strict=True):
            if len(given) > len(joints):
                diagnostics.warning(
                    place,
                    f"<armPosition> has {len(given)} values for {len(joints)} joints "
                    f"({', '.join(joint.name for joint in joints)}); the rest is not used",
                )
            for joint, value, at in zip(joints, given, place.iterfind("joint"), strict=False):
                held = joint.clamped(value)
                if held != value:
                    message = f"joint {joint.name!r} at {value:g} is limited to {held:g}"
                    diagnostics.warning(at, message)
    return diagnostics.to_list()


def recorded_truths(benchmark: CheckedBenchmark) -> Iterable[Diagnostic]:
    """Compare its recorded truths with what measures read of them."""
    if not benchmark.is_whole:
        return ()
    return truth_diagnostics(benchmark.spec, benchmark.stage)
