"""Measure the speed-up by workers: 40 independent levels of `currents`, by one worker and two.

Each run is a fresh process started from the command line, start to report; caches are warm. One
worker is measured twice: with its own thread alone for its images, as each of several workers
has, and as it comes, when the software rasteriser takes what is left of the machine. The promise
is about the first: so much does a second core bring. That all runs leave the same bytes is checked
on the way.

Beside it: the CPU time that a unit costs beyond its steps, with the renderer that a worker keeps
and with one made anew.
"""

from __future__ import annotations

import os
import tempfile
from importlib import resources
from pathlib import Path

from lxml import etree
from measure import main, milliseconds
from visibility import UWSIM, run

from uwsim.assets.find import find
from uwsim.physics.compile_scene import compile_scene
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec
from uwsim.simulation import RendererPool, Simulation

TARGET_SPEEDUP = 1.8
LEVELS = 40
LEVEL_LENGTH = 10.0
"""The length of a level [s]; an independent level settles before it."""
CAMERA = "bowtech1"


def write_benchmark(folder: Path, length: float) -> Path:
    """Write `currents` with 40 levels of another length."""
    bundled_file = Path(str(resources.files("uwsim"))) / "data" / "benchmarks" / "currents.xml"
    tree = etree.parse(bundled_file)
    [updater] = tree.findall("sceneUpdater/currentForceUpdater")
    for name, value in (("finalValue", 0.2), ("step", 0.2 / LEVELS), ("interval", length)):
        updater.find(name).text = repr(value)
    path = folder / f"currents-{length:g}.xml"
    tree.write(path)
    return path


def measure_wall_time(benchmark: Path, out: str, workers: int, threads: str | None) -> float:
    """Run the benchmark from the command line; return the wall time [s]."""
    threads_before = os.environ.pop("LP_NUM_THREADS", None)
    if threads is not None:
        os.environ["LP_NUM_THREADS"] = threads
    try:
        command = [*UWSIM, "bench", str(benchmark), "--workers", str(workers), "--out", out]
        wall, _, _ = run([*command, "--overwrite"], str(benchmark.parent))
    finally:
        os.environ.pop("LP_NUM_THREADS", None)
        if threads_before is not None:
            os.environ["LP_NUM_THREADS"] = threads_before
    return wall


def begin_and_end(scene: SceneSpec, pool: RendererPool | None) -> None:
    """Do the work of a unit beside its steps: open the scene, draw two images, close."""
    simulation = Simulation(compile_scene(scene), pool=pool)
    simulation.advance(0.0)
    camera = simulation.world.sensors.camera(CAMERA)
    camera.capture()
    simulation.world.scenery.render_clean(camera.world_from_camera, camera.intrinsics, fog=0.0)
    simulation.close()


def measure() -> dict[str, object]:
    """Measure everything; the keys name the unit."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        benchmark = write_benchmark(folder, LEVEL_LENGTH)
        measure_wall_time(write_benchmark(folder, 1.0), "warm", 2, None)
        one_thread_s = measure_wall_time(benchmark, "one-thread", 1, "0")
        one_worker_s = measure_wall_time(benchmark, "one", 1, None)
        two_workers_s = measure_wall_time(benchmark, "two", 2, None)
        outs = ("one-thread", "one", "two")
        results = {(folder / out / "result.json").read_bytes() for out in outs}
    scene = read_scene(find("currents-scene.xml")).nominal_scene
    pool = RendererPool()
    return {
        "levels": LEVELS,
        "1 worker, 1 thread: wall_s": round(one_thread_s, 2),
        "1 worker, as it comes: wall_s": round(one_worker_s, 2),
        "2 workers: wall_s": round(two_workers_s, 2),
        "2 workers over 1 with 1 thread: times": {
            "value": round(one_thread_s / two_workers_s, 3),
            "target": TARGET_SPEEDUP,
            "ratio": round(TARGET_SPEEDUP / (one_thread_s / two_workers_s), 3),
        },
        "2 workers over 1 as it comes: times": round(one_worker_s / two_workers_s, 3),
        "same bytes": len(results) == 1,
        "a unit beyond its steps": milliseconds(
            lambda: begin_and_end(scene, pool), calls=3, batches=5
        ),
        "the same with a renderer of its own": milliseconds(
            lambda: begin_and_end(scene, None), calls=3, batches=5
        ),
    }


if __name__ == "__main__":
    main(measure)
