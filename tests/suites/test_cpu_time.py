"""The CPU time of an entry includes that of workers that are children of a living child."""

from __future__ import annotations

import subprocess
import sys

from uwsim.suites.campaign import _cpu_time, cpu_time_text

NESTED = (
    "import subprocess, sys; "
    "subprocess.run([sys.executable, '-c', 'sum(range(10**7))'], check=True); "
    "print('done', flush=True); sys.stdin.read()"
)


def test_the_time_of_an_ended_child_of_a_living_child_counts() -> None:
    before = _cpu_time()
    child = subprocess.Popen(
        [sys.executable, "-c", NESTED], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    assert child.stdout is not None
    assert child.stdout.readline() == "done\n"
    assert _cpu_time() - before > 0.1
    child.communicate("")
    assert child.returncode == 0


def test_a_time_is_written_in_a_readable_unit() -> None:
    assert [cpu_time_text(t) for t in (0.4, 42.0, 450.0, 11160.0)] == [
        "0 s",
        "42 s",
        "7.5 min",
        "3.1 h",
    ]
