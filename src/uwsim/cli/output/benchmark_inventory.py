"""The content of a benchmark for ``uwsim info``: its scene, levels, measures and outcome."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ...assets.bundled import bundled_files
from ...benchmark.measures import MEASURES
from ...benchmark.measures.outcome import find_outcome_spec
from ...benchmark.reader import read_benchmark
from ...benchmark.spec import BenchmarkSpec
from ...benchmark.updaters import chain
from ...benchmark.updaters import levels as levels_of
from ...schema.names import prefixed_name

Fields = Mapping[str, object]


def is_benchmark(name: str) -> bool:
    """Return whether a name is that of a bundled benchmark, and not of a file or a scene."""
    is_other = Path(name).is_file() or name in bundled_files("scenes")
    return not is_other and name in bundled_files("benchmarks")


def benchmark_inventory(path: Path) -> Fields:
    """Return the content of a benchmark file: texts, and lists of texts.

    Raises:
        BenchmarkError: the file is invalid.
    """
    spec = read_benchmark(path)
    levels = levels_of(spec.scene_updater)
    values: dict[str, dict[str, None]] = {}
    for level in levels:
        for name, value in level.values:
            if name != "none":
                values.setdefault(name, {})[f"{value:g}"] = None
    kinds = {cls: prefixed_name(tag) for tag, cls in MEASURES.items()}
    return {
        "file": str(path),
        "scene": (spec.scene or "named by --scene").removesuffix(".xml"),
        "algorithm": spec.algorithm or "named by --algorithm",
        "n_levels": len(levels),
        "levels": {name: list(texts) for name, texts in values.items()},
        "units": {
            updater.parameter: updater.parameter_unit for updater in chain(spec.scene_updater)
        },
        "measures": {m.name: kinds.get(type(m), type(m).__name__) for m in spec.measures},
        "score": " ".join(spec.function.text.split()),
        **_outcome(spec),
        "varies": [variation.path for variation in spec.vary],
        "observations": {
            environment.vehicle: environment.observation.split()
            for environment in spec.environments
        },
    }


def _outcome(spec: BenchmarkSpec) -> Fields:
    outcome = find_outcome_spec(spec.measures)
    if outcome is None:
        return {"success": "", "failures": {}}
    return {
        "success": " ".join(outcome.success.split()),
        "failures": {f.status: " ".join(f.condition.split()) for f in outcome.failure},
    }
