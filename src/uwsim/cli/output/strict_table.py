"""What was late with the strict clock, as a table, as JSON and as a plot."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.table import Table
from rich.text import Text

from .console import standard_output

if TYPE_CHECKING:
    from ...middleware.strict import Delays, StrictReport

PERCENTILES = (50.0, 95.0, 99.0, 99.9)
"""The percentiles of delays in tables."""
HEADINGS = tuple(f"{percent:g} %" for percent in PERCENTILES)


def print_strict_report(report: StrictReport) -> None:
    """Print what was late, and the delays [ms]."""
    console = standard_output()
    table = Table(box=None, padding=(0, 2, 0, 0), pad_edge=False)
    table.add_column("stream", no_wrap=True, style="bold")
    table.add_column("kind", no_wrap=True)
    for name in ("number", "on time", "late", "missing", "no reader", *HEADINGS, "worst [ms]"):
        table.add_column(Text(name), justify="right")
    for stream in report.streams:
        counts = (stream.n, stream.n_on_time, stream.n_late, stream.n_missing, stream.n_unread)
        table.add_row(stream.name, stream.kind, *map(str, counts), *_format_delays(stream.lateness))
    console.print(table)
    delays = Table(box=None, padding=(0, 2, 0, 0), pad_edge=False)
    delays.add_column("delay", no_wrap=True, style="bold")
    for name in ("number", *HEADINGS, "worst [ms]"):
        delays.add_column(Text(name), justify="right")
    for name, values in _named_delays(report).items():
        delays.add_row(name, str(values.n), *_format_delays(values))
    console.print(delays)
    lost_note = f"; lost {report.lost_time:.3g} s" if report.lost_time else ""
    print(
        f"{report.duration:.4g} s in real time, deadline {1000.0 * report.deadline:g} ms: "
        f"{report.n_errors} late or missing{lost_note}"
    )


def strict_document(report: StrictReport) -> dict[str, Any]:
    """Return the report for JSON; times are in seconds."""
    return {
        "deadline": report.deadline,
        "duration": report.duration,
        "lost_time": report.lost_time,
        "errors": report.n_errors,
        "streams": [
            {
                "name": stream.name,
                "kind": stream.kind,
                "rate": stream.rate,
                "number": stream.n,
                "on_time": stream.n_on_time,
                "late": stream.n_late,
                "missing": stream.n_missing,
                "no_reader": stream.n_unread,
                "lateness": _delays_document(stream.lateness),
            }
            for stream in report.streams
        ],
        "delays": {
            name.replace(" ", "_"): _delays_document(values)
            for name, values in _named_delays(report).items()
        },
    }


def draw_latency(report: StrictReport, path: Path) -> None:
    """Draw the delays of a run as PNG."""
    from ...analysis.plots import save_plot
    from ...analysis.plots.latency_plot import DelayCounts, draw_latency_plot
    from ...middleware.strict.delays import bin_edges

    edges = bin_edges()
    delays = [
        DelayCounts(name, edges, values.counts, values.n_early, values.max_delay)
        for name, values in _named_delays(report).items()
    ]
    lateness = [
        DelayCounts(
            stream.name,
            edges,
            stream.lateness.counts,
            stream.lateness.n_early,
            stream.lateness.max_delay,
        )
        for stream in report.streams
    ]
    save_plot(draw_latency_plot(delays, lateness, deadline=report.deadline), path)


def _named_delays(report: StrictReport) -> dict[str, Delays]:
    return {
        "step time": report.step_time,
        "output age": report.output_age,
        "input to effect": report.input_to_effect,
    }


def _delays_document(delays: Delays) -> dict[str, Any]:
    from ...middleware.strict.delays import bin_edges

    edges = bin_edges()
    bins = [
        [float(edges[i]), float(edges[i + 1]), int(delays.counts[i])]
        for i in np.flatnonzero(delays.counts).tolist()
    ]
    percentiles = {
        f"{percent:g}": None if delays.n == 0 else delays.percentile(percent)
        for percent in PERCENTILES
    }
    max_delay = delays.max_delay if delays.n else None
    return {
        "number": delays.n,
        "early": delays.n_early,
        "percentiles": percentiles,
        "worst": max_delay,
        "histogram": bins,
    }


def _format_delays(delays: Delays) -> list[str]:
    values = [delays.percentile(percent) for percent in PERCENTILES]
    values.append(delays.max_delay if delays.n else math.nan)
    return ["-" if math.isnan(value) else f"{1000.0 * value:.3g}" for value in values]
