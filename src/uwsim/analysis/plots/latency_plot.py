"""The plot of the delays of a run with hardware in the loop."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .style import GREY, PALETTE, styled_figure, write_note

SIZE = (7.4, 3.2)  # [inch]
N_MERGED = 5
"""The number of bins, of 50 a decade, that the histogram shows as one."""
MAX_SHARE = 100.0
"""The greatest share [%], above which the axis has no numbers."""
HEAD_ROOM = 1.3
"""The height of the left axes per largest share, which leaves room for the legend."""
SHORTEST_MS = 0.01
"""The shortest delay on the axes [ms]; shorter ones are drawn there."""


@dataclass(frozen=True, eq=False)
class DelayCounts:
    """The histogram of a delay."""

    name: str
    """The name of the delay or stream."""
    edges: npt.NDArray[np.float64]
    """The edges of the bins, (n + 1,) [s]."""
    counts: npt.NDArray[np.int64]
    """The number of delays in each bin, (n,)."""
    n_early: int
    """The number of delays <= 0, which are in no bin."""
    max_delay: float
    """The max_delay delay [s]."""

    @property
    def n(self) -> int:
        """The number of delays."""
        return self.n_early + int(self.counts.sum())


def draw_latency_plot(
    delays: Sequence[DelayCounts], lateness: Sequence[DelayCounts], *, deadline: float
) -> Figure:
    """Draw the distribution of delays, and the fraction of messages that is later than a time.

    Args:
        delays: step time, output age and input to effect; those without values are left out.
        lateness: the lateness of each stream.
        deadline: the time by which data may be late [s].
    """
    with styled_figure(SIZE) as figure:
        left, right = figure.subplots(1, 2)
        for i, delay in enumerate(delays):
            _draw_density(left, delay, PALETTE[i % len(PALETTE)])
        for i, delay in enumerate(lateness):
            _draw_exceedance(right, delay, PALETTE[i % len(PALETTE)], i)
        left.set_xlabel("delay [ms]")
        left.set_ylabel("share of delays in a bin [%]")
        left.set_ylim(0.0, HEAD_ROOM * left.get_ylim()[1])
        left.set_yticks([tick for tick in left.get_yticks() if tick <= MAX_SHARE])
        right.set_xlabel("lateness [ms]")
        right.set_ylabel("share that is later")
        right.set_yscale("log")
        right.axvline(1000.0 * deadline, color=GREY, linewidth=0.9, linestyle="--")
        right.annotate(
            "deadline",
            (1000.0 * deadline, 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(3, -2),
            textcoords="offset points",
            va="top",
            fontsize=7,
            color=GREY,
        )
        for axes in (left, right):
            axes.set_xscale("log")
            axes.set_xlim(left=SHORTEST_MS)
            axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
            if axes.get_legend_handles_labels()[0]:
                axes.legend(loc="upper right" if axes is left else "lower left")
        numbers = ", ".join(f"{delay.name} {delay.n}" for delay in lateness)
        write_note(figure, f"number: {numbers}; 10 bins a decade; what is early is not drawn")
    return figure


def _draw_density(axes: Axes, delay: DelayCounts, colour: str) -> None:
    """Draw the share of delays in each of ten bins a decade."""
    counts = delay.counts[1:]  # without the bin of the shortest delays
    if not counts.any():
        return
    starts = np.arange(0, len(counts), N_MERGED)
    share = 100.0 * np.add.reduceat(counts, starts) / delay.n
    edges = 1000.0 * np.append(delay.edges[1:-1][starts], delay.edges[-1])
    indices = np.flatnonzero(share)
    start, end = int(indices[0]), int(indices[-1]) + 1
    axes.stairs(share[start:end], edges[start : end + 1], color=colour, fill=True, alpha=0.15)
    axes.stairs(share[start:end], edges[start : end + 1], color=colour, label=delay.name)


def _draw_exceedance(axes: Axes, delay: DelayCounts, colour: str, index: int) -> None:
    """Draw the share of messages that is later than a time, down to the last_time one."""
    if not delay.counts.any():
        return
    n_later = delay.n - delay.n_early - np.cumsum(delay.counts)
    is_drawn = n_later > 0
    first = (delay.n - delay.n_early) / delay.n
    last_time = max(1000.0 * delay.max_delay, SHORTEST_MS)
    times = np.concatenate(([SHORTEST_MS], 1000.0 * delay.edges[1:][is_drawn], [last_time]))
    last_share = n_later[is_drawn][-1] / delay.n if is_drawn.any() else first
    shares = np.concatenate(([first], n_later[is_drawn] / delay.n, [last_share]))
    style = ("-", "--", "-.", ":")[index % 4]
    axes.plot(
        np.maximum(times, SHORTEST_MS),
        shares,
        color=colour,
        linestyle=style,
        label=delay.name,
        drawstyle="steps-post",
    )
    axes.plot([last_time], [last_share], color=colour, marker="o", markersize=3)
