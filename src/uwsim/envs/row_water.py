"""The water of rows: the currents and waves of a benchmark's levels, as the engine computes them.

The currents and waves of the scene, the variations (``<u:vary>``), the currents of
``<currentForceUpdater>`` and the heights of ``<u:seaStateUpdater>`` are those of a trial with the
same seed and level: the same random streams and the same compiled functions.
"""

from __future__ import annotations

import dataclasses

import numpy as np

from ..base.geometry import Array
from ..base.rng import stream
from ..benchmark.triggers.on_init import OnInitSpec
from ..benchmark.updater_settings import benchmark_of_seed
from ..benchmark.updaters import (
    STILL_WATER_TIME,
    CurrentForceUpdaterSpec,
    Level,
    SeaStateUpdaterSpec,
    chain,
    initial_level,
    settling_time,
)
from ..model.scene_model import SceneModel
from ..physics.hydrodynamics.water_function import WaterFunction
from ..runs.planning.plan import Plan
from ..scene.variation import apply_variations
from ..simulation.water.water_motion import WaterMotion, water_motion
from .task import trial_of

WATER_PATHS = ("oceanState.current", "oceanState.waves")
"""The beginnings of the paths of variations that change the motion of the water."""


class RowWater:
    """The water of a benchmark's levels at the bodies of one vehicle.

    Args:
        plan: the plan of the benchmark.
        model: the compiled scene for any seed.
        vehicle: the name of the vehicle.
        n_bodies: the number of bodies at which the water is computed.
        n_steps: the number of physics steps of a level.
    """

    def __init__(
        self, plan: Plan, model: SceneModel, vehicle: str, *, n_bodies: int, n_steps: int
    ) -> None:
        self._plan, self._model = plan, model
        self._names = (vehicle,) * n_bodies
        self._steps = range(1, n_steps + 1)
        scene = plan.scene
        water_variations = [item for item in scene.vary if item.path.startswith(WATER_PATHS)]
        self._scene = dataclasses.replace(scene, vary=tuple(water_variations))
        self._varies_level = bool(plan.benchmark.vary)

    def function(self, seed: int, level: Level) -> WaterFunction | None:
        """Return the motion of the water in an episode, which begins at time 0; None: still water.

        The result may serve one row only, as it contains memory.
        """
        motion = self._motion(seed, level)
        return motion.motion_during(no_positions, self._steps, self._plan.timestep, self._names)

    def reasons(self) -> list[str]:
        """Return the reasons why rows cannot have the water of the benchmark."""
        benchmark, reasons = self._plan.benchmark, []
        level = initial_level(benchmark.scene_updater)
        if not isinstance(benchmark.start_on, OnInitSpec) or benchmark.prelude:
            reasons.append("its levels do not begin at once (<startOn> onInit, u:prelude false)")
        if settling_time(benchmark.scene_updater, level) > 0.0:
            reasons.append("its updater has a u:settlingTime")
        if self._motion(0, level).needs_positions(self._names):
            reasons.append("its scene has a current that Python computes from positions")
        return reasons

    def _motion(self, seed: int, level: Level) -> WaterMotion:
        """Return the water of a level, as the updaters of a trial set it at time 0."""
        prefix, compatibility = trial_of(seed, level).stream_prefix, self._plan.compatibility

        def level_stream(name: str) -> np.random.Generator:
            return stream(seed, prefix + name)

        model = dataclasses.replace(self._model, scene=apply_variations(self._scene, seed))
        motion = water_motion(model, level_stream, runs_code=True)
        benchmark = self._plan.benchmark
        if self._varies_level:
            benchmark = benchmark_of_seed(benchmark, seed)
        updaters = chain(benchmark.scene_updater)
        for updater, (_, value) in zip(updaters, level.values, strict=True):
            if isinstance(updater, SeaStateUpdaterSpec):
                motion.set_wave_height(value)
            elif isinstance(updater, CurrentForceUpdaterSpec) and not updater.publish_as_force:
                motion.set(
                    updater.flow(
                        value, level_stream, compatibility, start=0.0, delay=STILL_WATER_TIME
                    )
                )
        return motion


def no_positions() -> Array:
    """Return no positions: those of rows are in compiled code."""
    return np.zeros((0, 3))
