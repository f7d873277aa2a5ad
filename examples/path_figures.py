"""Draws the tracks of controllers on the circle, the helix and the figure of eight.

for task in circle helix lemniscate; do
  uwsim bench $task --algorithm position-p --algorithm position-pi --algorithm position-lqr \
      --level current=0.3 --out tracks/$task
done
python examples/path_figures.py tracks docs/images
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from uwsim.assets.bundled import bundled_files
from uwsim.benchmark.measures.tracking_error import TrackingErrorSpec
from uwsim.benchmark.reader import read_benchmark
from uwsim.benchmark.reference_trajectory import TrajectorySpec

HEIGHTS = {"circle": 3.6, "helix": 3.0, "lemniscate": 2.5}
"""The heights of the images, by task [inch]."""
ALGORITHMS = ("position-p", "position-pi", "position-lqr")


def read_reference(task: str) -> TrajectorySpec:
    """Return the place that moves in a task."""
    measures = read_benchmark(bundled_files("benchmarks")[task]).measures
    [spec] = [spec for spec in measures if isinstance(spec, TrackingErrorSpec)]
    return spec.trajectory


def read_track(folder: Path, reference: TrajectorySpec) -> np.ndarray:
    """Return the places of a vehicle, (n, 3) [m]."""
    with (folder / "measure-offset.csv").open() as file:
        rows = np.array([[float(cell) for cell in row] for row in list(csv.reader(file))[1:]])
    return reference.position(rows[:, 1]) + rows[:, 3:6]


def draw_task(task: str, folder: Path, out: Path) -> None:
    """Draw the reference of a task and the tracks, a panel for each controller."""
    reference, has_depth = read_reference(task), task == "helix"
    figure, panels = plt.subplots(
        1,
        3,
        figsize=(9.0, HEIGHTS[task]),
        layout="constrained",
        sharex=not has_depth,
        sharey=not has_depth,
        subplot_kw={"projection": "3d"} if has_depth else {},
    )
    axes_shown = [0, 1, 2] if has_depth else [0, 1]
    path = reference.position(np.linspace(0.0, 2.0 * reference.period, 400))
    for axes, algorithm in zip(panels, ALGORITHMS, strict=True):
        track = read_track(folder / algorithm, reference)
        axes.plot(*path.T[axes_shown], "k--", linewidth=0.8, label="place that moves")
        axes.plot(*track.T[axes_shown], linewidth=1.4, label="vehicle")
        axes.plot(*track[:1].T[axes_shown], "o", color="C0", markersize=4)
        axes.set_title(algorithm, fontsize=10)
        axes.set_xlabel("x [m]")
        axes.set_ylabel("y [m]")
        axes.set_aspect("equal")
        if has_depth:
            axes.invert_zaxis()
            axes.tick_params(labelsize=7)
    if not has_depth:
        panels[0].invert_yaxis()  # as seen from above
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=2)
    figure.savefig(out, dpi=100)


if __name__ == "__main__":
    for name in HEIGHTS:
        draw_task(name, Path(sys.argv[1]) / name, Path(sys.argv[2]) / f"{name}-tracks.png")
