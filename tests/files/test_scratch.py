"""A temporary folder is gone with its process, however that comes to its end."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from uwsim.base.files.scratch import scratch_folder
from uwsim.errors import RunFailed

PROGRAM = """
import os, subprocess, sys, time
from uwsim.base.files.scratch import SCRATCH_VARIABLE, scratch_folder
with scratch_folder("uwsim-test-") as folder:
    (folder / "a").write_text("x")
    os.environ[SCRATCH_VARIABLE] = str(folder)
    sleeper = subprocess.Popen(["sleep", "60"], start_new_session=True)
    (folder / "b").write_text(str(sleeper.pid))
    print(folder, flush=True)
    time.sleep(60)
"""


def is_alive(process: Path) -> bool:
    try:
        return (process / "cmdline").read_bytes() != b""  # of a zombie it is empty
    except FileNotFoundError:
        return False


def test_it_is_there_while_it_is_used_and_gone_afterwards(tmp_path: Path) -> None:
    with scratch_folder("uwsim-test-", tmp_path) as folder:
        assert (folder.parent, list(folder.iterdir())) == (tmp_path, [])
        (folder / "a").mkdir()
        (folder / "a" / "b").touch()
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(ZeroDivisionError), scratch_folder("uwsim-test-", tmp_path):
        raise ZeroDivisionError
    assert list(tmp_path.iterdir()) == []


def test_where_none_can_be_made_the_run_fails_in_one_line(tmp_path: Path) -> None:
    with (
        pytest.raises(RunFailed, match=r"No temporary folder can be created: .*No such file"),
        scratch_folder("uwsim-test-", tmp_path / "nowhere"),
    ):
        pass


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGHUP, signal.SIGTERM])
def test_it_is_gone_soon_after_its_process_was_killed(tmp_path: Path, number: int) -> None:
    with subprocess.Popen(
        [sys.executable, "-c", PROGRAM],
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "TMPDIR": str(tmp_path)},
        start_new_session=True,
    ) as process:
        assert process.stdout is not None
        folder = Path(process.stdout.readline().strip())
        assert (folder / "a").exists()
        started = Path("/proc", (folder / "b").read_text())
        os.killpg(process.pid, number)
    until = time.monotonic() + 20
    while (folder.exists() or is_alive(started)) and time.monotonic() < until:
        time.sleep(0.02)
    assert list(tmp_path.iterdir()) == []
    assert not is_alive(started)
