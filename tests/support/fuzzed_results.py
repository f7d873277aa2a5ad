"""Results, damaged at random, and their readers, for a test and for scripts/fuzz."""

from __future__ import annotations

import json
import random
import shutil
from collections.abc import Callable, Iterator
from copy import deepcopy
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from tests.support.short_benchmark import bench_of, write_benchmark
from uwsim.analysis.comparison import compare, differences, read_entries, remarks, shared_column
from uwsim.analysis.comparison.page import render as render_comparison
from uwsim.analysis.report.page import render
from uwsim.base.terminal import clean_text
from uwsim.cli.exit_status import format_error
from uwsim.cli.verify import describe_result
from uwsim.errors import UwsimError
from uwsim.results.interrupted import describe_missing_result, resume_command
from uwsim.results.journal_check import check_rows
from uwsim.results.provenance import machine, save_provenance
from uwsim.results.result_file import load
from uwsim.runs.executors.executor import run_all
from uwsim.runs.run import Run
from uwsim.verify.environment import environment_differences
from uwsim.verify.recorded_plan import FileOverrides, check_inputs, plan_of
from uwsim.verify.verify import complete_trials, verify

FILES = ("result.json", "units/00000.jsonl", "units/00001.jsonl", "provenance.json")
"""The files to damage."""
VALUES: tuple[Any, ...] = (
    None, True, False, 0, -1, 3, 1.5, -0.0, 1e300, -1e61, 10**30, float("nan"), float("inf"),
    "", "x", "esm", "../../etc/passwd", "\x1b[31m", "a" * 400, [], {}, [[]], [1, 2], ["a", "b"],
    {"a": 1}, [None] * 8, [["a", 1]],
)  # fmt: skip
"""The replacements of values."""


@dataclass(frozen=True)
class IntactResult:
    """A small intact result and its run."""

    folder: Path
    """The folder with the benchmark, the result directory ``out`` and its copy ``other``."""
    bench: Run
    """The run."""


def make_intact_result(folder: Path) -> IntactResult:
    """Run a small benchmark in two trials."""
    benchmark = write_benchmark(folder, "0.1")
    levels = ["fog=0", "fog=0.4"]
    bench = bench_of(benchmark, folder / "out", mode="independent", levels=levels)
    run_all([bench])
    command = ["bench", str(benchmark), "--algorithm", "esm", "--out", "out"]
    save_provenance({"command": command, "wall_s": 1.0, **machine()}, folder / "out")
    shutil.copytree(folder / "out", folder / "other")
    return IntactResult(folder, bench)


def damage_json(data: bytes, chance: random.Random) -> bytes:
    """Return the bytes of a JSON file, or of a file with a document on each line, with errors."""
    if chance.random() < 0.15:
        return _damage_bytes(data, chance)
    lines = data.split(b"\n") if data.count(b"\n{") else [data]
    k = chance.choice([i for i, line in enumerate(lines) if line.strip()])
    document = json.loads(lines[k])
    for _ in range(chance.choice((1, 1, 1, 2, 4))):
        document = _with_error(document, chance)
    lines[k] = json.dumps(document).encode()
    return b"\n".join(lines)


def _damage_bytes(data: bytes, chance: random.Random) -> bytes:
    offset = chance.randrange(len(data))
    return chance.choice(
        [
            data[:offset],
            data[:offset] + bytes([chance.randrange(256)]) + data[offset + 1 :],
            data[:offset] + b"[" * chance.choice((50, 500, 100_000)) + data[offset:],
            b"[" * 400 + b"]" * 400,
            b'{"format": "uwsim-result/1", "run": ' + b"[" * 400 + b"]" * 400 + b"}",
            b"",
            b"\xff\xfe\0",
        ]
    )


def _walk_keys(node: Any) -> Iterator[tuple[Any, Any]]:
    """Yield every container with each of its keys."""
    containers = [node]
    while containers:
        container = containers.pop()
        keys = list(container) if isinstance(container, dict) else range(len(container))
        for key in keys:
            yield container, key
            if isinstance(container[key], dict | list):
                containers.append(container[key])


