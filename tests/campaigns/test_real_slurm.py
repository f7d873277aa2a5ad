"""A campaign on the daemons of Slurm itself, two of whose tasks are killed and queued again."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.support.blind_benchmark import write_blind_benchmark
from tests.support.short_benchmark import fingerprint
from tests.support.slurm_cluster import ask, missing_part, slurm_cluster
from uwsim.cli.app import main

BENCH = ["bench", "blind.xml", "--mode", "independent"]
N_TASKS = 20
N_KILLED = 2
MAX_WAIT = 500.0
"""The longest wait for the cluster [s]."""


@pytest.mark.slow
@pytest.mark.timeout(600)
@pytest.mark.skipif(missing_part() is not None, reason=f"no Slurm here: {missing_part()}")
def test_tasks_that_slurm_kills_and_queues_again_leave_the_bytes_of_one_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    write_blind_benchmark(tmp_path, levels=N_TASKS)
    out = tmp_path / "x.result"
    (tmp_path / "bin").mkdir()
    program = tmp_path / "bin" / "uwsim"
    program.write_text(f'#!/bin/bash\nexec "{sys.executable}" -m uwsim "$@"\n')
    program.chmod(0o755)
    options = ["--tasks", str(N_TASKS), "--memory", "500M", "--setup", f"PATH={tmp_path}/bin:$PATH"]
    assert main(["slurm", *options, "--", *BENCH, "--out", str(out)]) == 0
    script = capsys.readouterr().out
    with slurm_cluster(tmp_path / "cluster") as environment:
        done = subprocess.run(
            ["bash"], input=script, env=environment, capture_output=True, text=True, check=True
        )
        killed: set[str] = set()
        end = time.monotonic() + MAX_WAIT
        while jobs := ask(environment, "squeue", "--noheader", "--format=%i %T").splitlines():
            assert time.monotonic() < end, jobs
            for job in jobs:
                name, state = job.split()
                if state == "RUNNING" and "_" in name and len(killed) < N_KILLED:
                    subprocess.run(["scontrol", "requeue", name], env=environment, check=True)
                    killed.add(name)
            time.sleep(0.3)
    assert done.stdout.startswith("array ")
    assert len(killed) == N_KILLED
    output = {path.name: path.read_text() for path in Path(f"{out}.slurm").iterdir()}
    assert len(output) == N_TASKS + 1
    assert "written: " in output["merge.log"], output["merge.log"]
    assert main([*BENCH, "--out", "whole"]) == 0
    assert fingerprint(out) == fingerprint(tmp_path / "whole")
