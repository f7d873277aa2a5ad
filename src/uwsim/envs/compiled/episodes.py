"""Rows of episodes of a benchmark that compiled code steps: of a vector, or of one environment.

An episode has the seed, level, variations, current and steps of a trial of ``uwsim bench``. The
physics agree with the engine to 1e-10, and so do observations, rewards and measures. Computed are
the measures of the vehicle's distance from a place (``<positionError>``, ``<u:trackingError>``) and
of its energy; of others, a score is NaN.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ...base.expression import Expression, parse
from ...base.geometry import Array
from ...base.numerics.memory import Floats, Ints64
from ...benchmark.environment.channels import CHANNELS
from ...benchmark.environment.program import Program, compile_program, run_rows
from ...benchmark.measures import EnergySpec
from ...benchmark.measures.outcome import MISSED_STATUS
from ...runs.planning.plan import Plan
from ...runs.planning.trial_cache import compile_plan
from ...runs.trial.status import SIMULATION_ERROR
from ..batch.flows import make_flows
from ..batch.rows import Rows
from ..batch.task import Channel, RowTask, Term
from ..levels import FACTORS, Value
from ..row_task import plan_rows
from . import numbers as c
from .currents import RowCurrents
from .draws import EpisodeDraws
from .kernel import begin_episodes, step_episodes
from .numbers import Flags, make_arrays, task_numbers
from .outcomes import DETAILS, RowOutcome


class Episodes:
    """Rows of episodes, each with its own seed and level.

    The arrays are views of the memory that the next step overwrites.

    Args:
        plan: the plan of the environment.
        n: the number of rows.
        threads: the number of threads; it has no effect on the results.

    Raises:
        BadSetting: rows cannot step the environment; the message has the reasons.
    """

    def __init__(self, plan: Plan, n: int, *, threads: int = 1) -> None:
        self.task = plan_rows(plan, compile_plan(plan, 0))
        self.n, self.n_actions = n, len(self.task.vehicle.actuators)
        no_task = RowTask(
            channels=(Channel(name="position"),),
            terms=(Term(name="constant", weight=0.0),),
            timestep=plan.timestep,
        )
        self._rows = Rows(self.task.vehicle, no_task, n, threads=threads)
        self._rows.seed([0] * n)  # whose streams draw nothing: the rows have no ranges
        self._rows.flows = make_flows(self.task.vehicle, n)
        self._currents = RowCurrents(self.task, self._rows)
        self.numbers = task_numbers(self.task)
        sizes = [CHANNELS[name][0] or self.n_actions for name in self.task.spec.channels]
        self.layout: tuple[tuple[str, int], ...] = tuple(
            zip(self.task.spec.channels, sizes, strict=True)
        )
        """The name and the size of each part of an observation, in order."""
        self.arrays = make_arrays(n, self.numbers, self.n_actions, sum(sizes))
        self._draws = EpisodeDraws(plan, self.task.index)
        self._factors = self._draws.factors
        self._actions = np.zeros((n, self.n_actions))
        self.seeds: Ints64 = np.zeros(n, np.int64)
        """The seeds of the episodes, (n,)."""
        self.levels: dict[str, Floats] = {}
        """The values of the swept parameters by name, (n,) each."""
        self.variations: dict[str, Floats] = {}
        """The values of the varied numbers by path, (n,) each."""
        benchmark, all_names = plan.benchmark, [item.name for item in plan.benchmark.measures]
        self._names = [measure.name for measure in self.task.measures]
        self._score = self._compile(parse(benchmark.function.text, all_names))
        outcome = self.task.outcome
        self._outcome = None if outcome is None else RowOutcome(outcome, self.task.measures)
        self._success = compile_program(
            parse(self.task.spec.success or "1", self._names), self._names
        )

    def begin(self, mask: Flags, seeds: Sequence[int], choices: Mapping[str, Value]) -> None:
        """Begin new episodes of some rows.

        Args:
            mask: true for these rows, (n,).
            seeds: the seed of each of these rows, in order.
            choices: the values or ranges of swept parameters (`levels.draw_level`) and `FACTORS`.

        Raises:
            BadSetting: a seed is invalid.
        """
        rows = np.flatnonzero(mask)
        draws = self._draws.draw(seeds, choices)
        self.seeds[rows] = seeds
        for target, values in ((self.levels, draws.levels), (self.variations, draws.variations)):
            for name, numbers in values.items():
                target.setdefault(name, np.zeros(self.n))[rows] = numbers
        self._rows.reset(mask, levels=self._set_factors(rows, draws.factors))
        self._currents.begin(rows.tolist(), seeds, draws)
        begin_episodes(
            rows, draws.starts, self._rows.vehicles, self._rows.is_varied, self.numbers,
            self._rows.arrays, self.arrays,
        )  # fmt: skip

    def _set_factors(self, rows: Ints64, values: Mapping[str, Floats]) -> dict[str, Floats]:
        """Set the factors of some rows, which are 1 unless chosen; return those of all rows."""
        for name in values:
            self.levels.setdefault(name, np.ones(self.n))
        names = [name for name in FACTORS if name in self.levels and name in self._factors]
        for name in names:
            self.levels[name][rows] = values.get(name, 1.0)
        return {FACTORS[name]: self.levels[name] for name in names}

    def step(self, actions: npt.ArrayLike, mask: Flags) -> None:
        """Apply actions for one period, or until the episode of a row ends.

        Args:
            actions: finite actions, which are limited to -1 to 1, (n, a).
            mask: true for the rows to step, (n,).
        """
        self._actions[:] = actions
        rows = self._rows
        vehicles, physics, flows = rows.vehicles, rows.arrays, rows.flows
        rows.share(
            lambda first, end: step_episodes(
                first, end, mask, vehicles, rows.is_varied, self.numbers, physics, self.arrays,
                self._actions, flows,
            )
        )  # fmt: skip

    def results(self, rows: Ints64) -> dict[str, Any]:
        """Return the results of rows whose episodes are over, as in ``info``: an array for each.

        Args:
            rows: the indices of the rows, (k,).
        """
        has_failed = self.arrays.terminated[rows]
        values = self._values(rows)
        values[has_failed] = np.nan
        measures = {name: values[:, i] for i, name in enumerate(self._names)}
        status = np.full(len(rows), "ok", dtype=object)
        if self._outcome is not None:
            status = self._outcome.judge(
                {"value": values, **{kind: self._statistic(rows, kind) for kind in DETAILS}}
            )
            is_judged = np.where(has_failed, np.nan, 1.0)
            measures[self._outcome.name] = (status == "ok") * is_judged
        status[has_failed] = SIMULATION_ERROR
        success = run_rows(self._success, values)
        is_success = np.isfinite(success) & (success != 0.0)
        # a success of the environment replaces that of an outcome, but not its failures
        good_statuses = ("ok",) if self.task.spec.success is None else ("ok", MISSED_STATUS)
        is_success &= np.isin(status.astype(str), good_statuses)
        no_score = np.full(len(rows), np.nan)
        return {
            "measures": measures,
            "score": no_score if self._score is None else run_rows(self._score, values),
            "status": status,
            "is_success": is_success,
            "success": is_success,
        }

    def close(self) -> None:
        """End the threads."""
        self._rows.close()

    def _values(self, rows: Ints64) -> Array:
        """Return the values of the measures of some rows, (k, m)."""
        values = np.empty((len(rows), len(self.task.measures)))
        for i, measure in enumerate(self.task.measures):
            kind = "last" if isinstance(measure, EnergySpec) else measure.value
            values[:, i] = self._statistic(rows, kind)[:, i]
        return values

    def _statistic(self, rows: Ints64, kind: str) -> Array:
        """Return the last sample, mean, rms or max of each measure of some rows, (k, m)."""
        statistics = self.arrays.statistics[rows]
        if kind == "rms":
            n_samples = self.arrays.steps[rows] + 1.0
            mean_squares: Array = statistics[:, :, c.SQUARES] / n_samples[:, np.newaxis]
            return np.sqrt(mean_squares)
        column = {"last": c.LAST_SAMPLE, "mean": c.MEAN, "max": c.MAX}[kind]
        result: Array = statistics[:, :, column]
        return result

    def _compile(self, expression: Expression) -> Program | None:
        """Compile an expression; None if it has a measure that rows do not compute."""
        if any(name not in self._names for name in expression.names):
            return None
        return compile_program(expression, self._names)
