"""The execution of the runs of a search, each a single level with a single seed.

A run is executed only once; stored runs are reused. Each run is a trial of the independent mode:
the algorithm settles at the initial values of the scene updaters, then the level is ramped in. The
images and the noise of a run depend on the seed and on the values of the level, not on other runs.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace
from typing import Any

from ..benchmark.updaters import Level
from ..results import journal
from ..results.stored.stored_row import Record, StoredRow
from ..runs.executors.executor import Executor, Job, JobQueue, OnLevel
from ..runs.planning.plan import Plan, Trial
from ..runs.run import Run
from ..runs.sealing import seal_runs
from .criterion import Criterion, Judgement
from .search import Search, SeedSearch, Strategy

TRIALS_PER_SEED = 10_000
"""The number of indices of trial files that are reserved for each seed."""


@dataclass(frozen=True, kw_only=True)
class Evaluation:
    """A run of the search and its judgement."""

    seed: int
    """The seed of all random streams of the run."""
    level: float
    """The value of the parameter that the search varies."""
    judgement: Judgement
    """The result of the criterion for the run."""
    row: StoredRow
    """The stored row of the run."""


def plan_for(plan: Plan) -> Plan:
    """Return the plan of the runs of a search, without the seeds and levels of a benchmark."""
    return replace(plan, mode="independent", seed=0, repeats=1, level_choices=())


class Evaluations:
    """The evaluations of the runs of a search, read from disk or executed.

    Args:
        run: the benchmark run that stores the trials, with a plan of `plan_for`.
        level: the values of all swept parameters, outermost first; the search varies one.
        parameter: the name of the swept parameter that the search varies.
        criterion: the criterion of a broken run.
    """

    def __init__(self, run: Run, *, level: Level, parameter: str, criterion: Criterion) -> None:
        self.main_run = run
        """The benchmark run that stores the trials."""
        self._level, self._criterion = level, criterion
        self.parameter = parameter
        """The name of the swept parameter that the search varies."""
        self._trials: dict[tuple[int, tuple[float, ...]], Trial] = {}
        self._used_indices: set[int] = set()  # indices of trial files
        self.results: dict[tuple[int, float], Evaluation] = {}
        """The evaluation of each requested run, by seed and level."""
        for path in sorted((run.out / journal.FOLDER).glob("*.jsonl")):
            self._register(int(path.stem), journal.head_of(path))

    def run(self, strategy: Strategy, executor: Executor, on_run: OnLevel = lambda: None) -> Search:
        """Carry out a strategy, and execute the runs that are not on disk.

        Args:
            strategy: the generator of the levels to run.
            executor: the executor of the runs.
            on_run: called after each executed run.

        Raises:
            ResultError: a stored trial belongs to another run.
            UwsimError: a run could not be executed.
        """
        queue = _JobQueue(self, strategy, on_run)
        with seal_runs([self.main_run]):
            executor.execute(queue)
        if queue.failure is not None:
            raise queue.failure
        assert queue.search is not None
        return queue.search

    def is_broken(self, seed: int, value: float) -> bool | None:
        """Return whether the run of a seed at a level is broken; None if it is not executed yet."""
        if (seed, value) not in self.results:
            trial = self.trial(seed, value)
            content = self.main_run.read_trial(trial)
            if content.end is None or not content.rows:
                return None
            row = content.rows[0]
            self.results[seed, value] = Evaluation(
                seed=seed, level=value, judgement=self._criterion.judge(row), row=row
            )
        return self.results[seed, value].judgement.is_broken

    def trial(self, seed: int, value: float) -> Trial:
        """Return the stored trial of a seed at a level, or a new one with the next free index."""
        level = Level(
            tuple((name, value if name == self.parameter else v) for name, v in self._level.values)
        )
        key = (seed, tuple(v for _, v in level.values))
        if key not in self._trials:
            indices = itertools.count(seed * TRIALS_PER_SEED)
            index = next(i for i in indices if i not in self._used_indices)
            self._add(Trial(index=index, repeat=0, seed=seed, levels=(level,), is_independent=True))
        return self._trials[key]

    def _add(self, trial: Trial) -> None:
        self._used_indices.add(trial.index)
        self._trials[trial.seed, tuple(v for _, v in trial.levels[0].values)] = trial

    def _register(self, index: int, head: Record | None) -> None:
        self._used_indices.add(index)
        names = [name for name, _ in self._level.values]
        match head:
            case {"seed": int(seed), "levels": [[*values]]} if len(values) == len(names):
                level = Level(tuple(zip(names, values, strict=True)))
                self._add(
                    Trial(index=index, repeat=0, seed=seed, levels=(level,), is_independent=True)
                )


class _JobQueue(JobQueue):
    """The queue of the runs that a strategy requests; each finished run may lead to others."""

    def __init__(self, runs: Evaluations, strategy: Strategy, on_run: OnLevel) -> None:
        super().__init__([], on_run)
        self._runs, self._strategy = runs, strategy
        self._tasks: list[SeedSearch[Any]] = []
        self._results: dict[int, Any] = {}
        self._waiting_tasks: dict[tuple[int, float], list[int]] = {}
        self.search: Search | None = None
        """The result of the strategy; None until the strategy ends."""
        self._start_tasks(next(strategy))

    def report_finish(self, job: Job) -> None:
        """Resume the tasks that wait for a finished run."""
        super().report_finish(job)
        values = dict(job.trial.levels[0].values)
        key = (job.trial.seed, values[self._runs.parameter])
        answer = self._runs.is_broken(*key)
        assert answer is not None
        for task in self._waiting_tasks.pop(key):
            self._advance(task, answer)
        self._end_when_finished()

    def _start_tasks(self, tasks: list[SeedSearch[Any]]) -> None:
        self._tasks, self._results = tasks, {}
        for i in range(len(tasks)):
            self._advance(i, None)
        self._end_when_finished()

    def _advance(self, i: int, answer: bool | None) -> None:
        """Advance task i until it needs a run that is not executed yet.

        Args:
            i: the index of the task.
            answer: whether the run that it waits for is broken; None to start the task.
        """
        task = self._tasks[i]
        try:
            while True:
                # None starts the generator
                level = task.requests.send(answer)  # type: ignore[arg-type]
                answer = self._runs.is_broken(task.seed, level)
                if answer is None:
                    self._request_run(i, (task.seed, level))
                    return
        except StopIteration as end:
            self._results[i] = end.value

    def _request_run(self, i: int, key: tuple[int, float]) -> None:
        tasks = self._waiting_tasks.setdefault(key, [])
        tasks.append(i)
        if len(tasks) == 1 and self.failure is None:
            self.add(Job(self._runs.main_run, self._runs.trial(*key)))

    def _end_when_finished(self) -> None:
        if self.search is None and len(self._results) == len(self._tasks):
            try:
                tasks = self._strategy.send([self._results[i] for i in range(len(self._tasks))])
            except StopIteration as end:
                self.search = end.value
            else:
                self._start_tasks(tasks)
