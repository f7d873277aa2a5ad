"""Speed of data sets: images of 640x480 with all labels. One JSON on stdout.

The time of one image is CPU time of this process with the environment of a worker, the smallest of
several batches of images, without start and compilation. The whole command, with two workers, is
wall time. Sizes are those of all files of an image.
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path
from typing import Any

from measure import main

from uwsim.base.environment import set_environment
from uwsim.datasets import DatasetRequest, make_dataset
from uwsim.datasets.make_dataset import read_sources
from uwsim.datasets.scene_draw import SceneDraw
from uwsim.runs.executors.executor import ENVIRONMENT
from uwsim.simulation.scenery.renderer_pool import RendererPool

TARGET = 60.0  # images a second on two cores
SCENES = ("visibility-scene", "cirs", "shipwreck-scene")
N_REPEATS, N_IMAGES = 4, 10


def measure_images(scene: str, encoding: str) -> dict[str, float]:
    """Return the CPU time [ms] and the size of the files [kB] of an image."""
    with tempfile.TemporaryDirectory() as folder:
        request = DatasetRequest(scene=scene, out=Path(folder), encoding=encoding)
        for name in ("images", "depth", "instances", "classes"):
            (request.out / name).mkdir()
        pool = RendererPool()
        draw = SceneDraw(request, read_sources(request), 0, pool)
        with set_environment(ENVIRONMENT):  # the renderer starts with the first image
            draw.write_image(0)
        times = []
        for repeat in range(N_REPEATS):
            start = time.process_time()
            for index in range(N_IMAGES):
                draw.write_image(1 + N_IMAGES * repeat + index)
            times.append(time.process_time() - start)
        draw.close()
        pool.close()
        n_bytes = sum(path.stat().st_size for path in request.out.rglob("*") if path.is_file())
    return {
        f"{encoding}_cpu_ms": round(1000.0 * min(times) / N_IMAGES, 1),
        f"{encoding}_kb": round(n_bytes / (1 + N_REPEATS * N_IMAGES) / 1000.0),
    }


def whole_rate(scene: str, n_images: int = 400) -> float:
    with tempfile.TemporaryDirectory() as folder:
        start = time.monotonic()
        make_dataset(
            DatasetRequest(scene=scene, out=Path(folder) / "set", n_images=n_images, workers=2)
        )
        return n_images / (time.monotonic() - start)


def measure() -> dict[str, Any]:
    results: dict[str, Any] = {"target_images_per_second": TARGET}
    for scene in SCENES:
        results[scene] = measure_images(scene, "png") | measure_images(scene, "jpeg")
    results["visibility-scene"]["images_per_second_2_workers"] = round(
        whole_rate("visibility-scene"), 1
    )
    return results


if __name__ == "__main__":
    main(measure)
