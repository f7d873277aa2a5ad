"""Long runs in one process keep their memory."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

N_TRIALS, N_FIRST = 120, 30
MAX_GROWTH = 8.0
"""From the first trials to the last; 500 trials may take 20 MB, and most of it at once [MB]."""
SOAK = """
import ctypes, gc, sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
from tests.support.short_benchmark import bench_of
from uwsim.runs.executors.executor import Job, run_and_record
from uwsim.runs.planning.trial_cache import TrialCache
from uwsim.simulation import Calls

folder, n_trials, n_first = Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])

def memory():
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    lines = [line.split() for line in open("/proc/self/status")]
    return next(int(line[1]) for line in lines if line[0] == "RssAnon:") / 1024.0

run = bench_of(folder / "soak.xml", folder / "out", algorithm="frozen", repeat=n_trials)
cache = TrialCache()
for i, trial in enumerate(run.begin(), 1):
    for _ in run_and_record(Job(run, trial), cache, Calls()):
        pass
    if i in (n_first, n_trials):
        print(memory(), flush=True)
"""


@pytest.mark.slow
def test_a_hundred_trials_of_a_scene_that_varies_take_no_more_memory(tmp_path: Path) -> None:
    from tests.support.short_benchmark import BENCHMARK

    text = BENCHMARK.replace("visibility-scene.xml", "visibility-moving-scene.xml")
    text = text.replace("<finalValue>1.0</finalValue>", "<finalValue>0.0</finalValue>")
    (tmp_path / "soak.xml").write_text(text.replace("LENGTH", "0.1"))
    root = Path(__file__).parents[2]
    command = [sys.executable, "-c", SOAK, str(root), str(tmp_path), str(N_TRIALS), str(N_FIRST)]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    first, last = (float(line) for line in done.stdout.split()[-2:])
    assert last - first < MAX_GROWTH
