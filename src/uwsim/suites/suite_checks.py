"""The checks of the tasks of a suite file: names, levels, statuses and hashes."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

from ..algorithms import ALGORITHMS
from ..assets.bundled import bundled_files
from ..benchmark.measures.outcome import MISSED_STATUS, OutcomeSpec
from ..benchmark.reader import read_benchmark
from ..benchmark.spec import BenchmarkSpec
from ..benchmark.updaters import levels
from ..errors import FileError, choices
from ..runs.named_plugins import plugin_names
from ..schema import Diagnostics
from .suite_spec import MAX_SEED, SplitSpec, TaskSpec

HASH = re.compile(r"sha256:[0-9a-f]{64}", re.ASCII)
"""The pattern of the hash of a task."""
GENERAL_STATUSES = ("lost", "timeout")
"""The statuses that the run itself may give a failed trial of any benchmark."""


def check_splits(splits: Sequence[SplitSpec], diagnostics: Diagnostics) -> None:
    """Report splits whose seeds exceed the greatest one."""
    for split in splits:
        if split.first + split.count - 1 > MAX_SEED:
            diagnostics.error(
                split,
                f"split {split.name!r} ends with the seed {split.first + split.count - 1}; the "
                f"greatest is {MAX_SEED}",
            )


def check_tasks(tasks: Sequence[TaskSpec], folder: Path, diagnostics: Diagnostics) -> None:
    """Report errors of tasks.

    Args:
        tasks: the tasks.
        folder: the folder of the suite, in which benchmarks are searched for.
        diagnostics: the errors.
    """
    counts = Counter(task.name.rpartition("-v")[0] for task in tasks)
    for task in tasks:
        stem = task.name.rpartition("-v")[0]
        is_known_name = Counter(other.name for other in tasks)[task.name] == 1
        if counts[stem] > 1 and is_known_name and task.name != stem:
            diagnostics.error(
                task, f"task {task.name!r}: {stem!r} has several versions; a suite has one of them"
            )
        for message in (*_algorithm_errors(task), *_hash_errors(task)):
            diagnostics.error(task, message)
        _check_benchmark(task, folder, diagnostics)


def _algorithm_errors(task: TaskSpec) -> Iterator[str]:
    """Yield errors of baselines, control and expert."""
    for name in (*task.baselines, task.control, task.expert):
        if name is not None and ":" not in name and name not in ALGORITHMS:
            yield f"no algorithm is called {name!r}.{choices(name, ALGORITHMS)}"
    if not task.baselines:
        yield f"task {task.name!r} has no <baseline>; expected one at least"
    yield from _repetitions("baseline", task.baselines)


def _hash_errors(task: TaskSpec) -> Iterator[str]:
    if task.hash is not None and not HASH.fullmatch(task.hash):
        yield (
            f"<hash> is {task.hash!r:.60}; expected sha256: and 64 digits, as in submission.json"
        )


def _repetitions(tag: str, words: Sequence[str]) -> Iterator[str]:
    for word, count in Counter(words).items():
        if count > 1:
            yield f"<{tag}> {word!r} is given twice"


def _check_benchmark(task: TaskSpec, folder: Path, diagnostics: Diagnostics) -> None:
    """Compare levels and failures with the benchmark, whose plugins are not run."""
    benchmarks = bundled_files("benchmarks")
    path = folder / task.benchmark
    if not path.is_file():
        if task.benchmark not in benchmarks:
            diagnostics.error(
                task,
                f"<benchmark>: {task.benchmark!r} is neither a file nor one of the bundled "
                f"benchmarks.{choices(task.benchmark, benchmarks)}",
            )
            return
        path = benchmarks[task.benchmark]
    if plugin_names(path):
        return
    try:
        benchmark = read_benchmark(path)
    except FileError as error:
        diagnostics.error(task, f"<benchmark>: {str(error).splitlines()[0]}")
        return
    for message in (*_level_errors(task, benchmark), *_failure_errors(task, benchmark)):
        diagnostics.error(task, message)


def _level_errors(task: TaskSpec, benchmark: BenchmarkSpec) -> Iterator[str]:
    """Yield errors of the levels of a task: names and values that the sweep does not have."""
    sweep: dict[str, list[float]] = {}
    for level in levels(benchmark.scene_updater):
        for name, value in level.values:
            sweep.setdefault(name, []).append(value)
    yield from _repetitions("level", task.levels)
    for text in task.levels:
        name, sign, word = text.partition("=")
        try:
            number = float(word)
        except ValueError:
            number = math.nan
        if not sign or not math.isfinite(number):
            yield f"<level> is {text!r:.60}; expected NAME=VALUE, as fog=0.5"
        elif name not in sweep:
            yield f"<level>: {name!r:.60} is not swept by {task.benchmark}.{choices(name, sweep)}"
        elif all(abs(value - number) >= 1e-9 for value in sweep[name]):
            nearest_value = min(sweep[name], key=lambda value: abs(value - number))
            yield f"<level> {text!r:.60} is no level; the nearest is {name}={nearest_value:.12g}"


def _failure_errors(task: TaskSpec, benchmark: BenchmarkSpec) -> Iterator[str]:
    """Yield errors of each ``<failure>``: statuses that the benchmark cannot give a trial."""
    statuses = list(GENERAL_STATUSES)
    for spec in benchmark.measures:
        statuses += spec.statuses
        if isinstance(spec, OutcomeSpec):
            statuses += [MISSED_STATUS, *(failure.status for failure in spec.failure)]
    yield from _repetitions("failure", task.failures)
    for name in task.failures:
        if name not in statuses:
            choice = choices(name, statuses)
            yield f"<failure>: {task.benchmark} has no status {name!r:.60}.{choice}"
