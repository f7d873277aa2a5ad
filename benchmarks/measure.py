"""The common parts of benchmarks: hardware, load, repeated timing, and JSON on standard output.

A benchmark calls `main` with a function that measures and returns its figures. `milliseconds`
measures CPU time of all threads of the process, which varies far less than wall time on a shared
machine. Above a load of 1.5 benchmarks measure only with ``--anyway`` (or ``--force``), and the
JSON records that.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import sys
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from statistics import median

MAX_LOAD = 1.5


def main(measure: Callable[[], Mapping[str, object]]) -> None:
    """Measure and print, as a command; exit status 2 if the machine is busy."""
    parser = argparse.ArgumentParser(description="One JSON with figures, hardware and load.")
    parser.add_argument(
        "--anyway", "--force", action="store_true", help="measure although the machine is busy"
    )
    parser.add_argument("--out", type=Path, help="write the JSON to this file, too")
    arguments = parser.parse_args()
    load_before = os.getloadavg()[0]
    if load_before > MAX_LOAD and not arguments.anyway:
        print(
            f"The load is {load_before:.2f}, above {MAX_LOAD}: figures would be meaningless. "
            "Wait, or measure anyway with --anyway.",
            file=sys.stderr,
        )
        raise SystemExit(2)
    figures = measure()
    load = {"before": load_before, "after": os.getloadavg()[0], "measured_anyway": arguments.anyway}
    facts = {"benchmark": Path(sys.argv[0]).stem, "hardware": hardware(), "load": load}
    text = json.dumps({**facts, "figures": figures}, indent=2)
    print(text)
    if arguments.out is not None:
        arguments.out.write_text(text + "\n", encoding="utf-8")


def milliseconds(
    call: Callable[[], object],
    *,
    target: float | None = None,
    calls: int = 30,
    batches: int = 9,
) -> dict[str, object]:
    """Time a call: median over batches of the CPU milliseconds of one call.

    A first call warms up. ``ratio`` is the median over the target; up to 1 meets the target.
    """
    call()
    cpu, wall = [], []
    for _ in range(batches):
        cpu_start, wall_start = time.process_time(), time.perf_counter()
        for _ in range(calls):
            call()
        cpu.append((time.process_time() - cpu_start) * 1e3 / calls)
        wall.append((time.perf_counter() - wall_start) * 1e3 / calls)
    figures: dict[str, object] = {
        "cpu_ms": round(median(cpu), 4),
        "cpu_ms_best": round(min(cpu), 4),
        "cpu_ms_worst": round(max(cpu), 4),
        "wall_ms": round(median(wall), 4),
        "calls": calls * batches,
    }
    if target is not None:
        figures |= {"target_ms": target, "ratio": round(median(cpu) / target, 3)}
    return figures


def upper_target_figure(value: float, target: float) -> Mapping[str, float | None]:
    """Return a figure with its upper target; a ratio up to 1 meets the target."""
    ratio = round(value / target, 3) if target else None
    return {"value": round(value, 3), "target": target, "ratio": ratio}


def lower_target_figure(value: float, target: float) -> Mapping[str, float]:
    """Return a figure with its lower target; a ratio from 1 on meets the target."""
    return {"value": round(value, 3), "target": target, "ratio": round(value / target, 3)}


def hardware() -> dict[str, object]:
    """Return the CPU, its cores, and the versions of Python and system."""
    model = platform.processor() or platform.machine()
    information = Path("/proc/cpuinfo")
    if information.exists():
        names = [line for line in information.read_text().splitlines() if "model name" in line]
        model = names[0].split(":", 1)[1].strip() if names else model
    return {
        "cpu": model,
        "cores": len(os.sched_getaffinity(0)),
        "python": platform.python_version(),
        "system": f"{platform.system()} {platform.machine()}",
    }
