"""The background process of a run does what it is asked, says what it cannot, and never outlives
it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.support.short_benchmark import bench_of, fingerprint, run, write_benchmark
from tests.support.synthetic_results import one_level_result
from uwsim.analysis.load_reporter import load_reporter
from uwsim.errors import RunFailed
from uwsim.results import journal
from uwsim.results.result_file import save
from uwsim.runs.executors.background import BackgroundProcess


def test_draws_reports_and_says_in_a_line_what_it_cannot_do_and_goes_on(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    for name in ("blocked", "good"):
        save(one_level_result(), tmp_path / name)
    (tmp_path / "blocked" / "report.html").mkdir()
    with BackgroundProcess(load_reporter) as background:
        for name in ("nowhere", "blocked", "good"):
            background.submit(tmp_path / name)
        with pytest.raises(RunFailed, match="no result here"):
            background.wait()
        with pytest.raises(RunFailed, match=r"^The report failed: .*Finished rows are kept"):
            background.wait()
        background.wait()
    assert "<html" in (tmp_path / "good" / "report.html").read_text(encoding="utf-8")
    assert "Traceback" not in capfd.readouterr().err


LOADED = """
import sys
from uwsim.analysis.load_reporter import load_reporter
from uwsim.runs.executors import background
load_reporter()
print(*sorted({"cv2", "mujoco", "numba", "uwsim.simulation"} & set(sys.modules)))
"""


def test_a_process_that_draws_reports_loads_no_simulation() -> None:
    command = [sys.executable, "-c", LOADED]
    loaded = subprocess.run(command, capture_output=True, text=True, check=True)
    assert loaded.stdout.split() == []


def test_ends_with_the_block() -> None:
    with BackgroundProcess(load_reporter) as background:
        process = background._process
        assert process.is_alive()
    assert not process.is_alive()


@pytest.mark.slow
def test_what_it_was_asked_is_done_here_if_it_dies(tmp_path: Path) -> None:
    for name in ("before", "after"):
        save(one_level_result(), tmp_path / name)
    with BackgroundProcess(load_reporter) as background:
        os.kill(background._process.pid or 0, signal.SIGSTOP)  # asked, and never answers
        background.submit(tmp_path / "before")
        background._process.kill()
        background._process.join()
        background.submit(tmp_path / "after")
        background.submit(tmp_path / "nowhere")
        background.wait()
        assert not (tmp_path / "after" / "report.html").exists()
        background.wait()
        with pytest.raises(RunFailed, match="no result here"):
            background.wait()
    assert all((tmp_path / name / "report.html").is_file() for name in ("before", "after"))


@pytest.mark.slow
def test_a_control_whose_process_died_on_the_way_has_the_same_bytes(tmp_path: Path) -> None:
    benchmark = write_benchmark(tmp_path, "0.2")
    run(benchmark, tmp_path / "whole", algorithm="frozen")
    bench = bench_of(benchmark, tmp_path / "out", algorithm="frozen")
    with BackgroundProcess(load_reporter) as background:
        background.submit(bench)
        file = journal.path_of(bench.out, 0)
        while not file.exists() or len(file.read_text().splitlines()) < 2:
            time.sleep(0.01)
        background._process.kill()
        background.wait()
    assert fingerprint(tmp_path / "out") == fingerprint(tmp_path / "whole")


PARENT = """
import time
from uwsim.analysis.load_reporter import load_reporter
from uwsim.runs.executors.background import BackgroundProcess
with BackgroundProcess(load_reporter) as background:
    print(background._process.pid, flush=True)
    time.sleep(60)
"""


@pytest.mark.slow
def test_does_not_outlive_a_parent_that_was_killed() -> None:
    parent = subprocess.Popen([sys.executable, "-c", PARENT], stdout=subprocess.PIPE, text=True)
    assert parent.stdout is not None
    child = int(parent.stdout.readline())
    parent.stdout.close()
    assert _is_running(child)
    parent.kill()
    parent.wait()
    for _ in range(100):
        if not _is_running(child):
            break
        time.sleep(0.1)
    assert not _is_running(child)


def _is_running(pid: int) -> bool:
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state not in "ZX"
