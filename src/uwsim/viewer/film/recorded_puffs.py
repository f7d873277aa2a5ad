"""The puffs of sediment of a recorded trial at any time, which follow from their births."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from ...base.geometry import Array
from ...particles.puffs import NUMBER, Puffs
from ...results.motion import StirredSediment
from ...results.motion.stirred_sediment import MASS_COLUMN, NO_VALUE, STEPS
from ...simulation.scenery.scene_sediment import UPDATE_RATE, SceneSediment

TOLERANCE = 1e-3
"""The greatest error of recorded times [s]."""


class RecordedPuffs:
    """The puffs of a trial.

    Args:
        sediment: the sediment of the scene, whose puffs are set.
        births: the births of the trial.
        find_water_velocity: returns the velocity of the water in W at a time, (3,) [m/s].
    """

    def __init__(
        self,
        sediment: SceneSediment,
        births: StirredSediment,
        find_water_velocity: Callable[[float], Array],
    ) -> None:
        self._shown_puffs, self._find_water_velocity = sediment.puffs, find_water_velocity
        self._spec, self._puffs = sediment.spec, Puffs(sediment.spec)
        self._removals = births.table[:, MASS_COLUMN] == NO_VALUE
        self._births: Array = births.table * np.array(STEPS)
        self._next_birth = 0

    def show(self, time: float) -> None:
        """Set the puffs of the scene to those of the last period before or at a time [s]."""
        if time < self._puffs.state.time:
            self._puffs, self._next_birth = Puffs(self._spec), 0
        while (step_time := self._find_step_time()) <= time:
            self._puffs.advance(step_time, self._find_water_velocity(step_time))
            while self._next_birth < len(self._births) and self._birth_time <= step_time:
                self._add(self._next_birth)
                self._next_birth += 1
        state, shown_state = self._puffs.state, self._shown_puffs.state
        shown_state.puffs[:] = state.puffs
        shown_state.n_puffs, shown_state.n_born = state.n_puffs, state.n_born
        shown_state.time = state.time

    @property
    def _birth_time(self) -> float:
        """The time of the next birth [s]; infinite if there is none."""
        births = self._births
        return float(births[self._next_birth, 0]) if self._next_birth < len(births) else math.inf

    def _find_step_time(self) -> float:
        """Return the time of the next period in which puffs move [s]."""
        state, birth_time = self._puffs.state, self._birth_time
        period_end = state.time + 1.0 / UPDATE_RATE
        is_birth = state.n_puffs == 0 or birth_time < period_end + TOLERANCE
        return birth_time if is_birth else period_end

    def _add(self, index: int) -> None:
        """Add a recorded puff, or remove all puffs."""
        state = self._puffs.state
        if self._removals[index]:
            state.n_puffs = 0
            return
        _, number, x, y, z, width, mass, *velocity, floor = self._births[index].tolist()
        self._puffs.add(np.array([x, y, z]), width, mass, np.array(velocity), floor)
        state.puffs[state.n_puffs - 1, NUMBER] = number
