"""The workers of a sealed run cannot be looked into at any time, replaced ones neither."""

from __future__ import annotations

import ctypes
import multiprocessing
import os
import signal
import sys
from multiprocessing.connection import Connection
from pathlib import Path

import pytest

from tests.support.cheat_trials import FOLDER, FirstQuadTracker, bench_of
from uwsim.base.environment import set_environment
from uwsim.errors import RunFailed
from uwsim.runs.executors.executor import run_each
from uwsim.runs.executors.processes import ProcessExecutor
from uwsim.runs.executors.protected_forks import ProtectedForks, parent_of

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="prctl is Linux's")
IS_DUMPABLE = 3
"""Number of a request to prctl."""


def tell(pipe: Connection) -> None:
    """Say whether this process may be looked into, and its environment."""
    modules = sorted(name for name in sys.modules if name in ("numpy", "numba"))
    is_dumpable = ctypes.CDLL(None).prctl(IS_DUMPABLE, 0, 0, 0, 0)
    pipe.send((is_dumpable, os.environ.get("UWSIM_TEST_SETTING"), modules))


def test_a_worker_is_closed_before_it_runs_anything() -> None:
    forks = ProtectedForks()
    ours, theirs = multiprocessing.get_context("forkserver").Pipe()
    process = forks.make(tell, (theirs,), {"UWSIM_TEST_SETTING": "1"})
    forks.start(process)
    assert ours.poll(60)
    is_dumpable, setting, _ = ours.recv()
    process.join()
    assert (is_dumpable, setting) == (0, "1")


def test_a_worker_has_the_environment_of_now(monkeypatch: pytest.MonkeyPatch) -> None:
    forks = ProtectedForks()
    for value in ("before", "after"):
        monkeypatch.setenv("UWSIM_TEST_SETTING", value)
        ours, theirs = multiprocessing.get_context("forkserver").Pipe()
        process = forks.make(tell, (theirs,), {"UWSIM_TEST_SETTING": "default"})
        forks.start(process)
        assert ours.poll(60)
        assert ours.recv()[1] == value
        process.join()


@pytest.mark.parametrize("is_noticed", [True, False])
def test_no_other_process_takes_the_place_of_the_one_that_starts_workers(is_noticed: bool) -> None:
    forks = ProtectedForks()
    ours, theirs = multiprocessing.get_context("forkserver").Pipe()
    first = forks.make(tell, (theirs,), {})
    forks.start(first)
    server = parent_of(first.pid)
    assert server not in (None, os.getpid())
    assert ours.poll(60)
    first.join()
    os.kill(server, signal.SIGKILL)
    if is_noticed:  # else a request to the process that ends just now fails
        os.waitid(os.P_PID, server, os.WEXITED | os.WNOWAIT)
    waits = forks.make(wait_for, (theirs,), {})
    with pytest.raises(RunFailed, match="The process that starts the workers of this run has"):
        forks.start(waits)
    assert not waits.is_alive()


def wait_for(pipe: Connection) -> None:
    """Live until the other end speaks."""
    pipe.poll(60)


class KillsItsWorker(FirstQuadTracker):
    """Kills the process that runs its trial, once; notes by whom the next one was started."""

    def cheat(self) -> None:
        super().cheat()
        folder = Path(os.environ[FOLDER])
        (folder / f"parent-{os.getpid()}").write_text(str(os.getppid()))
        if not (folder / "killed").exists():
            (folder / "killed").touch()
            os.kill(os.getpid(), signal.SIGKILL)


def test_a_lost_worker_of_a_sealed_run_is_replaced_by_a_closed_one(tmp_path: Path) -> None:
    run = bench_of(tmp_path, KillsItsWorker, seed=3, length=0.2)
    with set_environment({FOLDER: str(tmp_path)}):
        outcome = run_each([run], ProcessExecutor(1))
    assert outcome.failures == ()
    assert len(outcome.results[0].rows) == 2
    parents = [path.read_text() for path in tmp_path.glob("parent-*")]
    assert len(parents) == 2
    assert len(set(parents)) == 1
    assert str(os.getpid()) not in parents
