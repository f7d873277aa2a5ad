"""Rules about a benchmark, alone and in its scene."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ..algorithms import load_algorithm
from ..benchmark import truth_checks, warnings
from ..benchmark.unknown_names import unknown_names
from ..errors import BadSetting, Diagnostic
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
    """Return what of its arm positions the arms of the scene cannot take."""
    if not benchmark.is_whole:
        return ()
    vehicles = [vehicle.name for vehicle in benchmark.model.scene.vehicles]
    return warnings.arm_warnings(benchmark.spec, vehicles, benchmark.model.robots)


def recorded_truths(benchmark: CheckedBenchmark) -> Iterable[Diagnostic]:
    """Compare its recorded truths with what measures read of them."""
    if not benchmark.is_whole:
        return ()
    return truth_checks.truth_diagnostics(benchmark.spec, benchmark.stage)
