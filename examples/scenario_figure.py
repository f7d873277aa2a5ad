"""Draw recorded images in added fog, and the errors of a tracker on them, as in docs/scenarios.md.

    python examples/scenario_figure.py scenario recorded.result rendered.result scenario-fog.jpg

The images are those that the tracker received, with the camera's noise. Curves end where the
tracker lost the target.
"""

from __future__ import annotations

import argparse
import csv
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from PIL import Image

from uwsim.analysis.plots import PALETTE, save_plot, styled_figure
from uwsim.benchmark.updaters.bag_fog_updater import (
    blend_fog,
    find_contrast,
    find_missing_noise,
    find_ranges,
)
from uwsim.messages.bag_camera import Recording

TIMES, DENSITIES = (0.0, 6.0), (0.0, 0.4, 0.6, 0.8)
"""The times of the images [s] and the added fog [1/m]."""
FOG_COLOUR, NOISE, UNKNOWN_RANGE = (0.0, 0.05, 0.3), 0.02, 2.5
"""The fog colour and the noise of the scene, and the range of pixels without a depth [m]."""


JPEG_QUALITY = 88
"""The JPEG quality of the figure, from 0 to 100."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("scenario", "recorded", "rendered", "out"):
        parser.add_argument(name, type=Path)
    arguments = parser.parse_args()
    with styled_figure((7.2, 5.4)) as figure:
        grid = figure.add_gridspec(3, len(DENSITIES), height_ratios=(1.0, 1.0, 1.1))
        recording = Recording(
            arguments.scenario / "recording.mcap", "/uwsim/camera1", "/uwsim/camera1_info", "/depth"
        )
        for row, (time, pixels, ranges) in enumerate(find_frames(recording)):
            row_axes = [figure.add_subplot(grid[row, k]) for k in range(len(DENSITIES))]
            draw_images(row_axes, pixels, ranges, key=row)
            row_axes[0].set_ylabel(f"{time:g} s")
        recording.close()
        for axes in figure.axes[: len(DENSITIES)]:
            axes.set_title(f"fog {DENSITIES[figure.axes.index(axes)]:g} m⁻¹")
        half = len(DENSITIES) // 2
        panels = (("recorded images", arguments.recorded), ("rendered views", arguments.rendered))
        for column, (title, result) in enumerate(panels):
            axes = figure.add_subplot(grid[2, column * half : (column + 1) * half])
            draw_errors(axes, result / "measure-corners.csv")
            axes.set(title=title, xlabel="time [s]", ylim=(0.0, 5.0), xlim=(0.0, 24.0))
            if column == 0:
                axes.set_ylabel("error [px]")
                axes.legend(title="fog [m⁻¹]", loc="center right", ncols=2, frameon=False)
        draft = save_plot(figure, arguments.out.with_suffix(".png"))
    with Image.open(draft) as picture:
        picture.convert("RGB").save(arguments.out, quality=JPEG_QUALITY)
    draft.unlink()


def draw_images(row_axes: list[Axes], pixels: np.ndarray, ranges: np.ndarray, key: int) -> None:
    """Draw an image in each fog, with the noise of its camera."""
    for axes, density in zip(row_axes, DENSITIES, strict=True):
        contrast = find_contrast(ranges, density)
        image = blend_fog(pixels, contrast, FOG_COLOUR)
        image += find_missing_noise(image.shape, contrast, NOISE, key)
        axes.imshow(image.clip(0.0, 255.0).astype(np.uint8), interpolation="nearest")
        axes.set(xticks=[], yticks=[])
        axes.grid(visible=False)


def find_frames(recording: Recording) -> Iterator[tuple[float, np.ndarray, np.ndarray]]:
    """Yield time, pixels (h, w, 3) and ranges (h, w) [m] of the images at `TIMES`."""
    times = list(TIMES)
    for frame in recording.frames():
        if times and frame.time * 1e-9 >= times[0] - 1e-6:
            pixels = frame.decode().pixels
            depth = frame.decode_depth()
            yield times.pop(0), pixels, find_ranges(depth, frame.info, UNKNOWN_RANGE)
        if not times:
            return


def draw_errors(axes: Axes, path: Path) -> None:
    """Draw the error over the time of each level, with a cross where it ends early."""
    with path.open(newline="") as file:
        rows = [[float(cell or "nan") for cell in row[:3]] for row in list(csv.reader(file))[1:]]
    table = np.array(rows)
    for index, density in enumerate(DENSITIES):
        level = table[np.isclose(table[:, 0], density)]
        level[:, 1] -= level[0, 1]
        level = level[np.isfinite(level[:, 2])]
        colour = PALETTE[index]
        axes.plot(level[:, 1], level[:, 2], color=colour, lw=1.0, label=f"{density:g}")
        if level[-1, 1] < 23.0:
            error = min(level[-1, 2], 4.8)
            axes.plot(level[-1, 1], error, marker="x", ms=7, mew=2.0, color=colour)
            axes.annotate(
                "lost", (level[-1, 1], error), (5, -3), textcoords="offset points", color=colour
            )


if __name__ == "__main__":
    main()
