"""The plots of a gap: error over the horizon, tracks, spectrum, and shares of coefficients."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...analysis.plots import GREY, INK, MARKERS, PALETTE, save_pdf, save_plot, styled_figure
from ..errors import AXES, choose_main_horizon
from ..gap import Gap
from ..residuals import StepResiduals
from .tables import format_factor, format_share

SIZE = (7.2, 2.9)
BAR_HEIGHT = 0.56
"""The height of a bar, in distances of bars."""
REST = "#d0d0d0"
"""The colour of the share that no coefficient explains."""
GROUPS = ((slice(0, 3), 1.0, "m"), (slice(3, 6), math.degrees(1.0), "°"))
"""The axes, the factor and the unit of displacements and of rotations."""


def draw_plots(gap: Gap, directory: Path) -> dict[str, Path]:
    """Draw the plots as PNG and PDF; return the paths of the PNGs by name."""
    figures = {"horizon": _draw_horizon(gap), "tracks": _draw_tracks(gap)}
    if gap.attribution is not None:
        figures["coefficients"] = _draw_shares(gap)
    if gap.residuals is not None:
        figures["spectrum"] = _draw_spectrum(gap.residuals)
    paths = {}
    for name, figure in figures.items():
        paths[name] = save_plot(figure, directory / f"{name}.png")
        save_pdf(figure, directory / f"{name}.pdf")
    return paths


def _draw_horizon(gap: Gap) -> Figure:
    with styled_figure(SIZE) as figure:
        for axes, (group, factor, unit) in zip(figure.subplots(1, 2), GROUPS, strict=True):
            for index in [i for i in range(*group.indices(6)) if i in gap.axis_indices]:
                colour = PALETTE[index % 3]
                axes.plot(gap.curve_times, factor * gap.curves[:, index], color=colour)
                _draw_estimates(axes, gap, index, factor, colour)
            axes.set_xlabel("time after the beginning of a window [s]")
            axes.set_ylabel(f"RMS error [{unit}]")
            axes.set_xlim(left=0.0)
            axes.set_ylim(bottom=0.0)
            _mark_few_windows(axes, gap)
            axes.legend(loc="upper left")
    return figure


def _mark_few_windows(axes: Axes, gap: Gap) -> None:
    """Mark horizons with too few independent windows for an interval."""
    for error in gap.horizons:
        if error.distance.low is None:
            axes.axvline(error.horizon, color=GREY, linewidth=0.7, linestyle=":", zorder=0)
            axes.annotate(
                f"n = {error.n_blocks:.3g}, no interval",
                (error.horizon, 1.01),
                xycoords=("data", "axes fraction"),
                ha="right" if error is gap.horizons[-1] else "center",
                va="bottom",
                fontsize=6.5,
                color=INK,
            )


def _draw_estimates(axes: Axes, gap: Gap, index: int, factor: float, colour: str) -> None:
    """Draw the errors at the horizons, with their intervals."""
    for number, error in enumerate(gap.horizons):
        rms = error.axes[index].rms
        limits = None
        if rms.low is not None and rms.high is not None:
            limits = [[factor * (rms.value - rms.low)], [factor * (rms.high - rms.value)]]
        axes.errorbar(
            [error.horizon],
            [factor * rms.value],
            yerr=limits,
            color=colour,
            marker=MARKERS[index % 3],
            markerfacecolor="white" if limits is None else colour,
            markersize=4,
            zorder=3,
            capsize=2,
            elinewidth=0.9,
            linestyle="-",
            label=AXES[index] if number == 0 else None,
        )


def _draw_tracks(gap: Gap) -> Figure:
    horizon = choose_main_horizon(gap.horizons).horizon
    with styled_figure((7.2, 3.3)) as figure:
        plan, depth = figure.subplots(1, 2, width_ratios=(1, 1))
        motion = gap.log.motion
        assert motion is not None
        positions = motion.positions
        plan.plot(positions[:, 1], positions[:, 0], color=GREY, linewidth=0.9, label="log")
        depth.plot(motion.times, positions[:, 2], color=GREY, linewidth=0.9)
        for number, (_, track) in enumerate(gap.tracks):
            label = f"simulation, windows of {horizon:g} s" if number == 0 else None
            plan.plot(track[:, 1], track[:, 0], color=PALETTE[1], linewidth=1.1, label=label)
            plan.plot(track[:1, 1], track[:1, 0], color=INK, marker="o", markersize=2.2)
        starts = _track_starts(gap, horizon)
        for start, (_, track) in zip(starts, gap.tracks, strict=True):
            times = start + np.linspace(0.0, horizon, len(track))
            depth.plot(times, track[:, 2], color=PALETTE[1], linewidth=1.1)
            depth.plot(times[:1], track[:1, 2], color=INK, marker="o", markersize=2.2)
        plan.set_aspect("equal", adjustable="datalim")
        plan.set_xlabel("y of L [m]")
        plan.set_ylabel("x of L [m]")
        plan.legend(loc="best")
        depth.set_xlabel("time of the log [s]")
        depth.set_ylabel("z of L [m]")
        if gap.points_down:
            depth.invert_yaxis()
    return figure


def _track_starts(gap: Gap, horizon: float) -> list[float]:
    starts: list[float] = []
    for index in gap.windows.fits[horizon]:
        start = float(gap.windows.starts[index])
        if not starts or start >= starts[-1] + horizon - 1e-6:
            starts.append(start)
    return starts[: len(gap.tracks)]


def _draw_spectrum(residuals: StepResiduals) -> Figure:
    units = ("(m/s²)²/Hz", "(rad/s²)²/Hz")
    with styled_figure(SIZE) as figure:
        groups = zip(figure.subplots(1, 2), GROUPS, units, strict=True)
        for axes, (group, _, _), unit in groups:
            for index in range(*group.indices(6)):
                axes.plot(
                    residuals.frequencies,
                    np.maximum(residuals.densities[:, index], 1e-16),
                    color=PALETTE[index % 3],
                    linewidth=1.1,
                    label=AXES[index],
                )
            axes.set_xscale("log")
            axes.set_yscale("log")
            low, high = (math.log10(limit) for limit in axes.get_ylim())
            axes.set_ylim(10.0 ** math.floor(low), 10.0 ** math.ceil(high))
            axes.set_xlabel("frequency [Hz]")
            axes.set_ylabel(f"residual acceleration [{unit}]")
            axes.legend(loc="best")
    return figure


def _draw_shares(gap: Gap) -> Figure:
    """Draw the shares of the causes, each from the end of the one before, and of the rest."""
    assert gap.attribution is not None
    causes = gap.attribution.causes
    names = [cause.coefficient.name for cause in causes]
    shares = [100.0 * cause.share for cause in causes]
    texts = [f"{format_share(cause.share)}, {format_factor(cause)}" for cause in causes]
    evident = gap.attribution.evident_cause
    colours = [PALETTE[1] if cause is evident else PALETTE[0] for cause in causes]
    rest = 100.0 * gap.attribution.unexplained_share
    names, shares, texts = (
        [*names, "unexplained"],
        [*shares, rest],
        [*texts, format_share(rest / 100.0)],
    )
    starts = [sum(shares[:row]) for row in range(len(shares))]
    with styled_figure((7.2, 0.95 + 0.34 * len(shares))) as figure:
        axes = figure.subplots()
        axes.barh(
            range(len(shares)),
            shares,
            left=starts,
            color=[*colours, REST],
            height=BAR_HEIGHT,
        )
        axes.spines["bottom"].set_bounds(0.0, 100.0)
        for row, (start, share, text) in enumerate(zip(starts, shares, texts, strict=True)):
            end = start + share
            if row + 1 < len(shares):
                edges = [row + 0.5 * BAR_HEIGHT, row + 1.0 - 0.5 * BAR_HEIGHT]
                axes.plot([end, end], edges, color=GREY, linewidth=0.7)
            is_left = start > 50.0
            axes.text(
                start - 1.0 if is_left else end + 1.0,
                row,
                text,
                va="center",
                ha="right" if is_left else "left",
                fontsize=7,
                color=INK,
                bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.0},
            )
        axes.set_yticks(range(len(shares)), names)
        axes.invert_yaxis()
        axes.grid(visible=False, axis="y")
        axes.set_xlim(0.0, 145.0 if max(starts) <= 50.0 or starts[-1] <= 50.0 else 130.0)
        axes.set_xticks(range(0, 101, 20))
        axes.set_xlabel(f"share of the error of {gap.attribution.duration:g} s [%]", loc="left")
    return figure
