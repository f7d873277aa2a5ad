"""Running single levels with single seeds, each once: stored runs are reused.

Each is a trial of the independent mode: the algorithm settles at the updaters'
initial values, then the level is ramped in. The images and the noise of a level depend on the
seed and on the level's values, never on earlier runs.
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
from ..runs.sealed import sealed
from .criterion import Criterion, Judgement
from .search import Search, SeedSearch, Strategy

STRIDE = 10_000
"""Numbers of trial files that a seed has for itself."""


@dataclass(frozen=True, kw_only=True)
class Evaluation:
    """One run."""

    seed: int
    """Seed of every random stream."""
    level: float
    """Value of the updater that is searched over."""
    judgement: Judgement
    """Whether it is broken, and why."""
    row: StoredRow
    """As it is stored."""


def plan_for(plan: Plan) -> Plan:
    """Return the plan of single levels, independent of seeds and search."""
    return replace(plan, mode="independent", seed=0, repeats=1, chosen=())


class Evaluations:
    """Runs of the search, from disk or executed now.

    Args:
        run: where they are kept; its plan is one of `plan_for`.
        at: the levels of all updaters, outermost first; that of ``over`` is replaced.
        over: the swept parameter that is searched over.
        criterion: what counts as broken.
    """

    def __init__(self, main_run: Run, *, at: Level, over: str, criterion: Criterion) -> None:
        self.main_run = main_run
        """Where they are kept."""
        self._at, self._criterion = at, criterion
        self.over = over
        """The column of the value that is searched."""
        self._trials: dict[tuple[int, tuple[float, ...]], Trial] = {}
        self._taken: set[int] = set()  # indices of trial files
        self.made: dict[tuple[int, float], Evaluation] = {}
        """Every run that was asked for."""
        for path in sorted((main_run.out / journal.FOLDER).glob("*.jsonl")):
            self._remember(int(path.stem), journal.head_of(path))

    def run(self, strategy: Strategy, executor: Executor, on_run: OnLevel = lambda: None) -> Search:
        """Execute a strategy to its end, running what is not on disk.

        Raises:
            ResultError: what is stored belongs to another run.
            UwsimError: a run could not be executed.
        """
        queue = _JobQueue(self, strategy, on_run)
        with sealed([self.main_run]):
            executor.execute(queue)
        if queue.failure is not None:
            raise queue.failure
        assert queue.found is not None
        return queue.found

    def stored(self, seed: int, value: float) -> bool | None:
        """Return whether a run is broken; None if it was not run yet."""
        if (seed, value) not in self.made:
            trial = self.trial(seed, value)
            stored = self.main_run.stored(trial)
            if stored.end is None or not stored.rows:
                return None
            row = stored.rows[0]
            self.made[seed, value] = Evaluation(
                seed=seed, level=value, judgement=self._criterion.judge(row), row=row
            )
        return self.made[seed, value].judgement.is_broken

    def trial(self, seed: int, value: float) -> Trial:
        """Return the trial of a run. Its number follows from its seed and its level."""
        level = Level(
            tuple((name, value if name == self.over else v) for name, v in self._at.values)
        )
        key = (seed, tuple(v for _, v in level.values))
        if key not in self._trials:
            index = next(i for i in itertools.count(seed * STRIDE) if i not in self._taken)
            self._add(Trial(index=index, repeat=0, seed=seed, levels=(level,), is_alone=True))
        return self._trials[key]

    def _add(self, trial: Trial) -> None:
        self._taken.add(trial.index)
        self._trials[trial.seed, tuple(v for _, v in trial.levels[0].values)] = trial

    def _remember(self, index: int, head: Record | None) -> None:
        """Register a stored run by its seed and its level."""
        self._taken.add(index)
        match head:
            case {"seed": int(seed), "levels": [[*values]]} if len(values) == len(self._at.values):
                names = [name for name, _ in self._at.values]
                level = Level(tuple(zip(names, values, strict=True)))
                self._add(Trial(index=index, repeat=0, seed=seed, levels=(level,), is_alone=True))


class _JobQueue(JobQueue):
    """Runs that a strategy requests; each finished one may lead to others."""

    def __init__(self, runs: Evaluations, strategy: Strategy, on_run: OnLevel) -> None:
        super().__init__([], on_run)
        self._runs, self._strategy = runs, strategy
        self._tasks: list[SeedSearch[Any]] = []
        self._results: dict[int, Any] = {}
        self._awaited: dict[tuple[int, float], list[int]] = {}
        self.found: Search | None = None
        """What the strategy found in the end."""
        self._begin(next(strategy))

    def done(self, job: Job) -> None:
        """Resume the task that waits for the run."""
        super().done(job)
        values = dict(job.trial.levels[0].values)
        key = (job.trial.seed, values[self._runs.over])
        answer = self._runs.stored(*key)
        assert answer is not None
        for task in self._awaited.pop(key):
            self._go_on(task, answer)
        self._end_if_done()

    def _begin(self, tasks: list[SeedSearch[Any]]) -> None:
        self._tasks, self._results = tasks, {}
        for i in range(len(tasks)):
            self._go_on(i, None)
        self._end_if_done()

    def _go_on(self, i: int, answer: bool | None) -> None:
        """Advance a task until it has to wait for a run."""
        task = self._tasks[i]
        try:
            while True:
                # None begins a generator
                level = task.questions.send(answer)  # type: ignore[arg-type]
                answer = self._runs.stored(task.seed, level)
                if answer is None:
                    self._await(i, (task.seed, level))
                    return
        except StopIteration as end:
            self._results[i] = end.value

    def _await(self, i: int, key: tuple[int, float]) -> None:
        waiting = self._awaited.setdefault(key, [])
        waiting.append(i)
        if len(waiting) == 1 and self.failure is None:
            self.add(Job(self._runs.main_run, self._runs.trial(*key)))

    def _end_if_done(self) -> None:
        if self.found is None and len(self._results) == len(self._tasks):
            try:
                tasks = self._strategy.send([self._results[i] for i in range(len(self._tasks))])
            except StopIteration as end:
                self.found = end.value
            else:
                self._begin(tasks)
