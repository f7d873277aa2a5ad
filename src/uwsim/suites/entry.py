"""An entry: an algorithm for some tasks of a suite, and the plans of its runs."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ..errors import BadSetting, ErrorCollector
from ..middleware.lockstep.spec import ClientSpec
from ..results.inputs import Inputs, short_hash
from ..runs.planning.make_plan import make_plan
from ..runs.planning.option_values import number_or_text
from ..runs.planning.plan import Plan
from ..runs.planning.plan_request import PlanRequest
from ..runs.prepare import prepare_runs
from ..runs.run import Run
from .suite import Suite
from .suite_spec import TaskSpec, TrackSpec

PARAMETER_PREFIX = "algorithm."
"""The beginning of the settings that an entry may have: those of its algorithm."""


@dataclass(frozen=True, kw_only=True)
class Seeds:
    """The consecutive seeds of an entry, and where they come from."""

    split: str
    """The name of the split."""
    first: int
    """The first seed."""
    count: int
    """The number of seeds."""
    date: str = ""
    """The date of the seeds of the split test; empty for a public split."""
    beacon: str = ""
    """The public text from which the seeds of the split test follow; empty for a public split."""

    @property
    def text(self) -> str:
        """The seeds in words, such as ``seeds 0 to 9``."""
        if self.count == 1:
            return f"seed {self.first}"
        return f"seeds {self.first} to {self.first + self.count - 1}"


@dataclass(frozen=True, kw_only=True)
class Entry:
    """An algorithm for some tasks of a suite, and the conditions of its runs."""

    suite: Suite
    """The suite."""
    algorithms: Mapping[str, str]
    """The algorithm for each task, by the name of the task."""
    track: TrackSpec
    """The track by sensors."""
    seeds: Seeds
    """The seeds."""
    is_short: bool = False
    """A flag for the middle level of each task alone."""
    settings: tuple[str, ...] = ()
    """Settings ``algorithm.NAME=VALUE``."""
    client: ClientSpec | None = None
    """The program outside that is the algorithm; None without one."""
    folder: Path | None = None
    """The folder of the algorithm's files; None for the current one."""

    @property
    def tasks(self) -> tuple[TaskSpec, ...]:
        """The tasks of the entry, in the order of the suite."""
        return tuple(task for task in self.suite.spec.tasks if task.name in self.algorithms)

    def plan(self, task: TaskSpec) -> Plan:
        """Return the plan of a task; raise UwsimError for invalid files, names and settings."""
        request = PlanRequest(
            benchmark=self.suite.benchmark_of(task),
            algorithm=None if self.client is not None else self.algorithms[task.name],
            seed=self.seeds.first,
            repeat=self.seeds.count,
            levels=read_levels(task),
            settings=self.settings,
            track=self.track.rule,
            client=self.client,
            is_isolated=True,
            folder=self.folder,
        )
        plan = make_plan(request)
        if self.is_short:
            levels = plan.levels()
            plan = replace(plan, level_choices=levels[len(levels) // 2].values)
        return plan


def read_levels(task: TaskSpec) -> list[tuple[str, float]]:
    """Return the names and values of the levels of a task; empty for all levels."""
    pairs = [level.partition("=") for level in task.levels]
    return [(name, float(value)) for name, _, value in pairs]


def choose_algorithms(suite: Suite, words: Sequence[str], tasks: Sequence[str]) -> dict[str, str]:
    """Return the algorithm of each task.

    Args:
        suite: the suite.
        words: ``NAME`` for all tasks, and ``TASK=NAME`` for one, which takes precedence.
        tasks: the names of the tasks; empty for all tasks that have an algorithm.

    Raises:
        SeveralErrors: tasks are unknown, or have no algorithm.
    """
    errors = ErrorCollector()
    chosen_tasks = []
    for name in tasks:
        with errors.collect():
            chosen_tasks.append(suite.task(name).name)
    algorithms: dict[str, str] = {}
    defaults = [word for word in words if not _is_pair(word)]
    with errors.collect():
        if len(defaults) > 1:
            raise BadSetting(
                f"--algorithm {defaults[1]}: one algorithm is for all tasks already, "
                f"{defaults[0]}; expected TASK={defaults[1]}."
            )
    for word in words:
        if _is_pair(word):
            task, _, name = word.partition("=")
            with errors.collect():
                algorithms[suite.task(task).name] = name
    all_names = chosen_tasks or [task.name for task in suite.spec.tasks]
    if defaults:
        algorithms = {name: defaults[0] for name in all_names} | algorithms
    with errors.collect():
        if idle_tasks := [name for name in chosen_tasks if name not in algorithms]:
            raise BadSetting(f"task {idle_tasks[0]} has no algorithm: add --algorithm NAME.")
    errors.raise_errors()
    names = set(chosen_tasks) or set(algorithms)
    return {name: algorithm for name, algorithm in algorithms.items() if name in names}


def _is_pair(word: str) -> bool:
    """Return whether a word is ``TASK=NAME``; a path may contain an equals sign after a slash."""
    name, sign, _ = word.partition("=")
    return bool(sign) and "/" not in name and ":" not in name


def check_settings(settings: Sequence[str]) -> None:
    """Raise BadSetting for a setting that is none of the algorithm: it would change the task."""
    for setting in settings:
        path, sign, value = setting.partition("=")
        if not path.startswith(PARAMETER_PREFIX) or not sign:
            raise BadSetting(
                f"--set {setting}: expected {PARAMETER_PREFIX}NAME=VALUE; the task itself is fixed."
            )
        number_or_text(value)


def plan_entry(entry: Entry) -> list[tuple[TaskSpec, Plan]]:
    """Return the plan of each task of an entry; all errors of all tasks are raised together.

    Raises:
        UwsimError: a file, a name or a setting is invalid.
    """
    errors, plans = ErrorCollector(), []
    for task in entry.tasks:
        with errors.collect():
            plans.append((task, entry.plan(task)))
    errors.raise_errors()
    return plans


def prepare_entry(plans: Sequence[tuple[TaskSpec, Plan]], out: Path) -> list[Run]:
    """Open the scene of each task once; return the runs, with their results in ``out/TASK``.

    Raises:
        UwsimError: as `prepare_entries` does.
    """
    return prepare_entries({out: plans})[out]


def prepare_entries(
    plans: Mapping[Path, Sequence[tuple[TaskSpec, Plan]]],
) -> dict[Path, list[Run]]:
    """Open the scene of each task once for several entries, which differ in the algorithms alone.

    Args:
        plans: the plans of each entry (`plan_entry`), by its folder, an absolute path.

    Returns:
        The runs of each entry, with their results in ``FOLDER/TASK``.

    Raises:
        UwsimError: as `prepare_runs` does; or a task has other files than the suite records.
    """
    members: dict[str, list[tuple[Path, Plan]]] = {}
    for folder, entry_plans in plans.items():
        for task, plan in entry_plans:
            members.setdefault(task.name, []).append((folder / task.name, plan))
    runs: dict[Path, Run] = {}
    for pairs in members.values():
        outs = [str(out) for out, _ in pairs]
        task_runs = prepare_runs([plan for _, plan in pairs], Path("/"), outs)
        runs |= {run.out: run for run in task_runs}
    for folder, entry_plans in plans.items():
        for task, _ in entry_plans:
            _check_hash(task, runs[folder / task.name])
    return {
        folder: [runs[folder / task.name] for task, _ in entry_plans]
        for folder, entry_plans in plans.items()
    }


def _check_hash(task: TaskSpec, run: Run) -> None:
    """Raise BadSetting if the suite records other files of a task."""
    if task.hash is not None and task_hash(run.inputs) != task.hash:
        raise BadSetting(
            f"{task.name} has other files than its <hash> states, {short_hash(task.hash)}; "
            f"expected a new version and hash, {task_hash(run.inputs)}."
        )


def task_hash(inputs: Inputs) -> str:
    """Return the hash of a task: of its benchmark, its scene, and all files that these name.

    The algorithm does not count, nor do plugins of the user.
    """
    files = sorted(
        (role, name, digest)
        for role, name, digest in inputs.drop_algorithm().files()
        if role != "plugins"
    )
    text = json.dumps(files, ensure_ascii=False)
    return "sha256:" + hashlib.sha256(text.encode()).hexdigest()
