"""The process beside a run does what it is asked, says what it cannot, and never outlives it."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

import pytest
from synthetic_results import one_level

from uwsim.benchmark.beside import Beside
from uwsim.benchmark.result_file import save
from uwsim.errors import RunFailed


def test_draws_a_report(tmp_path: Path) -> None:
    save(one_level(), tmp_path)
    with Beside() as beside:
        beside.ask(tmp_path)
        beside.wait()
    assert "<html" in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_says_what_it_cannot_do_and_goes_on(tmp_path: Path) -> None:
    save(one_level(), tmp_path / "good")
    with Beside() as beside:
        beside.ask(tmp_path / "nowhere")
        beside.ask(tmp_path / "good")
        with pytest.raises(RunFailed, match="no result here"):
            beside.wait()
        beside.wait()
    assert (tmp_path / "good" / "report.html").exists()


def test_a_report_that_cannot_be_written_is_one_line_and_no_death(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    save(one_level(), tmp_path)
    (tmp_path / "report.html").mkdir()
    with Beside() as beside:
        for _ in range(2):
            beside.ask(tmp_path)
            with pytest.raises(RunFailed, match=r"^The report failed: .*Finished rows are kept"):
                beside.wait()
    assert "Traceback" not in capfd.readouterr().err


def test_ends_with_the_block() -> None:
    with Beside() as beside:
        process = beside._process
        assert process.is_alive()
    assert not process.is_alive()


def ask_and_wait(beside: Beside) -> None:
    beside.ask(Path("anything"))
    beside.wait()


def test_says_that_it_died() -> None:
    with Beside() as beside:
        beside._process.kill()
        beside._process.join()
        with pytest.raises(RunFailed, match="died"):
            ask_and_wait(beside)


PARENT = """
import time
from uwsim.benchmark.beside import Beside
with Beside() as beside:
    print(beside._process.pid, flush=True)
    time.sleep(60)
"""


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
