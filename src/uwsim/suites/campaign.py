"""The runs of an entry: all tasks share the workers, and finished trials are kept.

A folder ``OUT`` has a result for each task, ``OUT/TASK``, the code of the algorithm in
``OUT/code``, the CPU time of each process in ``OUT/timing``, and finally ``OUT/submission.json``.
"""

from __future__ import annotations

import json
import os
import re
import resource
import shutil
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import replace
from pathlib import Path

from ..campaigns.shard import Shard, shared_directory
from ..errors import BadSetting
from ..results.atomic_file import write_text
from ..results.directory import lock_directory, prepare_directory
from ..runs.execute import Execution, Progress, begin_runs, run_trials
from ..runs.executors.executor import Outcome
from ..runs.failed_algorithms import raise_if_simulation_failed

CODE_FOLDER = "code"
"""The folder of the files of the user's algorithm."""
TIMING_FOLDER = "timing"
"""The folder with the CPU time of each shard."""
SECONDS_PER_MINUTE, SECONDS_PER_HOUR = 60.0, 3600.0
RESERVED_FOLDERS = (CODE_FOLDER, TIMING_FOLDER)


def execute_tasks(execution: Execution, shard: Shard | None, progress: Progress) -> Outcome:
    """Run the unfinished trials of all tasks; write the results, unless it is a shard.

    An algorithm that fails in every row of a task is no error: its rows have the status.

    Args:
        execution: the runs of the tasks.
        shard: the part of the trials to run; None for all.
        progress: the display of the number of finished levels.

    Raises:
        UwsimError: the first failure of a run; the other runs are finished first.
        RunFailed: a simulation failed.
    """
    runs = list(execution.runs) if shard is None else shard.choose(execution.runs)
    execution = replace(execution, runs=runs)
    out = runs[0].out.parent
    start_time = _cpu_time()
    with begin_runs(execution, _open_folders(execution, is_shared=shard is not None)):
        has_work = any(run.unfinished_trials() for run in runs)
        try:
            title = execution.title if shard is None else f"{execution.title}, shard {shard}"
            outcome = run_trials(runs, execution.executor, title, progress)
        finally:
            if has_work:
                add_cpu_time(out, shard, _cpu_time() - start_time)
        if shard is None:
            for run, _ in outcome.finished_runs(runs):
                execution.save_provenance(run, execution.timing())
    for _, error in outcome.failures:
        raise error
    raise_if_simulation_failed(runs, outcome.results)
    return outcome


@contextmanager
def _open_folders(execution: Execution, *, is_shared: bool) -> Iterator[None]:
    """Lock the folders of all results, unless other shards share them."""
    with ExitStack() as stack:
        if not is_shared:
            stack.enter_context(lock_directory(execution.runs[0].out.parent))
        for run in execution.runs:
            stack.enter_context(
                shared_directory(run.out, ())
                if is_shared
                else prepare_directory(run.out, resume=True, overwrite=False)
            )
        yield


def copy_code(algorithms: Sequence[str], files: Sequence[Path], out: Path) -> dict[str, str]:
    """Copy the files of algorithms ``FILE.py:Class`` and further files into ``out/code``.

    Args:
        algorithms: the names of algorithms.
        files: files that the algorithms read or import, such as weights.
        out: the folder of the entry.

    Returns:
        The name of each algorithm, relative to ``out/code``.

    Raises:
        BadSetting: a file does not exist, or ``out/code`` has another file of that name.
    """
    names, sources = {}, [*files]
    for name in algorithms:
        file, colon, class_name = name.partition(":")
        if file.endswith(".py"):
            sources.append(Path(file))
            names[name] = f"{Path(file).name}{colon}{class_name}"
        else:
            names[name] = name
    for source in dict.fromkeys(sources):
        if not source.is_file():
            raise BadSetting(f"{source}: there is no such file of the algorithm.")
        target = out / CODE_FOLDER / source.name
        if target.is_file() and target.read_bytes() != source.read_bytes():
            raise BadSetting(
                f"{source} is not the file of the trials in {out}; use another --out, or restore "
                f"it from {target}."
            )
        target.parent.mkdir(parents=True, exist_ok=True)
        if not target.is_file():
            shutil.copyfile(source, target)
    return names


def code_folder(out: Path) -> Path | None:
    """Return the folder of the algorithm's files in an entry; None if it has none.

    The process of the algorithm runs there, and no other: its files may have the names of modules.
    """
    folder = out / CODE_FOLDER
    return folder if folder.is_dir() else None


def add_cpu_time(out: Path, shard: Shard | None, seconds: float) -> None:
    """Add CPU time [s] to that of earlier calls with the same shard."""
    name = "all" if shard is None else f"{shard.number}-of-{shard.count}"
    path = out / TIMING_FOLDER / f"{name}.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    seconds += _read_seconds(path)
    write_text(path, json.dumps({"cpu_s": round(seconds, 3)}) + "\n")


def total_cpu_time(out: Path) -> float:
    """Return the CPU time of all calls that ran trials of an entry [s]."""
    paths = sorted((out / TIMING_FOLDER).glob("*.json"))
    return sum(_read_seconds(path) for path in paths if re.fullmatch(r"[\w-]+\.json", path.name))


def cpu_time_text(seconds: float) -> str:
    """Return a CPU time in a readable unit: ``42 s``, ``7.5 min``, ``3.1 h``."""
    if seconds < SECONDS_PER_MINUTE:
        return f"{seconds:.0f} s"
    if seconds < SECONDS_PER_HOUR:
        return f"{seconds / SECONDS_PER_MINUTE:.1f} min"
    return f"{seconds / SECONDS_PER_HOUR:.1f} h"


def _read_seconds(path: Path) -> float:
    try:
        return float(json.loads(path.read_text(encoding="utf-8"))["cpu_s"])
    except (OSError, ValueError, KeyError, TypeError):
        return 0.0


def _cpu_time() -> float:
    """Return the CPU time of this process and of its children, with their ended children [s]."""
    kinds = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    ended_s = sum(u.ru_utime + u.ru_stime for u in map(resource.getrusage, kinds))
    return ended_s + sum(_living_children_times())


def _living_children_times() -> Iterator[float]:
    """Yield the CPU time of each living child, with its ended children [s].

    The workers of an algorithm of a user are children of a process that lives on.
    """
    ticks_per_second = os.sysconf("SC_CLK_TCK")
    with suppress(OSError, ValueError, IndexError):
        for child in Path(f"/proc/self/task/{os.getpid()}/children").read_text().split():
            fields = Path(f"/proc/{child}/stat").read_text().rpartition(")")[2].split()
            yield sum(map(int, fields[11:15])) / ticks_per_second  # own and of ended children
