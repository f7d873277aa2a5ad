"""A start without cameras: CPU time and memory of a fresh process, stage by stage.

Run ``python benchmarks/start.py``. The scene is the flat floor of `steps.py`: a Girona 500 with its
arm above a box from an OBJ file, with physics, and no camera. ``floor`` is what numpy, MuJoCo and
numba cost alone: their imports, and one compiled function on an array that is read from its cache.
Caches are warm: each process runs once before it counts. Memory is resident, anonymous pages apart:
the others are of libraries, which processes share.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median

from measure import main
from steps import write_scene

CPU_S = 1.0
MEMORY_MB = 190.0
RUNS = 7
MARKS = """
import json, sys, time
found, before = {}, [0.0]
def mark(name):
    spent = time.process_time()
    lines = [line.split() for line in open("/proc/self/status")]
    kb = {line[0]: int(line[1]) for line in lines if line[0] in ("VmRSS:", "RssAnon:")}
    found[name] = {"cpu_s": spent - before[0], "memory_mb": kb["VmRSS:"] / 1024.0,
                   "anonymous_mb": kb["RssAnon:"] / 1024.0}
    before[0] = time.process_time()
mark("python")
"""
START = f"""{MARKS}
import uwsim
from uwsim.scene.reader import read_scene
mark("import uwsim, reader of scenes")
scene = read_scene(sys.argv[1])
mark("read the scene")
uwsim.Simulation
mark("import the simulation")
simulation = uwsim.load(scene)
mark("bind and compile the scene")
simulation.advance(0.002)
mark("first step")
print(json.dumps(found))
"""
FLOOR = f"""{MARKS}
import numpy
mark("numpy")
import mujoco
mark("mujoco")
import numba
mark("numba")
sys.path.insert(0, sys.argv[1])
import twice
twice.twice(numpy.ones(3))
mark("a compiled function")
print(json.dumps(found))
"""
COMPILED_MODULE = """
import numba
import numpy as np
from numba.core.caching import FunctionCache
from numba.core.runtime.nrt import rtsys

def load(self, sig, context):
    rtsys.initialize(context)
    return self._load_overload(sig, context)

FunctionCache.load_overload = load  # as uwsim does: without the tables for compiling

@numba.njit(cache=True)
def twice(x):
    found = np.empty(len(x))
    for i in range(len(x)):
        found[i] = 2.0 * x[i]
    return found
"""
Stages = dict[str, dict[str, float]]


def measure_stages(code: str, argument: Path) -> Stages:
    """Measure the median cost of each stage over fresh processes, and the memory at its end."""
    command = [sys.executable, "-c", code, str(argument)]
    runs: list[Stages] = []
    for _ in range(RUNS + 1):
        process = subprocess.run(command, stdout=subprocess.PIPE, check=True)
        runs.append(json.loads(process.stdout))
    return {
        stage: {name: round(median(run[stage][name] for run in runs[1:]), 3) for name in figures}
        for stage, figures in runs[0].items()
    }


def total(stages: Stages) -> dict[str, float]:
    """Return the CPU time of all stages, and the memory at the end of the last."""
    last_stage = list(stages.values())[-1]
    return {**last_stage, "cpu_s": round(sum(stage["cpu_s"] for stage in stages.values()), 3)}


def measure() -> dict[str, object]:
    """Measure the start and its floor."""
    with tempfile.TemporaryDirectory() as folder:
        start = measure_stages(START, write_scene("flat floor", Path(folder)))
        (Path(folder) / "twice.py").write_text(COMPILED_MODULE)
        floor = measure_stages(FLOOR, Path(folder))
    total_figures = total(start)
    return {
        "start": {
            **total_figures,
            "target_cpu_s": CPU_S,
            "target_memory_mb": MEMORY_MB,
            "cpu_ratio": round(total_figures["cpu_s"] / CPU_S, 3),
            "memory_ratio": round(total_figures["memory_mb"] / MEMORY_MB, 3),
        },
        "floor": total(floor),
        "stages": start,
        "stages of the floor": floor,
    }


if __name__ == "__main__":
    main(measure)
