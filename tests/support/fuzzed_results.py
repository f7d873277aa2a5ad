"""Results that were damaged by chance, and what reads them: for a test and for scripts/fuzz."""

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
"""What is damaged."""
VALUES: tuple[Any, ...] = (
    None, True, False, 0, -1, 3, 1.5, -0.0, 1e300, -1e61, 10**30, float("nan"), float("inf"),
    "", "x", "esm", "../../etc/passwd", "\x1b[31m", "a" * 400, [], {}, [[]], [1, 2], ["a", "b"],
    {"a": 1}, [None] * 8, [["a", 1]],
)  # fmt: skip
"""What is put in the place of something."""


@dataclass(frozen=True)
class Sound:
    """A tiny result that is sound, and the run that made it."""

    folder: Path
    """Benchmark and result directory ``out``; and ``other``, the same under another name."""
    bench: Run
    """The run."""


def made(folder: Path) -> Sound:
    """Play a tiny benchmark in two trials."""
    benchmark = write_benchmark(folder, "0.1")
    levels = ["fog=0", "fog=0.4"]
    bench = bench_of(benchmark, folder / "out", mode="independent", levels=levels)
    run_all([bench])
    command = ["bench", str(benchmark), "--algorithm", "esm", "--out", "out"]
    save_provenance({"command": command, "wall_s": 1.0, **machine()}, folder / "out")
    shutil.copytree(folder / "out", folder / "other")
    return Sound(folder, bench)


def damaged(data: bytes, chance: random.Random) -> bytes:
    """Return the bytes of a JSON file, or of one with a document a line, with a few errors."""
    if chance.random() < 0.15:
        return _damaged_bytes(data, chance)
    lines = data.split(b"\n") if data.count(b"\n{") else [data]
    k = chance.choice([i for i, line in enumerate(lines) if line.strip()])
    document = json.loads(lines[k])
    for _ in range(chance.choice((1, 1, 1, 2, 4))):
        document = _with_error(document, chance)
    lines[k] = json.dumps(document).encode()
    return b"\n".join(lines)


def _damaged_bytes(data: bytes, chance: random.Random) -> bytes:
    place = chance.randrange(len(data))
    return chance.choice(
        [
            data[:place],
            data[:place] + bytes([chance.randrange(256)]) + data[place + 1 :],
            data[:place] + b"[" * chance.choice((50, 500, 100_000)) + data[place:],
            b"[" * 400 + b"]" * 400,
            b'{"format": "uwsim-result/1", "run": ' + b"[" * 400 + b"]" * 400 + b"}",
            b"",
            b"\xff\xfe\0",
        ]
    )


def _places(node: Any) -> Iterator[tuple[Any, Any]]:
    """Every container, with each of its keys."""
    todo = [node]
    while todo:
        here = todo.pop()
        keys = list(here) if isinstance(here, dict) else range(len(here))
        for key in keys:
            yield here, key
            if isinstance(here[key], dict | list):
                todo.append(here[key])


def _with_error(document: Any, chance: random.Random) -> Any:
    places = list(_places(document)) if isinstance(document, dict | list) else []
    if not places or chance.random() < 0.03:
        return deepcopy(chance.choice(VALUES))
    here, key = chance.choice(places)
    match chance.randrange(6):
        case 0:
            del here[key]
        case 1 if isinstance(here, dict):
            here[chance.choice(("x", "", str(key) + "s"))] = here.pop(key)
        case 2:
            there, other = chance.choice(places)
            here[key] = json.loads(json.dumps(there[other]))
        case 3:
            nested: Any = 1
            for _ in range(chance.choice((3, 30, 300))):
                nested = [nested]
            here[key] = nested
        case _:
            here[key] = deepcopy(chance.choice(VALUES))
    return document


# ---------------------------------------------------------------------------- what reads them


def read_for_report(sound: Sound, directory: Path) -> None:
    """What ``uwsim report`` does but draw."""
    result = load(directory)
    unchecked = check_rows(result, directory)
    render(result, directory, plots=[], check_note=unchecked)


def read_for_compare(sound: Sound, directory: Path) -> None:
    """What ``uwsim compare`` does but draw."""
    entries = read_entries([directory, sound.folder / "other"])
    column = shared_column(entries, None)
    comparison = compare(
        entries, column, experiment_differences=differences(entries), remarks=remarks(entries)
    )
    render_comparison(comparison, [])


def read_for_verify(sound: Sound, directory: Path) -> None:
    """What ``uwsim verify`` does but play."""
    stored = load(directory)
    plan = plan_of(
        stored, directory, FileOverrides(benchmark=Path(sound.bench.plan.benchmark.path))
    )
    check_inputs(stored.inputs, sound.bench.inputs)
    bench = Run(plan=plan, out=directory, inputs=stored.inputs, renderer=sound.bench.renderer)
    trials = complete_trials(directory, plan, stored)
    clean_text(describe_result(stored, directory, len(trials), len(plan.trials())))
    if trials:
        environment_differences(stored, directory, bench.info)
        verify(directory, stored, bench, trials, executor=Copies(sound))


def read_for_resume(sound: Sound, directory: Path) -> None:
    """What ``uwsim bench --resume`` does but play; and what is said of an interrupted run."""
    resume_command(directory)
    describe_missing_result(directory)
    bench = replace(sound.bench, out=directory)
    bench.begin()
    bench.write()


@dataclass(frozen=True)
class Copies:
    """An executor that gives what the sound result has."""

    sound: Sound

    def execute(self, queue: Any) -> None:
        """Copy the trials that are asked for."""
        while (job := queue.take()) is not None:
            place = job.run.out / "units"
            shutil.copytree(self.sound.folder / "out" / "units", place, dirs_exist_ok=True)


TARGETS: dict[str, Callable[[Sound, Path], None]] = {
    "report": read_for_report,
    "compare": read_for_compare,
    "verify": read_for_verify,
    "resume": read_for_resume,
}


def trial(sound: Sound, target: str, seed: int) -> str | None:
    """Damage a copy of the result and read it; returns what is wrong with how that ended."""
    chance = random.Random(f"{target} {seed}")
    directory = sound.folder / f"trial-{target}-{seed}"
    shutil.copytree(sound.folder / "out", directory)
    try:
        file = directory / chance.choice(FILES)
        file.write_bytes(damaged(file.read_bytes(), chance))
        TARGETS[target](sound, directory)
    except UwsimError as error:
        line = format_error(error)
        return None if line.count("\n") == 0 and len(line) < 4100 else f"many lines: {line[:200]}"
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    finally:
        shutil.rmtree(directory)
    return None
