"""The whole benchmark, as a user meets it: speed, cold start, memory, help. One JSON on stdout.

Every figure is of a fresh process started from the command line. Caches are warm: each command
runs once before it is measured.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from measure import main

TIMES_REAL_TIME = 5.0
UWSIM = [sys.executable, "-m", "uwsim"]
TWO_CAMERAS = """
import dataclasses
import uwsim
from uwsim.assets.find import find
from uwsim.scene.reader import read_scene
scene = read_scene(find("visibility-scene.xml"))
vehicle = scene.vehicles[0]
first = vehicle.parts[0]
both = (first, dataclasses.replace(first, name="second"))
vehicle = dataclasses.replace(vehicle, parts=both)
simulation = uwsim.load(dataclasses.replace(scene, vehicles=(vehicle,)))
simulation.advance(0.0)
for _ in range(500):
    simulation.advance()
    simulation.world.sensors.camera(first.name).capture()
    simulation.world.sensors.camera("second").capture()
"""


def run(command: list[str], folder: str) -> tuple[float, float, float]:
    """Run a command; return wall time [s], CPU time [s], peak resident memory [MB]."""
    begin = time.perf_counter()
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    wall_s = time.perf_counter() - begin
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise SystemExit(f"{command} ended with {process.returncode}")
    return wall_s, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024.0


def best_of(times: int, command: list[str], folder: str) -> tuple[float, float, float]:
    """Run once to fill the caches, then ``times`` times; return the fastest run."""
    run(command, folder)
    return min(run(command, folder) for _ in range(times))


def upper_target_figure(value: float, target: float) -> dict[str, float]:
    """Return a figure with its upper target; a ratio up to 1 meets the target."""
    return {"value": round(value, 3), "target": target, "ratio": round(value / target, 3)}


def measure() -> dict[str, object]:
    """Measure everything; the keys name the unit."""
    with tempfile.TemporaryDirectory() as folder:
        bench = [*UWSIM, "bench", "visibility", "--seed", "1", "--out", "v", "--overwrite"]
        bench_s, bench_cpu_s, bench_mb = best_of(1, bench, folder)
        result = json.loads((Path(folder) / "v" / "result.json").read_text())
        names = [column["name"] for column in result["columns"]]
        simulated_s = result["rows"][-1][names.index("ended_at")]
        frames = sum(stream["frames"] for stream in result["image_streams"])
        image = [*UWSIM, "render", "visibility-scene", "--camera", "bowtech1", "-o", "a.png"]
        first_image_s, first_image_cpu_s, _ = best_of(3, image, folder)
        help_s, _, _ = best_of(5, [*UWSIM, "--help"], folder)
        _, _, two_cameras_mb = best_of(1, [sys.executable, "-c", TWO_CAMERAS], folder)
    return {
        "visibility, start to report: wall_s": upper_target_figure(
            bench_s, simulated_s / TIMES_REAL_TIME
        ),
        "visibility: times_real_time": round(simulated_s / bench_s, 2),
        "visibility: cpu_s": round(bench_cpu_s, 2),
        "visibility: simulated_s": simulated_s,
        "visibility: rows": len(result["rows"]),
        "visibility: frames": frames,
        "visibility: peak_memory_mb": round(bench_mb, 1),
        "cold start to first image: wall_s": upper_target_figure(first_image_s, 1.5),
        "cold start to first image: cpu_s": round(first_image_cpu_s, 2),
        "help: wall_s": upper_target_figure(help_s, 0.3),
        "two cameras: peak_memory_mb": upper_target_figure(two_cameras_mb, 500.0),
    }


if __name__ == "__main__":
    main(measure)
