"""One worker, several, killed and resumed: the same bytes, and nothing lost or counted twice."""

import os
import random
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest

from tests.support.short_benchmark import bench_of, fingerprint, run, write_benchmark
from tests.support.stored_rows import stored_end, stored_row
from uwsim.errors import NeverStarted, ResultError, RunFailed
from uwsim.results.journal import Journal
from uwsim.results.result_file import load
from uwsim.runs.executors import executor
from uwsim.runs.executors.executor import Job, JobQueue, SerialExecutor, run_all
from uwsim.runs.executors.processes import ProcessExecutor, make_picklable
from uwsim.simulation import Cut

ALGORITHMS = "tests.runs.executors.algorithms"


@pytest.fixture
def benchmark(tmp_path: Path) -> Path:
    return write_benchmark(tmp_path, "0.2")


def mortal(tmp_path: Path, dies: str) -> dict[str, object]:
    settings = [f"algorithm.immortal={tmp_path / 'immortal'}", f"algorithm.dies={dies}"]
    return {"algorithm": f"{ALGORITHMS}:Mortal", "settings": settings}


def killing_its_worker(tmp_path: Path) -> dict[str, object]:
    """An algorithm in the worker's own process: it takes the worker with it, once."""
    return {**mortal(tmp_path, "once"), "in_process": True}


def test_one_worker_and_two_give_the_same_bytes(benchmark: Path, tmp_path: Path) -> None:
    n_levels: list[None] = []
    levels = ["fog=0.4"]
    run(benchmark, tmp_path / "one", repeat=2, levels=levels)
    two = bench_of(benchmark, tmp_path / "two", repeat=2, levels=levels)
    run_all([two], ProcessExecutor(2), on_level=lambda: n_levels.append(None))
    assert fingerprint(tmp_path / "one") == fingerprint(tmp_path / "two")
    assert load(tmp_path / "one").values("seed") == (1, 2)
    assert len(n_levels) == 2


@pytest.mark.slow
def test_a_worker_that_is_killed_leaves_the_same_bytes(benchmark: Path, tmp_path: Path) -> None:
    """Its trial is sequential: the level that was over is played again and must be the same."""
    n_levels: list[None] = []
    disturbed = bench_of(benchmark, tmp_path / "a", repeat=2, **killing_its_worker(tmp_path))
    run_all([disturbed], ProcessExecutor(2), on_level=lambda: n_levels.append(None))
    assert (tmp_path / "immortal").exists()
    run(benchmark, tmp_path / "b", repeat=2, **killing_its_worker(tmp_path))
    assert fingerprint(tmp_path / "a") == fingerprint(tmp_path / "b")
    assert len(n_levels) == 6


@pytest.mark.slow
def test_what_kills_every_worker_is_reported_in_its_row_and_tried_again_when_resumed(
    benchmark: Path, tmp_path: Path
) -> None:
    deadly = bench_of(benchmark, tmp_path / "deadly", **mortal(tmp_path, "always"))
    good = bench_of(benchmark, tmp_path / "good", repeat=2)
    result, _ = run_all([deadly, good], ProcessExecutor(2))
    assert result.values("status") == ("ok", "algorithm error", "algorithm error")
    said = f"{ALGORITHMS}:Mortal was stopped at 0.268 s: its process ended (killed by SIGKILL)"
    assert result.reason(1, "total") == result.reason(2, "total") == said
    assert load(tmp_path / "good").values("status") == ("ok",) * 6
    (tmp_path / "immortal").touch()
    run_all([bench_of(benchmark, tmp_path / "deadly", **mortal(tmp_path, "always"))])
    run(benchmark, tmp_path / "b", **mortal(tmp_path, "always"))
    assert fingerprint(tmp_path / "deadly") == fingerprint(tmp_path / "b")


