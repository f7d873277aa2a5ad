"""Draw the figure of docs/waves.md, and print its table.

    python examples/station_waves_figure.py docs/images/station-waves.png RESULTS ...

RESULTS has a folder for each controller, which `uwsim bench station-waves` writes with
``--algorithm p --algorithm pi --algorithm feedforward --seed 1 --repeat 6 --out RESULTS``. Several
RESULTS with different wave heights count as one. ``--pdf`` writes a PDF, too.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from uwsim.analysis.plots import (
    MARKERS,
    PALETTE,
    save_pdf,
    save_plot,
    styled_figure,
    write_note,
)
from uwsim.results.result import Result
from uwsim.results.result_file import load
from uwsim.statistics import Interval, mean_interval, rate

CONTROLLERS = ("p", "pi", "feedforward")
HEIGHT = "waveHeight"
MIN_SEEDS = 3
"""The least number of seeds of a mean in the figure."""
SHIFT = 0.025
"""The shift between the bars of controllers [m]."""
Values = Mapping[tuple[int, float], float]
"""The value of each seed and level."""


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw the figure of station keeping in waves.")
    parser.add_argument("image", type=Path)
    parser.add_argument("results", type=Path, nargs="+")
    parser.add_argument("--pdf", action="store_true", help="a PDF for a paper, too")
    options = parser.parse_args()
    results = {name: [load(folder / name) for folder in options.results] for name in CONTROLLERS}
    print_table(results)
    draw(results, options.image, has_pdf=options.pdf)


def read_values(results: Sequence[Result], column: str) -> dict[tuple[int, float], float]:
    """Return the values of a column in the rows that are ok."""
    return {
        (int(str(seed)), round(height, 6)): value
        for result in results
        for seed, height, status, value in zip(
            result.values("seed"),
            result.numbers(HEIGHT),
            result.values("status"),
            result.numbers(column),
            strict=True,
        )
        if status == "ok" and height is not None and value is not None
    }


def find_heights(controllers: Mapping[str, Sequence[Result]]) -> list[float]:
    """Return the wave heights at which all controllers have results [m]."""
    heights = [
        {
            round(height, 6)
            for result in results
            for height in result.numbers(HEIGHT)
            if height is not None
        }
        for results in controllers.values()
    ]
    return sorted(set.intersection(*heights))


def count_ok(results: Sequence[Result], height: float) -> tuple[int, int]:
    """Return the number of rows that are ok at a height, and of all rows."""
    statuses = [
        status
        for result in results
        for level, status in zip(result.numbers(HEIGHT), result.values("status"), strict=True)
        if level is not None and round(level, 6) == height
    ]
    return statuses.count("ok"), len(statuses)


def compute_interval(values: Values, height: float) -> Interval:
    """Compute the mean over the seeds at a height, with its interval."""
    return mean_interval([value for (_, level), value in values.items() if level == height])


def compute_difference(first: Values, second: Values, height: float) -> Interval:
    """Compute the mean of the paired differences, second minus first, with its interval."""
    keys = [key for key in first if key in second and key[1] == height]
    return mean_interval([second[key] - first[key] for key in keys])


def format_interval(interval: Interval) -> str:
    """Return a mean with its limits as text."""
    if interval.mean is None:
        return "-"
    if interval.low is None or interval.high is None:
        return f"{interval.mean:.3f}"
    return f"{interval.mean:.3f} ({interval.low:.3f} to {interval.high:.3f})"


def print_table(results: Mapping[str, Sequence[Result]]) -> None:
    """Print the table of position errors, paired differences and losses."""
    offsets = {name: read_values(result, "offset") for name, result in results.items()}
    names = " | ".join(f"`{name}`" for name in results)
    print(f"| significant height [m] | {names} | `pi` - `p` | `feedforward` - `p` | ok |")
    print("|---" * (len(results) + 4) + "|")
    for height in find_heights(results):
        cells = [format_interval(compute_interval(values, height)) for values in offsets.values()]
        cells += [
            format_interval(compute_difference(offsets["p"], offsets[name], height))
            for name in ("pi", "feedforward")
        ]
        counts = [count_ok(result, height) for result in results.values()]
        cells.append(", ".join(f"{n_ok} of {n}" for n_ok, n in counts))
        print(f"| {height:g} | " + " | ".join(cells) + " |")


def draw(results: Mapping[str, Sequence[Result]], image: Path, *, has_pdf: bool) -> None:
    """Draw position error, energy and success over the wave height."""
    with styled_figure((7.2, 2.7)) as figure:
        grid = figure.subplots(1, 3)
        draw_means(grid[0], results, "offset", 1.0)
        grid[0].set_ylabel("position error, rms [m]")
        draw_means(grid[1], results, "energy", 1e-3)
        grid[1].set_ylabel("energy in 60 s [kJ]")
        draw_success(grid[2], results)
        for axes in grid:
            axes.set(xlabel="significant wave height [m]", xlim=(-0.05, 1.45))
        handles, names = grid[0].get_legend_handles_labels()
        figure.legend(handles, names, loc="outside upper center", ncols=len(names))
        write_note(
            figure,
            "bars: 95 % intervals over 6 seeds; hollow: without the seeds that lost the box, "
            "if 3 or more are left",
        )
    save_plot(figure, image)
    if has_pdf:
        save_pdf(figure, image.with_suffix(".pdf"))


def draw_means(
    axes: Axes, results: Mapping[str, Sequence[Result]], column: str, scale: float
) -> None:
    """Draw the means of a column with their intervals, times a factor."""
    for i, (name, result) in enumerate(results.items()):
        values, colour = read_values(result, column), PALETTE[i]
        heights = [
            height for height in find_heights(results) if count_ok(result, height)[0] >= MIN_SEEDS
        ]
        intervals = [compute_interval(values, height) for height in heights]
        means = scale * np.array([interval.mean or 0.0 for interval in intervals])
        spreads = np.array(
            [
                (
                    means[k] - scale * (interval.low or 0.0),
                    scale * (interval.high or 0.0) - means[k],
                )
                for k, interval in enumerate(intervals)
            ]
        )
        axes.errorbar(
            np.array(heights) + SHIFT * (i - 1), means, yerr=spreads.T, color=colour,
            marker=MARKERS[i], capsize=2.0, linewidth=1.2, label=name,
        )  # fmt: skip
        n_seeds = max(count_ok(result, height)[1] for height in heights)
        partial_indices = [
            k for k, height in enumerate(heights) if count_ok(result, height)[0] < n_seeds
        ]
        axes.plot(
            np.array(heights)[partial_indices] + SHIFT * (i - 1), means[partial_indices],
            MARKERS[i], color=colour, markerfacecolor="white", zorder=4,
        )  # fmt: skip
    axes.set_ylim(bottom=0.0)


def draw_success(axes: Axes, results: Mapping[str, Sequence[Result]]) -> None:
    """Draw the share of seeds whose tracker keeps the box, with exact intervals."""
    for i, (_, result) in enumerate(results.items()):
        heights = find_heights(results)
        counts = [count_ok(result, height) for height in heights]
        rates = [share for n_ok, n in counts if (share := rate(n_ok, n)) is not None]
        values = np.array([share.value for share in rates])
        spreads = np.array([(r.value - r.low, r.high - r.value) for r in rates])
        axes.errorbar(
            np.array(heights) + SHIFT * (i - 1), values, yerr=np.maximum(spreads.T, 0.0),
            color=PALETTE[i], marker=MARKERS[i], capsize=2.0, linewidth=1.2,
        )  # fmt: skip
    axes.set(ylabel="share of seeds with the box", ylim=(-0.03, 1.03))


if __name__ == "__main__":
    main()
