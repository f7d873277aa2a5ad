"""The HTML page of a comparison: one file without scripts, which loads no other file."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ...results.per_level import success_rates
from ...results.result import Result
from ...statistics import Interval
from ...version import __version__
from ..plots import written_unit
from ..templates import data_url, template
from .matrix import few_repeats_text, matrix, matrix_note, matrix_title
from .model import Comparison, PairComparison
from .sentences import distinct_texts, sentences
from .terminal import TIME_LEGEND, heading, lines
from .time_table import time_heading, time_lines, time_sentence

CAPTIONS = {
    "curves": "Mean over the repeats of each result, with its 95 % interval.",
    "differences": "Paired differences with their 95 % intervals. A filled marker is a level at "
    "which one result is better after Holm's correction.",
    "times": "Share of all trials that have succeeded by each time (Kaplan and Meier), from the "
    "beginning of the trial up to the time limit.",
    "success": "Share of repeats that ended ok, with its exact 95 % interval. The markers are "
    "shifted so that none hides another.",
}


def render(comparison: Comparison, plots: Sequence[Path]) -> str:
    """Return the HTML of the page."""
    return template("comparison.html.j2").render(
        title=comparison.entries[0].result.inputs.title,
        names=[entry.name for entry in comparison.entries],
        lead=_lead(comparison),
        cards=[_card(pair, comparison.column.unit) for pair in comparison.pairs],
        matrix=matrix(comparison),
        matrix_title=matrix_title(comparison),
        matrix_note=matrix_note(comparison),
        experiment_differences=comparison.experiment_differences,
        remarks=comparison.remarks,
        plots=[(CAPTIONS[plot.stem], data_url(plot.read_bytes(), "png")) for plot in plots],
        pairs=[
            {
                "heading": heading(comparison, pair),
                "first": pair.first.name,
                "second": pair.second.name,
                "words": sentences(comparison, pair),
                "levels": [
                    (column.name, column.unit)
                    for column in pair.first.result.columns_of_kind("level")
                ],
                "lines": lines(comparison, pair),
                "time_heading": time_heading(pair),
                "time_lines": time_lines(pair),
                "time_sentence": time_sentence(comparison, pair),
            }
            for pair in comparison.pairs
        ],
        time_legend=TIME_LEGEND,
        results=[
            {
                "name": entry.name,
                "source": entry.source,
                "sha256": entry.sha256,
                "rows": _run_fields(entry.result),
            }
            for entry in comparison.entries
        ],
        inputs=[*comparison.entries[0].result.inputs.files()],
        version=__version__,
    )


def _lead(comparison: Comparison) -> str:
    column = comparison.column
    unit = f" [{written_unit(column.unit)}]" if column.unit else ""
    function = f" = {column.expression}" if column.expression else ""
    direction = "higher" if comparison.higher_is_better else "lower"
    baseline = f"; {comparison.baseline.name} is the baseline" if comparison.baseline else ""
    levels = len(comparison.levels)
    repeats = max(len(stats.seeds) for pair in comparison.pairs for stats in pair.levels)
    return (
        f"{column.name}{unit}{function}, {direction} is better; {_count_text(levels, 'level')}, "
        f"{_count_text(repeats, 'repeat')}{baseline}."
    )


def _count_text(n: int, word: str) -> str:
    return f"{n} {word}" + ("s" if n != 1 else "")


def _card(pair: PairComparison, unit: str | None) -> dict[str, str]:
    d = pair.sweep.value
    verdict_text = {
        "first": f"{pair.first.name} better",
        "second": f"{pair.second.name} better",
        "equal": "equal",
        "one repeat": "one repeat: no inference",
        "no pair": "not compared",
        "too few": few_repeats_text(d)[0].lower() + few_repeats_text(d)[1:],
    }.get(d.verdict, "no difference shown")
    return {
        "label": f"{pair.second.name} against {pair.first.name}, the sweep as a whole",
        "value": verdict_text,
        "note": _difference_text(d.difference, unit),
    }


def _difference_text(d: Interval, unit: str | None) -> str:
    if d.mean is None:
        return ""
    unit_text = f" {written_unit(unit)}" if unit else ""
    text = f"difference {d.mean:.3g}{unit_text}"
    if d.low is not None and d.high is not None:
        low, high = distinct_texts(d.low, d.high)
        text += f", 95 % interval {low} to {high}{unit_text}"
    return text.replace("-", "−")


def _run_fields(result: Result) -> list[tuple[str, str]]:
    run = result.run
    seeds = sorted({s for rate in success_rates(result) for s in rate.seeds if s is not None})
    versions = {"mode": run.mode, "version": run.version, "renderer": run.renderer}
    return [
        ("algorithm", run.algorithm or ""),
        *((f"parameter {name}", _word(value)) for name, value in (run.parameters or {}).items()),
        ("seeds", " ".join(map(str, seeds))),
        *((name, value) for name, value in versions.items() if value is not None),
    ]


def _word(value: object) -> str:
    return f"{value:.10g}" if isinstance(value, float) else str(value)
