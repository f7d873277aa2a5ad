"""The preparation of runs: all names are resolved and all files hashed before the execution."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from ..base.files.input_files import record_inputs
from ..benchmark.plugin import attribute_errors_to, check_bound
from ..benchmark.truth_checks import truth_diagnostics
from ..benchmark.unknown_names import find_unknown_names
from ..errors import BenchmarkError, UwsimError
from ..results.inputs import Inputs
from ..simulation import RendererPool, Simulation
from .bind_all import bind_all
from .input_watch import unique_files
from .planning.plan import Plan
from .planning.trial_cache import compile_plan
from .result_inputs import hash_algorithm, inputs_of
from .run import Run


def prepare_run(plan: Plan, out: Path) -> Run:
    """Return the run of a plan, with its result in ``out``; raise errors as `hash_inputs` does."""
    with record_inputs() as files:
        inputs, renderer = hash_inputs(plan)
    return Run(plan=plan, out=out, inputs=inputs, renderer=renderer, files=unique_files(files))


def prepare_runs(plans: Sequence[Plan], out: Path, folders: Sequence[str]) -> list[Run]:
    """Return the runs of plans that differ in the algorithm alone; the scene is opened once.

    Args:
        plans: the plans, one for each algorithm.
        out: the result directory.
        folders: the subfolder of ``out`` for each result; empty for one result in ``out`` itself.

    Raises:
        UwsimError: as `hash_inputs` does.
    """
    base = prepare_run(plans[0], out)
    runs = []
    for plan, folder in zip(plans, folders or [""], strict=True):
        with record_inputs() as sources:
            inputs = replace(base.inputs, algorithm=hash_algorithm(plan))
        files = unique_files([*base.files, *sources])
        run = Run(plan=plan, out=out / folder, inputs=inputs, renderer=base.renderer, files=files)
        runs.append(run)
    return runs


def hash_inputs(plan: Plan, pool: RendererPool | None = None) -> tuple[Inputs, str]:
    """Open the scene once: hash every file that is read, and return the renderer's name.

    Every name in the benchmark is resolved, so that no name can fail later. Within a
    `record_inputs` block of the caller, the files are recorded with their paths.

    Args:
        plan: the plan.
        pool: the pool of renderers; without one a renderer is created and closed again.

    Returns:
        The ``inputs`` of the result, and the name of the renderer.

    Raises:
        UwsimError: a file, a body, a camera or a service does not exist.
    """
    with record_inputs() as files:
        simulation = Simulation(compile_plan(plan, 0), pool=pool)
        try:
            with attribute_errors_to(plan.plugins):
                check_bound(plan.plugins, plan.benchmark.parts, simulation.world.stage_view)
                _bind_all(plan, simulation)
            return inputs_of(plan, simulation, files), simulation.world.scenery.renderer_name
        finally:
            simulation.close()


def _bind_all(plan: Plan, simulation: Simulation) -> None:
    """Resolve every name of the benchmark; raise BenchmarkError with all errors."""
    try:
        bind_all(plan, simulation)
    except UwsimError:
        if errors := find_unknown_names(plan.benchmark, simulation.world.stage_view):
            raise BenchmarkError(errors) from None
        raise
    truths = truth_diagnostics(plan.benchmark, simulation.world.stage_view)
    if errors := [diagnostic for diagnostic in truths if diagnostic.severity == "error"]:
        raise BenchmarkError(errors)
