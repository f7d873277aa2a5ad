"""The ``inputs`` of a result: the files that were read and the sources of the algorithm."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from ..base.files.input_files import InputFile, compute_hash, hashes_by_name, portable_name, record
from ..base.files.python_sources import find_sources
from ..benchmark.plugin import attribute_errors_to, hashes
from ..benchmark.plugin_checks import updater_files
from ..benchmark.updaters import chain
from ..results.inputs import Inputs
from ..simulation import Simulation
from .planning.plan import Plan


def inputs_of(plan: Plan, simulation: Simulation, read_files: Iterable[InputFile]) -> Inputs:
    """Collect the input files of a plan; hash those that were not read yet.

    Args:
        plan: the plan.
        simulation: the simulation of its scene.
        read_files: the input files that were read to make the plan (`record_inputs`).
    """
    benchmark, scene = Path(plan.benchmark.path), Path(plan.scene.path)
    robots = {
        Path(simulation.world.model.robots[i].path): vehicle.file
        for i, vehicle in enumerate(plan.scene.vehicles)
    }
    assets = [
        InputFile(portable_name(robots[file.path]), file.sha256) if file.path in robots else file
        for file in read_files
        if file.path not in (benchmark, scene)
    ]
    read_paths = {file.path for file in read_files}
    other_files = dict(simulation.world.files)
    for updater in chain(plan.benchmark.scene_updater):
        with attribute_errors_to(plan.plugins):
            other_files |= updater_files(updater, simulation.world.stage_view)
    assets += _hash_files({n: path for n, path in other_files.items() if path not in read_paths})
    assets += [
        InputFile(name, f"sha256:{digest}")
        for name, digest in simulation.world.scenery.generated_hashes.items()
    ]
    return Inputs(
        benchmark=(benchmark.name, compute_hash(benchmark)),
        scene=(scene.name, compute_hash(scene)),
        assets=hashes_by_name(assets),
        plugins=hashes(plan.plugins) or None,
        algorithm=hash_algorithm(plan),
    )


def hash_algorithm(plan: Plan) -> dict[str, str] | None:
    """Hash and record the source files of a ``module:Class``; return None for other algorithms."""
    module, colon, _ = plan.algorithm.name.partition(":")
    if not colon:
        return None
    sources = plan.algorithm.sources
    return hashes_by_name(_hash_files(find_sources(module) if sources is None else sources))


def _hash_files(files: Mapping[str, Path]) -> list[InputFile]:
    """Hash and record files that are read later, or by other processes."""
    hashes = [
        InputFile(portable_name(name), compute_hash(path), path) for name, path in files.items()
    ]
    record(hashes)
    return hashes
