"""Figures of station keeping: errors over time and over the current, with the theory."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure

from uwsim.analysis.plots import GREY, MARKERS, PALETTE, styled_figure
from uwsim.base.geometry import Array
from uwsim.statistics import mean_interval

from .station_keeping import Loop, StationError, SwingingCurrent, predict_error

NOTE = "thin lines: theory (closed forms)"


@dataclass(frozen=True, kw_only=True)
class Line:
    """A measured curve over time, and its theory."""

    name: str
    """The name in the legend."""
    time: Array
    """The times, (n,) [s]."""
    values: Array
    """The values, (n,); NaN is a gap."""
    theory: Array | None = None
    """The theory at the same times, (n,); NaN where it does not apply."""


def draw_over_time(
    panels: Mapping[str, Sequence[Line]], *, label: str, note: str = "", theory: str = NOTE
) -> Figure:
    """Draw panels side by side with one scale.

    Args:
        panels: the lines of each panel, by title.
        label: the label of the vertical axis, with its unit.
        note: the note below the figure.
        theory: the note that replaces ``note`` if theory is drawn.
    """
    theories = [line.theory for lines in panels.values() for line in lines]
    if any(values is not None and np.isfinite(values).any() for values in theories):
        note = theory
    with styled_figure((7.0, 2.7)) as figure:
        grid = figure.subplots(1, len(panels), sharey=True, squeeze=False)[0]
        for axes, (title, lines) in zip(grid, panels.items(), strict=True):
            for i, line in enumerate(lines):
                colour = PALETTE[i % len(PALETTE)]
                axes.plot(line.time, line.values, color=colour, label=line.name, linewidth=1.2)
                if line.theory is not None:
                    axes.plot(line.time, line.theory, color="black", linewidth=0.6)
            axes.set(xlabel="time [s]", xlim=(0.0, max(float(line.time[-1]) for line in lines)))
            axes.text(0.5, 1.02, title, transform=axes.transAxes, ha="center", va="bottom")
        grid[0].set_ylabel(label)
        handles, names = grid[0].get_legend_handles_labels()
        figure.legend(handles, names, loc="outside right upper")
        figure.text(0.995, 0.004, note, ha="right", va="bottom", fontsize=5.5, color=GREY)
    return figure


def draw_over_current(
    stations: Mapping[str, Mapping[float, Sequence[StationError]]], loops: Mapping[str, Loop]
) -> Figure:
    """Draw the mean error along and the amplitude across over the current.

    Args:
        stations: the station-keeping errors, one for each seed, by controller and current [m/s].
        loops: the gains of each controller, for the theory.
    """
    columns = {
        "mean error along the current [m]": "along_mean",
        "amplitude across, 30 s [m]": "across_amplitude",
    }
    max_seeds = max(len(errors) for levels in stations.values() for errors in levels.values())
    with styled_figure((7.0, 2.9)) as figure:
        grid = figure.subplots(1, 2)
        for axes, (label, name) in zip(grid, columns.items(), strict=True):
            for i, (controller, levels) in enumerate(stations.items()):
                colour = PALETTE[i % len(PALETTE)]
                currents = sorted(levels)
                intervals = [
                    mean_interval([getattr(station, name) for station in levels[current]])
                    for current in currents
                ]
                means = np.array([interval.mean for interval in intervals], dtype=np.float64)
                spread = np.array(
                    [
                        (0.0, 0.0)
                        if interval.mean is None or interval.low is None or interval.high is None
                        else (interval.mean - interval.low, interval.high - interval.mean)
                        for interval in intervals
                    ]
                )
                axes.errorbar(
                    currents, means, yerr=spread.T if max_seeds > 1 else None, capsize=2.5,
                    fmt=MARKERS[i % len(MARKERS)], color=colour, label=controller, zorder=3,
                )  # fmt: skip
                line = np.linspace(0.0, max(currents), 50)
                theory = [predict_error(loops[controller], SwingingCurrent(speed=f)) for f in line]
                axes.plot(line, [getattr(t, name) for t in theory], color=colour, linewidth=0.7)
            axes.set(xlabel="current [m/s]", ylabel=label)
        grid[0].legend(loc="upper left")
        seeds = f"bars: 95 % intervals over {max_seeds} seeds; " if max_seeds > 1 else "one seed; "
        figure.text(0.995, 0.004, seeds + NOTE, ha="right", va="bottom", fontsize=5.5, color=GREY)
    return figure
