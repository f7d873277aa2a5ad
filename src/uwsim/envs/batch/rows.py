"""Many free vehicles with one task, stepped together by compiled code on threads."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.draws import stream_of
from ...base.numerics.memory import Floats
from ...base.rng import stream
from ...errors import BadSetting
from ...physics.hydrodynamics.kernel.free_step import FreeVehicle
from ...physics.hydrodynamics.water_function import WaterFunction
from . import columns as c
from .arrays import Flags, make_arrays, stack_vehicles
from .channels import Singles
from .flows import RowFlows, make_flows, set_flow
from .loops import reset_rows, step_rows
from .task import RowTask, parameter_index

MAX_ROWS = 1_000_000
"""The greatest number of rows."""
_FACTORS = slice(c.MASS, c.DELAY)


class Rows:
    """Rows of one vehicle with one task; each row has its own state, stream and parameters.

    The arrays are views of the memory that the next step overwrites.

    Args:
        vehicle: the numbers of the vehicle.
        task: the task.
        n: the number of rows.
        mixing: the commands of the actuators per action, (k, a); None: an action for each actuator.
        threads: the number of threads that share the rows; it has no effect on the results.

    Raises:
        BadSetting: a number is out of its range.
        UnknownName: the task has an unknown name.
    """

    def __init__(
        self,
        vehicle: FreeVehicle,
        task: RowTask,
        n: int,
        *,
        mixing: Array | None = None,
        threads: int = 1,
    ) -> None:
        if not 1 <= n <= MAX_ROWS:
            raise BadSetting(f"The batch has {n} rows; expected 1 to {MAX_ROWS}.")
        if not 1 <= threads <= 256:
            raise BadSetting(f"The batch has {threads} threads; expected 1 to 256.")
        self.task, self.n = task, n
        self.numbers = task.bind(vehicle, mixing)
        n_actuators, n_actions = self.numbers.mixing.shape
        self._nominal_vehicle = vehicle
        self.arrays = make_arrays(
            n,
            len(vehicle.bodies),
            n_actuators,
            n_actions,
            task.n_observations(n_actions, n_actuators),
        )
        ranges = self.numbers.ranges[_FACTORS]
        self.is_varied = bool((ranges != 1.0).any())
        self.vehicles = stack_vehicles(vehicle, n if self.is_varied else 1)
        self.flows: RowFlows | None = None
        """The functions of the water of the rows; None: no water moves in an episode."""
        self._water_functions: list[WaterFunction | None] = [None] * n
        self._generators: list[np.random.Generator | None] = [None] * n
        self._all_rows = np.ones(n, np.bool_)
        self._no_levels = np.full((n, len(c.PARAMETERS)), np.nan)
        self._actions = np.zeros((n, n_actions))
        self._bounds = [(n * i // threads, n * (i + 1) // threads) for i in range(threads)]
        self._pool = ThreadPoolExecutor(threads - 1) if threads > 1 else None

    @property
    def observations(self) -> Singles:
        """The observations, (n, o)."""
        return self.arrays.observations

    @property
    def rewards(self) -> Floats:
        """The rewards of the last step, (n,)."""
        return self.arrays.rewards

    @property
    def terminated(self) -> Flags:
        """The rows that left the region of the task, or succeeded if that ends it, (n,)."""
        return self.arrays.terminated

    @property
    def truncated(self) -> Flags:
        """The rows whose time is over, (n,)."""
        return self.arrays.truncated

    @property
    def successes(self) -> Flags:
        """The rows that have succeeded in this episode, (n,)."""
        return self.arrays.successes

    @property
    def tallies(self) -> Floats:
        """The sums over the episodes (`columns`), (n, 7)."""
        return self.arrays.tallies

    @property
    def steps(self) -> npt.NDArray[np.int64]:
        """The numbers of steps since the episodes began, (n,)."""
        return self.arrays.steps

    @property
    def states(self) -> Floats:
        """The states of the vehicles (`free_step`), (n, 13 + k)."""
        return self.arrays.states

    @property
    def levels(self) -> dict[str, Floats]:
        """The parameters of the episodes by name, (n,) each."""
        return {name: self.arrays.parameters[:, i] for i, name in enumerate(c.PARAMETERS)}

    def seed(self, seeds: Sequence[int | None]) -> None:
        """Give some rows new random streams.

        Args:
            seeds: the seed of each row, (n,); None: the row keeps its stream.
        """
        for row, seed in enumerate(seeds):
            if seed is not None:
                generator = stream(seed, "envs/reset")
                self._generators[row] = generator
                self.arrays.streams[row] = stream_of(generator)

    def reset(
        self,
        mask: Flags | None = None,
        seeds: Sequence[int | None] | None = None,
        levels: Mapping[str, float | npt.ArrayLike] | None = None,
    ) -> Singles:
        """Begin new episodes, in water with the drawn current until `set_water`.

        Args:
            mask: true for the rows to reset, (n,); None: all.
            seeds: the seed of each row, or None for rows that keep their streams; rows without a
                stream need one.
            levels: values of parameters by name, one for all rows or one for each; others are
                drawn.

        Returns:
            The observations of all rows, (n, o).
        """
        if seeds is not None:
            self.seed(seeds)
        row_mask = self._all_rows if mask is None else np.ascontiguousarray(mask, np.bool_)
        if any(self._generators[row] is None for row in np.flatnonzero(row_mask)):
            raise BadSetting("A row has no random stream; the first reset needs seeds.")
        values = self._no_levels
        if levels:
            values = self._no_levels.copy()
            for name, level in levels.items():
                values[:, parameter_index(name)] = level
            factors = values[:, _FACTORS]
            if not self.is_varied and ((factors != 1.0) & ~np.isnan(factors)).any():
                self.vehicles, self.is_varied = (
                    stack_vehicles(self._nominal_vehicle, self.n),
                    True,
                )
        if self.flows is not None:
            self.flows.functions[row_mask] = 0
        numbers, rows = self.numbers, self.arrays
        self.share(
            lambda first, end: reset_rows(
                first,
                end,
                row_mask,
                self._nominal_vehicle,
                self.vehicles,
                self.is_varied,
                numbers,
                rows,
                values,
            )
        )
        return rows.observations

    def set_water(self, row: int, function: WaterFunction | None) -> None:
        """Set the motion of the water of a row for the episode that has begun.

        It replaces the drawn current. The function has to be of this row alone, and ready for the
        whole episode; its time is 0 when the episode begins.

        Args:
            row: the index of the row, which has been reset.
            function: the function of the water at `flows.n_bodies` bodies; None: still water.
        """
        self.arrays.water[row] = 0.0
        if function is not None and self.flows is None:
            self.flows = make_flows(self._nominal_vehicle, self.n)
        if self.flows is not None:
            self._water_functions[row] = function  # which keeps its memory
            set_flow(self.flows, row, function)

    def step(self, actions: npt.ArrayLike, mask: Flags | None = None) -> Singles:
        """Take a step of the environment.

        Args:
            actions: the actions from -1 to 1, (n, a).
            mask: true for the rows to step, (n,); None: all.

        Returns:
            The observations of all rows, (n, o).
        """
        self._actions[:] = actions
        row_mask = self._all_rows if mask is None else np.ascontiguousarray(mask, np.bool_)
        numbers, rows = self.numbers, self.arrays
        if self._pool is None:
            step_rows(
                0, self.n, row_mask, self.vehicles, self.is_varied, numbers, rows, self._actions,
                self.flows,
            )  # fmt: skip
        else:
            self.share(
                lambda first, end: step_rows(
                    first,
                    end,
                    row_mask,
                    self.vehicles,
                    self.is_varied,
                    numbers,
                    rows,
                    self._actions,
                    self.flows,
                )
            )
        return rows.observations

    def close(self) -> None:
        """End the threads."""
        if self._pool is not None:
            self._pool.shutdown()

    def share(self, work: Callable[[int, int], Any]) -> None:
        """Call a compiled function for the rows of each thread, the last ones in this thread."""
        if self._pool is None:
            work(0, self.n)
            return
        *other_bounds, own_bounds = self._bounds
        futures = [self._pool.submit(work, *bounds) for bounds in other_bounds]
        work(*own_bounds)
        for future in futures:
            future.result()
