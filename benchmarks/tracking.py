"""Measure the cost of an image in trackers: DESIGN 9's ESM case, and the patch of `visibility`.

Run ``python benchmarks/tracking.py``. The case: one 100x100 patch in 320x240, up to 3 px of motion
an image, noise of 4 grey levels, pyramid and loss test included, median of 500 images; the
target of 2 ms is for ``esm``. The patch of `visibility` is 93x28 and stands still in RGB images
with a noise of 5.1; the conversion to grey counts there, and the target is 1 ms.
"""

from __future__ import annotations

import math
import time
from statistics import median

import numpy as np
from measure import main

from uwsim.algorithms import ALGORITHMS
from uwsim.algorithms.esm.homography import homography_between, warp
from uwsim.algorithms.esm.pyramid import to_grey
from uwsim.algorithms.tracker import LossTest, Tracker
from uwsim.algorithms.tracker_node import TrackerNode

IMAGES = 500
WIDTH, HEIGHT = 320, 240


def rectangle(width: float, height: float) -> np.ndarray:
    u, v = WIDTH / 2, HEIGHT / 2
    signs = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    return np.array([u, v]) + signs * [width / 2, height / 2]


def texture() -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.Generator(np.random.Philox(0))
    angle, wavelength = 2 * np.pi * rng.random(24), 8.0 * 7.5 ** rng.random(24)
    k = 2 * np.pi / wavelength * np.stack([np.cos(angle), np.sin(angle)])
    return k, 2 * np.pi * rng.random(24)


def moving_images(quad: np.ndarray, step: float, sigma: float, *, rgb: bool) -> list[np.ndarray]:
    """Return images of a plane that moves by exactly ``step`` px each, around the centre."""
    k, phase = texture()
    rng = np.random.Generator(np.random.Philox(1))
    v, u = np.mgrid[0:HEIGHT, 0:WIDTH] + 0.5
    points = np.stack([u.ravel(), v.ravel()], axis=1)
    position, images = np.zeros(2), []
    for i in range(IMAGES + 1):
        inverse = homography_between(quad + position, quad)
        clean_image = np.cos(warp(inverse, points) @ k + phase).sum(axis=1).reshape(HEIGHT, WIDTH)
        clean_image = 128.0 + 30.0 * clean_image / math.sqrt(12.0)
        if rgb:
            clean_image = np.repeat(clean_image[:, :, None], 3, axis=2)
        noisy_image = np.rint(clean_image + sigma * rng.standard_normal(clean_image.shape))
        images.append(np.clip(noisy_image, 0, 255).astype(np.uint8))
        heading = 0.1 * i
        position = position + step * np.array([math.cos(heading), math.sin(heading)])
    return images


def measure_tracker(
    name: str, quad: np.ndarray, images: list[np.ndarray], target: float | None
) -> object:
    node = ALGORITHMS[name]()
    assert isinstance(node, TrackerNode)
    tracker = node.make_tracker(to_grey(images[0]), quad)
    assert isinstance(tracker, Tracker)
    loss = LossTest(zncc_threshold=0.5, frames=5)
    tracker.step(to_grey(images[0]))  # compiles
    cpu, wall, iterations = [], [], []
    for image in images[1:]:
        cpu_start, wall_start = time.process_time_ns(), time.perf_counter_ns()
        estimate = tracker.step(to_grey(image))
        loss_reason = loss.check(estimate, WIDTH, HEIGHT)
        cpu.append((time.process_time_ns() - cpu_start) / 1e6)
        wall.append((time.perf_counter_ns() - wall_start) / 1e6)
        iterations.append(estimate.iterations)
        if loss_reason:
            return {"lost": loss_reason, "after": len(cpu)}
    figures = {
        "cpu_ms": round(median(cpu), 3),
        "wall_ms": round(median(wall), 3),
        "wall_ms_95": round(sorted(wall)[int(0.95 * len(wall))], 3),
        "iterations": round(sum(iterations) / len(iterations), 1),
        "images": len(cpu),
    }
    if target is not None:
        figures |= {"target_ms": target, "ratio": round(median(cpu) / target, 3)}
    return figures


def measure() -> dict[str, object]:
    figures: dict[str, object] = {}
    quad = rectangle(100.0, 100.0)
    images = moving_images(quad, 3.0, 4.0, rgb=False)
    for name in ("esm", "ssd-esm", "ic", "ecc", "orb"):
        target = 2.0 if name == "esm" else None
        figures[f"{name}, 100x100, 3 px an image, noise 4"] = measure_tracker(
            name, quad, images, target
        )
    quad = rectangle(93.0, 28.0)
    images = moving_images(quad, 0.0, 5.1, rgb=True)
    figures["esm, 93x28, still, RGB, noise 5.1"] = measure_tracker("esm", quad, images, 1.0)
    return figures


if __name__ == "__main__":
    main(measure)
