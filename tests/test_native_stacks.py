"""A test that crashes in native code leaves its native stacks, and its worker is replaced."""

from __future__ import annotations

import resource
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PATTERN = Path("/proc/sys/kernel/core_pattern")
CRASH = "import ctypes\ndef test_crash(): ctypes.string_at(0)\ndef test_other(): pass\n"
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


@pytest.mark.slow
def test_a_worker_that_crashes_is_replaced_and_its_python_stack_printed(tmp_path: Path) -> None:
    (tmp_path / "test_crash.py").write_text(CRASH)
    command = [sys.executable, "-m", "pytest", "--numprocesses", "1", "-p", "no:cacheprovider"]
    done = subprocess.run([*command, str(tmp_path)], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 1
    assert "test_crash.py::test_crash" in done.stdout
    assert "crashed while running" in done.stdout
    assert "1 failed, 1 passed" in done.stdout
    assert "Segmentation fault" in done.stderr + done.stdout
    assert "in test_crash" in done.stderr + done.stdout
    for core in tmp_path.glob("core*"):
        core.unlink()  # or a failure elsewhere would have it reported as its own