@pytest.mark.parametrize(
    "executor",
    [SerialExecutor(), pytest.param(ProcessExecutor(2), marks=pytest.mark.slow)],
    ids=["here", "processes"],
)
def test_what_is_wrong_with_one_algorithm_does_not_stop_the_other(
    benchmark: Path, tmp_path: Path, executor: executor.Executor
) -> None:
    absent = bench_of(
        benchmark, tmp_path / "absent", algorithm="tests.support.failing:NeverStarted", repeat=2
    )
    good = bench_of(benchmark, tmp_path / "good")
    with pytest.raises(NeverStarted, match="10 s of simulation time"):
        run_all([absent, good], executor)
    assert load(tmp_path / "absent").rows == ()
    assert len(load(tmp_path / "good").rows) == 3


def jobs(tmp_path: Path, *sizes: int) -> list[Job]:
    """Jobs of one benchmark with so many levels each."""
    plan = SimpleNamespace(algorithm=SimpleNamespace(name="esm"))
    bench = SimpleNamespace(n_rows=lambda trial: 0, n_lost=0, plan=plan)
    levels = [SimpleNamespace(values=(("fog", 0.5),))]
    return [
        Job(bench, SimpleNamespace(index=i, seed=0, levels=levels * size))  # type: ignore[arg-type]
        for i, size in enumerate(sizes)
    ]


def test_a_lost_unit_is_the_next_to_be_played_and_three_times_at_most(tmp_path: Path) -> None:
    queue = JobQueue(jobs(tmp_path, 1, 1))
    first = queue.pop()
    assert first is not None
    for _ in range(3):
        queue.report_loss(first, "killed by SIGSEGV")
        assert queue.pop() is first
        assert queue.failure is None
    queue.report_loss(first, "killed by SIGSEGV")
    assert str(queue.failure) == (
        "trial 0 (esm, seed 0, fog=0.5) lost its worker 4 times, the last time killed by SIGSEGV. "
        "Finished rows are kept; continue with --resume."
    )
    assert queue.pop() is None
    assert first.run.n_lost == 4


def test_a_unit_that_is_lost_twice_in_one_call_is_played_without_it(tmp_path: Path) -> None:
    queue = JobQueue(jobs(tmp_path, 1))
    first = queue.pop()
    assert first is not None
    for call in (7, None, 8):
        queue.report_loss(first, "with exit status 0", call)
        assert queue.pop() is first
        assert first.cut is None
    queue.report_loss(first, "with exit status 0", 7)
    assert queue.pop() is first
    assert first.cut == Cut(7, "its process ended (with exit status 0)")
    assert queue.failure is None


@pytest.mark.parametrize(
    ("why", "is_finished", "n_left"),
    [
        ("its process ended (killed by SIGSEGV)", True, 1),
        ("a callback took longer than --callback-limit", True, 3),
        ("a callback took longer than --callback-limit", False, 1),
    ],
)
def test_resume_tries_again_what_ended_its_process_and_leaves_what_did_not_come_back(
    benchmark: Path, tmp_path: Path, why: str, is_finished: bool, n_left: int
) -> None:
    bench = bench_of(benchmark, tmp_path / "out")
    [trial] = bench.plan.trials()
    file = Journal(bench.out, trial.index, bench.head(trial))
    broken = stored_row(missing={"total": f"esm was stopped at 0.3 s: {why}"})
    for row, values in zip((stored_row(), broken, broken), trial.values, strict=True):
        file.add(replace(row, values=values, ended_at=2.0, fingerprint=""))
    if is_finished:
        file.finish(stored_end(trace={}))
    file.close()
    bench.begin()
    assert bench.n_rows(trial) == n_left
    assert (bench.unfinished_trials() == []) == (n_left == 3)


@pytest.mark.parametrize(
    ("order", "message"),
    [
        ((0, 2), "row 1 is of the level 0.8; expected 0.4"),
        ((0, 0, 1, 2), "row 1 is of the level 0.0; expected 0.4"),
        ((1, 0, 2), "row 0 is of the level 0.4; expected 0.0"),
        ((0, 1), "2 rows; expected 3, one for each level of the trial"),
        ((0, 1, 2, 2), "4 rows; expected 3, one for each level of the trial"),
    ],
)
def test_resume_refuses_a_trial_whose_rows_are_not_its_levels(
    benchmark: Path, tmp_path: Path, order: tuple[int, ...], message: str
) -> None:
    bench = bench_of(benchmark, tmp_path / "out")
    [trial] = bench.plan.trials()
    file = Journal(bench.out, trial.index, bench.head(trial))
    for number in order:
        row = stored_row(values=list(trial.values[number]))
        file.add(replace(row, ended_at=2.0, fingerprint=""))
    file.finish(stored_end(trace={}))
    file.close()
    with pytest.raises(ResultError, match=rf"00000\.jsonl: {message}\. Remove this file: --resume"):
        bench.begin()