def _with_error(document: Any, chance: random.Random) -> Any:
    keys = list(_walk_keys(document)) if isinstance(document, dict | list) else []
    if not keys or chance.random() < 0.03:
        return deepcopy(chance.choice(VALUES))
    container, key = chance.choice(keys)
    match chance.randrange(6):
        case 0:
            del container[key]
        case 1 if isinstance(container, dict):
            container[chance.choice(("x", "", str(key) + "s"))] = container.pop(key)
        case 2:
            source, source_key = chance.choice(keys)
            container[key] = json.loads(json.dumps(source[source_key]))
        case 3:
            nested_list: Any = 1
            for _ in range(chance.choice((3, 30, 300))):
                nested_list = [nested_list]
            container[key] = nested_list
        case _:
            container[key] = deepcopy(chance.choice(VALUES))
    return document


# ---------------------------------------------------------------------------- readers


def read_for_report(intact_result: IntactResult, directory: Path) -> None:
    """Read as ``uwsim report``, without drawing."""
    result = load(directory)
    check_note = check_rows(result, directory)
    render(result, directory, plots=[], check_note=check_note)


def read_for_compare(intact_result: IntactResult, directory: Path) -> None:
    """Read as ``uwsim compare``, without drawing."""
    entries = read_entries([directory, intact_result.folder / "other"])
    column = shared_column(entries, None)
    comparison = compare(
        entries, column, experiment_differences=differences(entries), remarks=remarks(entries)
    )
    render_comparison(comparison, [])


def read_for_verify(intact_result: IntactResult, directory: Path) -> None:
    """Read as ``uwsim verify``, without simulation."""
    result = load(directory)
    plan = plan_of(
        result, directory, FileOverrides(benchmark=Path(intact_result.bench.plan.benchmark.path))
    )
    check_inputs(result.inputs, intact_result.bench.inputs)
    bench = Run(
        plan=plan, out=directory, inputs=result.inputs, renderer=intact_result.bench.renderer
    )
    trials = complete_trials(directory, plan, result)
    clean_text(describe_result(result, directory, len(trials), len(plan.trials())))
    if trials:
        environment_differences(result, directory, bench.info)
        verify(directory, result, bench, trials, executor=CopyingExecutor(intact_result))


def read_for_resume(intact_result: IntactResult, directory: Path) -> None:
    """Read as ``uwsim bench --resume``, without simulation, and describe an interrupted run."""
    resume_command(directory)
    describe_missing_result(directory)
    bench = replace(intact_result.bench, out=directory)
    bench.begin()
    bench.write()


@dataclass(frozen=True)
class CopyingExecutor:
    """An executor that copies trials of the intact result."""

    intact_result: IntactResult

    def execute(self, queue: Any) -> None:
        """Copy the requested trials."""
        while (job := queue.pop()) is not None:
            folder = job.run.out / "units"
            shutil.copytree(self.intact_result.folder / "out" / "units", folder, dirs_exist_ok=True)


TARGETS: dict[str, Callable[[IntactResult, Path], None]] = {
    "report": read_for_report,
    "compare": read_for_compare,
    "verify": read_for_verify,
    "resume": read_for_resume,
}


def trial(intact_result: IntactResult, target: str, seed: int) -> str | None:
    """Damage a copy of the result, and read it; return a description of the failure."""
    chance = random.Random(f"{target} {seed}")
    directory = intact_result.folder / f"trial-{target}-{seed}"
    shutil.copytree(intact_result.folder / "out", directory)
    try:
        file = directory / chance.choice(FILES)
        file.write_bytes(damage_json(file.read_bytes(), chance))
        TARGETS[target](intact_result, directory)
    except UwsimError as error:
        line = format_error(error)
        return None if line.count("\n") == 0 and len(line) < 4100 else f"many lines: {line[:200]}"
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    finally:
        shutil.rmtree(directory)
    return None
