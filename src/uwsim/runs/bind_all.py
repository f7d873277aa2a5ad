"""A check, before a run, that every name in a benchmark exists in its scene."""

from __future__ import annotations

from ..benchmark.updaters import bind_updaters
from ..middleware.lockstep.output_client import check_outputs
from ..simulation import Simulation
from .planning.plan import Plan
from .trial.level_triggers import LevelTriggers
from .trial.policy_channel import open_channels
from .trial.triggered_measure import bind_measures


def bind_all(plan: Plan, simulation: Simulation) -> None:
    """Bind every part of a benchmark to its scene, and close the measures and triggers again.

    The updaters are not closed: they open files only when the simulation advances.

    Raises:
        UnknownName: a body, a camera or a link does not exist.
        BadSetting: a declared output of an external program is on no topic of the scene.
    """
    benchmark = plan.benchmark
    bind_updaters(benchmark.scene_updater, simulation.world.stage_view)
    measures = bind_measures(benchmark.measures, simulation.world.measure_view)
    if plan.algorithm.client is not None:
        check_outputs(plan.algorithm.client.outputs, simulation.bus)
    for measure in measures:
        measure.close()
    for channel in open_channels(benchmark, simulation):
        channel.close()
    LevelTriggers(benchmark, simulation.world.measure_view).close()
