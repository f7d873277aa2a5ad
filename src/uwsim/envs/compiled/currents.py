"""The water of the episodes of rows: made anew by `RowWater`, or that of the last episode, changed.

`RowWater` makes the water of a level from specs, which takes 0.4 ms. The current of a
``<currentForceUpdater>`` differs from episode to episode in two numbers only, its speed and its
``u:timeOffset``, unless it has noise. Then each row keeps the records of its current.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ...base.geometry import Array
from ...benchmark.updater_settings import updater_path
from ...benchmark.updaters import CurrentForceUpdaterSpec, Level, chain
from ...currents.flow_function import FlowFunction
from ...physics.hydrodynamics.water_function import WaterFunction
from ..batch.rows import Rows
from ..row_task import RowPlan
from .draws import Draws


@dataclass(frozen=True, eq=False)
class RowCurrent:
    """The current of a row, whose numbers can be changed."""

    function: WaterFunction
    """The function of the water."""
    speed: Array
    """The mean speed in the record of the current, (1,) [m/s]."""
    offset: Array
    """The time of the current when an episode begins, in its record, (1,) [s]."""


class RowCurrents:
    """The water of the episodes of rows.

    Args:
        task: the task of the rows.
        rows: the rows whose water is set.
    """

    def __init__(self, task: RowPlan, rows: Rows) -> None:
        self._water, self._rows = task.water, rows
        self._updater = changeable_updater(task)
        self._currents: dict[int, RowCurrent] = {}

    def begin(self, rows: Sequence[int], seeds: Sequence[int], draws: Draws) -> None:
        """Set the water of rows whose episodes begin.

        Args:
            rows: the indices of the rows.
            seeds: the seed of each of these rows.
            draws: the values that the seeds have drawn.
        """
        updater = self._updater
        if updater is None:
            for i, (row, seed) in enumerate(zip(rows, seeds, strict=True)):
                self._rows.set_water(row, self._water.function(seed, draws.level(i)))
            return
        speeds = draws.levels[updater.parameter].tolist()
        offsets = [updater.time_offset] * len(rows)
        if (path := f"{updater_path(updater)}.timeOffset") in draws.variations:
            offsets = draws.variations[path].tolist()
        for row, speed, offset in zip(rows, speeds, offsets, strict=True):
            current = self._currents.get(row)
            if current is None:
                water = self._water.function(0, Level(((updater.parameter, 1.0),)))
                current = self._currents[row] = changeable_current(water)
            current.speed[0], current.offset[0] = speed, offset
            is_still = speed == updater.force_variation == 0.0
            self._rows.set_water(row, None if is_still else current.function)


def changeable_updater(task: RowPlan) -> CurrentForceUpdaterSpec | None:
    """Return the updater if its speed and its offset alone determine the water; else None."""
    benchmark, ocean = task.plan.benchmark, task.plan.scene.ocean_state
    updaters = chain(benchmark.scene_updater)
    updater = updaters[0]
    if len(updaters) != 1 or not isinstance(updater, CurrentForceUpdaterSpec):
        return None
    if updater.publish_as_force or updater.random != 0.0 or ocean.currents or ocean.waves:
        return None
    paths = [f"{updater_path(updater)}.timeOffset"]
    has_others = any(item.path not in paths for item in benchmark.vary)
    has_water = any(item.path.startswith("oceanState") for item in task.plan.scene.vary)
    return None if has_others or has_water else updater


def changeable_current(function: WaterFunction | None) -> RowCurrent:
    """Return the records in the water of a `changeable_updater` that is not still."""
    assert function is not None
    delayed_flow = function.memory_owners[0]
    assert isinstance(delayed_flow, FlowFunction)
    sinusoid = delayed_flow.memory_owners[0]
    assert isinstance(sinusoid, FlowFunction)
    return RowCurrent(
        function=function,
        speed=sinusoid.parameters["speed"]["mean"],
        offset=delayed_flow.parameters["offset"],
    )
