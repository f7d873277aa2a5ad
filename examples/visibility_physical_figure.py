r"""Draw the figure of docs/visibility-physical.md, and print its tables.

    python examples/visibility_physical_figure.py RESULTS docs/images/visibility-physical.png \
        --views docs/images/visibility-physical-views.jpg

RESULTS has the folders ``day``, ``lamp-0.1`` and ``lamp-0.5``, each with the results of several
trackers, which the commands of the page write. ``--pdf`` writes a PDF, too.

The second table has what is expected without a tracker. The contrast is that of the model,
M(psi) J / L, with the light J of a white board and its radiance L, veil included. The correlation
is that of noise-free images of the box with the template, times the loss by noise.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter
from PIL import Image, ImageDraw, ImageFont

from uwsim.analysis.plots import (
    INK,
    MARKERS,
    curves_of,
    save_pdf,
    save_plot,
    styled_figure,
    write_note,
)
from uwsim.analysis.plots.drawing import curve_style, draw_curve, draw_end
from uwsim.api import load as load_scene
from uwsim.assets.bundled import bundled_files
from uwsim.base.geometry import Array
from uwsim.benchmark.reader import read_benchmark
from uwsim.benchmark.updaters import WaterUpdaterSpec
from uwsim.optics import compute_modulation_transfer
from uwsim.optics.lamp_light import compute_lamp_irradiance
from uwsim.results.result import Result
from uwsim.results.result_file import load
from uwsim.simulation import Simulation
from uwsim.simulation.scenery.board_exposure import (
    compute_board_light,
    compute_lamplit_board,
    compute_sunlit_board,
    make_point_lamp,
)
from uwsim.simulation.scenery.light_sources import make_lamp
from uwsim.statistics import Median, median_interval
from uwsim.world import LineOfSight

LIGHTS = {"day": "0", "lamp-0.1": "0.1", "lamp-0.5": "0.5"}
"""The folder of each light, and its distance beside the lens [m]; 0: the sun."""
TITLES = {
    "day": "sun and sky",
    "lamp-0.1": "lamp 0.1 m beside the lens",
    "lamp-0.5": "lamp 0.5 m beside the lens",
}
SHORT_TITLES = {"day": "sun", "lamp-0.1": "lamp 0.1 m", "lamp-0.5": "lamp 0.5 m"}
LIGHT_COLOURS = (INK, "#8c8c8c", "#3b6ea8")
"""The colours of the lights, none of which is that of a tracker."""
TRACKERS = ("esm", "ic", "ecc", "orb", "ssd-esm")
LEVEL, CORNERS = "attenuationLengths", "corners"
MAX_ERROR = 5.0
"""The error of the corners up to which a tracker is accurate [px]."""
MAX_LEVEL = 6.0
"""The greatest number of attenuation lengths in the figure."""
FREQUENCIES = (10.0, 30.0)
"""The frequencies of detail for which a contrast is stated [cycles/rad]."""
VIEW_LEVELS = (0.5, 2.0, 3.0, 4.0)
"""The attenuation lengths of the images of the camera."""
LEVELS = (0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
NOISE = 0.02 * 255.0 * 0.668
"""The standard deviation of the noise of a grey image, of 2 % in each channel [grey level]."""
GREY = np.array([0.299, 0.587, 0.114])
BOX = slice(149, 177), slice(206, 297)
"""The rows and columns of the box in the image."""


@dataclass(frozen=True, kw_only=True)
class Expectation:
    """The expected visibility at a number of attenuation lengths."""

    contrasts: tuple[float, ...]
    """The contrast of the model at `FREQUENCIES` [1]."""
    correlation: float
    """The correlation of noisy images of the box with its template [1]."""


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw the figure of visibility in water.")
    parser.add_argument("results", type=Path)
    parser.add_argument("image", type=Path)
    parser.add_argument("--views", type=Path, metavar="FILE.jpg", help="images of the camera, too")
    parser.add_argument("--pdf", action="store_true", help="a PDF for a paper, too")
    options = parser.parse_args()
    if options.views is not None:
        rows = [draw_views(lamp) for lamp in LIGHTS.values()]
        Image.fromarray(np.concatenate(rows)).save(options.views, quality=88, optimize=True)
    results = {
        light: {name: load(path) for name in TRACKERS if is_complete(path := folder / name)}
        for light in LIGHTS
        if (folder := options.results / light) and is_complete(folder / TRACKERS[0])
    }
    print_losses(results)
    print_expectations({light: compute_expectations(LIGHTS[light]) for light in results})
    draw(results, options.image, has_pdf=options.pdf)


def is_complete(folder: Path) -> bool:
    """Return True if a folder has a result."""
    return (folder / "result.json").is_file()


def find_losses(result: Result) -> list[tuple[float, float]]:
    """Return for each seed the last level that is ok and the first that is not."""
    return _find_brackets(result, [status == "ok" for status in result.values("status")])


def find_inaccuracies(result: Result) -> list[tuple[float, float]]:
    """Return for each seed the last level with a small error and the first without."""
    errors = result.numbers(CORNERS)
    return _find_brackets(result, [error is not None and error <= MAX_ERROR for error in errors])


def _find_brackets(result: Result, passes: Sequence[bool]) -> list[tuple[float, float]]:
    levels, brackets = result.numbers(LEVEL), []
    seeds = result.values("seed")
    for seed in dict.fromkeys(seeds):
        rows = [i for i, value in enumerate(seeds) if value == seed]
        row = next((i for i in rows if not passes[i]), None)
        previous_row = rows[-1] if row is None else row - 1
        low = 0.0 if row == rows[0] else float(levels[previous_row] or 0.0)
        high = math.inf if row is None else float(levels[row] or 0.0)
        brackets.append((low, high))
    return brackets


def print_losses(results: Mapping[str, Mapping[str, Result]]) -> None:
    """Print the table of losses."""
    print(
        "| tracker | " + " | ".join(f"{TITLES[light]}: lost | > 5 px" for light in results) + " |"
    )
    print("|---|" + "---|---|" * len(results))
    for tracker in TRACKERS:
        cells = []
        for light in results:
            result = results[light].get(tracker)
            for find in (find_losses, find_inaccuracies):
                cells.append("" if result is None else format_median(median_interval(find(result))))
        print(f"| `{tracker}` | " + " | ".join(cells) + " |")


def format_median(median: Median) -> str:
    """Return a median with its limits as text."""
    if median.value is None:
        return "beyond 8"
    limits = "" if median.low is None else f" ({median.low:.2f} to {median.high:.2f})"
    return f"{median.value:.2f}{limits}"


def compute_expectations(lamp: str) -> dict[float, Expectation]:
    """Compute the expected visibility at `LEVELS`, for a distance of the lamp [m]."""
    spec = read_benchmark(bundled_files("benchmarks")["visibility-physical"]).scene_updater
    assert isinstance(spec, WaterUpdaterSpec)
    path = bundled_files("scenes")["visibility-physical-scene"]
    with load_scene(path, settings={"xacro.lamp": lamp}) as simulation:
        stage = simulation.world.stage_view
        updater, box = spec.bind(stage), stage.world.body("blackbox").world_from_body
        camera = stage.world.camera("bowtech1")
        sight = LineOfSight(
            camera=camera.world_from_camera.position,
            point=box.transform(np.array([spec.point]))[0],
        )
        expectations, template = {}, None
        for level in LEVELS:
            updater.apply(level)
            image = simulation.world.scenery.render_clean(
                camera.world_from_camera, camera.intrinsics, targets=("colour",)
            ).colour
            assert image is not None
            patch = image[(*BOX, slice(0, 3))].astype(np.float64) @ GREY
            template = patch if template is None else template
            correlation = float(np.corrcoef(patch.ravel(), template.ravel())[0, 1])
            for values in (patch, template):
                correlation *= float(values.std()) / math.hypot(float(values.std()), NOISE)
            expectations[level] = Expectation(
                contrasts=tuple(
                    compute_contrast(simulation, sight, frequency) for frequency in FREQUENCIES
                ),
                correlation=correlation,
            )
        return expectations


def compute_contrast(simulation: Simulation, sight: LineOfSight, frequency: float) -> float:
    """Compute the contrast of detail against a white board in the present water [1]."""
    scenery = simulation.world.scenery
    water, rate = scenery.state.water, scenery.state.light.rate
    assert water.physical_water is not None
    optics, height = water.physical_water, water.surface_height
    light: Array = compute_board_light(optics, height, rate, sight)
    radiance: Array = compute_sunlit_board(optics, height, rate, sight)
    normal = (sight.camera - sight.point) / sight.length
    for mounted_lamp in scenery.mounted_lamps:
        lamp = make_lamp(mounted_lamp)
        light = (
            light
            + compute_lamp_irradiance(
                optics.medium, make_point_lamp(lamp), sight.point[None], normal[None]
            )[0]
        )
        radiance = radiance + compute_lamplit_board(optics, lamp, sight)
    transfer = compute_modulation_transfer(optics.medium, frequency, sight.length)
    return float((light * transfer / radiance)[1])


def draw_views(lamp: str) -> npt.NDArray[np.uint8]:
    """Draw a row of images of the camera at `VIEW_LEVELS`, for a distance of the lamp [m]."""
    spec = read_benchmark(bundled_files("benchmarks")["visibility-physical"]).scene_updater
    path = bundled_files("scenes")["visibility-physical-scene"]
    with load_scene(path, settings={"xacro.lamp": lamp}, seed=1) as simulation:
        updater, images = spec.bind(simulation.world.stage_view), []
        for level in VIEW_LEVELS:
            updater.apply(level)
            pixels = simulation.world.sensors.camera("bowtech1").capture()
            image = Image.fromarray(np.ascontiguousarray(pixels[..., :3]))
            text = f"{level:g} attenuation lengths"
            font = ImageFont.load_default(size=15)
            ImageDraw.Draw(image).text((8, 5), text, "white", font, stroke_width=2, stroke_fill=INK)
            images.append(np.pad(np.asarray(image), ((0, 4), (0, 4), (0, 0)), constant_values=255))
    return np.concatenate(images, axis=1)


def print_expectations(expectations: Mapping[str, Mapping[float, Expectation]]) -> None:
    """Print the table of what is expected without a tracker."""
    print("| attenuation lengths | " + " | ".join(TITLES[light] for light in expectations) + " |")
    print("|---|" + "---|" * len(expectations))
    for level in LEVELS:
        cells = []
        for rows in expectations.values():
            contrasts = ", ".join(f"{contrast:.3f}" for contrast in rows[level].contrasts)
            cells.append(f"{contrasts}; {rows[level].correlation:.2f}")
        print(f"| {level:g} | " + " | ".join(cells) + " |")


def draw(results: Mapping[str, Mapping[str, Result]], image: Path, *, has_pdf: bool) -> None:
    """Draw the errors of the corners for each light, and the losses."""
    with styled_figure((7.2, 5.4)) as figure:
        grid = figure.subplots(2, 2).ravel()
        for letter, axes, (light, trackers) in zip("abc", grid, results.items(), strict=False):
            draw_errors(axes, trackers)
            axes.set_title(f"({letter}) {TITLES[light]}", fontsize=8.5, loc="left")
        draw_losses(grid[3], results)
        grid[3].set_title("(d) the target is lost", fontsize=8.5, loc="left")
        handles, names = grid[0].get_legend_handles_labels()
        figure.legend(handles, names, loc="outside upper center", ncols=len(names))
        write_note(
            figure,
            "bands: 95 % intervals of means over 6 seeds; bars in (d): exact 97 % intervals of "
            "medians; cross: the last level before the loss; lines that leave a panel: > 100 px",
        )
    save_plot(figure, image)
    if has_pdf:
        save_pdf(figure, image.with_suffix(".pdf"))


def draw_errors(axes: Axes, trackers: Mapping[str, Result]) -> None:
    """Draw the error of the corners of each tracker over the attenuation lengths."""
    for i, (tracker, result) in enumerate(trackers.items()):
        style = curve_style(i, len(TRACKERS))
        for curve in curves_of(result, CORNERS):
            draw_curve(axes, curve, style, tracker)
            draw_end(axes, curve, style)
    axes.axhline(MAX_ERROR, color="black", linewidth=0.6, linestyle=":")
    axes.set(yscale="log", ylim=(0.1, 100.0), xlim=(0.0, MAX_LEVEL))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda error, _: f"{error:g}"))
    axes.set(xlabel="attenuation lengths to the target", ylabel="error of the corners [px]")


def draw_losses(axes: Axes, results: Mapping[str, Mapping[str, Result]]) -> None:
    """Draw the median level at which each tracker loses the target, by light."""
    for j, (light, trackers) in enumerate(results.items()):
        for tracker, result in trackers.items():
            median = median_interval(find_losses(result))
            if median.value is None:
                continue
            y = TRACKERS.index(tracker) + 0.22 * (j - 1)
            low, high = median.low or median.value, median.high or median.value
            spread = [[median.value - low], [min(high, MAX_LEVEL) - median.value]]
            axes.errorbar(
                [median.value], [y], xerr=spread,
                fmt=MARKERS[j], color=LIGHT_COLOURS[j], capsize=2.5,
                label=SHORT_TITLES[light] if tracker == TRACKERS[0] else None,
            )  # fmt: skip
    axes.set_yticks(range(len(TRACKERS)), TRACKERS)
    axes.set(xlabel="attenuation lengths to the target", xlim=(0.0, MAX_LEVEL))
    axes.set_ylim(len(TRACKERS) + 0.3, -0.6)
    axes.legend(loc="lower center", ncols=len(results), columnspacing=1.0, handletextpad=0.2)


if __name__ == "__main__":
    main()