@pytest.mark.slow
def test_an_algorithm_that_changes_the_working_directory_takes_no_result_with_it(
    benchmark: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "elsewhere").mkdir()
    settings = [f"algorithm.where={tmp_path / 'elsewhere'}"]
    algorithm = f"{ALGORITHMS}:Wanders"
    run(benchmark, Path("out"), algorithm=algorithm, settings=settings, repeat=2)
    assert len(load(tmp_path / "out").rows) == 6
    assert list((tmp_path / "elsewhere").iterdir()) == []
    assert Path.cwd() == tmp_path


def test_every_level_is_reported_once(tmp_path: Path) -> None:
    told: list[None] = []
    queue = JobQueue(jobs(tmp_path, 3), lambda: told.append(None))
    job = queue.pop()
    assert job is not None
    queue.report_level(job)
    queue.report_loss(job, "killed by SIGKILL")  # with a second level on disk that it did not tell
    queue.report_level(job)
    queue.report_finish(job)
    assert len(told) == 3


@pytest.mark.slow
def test_a_unit_that_is_gone_when_all_are_played_is_missed_and_played_with_resume(
    benchmark: Path, tmp_path: Path
) -> None:
    whole, out = tmp_path / "whole", tmp_path / "out"
    run_all([bench_of(benchmark, whole, mode="independent")])
    first, told = out / "units" / "00000.jsonl", []

    def harm() -> None:
        told.append(None)
        if len(told) == 2:
            first.unlink()

    bench = bench_of(benchmark, out, mode="independent")
    said = r"units/00000\.jsonl: trial 0 .* its file is incomplete now\. Continue with --resume\.$"
    with pytest.raises(RunFailed, match=said):
        run_all([bench], on_level=harm)
    assert len(load(out).rows) == 2
    run_all([bench])
    assert fingerprint(out) == fingerprint(whole)


def test_an_error_that_cannot_be_pickled_is_reported_all_the_same() -> None:
    class Odd(Exception):
        def __reduce__(self) -> str:
            raise TypeError("not me")

    try:
        raise Odd("out of focus")
    except Odd as error:
        back = make_picklable(error)
    assert str(back) == "Odd: out of focus"
    assert "test_executor.py" in back.__notes__[-1]


@pytest.fixture(scope="module")
def whole_run(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, str]]:
    """Return a benchmark, and the fingerprint of its run that nothing disturbed."""
    folder = tmp_path_factory.mktemp("whole")
    benchmark = write_benchmark(folder, "2")
    command = [sys.executable, "-m", "uwsim", "bench", str(benchmark), "--mode", "independent"]
    subprocess.run([*command, "--out", str(folder / "out")], check=True, capture_output=True)
    return benchmark, fingerprint(folder / "out")


@pytest.mark.slow
@pytest.mark.parametrize("workers", ["1", "2"])
def test_a_killed_run_that_is_resumed_ends_with_the_same_bytes(
    tmp_path: Path, workers: str, whole_run: tuple[Path, dict[str, str]]
) -> None:
    benchmark, whole = whole_run
    broken = tmp_path / "broken"
    command = [sys.executable, "-m", "uwsim", "bench", str(benchmark), "--mode", "independent"]
    command += ["--workers", workers, "--out", str(broken), "--resume"]
    chance = random.Random(20261121)
    for _ in range(3):
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(chance.uniform(1.0, 4.0))
        os.kill(process.pid, signal.SIGKILL)
        process.wait()
    subprocess.run(command, check=True, capture_output=True)
    assert fingerprint(broken) == whole
