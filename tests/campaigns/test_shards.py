"""Shards of a campaign, killed and run again, leave the bytes of a run on one machine."""

from __future__ import annotations

import os
import signal
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.support.short_benchmark import fingerprint, write_benchmark
from tests.support.short_trial import make_plan
from uwsim.algorithms import load_algorithm
from uwsim.campaigns.merge import Campaign, merge
from uwsim.campaigns.shard import Shard, drop_shard, read_shard, shared_directory
from uwsim.cli.app import main
from uwsim.errors import BadSetting, ResultError
from uwsim.results.inputs import Inputs
from uwsim.runs.executors.executor import run_all, run_each
from uwsim.runs.planning.plan import AlgorithmUnderTest, Plan
from uwsim.runs.prepare import prepare_run
from uwsim.runs.run import Run

N_SHARDS = 200
LEVELS = "<repeat> <iterations>100</iterations> <interval>0.01</interval> </repeat>"


def campaign_run(folder: Path, out: Path) -> Run:
    """Return a run of 200 short trials: 100 levels, two seeds."""
    return prepare_run(campaign_plan(folder), out)


def campaign_plan(folder: Path) -> Plan:
    algorithm = load_algorithm("nothing")
    plan = make_plan(folder, algorithm, LEVELS, mode="independent")
    return replace(
        plan, repeats=2, seed=7, algorithm=AlgorithmUnderTest(cls=algorithm, name="nothing")
    )


@pytest.mark.slow
def test_killed_shards_that_are_run_again_leave_the_bytes_of_one_run(tmp_path: Path) -> None:
    whole = campaign_run(tmp_path, tmp_path / "whole")
    run_all([whole])
    shared = replace(whole, out=tmp_path / "shared")
    random = np.random.default_rng(3)
    killed = set(random.choice(np.arange(1, N_SHARDS + 1), N_SHARDS // 10, replace=False).tolist())
    for number in range(1, N_SHARDS + 1):
        kill_after = 1 if number in killed else None
        status = run_in_child(shared, Shard(number=number, count=N_SHARDS), kill_after)
        assert (os.WTERMSIG(status) == signal.SIGKILL) == (number in killed)
    campaign = Campaign(directory=shared.out, runs=(shared,))
    unfinished = shared.unfinished_trials()
    assert len(unfinished) == len(killed)
    with pytest.raises(ResultError, match=f"{len(unfinished)} of 200 of nothing"):
        merge(campaign)
    assert not (shared.out / "result.json").exists()
    for number in sorted(killed):
        assert run_in_child(shared, Shard(number=number, count=N_SHARDS), None) == 0
    merge(campaign)
    assert fingerprint(shared.out) == fingerprint(whole.out)


def run_in_child(run: Run, shard: Shard, kill_after: int | None) -> int:
    """Run a shard in a forked process, killed after some levels; return its wait status."""
    process = os.fork()
    if process == 0:
        n_levels = 0

        def kill() -> None:
            nonlocal n_levels
            n_levels += 1
            if n_levels == kill_after:
                os.kill(os.getpid(), signal.SIGKILL)

        with shared_directory(run.out, ()):
            outcome = run_each(shard.choose([run]), on_level=kill)
        os._exit(len(outcome.failures))
    return os.waitpid(process, 0)[1]


@pytest.mark.parametrize("count", [1, 2, 7, 41, 401])
def test_each_trial_is_in_one_shard_and_shards_have_equal_sizes(tmp_path: Path, count: int) -> None:
    run = Run(plan=campaign_plan(tmp_path), out=tmp_path, inputs=Inputs(), renderer="none")
    shards = [Shard(number=i, count=count).choose([run, run]) for i in range(1, count + 1)]
    sizes = [sum(len(part.trials()) for part in runs) for runs in shards]
    assert sum(sizes) == 400
    assert max(sizes) - min(sizes) <= 1
    for i in range(2):
        indices = sorted(trial.index for runs in shards for trial in runs[i].trials())
        assert indices == list(range(200))


@pytest.mark.parametrize("text", ["", "3", "0/3", "4/3", "1/0", "-1/3", "1/3/5", "1.0/3", "a/b"])
def test_a_text_that_is_no_shard_is_refused(text: str) -> None:
    with pytest.raises(BadSetting, match="expected NUMBER/COUNT from 1/COUNT on, such as 3/10"):
        read_shard(text)


def test_a_shard_is_read_and_dropped_from_a_command() -> None:
    assert read_shard("3/10") == Shard(number=3, count=10)
    words = ["bench", "a.xml", "--shard", "3/10", "--out", "d"]
    assert drop_shard(words) == ["bench", "a.xml", "--out", "d"]
    assert drop_shard(["bench", "--shard=3/10", "a.xml"]) == ["bench", "a.xml"]


@pytest.mark.parametrize("option", [["--client", "mine"], ["--ardupilot"], ["--resume"]])
def test_options_that_shards_exclude_are_refused(
    option: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    command = ["bench", "visibility", "--shard", "1/2", "--out", str(tmp_path / "out")]
    assert main([*command, *option]) == 2
    assert "--shard" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_two_shards_of_two_algorithms_with_a_control_run_are_merged(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    write_benchmark(tmp_path, "0.1")
    command = ["bench", "short.xml", "--algorithm", "esm", "--algorithm", "ic"]
    command += ["--mode", "independent", "--level", "fog=0", "--level", "fog=0.4"]
    assert main([*command, "--out", "whole"]) == 0
    assert main([*command, "--out", "shared", "--shard", "1/2"]) == 0
    capsys.readouterr()
    assert main([*command, "--seed", "5", "--out", "shared", "--shard", "2/2"]) == 2
    assert "seed is 5 now, was 0" in capsys.readouterr().err
    assert main(["merge", "shared"]) == 2
    error = capsys.readouterr().err
    assert "trials are not finished" in error
    assert "--level fog=0.4 --out shared --resume" in error
    assert "--shard" not in error
    assert main([*command, "--out", "shared", "--shard", "2/2"]) == 0
    assert main([*command, "--out", "shared", "--shard", "2/2", "--resume"]) == 2
    assert main(["merge", "shared", "--no-report"]) == 0
    assert fingerprint(tmp_path / "shared") == fingerprint(tmp_path / "whole")
    assert (tmp_path / "shared" / "esm" / "control" / "result.json").exists()
    assert main([*command, "--seed", "5", "--out", "shared", "--shard", "1/2"]) == 2
    assert "seed is 5 now, was 0" in capsys.readouterr().err


@pytest.mark.slow
def test_a_merge_of_rows_that_all_failed_ends_with_3_as_the_run_would(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    write_benchmark(tmp_path, "0.1")
    command = ["bench", "short.xml", "--algorithm", "tests.support.failing:RaisedError"]
    main([*command, "--out", "shared", "--shard", "1/1"])
    capsys.readouterr()
    assert main(["merge", "shared", "--no-report"]) == 3
    assert "Every row ended in 'algorithm error'" in capsys.readouterr().err
    assert (tmp_path / "shared" / "result.json").exists()
