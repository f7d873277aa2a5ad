"""The figures of a task on the page: how its trials end, and the times to success."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from tempfile import TemporaryDirectory

from matplotlib.figure import Figure

from ...analysis.overview.tasks import OverviewTask
from ...analysis.plots import PALETTE, SIZE, escape, save_plot, styled_figure
from ...analysis.plots.style import shorten_name
from ...analysis.task import draw_success_curve, success_times, task_measure
from ...analysis.task.success_times import time_limit
from ...statistics import success_curve

SUCCESS_COLOUR = PALETTE[2]
FAILURE_COLOURS = (PALETTE[1], PALETTE[4], PALETTE[3], PALETTE[5], PALETTE[0], PALETTE[6])
"""The colours of the failures, the most frequent first."""
MIN_LABEL_SHARE = 0.06
"""The share of a bar from which its number is written in it [1]."""


def endings(task: OverviewTask) -> dict[str, Counter[str]]:
    """Return the number of trials with each status, by the name of the submission."""
    counts = {}
    for entry in task.entries:
        column = entry.result.columns_of_kind("status")[0].name
        counts[entry.name] = Counter(str(status) for status in entry.result.values(column))
    return counts


def statuses_of(task: OverviewTask) -> list[str]:
    """Return all statuses of a task: ``ok``, then the failures by frequency."""
    total: Counter[str] = Counter()
    for counts in endings(task).values():
        total.update(counts)
    failures = sorted((s for s in total if s != "ok"), key=lambda status: (-total[status], status))
    return ["ok", *failures]


def draw_endings(task: OverviewTask) -> Figure:
    """Draw the shares of the statuses as a stacked bar for each submission."""
    statuses = statuses_of(task)
    with styled_figure((SIZE[0] + 1.6, 0.9 + 0.3 * len(task.entries))) as figure:
        axes = figure.subplots()
        for y, counts in enumerate(endings(task).values()):
            left, n = 0.0, counts.total()
            for i, status in enumerate(statuses):
                share = counts[status] / n
                colour = (
                    SUCCESS_COLOUR if i == 0 else FAILURE_COLOURS[(i - 1) % len(FAILURE_COLOURS)]
                )
                bar = axes.barh(
                    y, share, left=left, color=colour, edgecolor="white", height=0.7, linewidth=0.8
                )
                if y == 0:
                    bar.set_label(escape(shorten_name(status, 24)))
                if share >= MIN_LABEL_SHARE:
                    axes.text(
                        left + share / 2,
                        y,
                        str(counts[status]),
                        ha="center",
                        va="center",
                        color="white",
                        fontsize=7,
                    )
                left += share
        names = [escape(shorten_name(entry.name, 24)) for entry in task.entries]
        axes.set_yticks(range(len(names)), names)
        axes.invert_yaxis()
        axes.grid(visible=False)
        axes.set(xlim=(0.0, 1.0), xlabel="share of trials [1]")
        figure.legend(loc="outside right upper")
    return figure


def draw_times(task: OverviewTask) -> Figure | None:
    """Draw the share of trials that succeeded by each time (Kaplan and Meier); None without times.

    There is none either if all successes are at the end of a level, which has a fixed length. The
    limit is that of all submissions. All levels together. Their trials are not independent, so
    there are no intervals.
    """
    curves = []
    for entry in task.entries:
        times = success_times(entry.result) if task_measure(entry.result) else None
        if times and (curve := success_curve(times)) is not None:
            curves.append((entry.name, curve, time_limit(times) or 0.0))
    limit = max((end for _, _, end in curves), default=0.0)
    if not any(time < limit for _, curve, _ in curves for time in curve.times[1:]):
        return None
    with styled_figure((SIZE[0] + 1.6, 2.6)) as figure:
        axes = figure.subplots()
        for i, (name, curve, _) in enumerate(curves):
            draw_success_curve(axes, curve, limit, i, shorten_name(name, 24), has_band=False)
        axes.set(xlabel="time [s]", ylabel="share that succeeded [1]")
        axes.set(xlim=(0.0, limit), ylim=(-0.03, 1.03))
        figure.legend(loc="outside right upper")
    return figure


def png(figure: Figure) -> bytes:
    """Return a figure as the bytes of a PNG file."""
    with TemporaryDirectory(prefix="uwsim-") as folder:
        return save_plot(figure, Path(folder) / "figure.png").read_bytes()
