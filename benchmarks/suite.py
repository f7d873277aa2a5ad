"""The short form of the suite: one seed and the middle level of each task, for all its algorithms.

Run ``python benchmarks/suite.py``. It is the command ``uwsim suite table intervention --short``
with two worker processes, with its start, in wall time; and its CPU time.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from measure import main, upper_target_figure

SHORT_S = 300.0
WORKERS = 2


def measure() -> dict[str, object]:
    """Measure the target."""
    with tempfile.TemporaryDirectory() as name:
        words = ["suite", "table", "intervention", "--short", "--workers", str(WORKERS)]
        start, cpu_start = time.perf_counter(), os.times()
        subprocess.run(
            [sys.executable, "-m", "uwsim", *words, "--out", name],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        seconds, cpu_end = time.perf_counter() - start, os.times()
        submissions = [json.loads(path.read_text()) for path in Path(name).glob("*/*.json")]
    cpu_s = sum(cpu_end[2:4]) - sum(cpu_start[2:4])
    tasks = [task for submission in submissions for task in submission["tasks"].values()]
    return {
        "short form of the suite, two workers [s]": {
            **upper_target_figure(seconds, SHORT_S),
            "cpu_s": round(cpu_s, 1),
            "trials": sum(task["n_trials"] for task in tasks),
            "tasks": len({name for submission in submissions for name in submission["tasks"]}),
        }
    }


if __name__ == "__main__":
    main(measure)
