"""Preparing runs: looks up all names and hashes all files before execution."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from ..base.files.input_files import record_inputs
from ..benchmark.plugin import attribute_errors_to, check_bound
from ..benchmark.truth_checks import truth_diagnostics
from ..benchmark.unknown_names import unknown_names
from ..errors import BenchmarkError, UwsimError
from ..results.inputs import Inputs
from ..simulation import RendererPool, Simulation
from .bind_all import bind_all
from .input_watch import watchable
from .inputs_read import inputs_of, of_algorithm
from .planning.plan import Plan
from .planning.trial_cache import compile_plan
from .run import Run


def prepare_run(plan: Plan, out: Path) -> Run:
    """Return the run of a plan, with its result in ``out``; raises as `hash_inputs` does."""
    with record_inputs() as files:
        inputs, renderer = hash_inputs(plan)
    return Run(plan=plan, out=out, inputs=inputs, renderer=renderer, files=watchable(files))


def prepare_runs(plans: Sequence[Plan], out: Path, folders: Sequence[str]) -> list[Run]:
    """Return the runs of plans that differ in the algorithm alone; the scene is opened once.

    Args:
        plans: an algorithm each.
        out: the result directory.
        folders: of each algorithm's result in ``out``; none where there is one algorithm.

    Raises:
        UwsimError: as `hash_inputs` does.
    """
    first = prepare_run(plans[0], out)
    runs = []
    for plan, folder in zip(plans, folders or [""], strict=True):
        with record_inputs() as sources:
            inputs = replace(first.inputs, algorithm=of_algorithm(plan))
        files = watchable([*first.files, *sources])
        run = Run(plan=plan, out=out / folder, inputs=inputs, renderer=first.renderer, files=files)
        runs.append(run)
    return runs


def hash_inputs(plan: Plan, pool: RendererPool | None = None) -> tuple[Inputs, str]:
    """Open the scene once: hash every file that is read, and name the renderer.

    Every name of the benchmark is looked up on the way, so that no name can fail later. Inside
    `record_inputs` the files are recorded with their paths.

    Args:
        plan: the benchmark to run.
        pool: lends the renderer; without one it is made, and closed again.

    Returns:
        The ``inputs`` of the result, and what draws the images.

    Raises:
        UwsimError: a file, a body, a camera or a service that is not there.
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
    """Look up every name of the benchmark; raises BenchmarkError with all that is wrong."""
    try:
        bind_all(plan, simulation)
    except UwsimError:
        if errors := unknown_names(plan.benchmark, simulation.world.stage_view):
            raise BenchmarkError(errors) from None
        raise
    truths = truth_diagnostics(plan.benchmark, simulation.world.stage_view)
    if errors := [each for each in truths if each.severity == "error"]:
        raise BenchmarkError(errors)
