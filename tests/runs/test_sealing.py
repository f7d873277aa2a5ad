"""While an algorithm runs that is not of uwsim, nothing on disk tells it the truth."""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar

import pytest

from tests.support.cheat_trials import FirstQuadTracker, bench_of
from tests.support.short_benchmark import write_benchmark
from uwsim.results.motion import load_track
from uwsim.results.seal import PR_SET_DUMPABLE, deny_access_to_memory
from uwsim.runs.executors.executor import run_each
from uwsim.runs.run import Run
from uwsim.runs.sealing import is_foreign

IS_DUMPABLE = 3
"""Number of a request to prctl."""


class Looks(FirstQuadTracker):
    """Notes what is on disk of the level before, and whether its process may be looked into."""

    folder = Path()
    seen: ClassVar[list[bytes]] = []
    dumpable: ClassVar[list[int]] = []

    def cheat(self) -> None:
        super().cheat()
        self.dumpable.append(ctypes.CDLL(None).prctl(IS_DUMPABLE, 0, 0, 0, 0))
        files = [path for path in self.folder.rglob("*") if path.is_file()]
        self.seen.append(b"\n".join(path.read_bytes() for path in files))


@pytest.fixture(autouse=True)
def _denies_access(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Runs deny access to the memory of this process, as outside of the tests."""
    for module in ("uwsim.runs.sealing", "uwsim.runs.executors.executor"):
        monkeypatch.setattr(f"{module}.deny_access_to_memory", deny_access_to_memory)
    yield
    ctypes.CDLL(None).prctl(PR_SET_DUMPABLE, 1, 0, 0, 0)


def played(tmp_path: Path) -> Run:
    run = bench_of(tmp_path, Looks, seed=3, length=0.2)
    Looks.folder, Looks.seen, Looks.dumpable = run.out, [], []
    run_each([run])
    return run


def test_rows_are_sealed_until_the_run_has_ended(tmp_path: Path) -> None:
    run = played(tmp_path)
    assert is_foreign(run.plan)
    during = b"".join(Looks.seen)
    assert b'"sealed"' in during
    assert b'"row"' not in during
    rows = run.read_trial(run.plan.trials()[0])
    assert len(rows.rows) == 2
    assert rows.end is not None
    assert load_track(run.out / "units" / "00000.motion").n_frames > 5
    assert set(Looks.dumpable) == {0}


def test_without_the_seal_rows_would_be_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("uwsim.runs.sealing.is_foreign", lambda plan: False)
    run = played(tmp_path)
    assert b'"row"' in b"".join(Looks.seen)
    assert len(run.read_trial(run.plan.trials()[0]).rows) == 2


def test_a_failed_run_leaves_its_rows_open(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run = bench_of(tmp_path, Looks, seed=3, length=0.2)
    Looks.folder, Looks.seen, Looks.dumpable = run.out, [], []

    def interrupted(*arguments: Any) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("uwsim.runs.executors.executor._check_journals", interrupted)
    with pytest.raises(KeyboardInterrupt):
        run_each([run])
    assert b'"row"' in (run.out / "units" / "00000.jsonl").read_bytes()


def test_a_bundled_algorithm_is_not_foreign_and_a_program_outside_is(tmp_path: Path) -> None:
    from uwsim.algorithms import load_algorithm
    from uwsim.middleware.connection import ConnectionSpec
    from uwsim.middleware.lockstep.spec import ClientSpec

    plan = bench_of(tmp_path, Looks, seed=3, length=0.2).plan
    bundled = replace(plan, algorithm=replace(plan.algorithm, cls=load_algorithm("esm")))
    client = ClientSpec(name="a", connection=ConnectionSpec(ros1=True))
    outside = replace(bundled, algorithm=replace(bundled.algorithm, client=client))
    assert [is_foreign(each) for each in (plan, bundled, outside)] == [True, False, True]


SPY = """
import os
from uwsim.bus import Node
from uwsim.messages import Empty, Float32MultiArray, GTpublish, GTpublishResponse, Image, floats

class Spy:
    def start(self, node: Node) -> None:
        self.node, self.started = node, False
        self.say = node.publisher("cornersTopic", Float32MultiArray)
        self.quad = [0.0] * 8
        node.serve("autoInit", GTpublish, self.told)
        node.subscribe("/uwsim/camera1", Image, self.on_image)

    def told(self, request: GTpublish) -> GTpublishResponse:
        self.quad = request.groundTruth
        return GTpublishResponse()

    def on_image(self, image: Image) -> None:
        if not self.started:
            self.started = True
            self.node.call("startBench", Empty())
            floats([1e300])  # beyond the type
        self.say(floats(self.quad))
        with open("seen.txt", "a") as seen:
            for folder, _, files in os.walk("spied"):
                seen.writelines(f"{folder}/{name} {os.environ.get('UWSIM_WEB_TOKEN')}\\n"
                                for name in files)

ALGORITHMS = {"spy": Spy}
"""


@pytest.mark.slow
def test_the_control_runs_after_an_algorithm_of_ones_own(tmp_path: Path) -> None:
    benchmark = write_benchmark(tmp_path, "0.5")
    (tmp_path / "spy.py").write_text(SPY)
    words = ["bench", str(benchmark), "--plugin", "spy.py", "--algorithm", "spy", "--out", "spied"]
    environment = {**os.environ, "UWSIM_WEB_TOKEN": "opensesame"}
    command = [sys.executable, "-m", "uwsim", *words]
    done = subprocess.run(command, cwd=tmp_path, check=True, capture_output=True, env=environment)
    assert b"RuntimeWarning" not in done.stderr
    seen = (tmp_path / "seen.txt").read_text()
    assert "spied/units/" in seen
    assert "control" not in seen
    assert "measure" not in seen
    assert "opensesame" not in seen
    assert (tmp_path / "spied" / "control" / "result.json").is_file()
