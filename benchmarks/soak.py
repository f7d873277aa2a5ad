"""Measure the memory of 500 trials in one process.

Run ``python benchmarks/soak.py``. A level of 0.1 s of `visibility-moving`, whose scene varies with
the seed, is run for the seeds 0 to 19, then for the seeds 0 to 499, in this process, as ``uwsim
bench --workers 0`` does; once with a tracker that reads images and once with the control.

Target: after 500 trials no more than 20 MB above what the process holds after 20. One JSON on
stdout.
"""

from __future__ import annotations

import ctypes
import gc
import tempfile
from pathlib import Path

from measure import main

import uwsim

BENCHMARK = """<benchmark xmlns:u="urn:uwsim:1" u:scene="visibility-moving-scene.xml">
  <measures>
    <euclideanNorm u:value="mean">
      <name>corners</name>
      <groundTruth type="cornersFromCamera">
        <camera>bowtech1</camera> <target>blackbox</target> <publishOn>autoInit</publishOn>
      </groundTruth>
      <target>cornersTopic</target>
      <startOn><type>onInit</type></startOn> <stopOn><type>never</type></stopOn>
    </euclideanNorm>
  </measures>
  <startOn><type>service</type><target>startBench</target></startOn>
  <stopOn><type>never</type></stopOn>
  <function>corners</function>
  <sceneUpdater>
    <sceneFogUpdater>
      <initialValue>0</initialValue> <finalValue>0</finalValue> <step>1</step>
      <interval>0.1</interval>
    </sceneFogUpdater>
  </sceneUpdater>
</benchmark>
"""
N_FIRST_TRIALS, N_TRIALS = 20, 500
"""The numbers of trials before each reading of the memory."""
MAX_GROWTH = 20.0
"""The target of the growth [MB]."""


def anonymous_memory() -> float:
    """Return the anonymous memory of this process [MB]."""
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    lines = [line.split() for line in Path("/proc/self/status").read_text().splitlines()]
    return next(int(line[1]) for line in lines if line and line[0] == "RssAnon:") / 1024.0


def measure() -> dict[str, object]:
    """Run the trials of both algorithms."""
    figures: dict[str, object] = {"trials": [N_FIRST_TRIALS, N_TRIALS]}
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "soak.xml"
        file.write_text(BENCHMARK)
        for algorithm in ("frozen", "esm"):
            memory_mb = []
            for n in (N_FIRST_TRIALS, N_TRIALS):
                uwsim.bench(file, algorithm=algorithm, seeds=range(n))
                memory_mb.append(anonymous_memory())
            growth = memory_mb[1] - memory_mb[0]
            figures[algorithm] = {
                "held_mb": [round(megabytes, 1) for megabytes in memory_mb],
                "growth_mb": round(growth, 1),
                "ratio": round(growth / MAX_GROWTH, 2),
            }
    return figures


if __name__ == "__main__":
    main(measure)
