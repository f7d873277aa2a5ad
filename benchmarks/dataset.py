"""Speed of data sets: images of 640x480 with all labels. One JSON on stdout.

The time of one image is CPU time of this process, the smallest of several scene draws, without
start and compilation. The whole command, with two workers, is wall time.
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path
from typing import Any

from measure import main

from uwsim.datasets import DatasetRequest, make_dataset
from uwsim.datasets.make_dataset import read_sources
from uwsim.datasets.scene_draw import SceneDraw
from uwsim.simulation.scenery.renderer_pool import RendererPool

TARGET = 60.0  # images a second on two cores
SCENES = ("visibility-scene", "cirs", "shipwreck-scene")
N_REPEATS, N_IMAGES = 4, 10


def cpu_ms(scene: str, encoding: str) -> float:
    with tempfile.TemporaryDirectory() as folder:
        request = DatasetRequest(scene=scene, out=Path(folder), encoding=encoding)
        for name in ("images", "depth", "instances", "classes"):
            (request.out / name).mkdir()
        pool = RendererPool()
        draw = SceneDraw(request, read_sources(request), 0, pool)
        draw.write_image(0)
        times = []
        for repeat in range(N_REPEATS):
            start = time.process_time()
            for index in range(N_IMAGES):
                draw.write_image(1 + N_IMAGES * repeat + index)
            times.append(time.process_time() - start)
        draw.close()
        pool.close()
    return 1000.0 * min(times) / N_IMAGES


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
        results[scene] = {
            f"{encoding}_cpu_ms": round(cpu_ms(scene, encoding), 1) for encoding in ("png", "jpeg")
        }
    results["visibility-scene"]["images_per_second_2_workers"] = round(
        whole_rate("visibility-scene"), 1
    )
    return results


if __name__ == "__main__":
    main(measure)
