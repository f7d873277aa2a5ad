"""What all benchmarks share: hardware, load, repeated timing, and JSON on standard output.

A benchmark hands `main` a function without arguments that measures and returns its figures.
`milliseconds` gives CPU time of the whole process, all threads: on a shared machine it moves far
less than wall time, which stands beside it. Above a load of 1.5 nothing is measured, unless asked
for with ``--anyway`` (or ``--force``), and the JSON says so.
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
    """Measure and print, as a command line; exit status 2 when the machine is busy."""
    parser = argparse.ArgumentParser(description="One JSON with figures, hardware and load.")
    parser.add_argument(
        "--anyway", "--force", action="store_true", help="measure although the machine is busy"
    )
    parser.add_argument("--out", type=Path, help="write the JSON here too")
    arguments = parser.parse_args()
    before = os.getloadavg()[0]
    if before > MAX_LOAD and not arguments.anyway:
        print(
            f"The load is {before:.2f}, above {MAX_LOAD}: figures would be worth nothing. "
            "Wait, or measure all the same with --anyway.",
            file=sys.stderr,
        )
        raise SystemExit(2)
    figures = measure()
    load = {"before": before, "after": os.getloadavg()[0], "measured_anyway": arguments.anyway}
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

    Called once before, to warm up. ``ratio`` is the median over the target: up to 1 is kept.
    """
    call()
    cpu, wall = [], []
    for _ in range(batches):
        began_cpu, began_wall = time.process_time(), time.perf_counter()
        for _ in range(calls):
            call()
        cpu.append((time.process_time() - began_cpu) * 1e3 / calls)
        wall.append((time.perf_counter() - began_wall) * 1e3 / calls)
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


def kept(value: float, target: float) -> Mapping[str, float | None]:
    """A figure with its target; the ratio is kept up to 1."""
    ratio = round(value / target, 3) if target else None
    return {"value": round(value, 3), "target": target, "ratio": ratio}


def reached(value: float, target: float) -> Mapping[str, float]:
    """A figure that is to be no less than its target; the ratio is reached from 1 on."""
    return {"value": round(value, 3), "target": target, "ratio": round(value / target, 3)}


def hardware() -> dict[str, object]:
    """Where this was measured."""
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
