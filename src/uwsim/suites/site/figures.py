"""The figures of a task on the page: how its trials end, and the times to success."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from matplotlib.figure import Figure

from ...analysis.overview.tasks import OverviewTask
from ...analysis.plots import PALETTE, SIZE, escape, save_plot, styled_figure
from ...analysis.plots.style import shorten_name
from ...analysis.task import draw_success_curve, success_times, task_measure
from ...analysis.task.success_times import is_judged_at_end, longest_level
from ...statistics import success_curve

SUCCESS_COLOUR = PALETTE[2]
FAILURE_COLOURS = (PALETTE[1], PALETTE[4], PALETTE[3], PALETTE[5], PALETTE[0], PALETTE[6])
"""The colours of the failures; after the last the first follow again, with the next hatch."""
HATCHES = ("", "////", "....", "xxxx")
"""The hatches of the failures."""
MIN_LABEL_SHARE = 0.06
"""The share of a bar from which its number is written in it [1]."""


def endings(task: OverviewTask) -> dict[str, Counter[str]]:
    """Return the number of trials with each status, by the name of the submission."""
    counts = {}
    for entry in task.entries:
        column = entry.result.columns_of_kind("status")[0].name
        counts[entry.name] = Counter(str(status) for status in entry.result.values(column))
    return counts


def all_statuses(tasks: Sequence[OverviewTask]) -> list[str]:
    """Return all statuses of tasks: ``ok``, then the failures by the number of tasks with them.

    The place of a status determines its colour, which is the same in all tasks.
    """
    n_tasks: Counter[str] = Counter()
    for task in tasks:
        n_tasks.update({status for counts in endings(task).values() for status in counts})
    failures = sorted((s for s in n_tasks if s != "ok"), key=lambda s: (-n_tasks[s], s))
    return ["ok", *failures]


def draw_endings(task: OverviewTask, statuses: Sequence[str]) -> Figure:
    """Draw the shares of the statuses as a stacked bar for each submission.

    Args:
        task: the task.
        statuses: the statuses of all tasks (`all_statuses`).
    """
    counts_by_name = endings(task)
    own_statuses = [s for s in statuses if any(counts[s] for counts in counts_by_name.values())]
    with styled_figure((SIZE[0] + 1.6, 0.9 + 0.3 * len(task.entries))) as figure:
        axes = figure.subplots()
        for y, counts in enumerate(counts_by_name.values()):
            left, n = 0.0, counts.total()
            for status in own_statuses:
                share, (colour, hatch) = counts[status] / n, _appearance(statuses.index(status))
                bar = axes.barh(y, share, left=left, color=colour, hatch=hatch,
                                edgecolor="white", height=0.7, linewidth=0.8)  # fmt: skip
                if y == 0:
                    bar.set_label(escape(shorten_name(status, 24)))
                if share >= MIN_LABEL_SHARE:
                    axes.text(left + share / 2, y, str(counts[status]), ha="center", va="center",
                              color="white", fontsize=7)  # fmt: skip
                left += share
        names = [escape(shorten_name(entry.name, 24)) for entry in task.entries]
        axes.set_yticks(range(len(names)), names)
        axes.invert_yaxis()
        axes.grid(visible=False)
        axes.set(xlim=(0.0, 1.0), xlabel="share of trials [1]")
        figure.legend(loc="outside right upper")
    return figure


def _appearance(i: int) -> tuple[str, str]:
    """Return the colour and the hatch of the status of an index; 0 is a success."""
    if i == 0:
        return SUCCESS_COLOUR, ""
    cycle, place = divmod(i - 1, len(FAILURE_COLOURS))
    return FAILURE_COLOURS[place], HATCHES[cycle % len(HATCHES)]


def draw_times(task: OverviewTask) -> Figure | None:
    """Draw the share of trials that succeeded by each time (Kaplan and Meier); None without times.

    There is none either if the success is judged at the end of a level (`is_judged_at_end`), or
    if all successes are at the end of a level, which has a fixed length. The axis ends with the
    longest level of all submissions. All levels together. Their trials are not independent, so
    there are no intervals.
    """
    curves = []
    for entry in task.entries:
        has_times = task_measure(entry.result) and not is_judged_at_end(entry.result)
        times = success_times(entry.result) if has_times else None
        if times and (curve := success_curve(times)) is not None:
            curves.append((entry.name, curve))
    limit = max((longest_level(entry.result) for entry in task.entries), default=0.0)
    if not any(time < limit for _, curve in curves for time in curve.times[1:]):
        return None
    with styled_figure((SIZE[0] + 1.6, 2.6)) as figure:
        axes = figure.subplots()
        for i, (name, curve) in enumerate(curves):
            draw_success_curve(axes, curve, limit, i, shorten_name(name, 24), has_band=False)
        axes.set(xlabel="time [s]", ylabel="share that succeeded [1]")
        axes.set(xlim=(0.0, limit), ylim=(-0.03, 1.03))
        figure.legend(loc="outside right upper")
    return figure


def png(figure: Figure) -> bytes:
    """Return a figure as the bytes of a PNG file."""
    with TemporaryDirectory(prefix="uwsim-") as folder:
        return save_plot(figure, Path(folder) / "figure.png").read_bytes()
