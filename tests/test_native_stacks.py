"""A test that crashes in native code leaves its native stacks, and its worker is replaced."""

from __future__ import annotations

import os
import resource
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PATTERN = Path("/proc/sys/kernel/core_pattern")
CRASH = "import ctypes\ndef test_crash(): ctypes.string_at(0)\ndef test_other(): pass\n"
ONCE = """import ctypes, pathlib
def test_crash():
    seen = pathlib.Path("seen")
    if not seen.exists():
        seen.touch()
        ctypes.string_at(0)
def test_other(): pass
"""
MOST = resource.getrlimit(resource.RLIMIT_CORE)[1]


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("gdb") is None, reason="gdb is not installed")
@pytest.mark.skipif(
    not PATTERN.exists() or PATTERN.read_text().startswith("|") or MOST == 0,
    reason="the system writes no core files",
)
def test_a_crash_leaves_the_stacks_of_all_threads(tmp_path: Path) -> None:
    began = tmp_path / "began"
    began.touch()
    script = (
        f"ulimit -c $(ulimit -H -c); exec {sys.executable} -c 'import ctypes; ctypes.string_at(0)'"
    )
    crashed = subprocess.run(["bash", "-c", script], cwd=tmp_path, capture_output=True)
    assert crashed.returncode < 0
    shown = subprocess.run(
        [ROOT / "scripts" / "native_stacks", began], check=True, capture_output=True, text=True
    ).stdout
    assert f"native stacks: {tmp_path}" in shown
    assert "SIGSEGV" in shown
    assert "Thread 1" in shown
    assert "#0 " in shown
    assert not list(tmp_path.glob("core*"))


def run_tests(folder: Path, code: str) -> subprocess.CompletedProcess[str]:
    """Run tests in a worker, with this folder as the only one."""
    (folder / "test_crash.py").write_text(code)
    plugins = ["-p", "no:cacheprovider", "-p", "tests.support.crashed_processes"]
    options = ["--numprocesses", "1", *plugins]
    command = [sys.executable, "-m", "pytest", *options, str(folder)]
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, env=environment)
    for core in folder.glob("core*"):
        core.unlink()  # or a failure elsewhere would have it reported as its own
    return done


@pytest.mark.slow
def test_a_worker_that_crashes_twice_is_replaced_and_its_python_stack_printed(
    tmp_path: Path,
) -> None:
    done = run_tests(tmp_path, CRASH)
    assert done.returncode == 1
    assert "test_crash.py::test_crash" in done.stdout
    assert "crashed while running" in done.stdout
    assert "1 failed, 1 passed, 1 rerun" in done.stdout
    assert done.stdout.count("CRASHED test_crash.py::test_crash") == 2
    assert "Segmentation fault" in done.stderr + done.stdout
    assert "in test_crash" in done.stderr + done.stdout


@pytest.mark.slow
def test_a_test_that_crashes_its_process_once_is_run_again_and_named(tmp_path: Path) -> None:
    done = run_tests(tmp_path, ONCE)
    assert done.returncode == 0
    assert "2 passed, 1 rerun" in done.stdout
    assert done.stdout.count("CRASHED test_crash.py::test_crash") == 1
    assert "Segmentation fault" in done.stderr + done.stdout
    failed = run_tests(tmp_path, CRASH.replace("ctypes.string_at(0)", "assert not 1"))
    assert "1 failed, 1 passed in" in failed.stdout  # what fails without a crash is not run again
