"""What workers bring: 40 independent levels of `currents`, played by one worker and by two.

Each run is a fresh process started from the command line, start to report; caches are warm. One
worker is measured twice: with one thread for its pictures, as each of several workers has, and as
it comes, when the software rasteriser takes what is left of the machine. The promise is about the
first: so much does a second core bring. That all runs leave the same bytes is checked on the way.

Beside it: the CPU time that a unit costs beyond its steps, once its worker has played one, with the
renderer that a worker keeps and with one made anew.
"""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Callable
from importlib import resources
from pathlib import Path
from statistics import median

from lxml import etree
from measure import main
from visibility import UWSIM, run

from uwsim.benchmark.play import RAMP, SETTLING, play
from uwsim.cli.bench import make_plan
from uwsim.simulation import Studio

TIMES = 1.8
LEVELS = 40
LENGTH = 5.0
"""Of a level [s]; before it an independent level settles."""
UNITS = 5


def write_benchmark(folder: Path, length: float) -> Path:
    """Write `currents` with 40 levels of another length."""
    bundled = Path(str(resources.files("uwsim"))) / "data" / "benchmarks" / "currents.xml"
    tree = etree.parse(bundled)
    [updater] = tree.findall("sceneUpdater/currentForceUpdater")
    for name, value in (("finalValue", 0.2), ("step", 0.2 / LEVELS), ("interval", length)):
        updater.find(name).text = repr(value)
    path = folder / f"currents-{length:g}.xml"
    tree.write(path)
    return path


def wall_s(benchmark: Path, out: str, workers: int, threads: str | None) -> float:
    """Play it from the command line; returns the wall time [s]."""
    before = os.environ.pop("LP_NUM_THREADS", None)
    if threads is not None:
        os.environ["LP_NUM_THREADS"] = threads
    try:
        command = [*UWSIM, "bench", str(benchmark), "--workers", str(workers), "--out", out]
        wall, _, _ = run([*command, "--overwrite"], str(benchmark.parent))
    finally:
        os.environ.pop("LP_NUM_THREADS", None)
        if before is not None:
            os.environ["LP_NUM_THREADS"] = before
    return wall


def beyond_its_steps(folder: Path, studio: Callable[[], Studio | None]) -> float:
    """CPU time of a unit with no steps [ms]: a line through units of two lengths."""
    lengths = (5.0, 10.0)
    costs = []
    for length in lengths:
        plan = make_plan(
            str(write_benchmark(folder, length)), scene=None, algorithm=None, seed=0, repeat=1,
            mode=None, levels=[], settings=[], compat=[], data_path=(),
        )  # fmt: skip
        lent = studio()
        cpu = []
        for unit in plan.units()[: UNITS + 1]:
            began = time.process_time()
            n_rows = sum(1 for _ in play(plan, unit, studio=lent))
            assert n_rows == 2
            cpu.append(time.process_time() - began)
        costs.append(median(cpu[1:]))
        if lent is not None:
            lent.close()
    per_second = (costs[1] - costs[0]) / (lengths[1] - lengths[0])
    return 1e3 * (costs[0] - per_second * (SETTLING + RAMP + lengths[0]))


def measure() -> dict[str, object]:
    """Measure everything; the keys name the unit."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        benchmark = write_benchmark(folder, LENGTH)
        wall_s(write_benchmark(folder, 1.0), "warm", 2, None)
        alone = wall_s(benchmark, "one-thread", 1, "1")
        as_it_comes = wall_s(benchmark, "one", 1, None)
        two = wall_s(benchmark, "two", 2, None)
        outs = ("one-thread", "one", "two")
        results = {(folder / out / "result.json").read_bytes() for out in outs}
        own = beyond_its_steps(folder, lambda: None)
        return {
            "levels": LEVELS,
            "1 worker, 1 thread: wall_s": round(alone, 2),
            "1 worker, as it comes: wall_s": round(as_it_comes, 2),
            "2 workers: wall_s": round(two, 2),
            "2 workers over 1 with 1 thread: times": {
                "value": round(alone / two, 3),
                "target": TIMES,
                "ratio": round(TIMES / (alone / two), 3),
            },
            "2 workers over 1 as it comes: times": round(as_it_comes / two, 3),
            "same bytes": len(results) == 1,
            "a unit beyond its steps: cpu_ms": round(beyond_its_steps(folder, Studio), 1),
            "the same with a renderer of its own: cpu_ms": round(own, 1),
        }


if __name__ == "__main__":
    main(measure)
