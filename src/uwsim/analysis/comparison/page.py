"""The page of a comparison: one HTML file that loads nothing and runs nothing."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from pathlib import Path

from ...results.per_level import success_rates
from ...results.result import Result
from ...statistics import Interval
from ...version import __version__
from ..plots import written_unit
from ..templates import template
from .matrix import matrix, note, too_few
from .matrix import title as matrix_title
from .model import Comparison, Versus
from .sentences import sentences, told_apart
from .terminal import heading, lines

CAPTIONS = {
    "curves": "Mean over the repeats of each result, with its 95 % interval.",
    "differences": "Paired differences with their 95 % intervals; a filled marker is a level at "
    "which one is better after Holm's correction.",
    "success": "Share of repeats that ended ok, with its exact 95 % interval; the results stand a "
    "little apart, so that none hides another.",
}


def render(comparison: Comparison, plots: Sequence[Path]) -> str:
    """Return the page's HTML."""
    return template("comparison.html.j2").render(
        title=_title(comparison),
        names=[entry.name for entry in comparison.entries],
        lead=_lead(comparison),
        cards=[_card(versus, comparison.column.unit) for versus in comparison.versus],
        matrix=matrix(comparison),
        matrix_title=matrix_title(comparison),
        matrix_note=note(comparison),
        forced=comparison.forced,
        remarks=comparison.remarks,
        plots=[(CAPTIONS[plot.stem], _data_url(plot.read_bytes())) for plot in plots],
        pairs=[
            {
                "heading": heading(comparison, versus),
                "first": versus.first.name,
                "second": versus.second.name,
                "words": sentences(comparison, versus),
                "levels": [
                    (column.name, column.unit)
                    for column in versus.first.result.columns_of_kind("level")
                ],
                "lines": lines(comparison, versus),
            }
            for versus in comparison.versus
        ],
        results=[
            {
                "name": entry.name,
                "source": entry.source,
                "sha256": entry.sha256,
                "rows": _about(entry.result),
            }
            for entry in comparison.entries
        ],
        inputs=[*comparison.entries[0].result.inputs.files()],
        version=__version__,
    )


def _title(comparison: Comparison) -> str:
    return comparison.entries[0].result.inputs.title


def _lead(comparison: Comparison) -> str:
    column = comparison.column
    unit = f" [{written_unit(column.unit)}]" if column.unit else ""
    function = f" = {column.expression}" if column.expression else ""
    better = "higher" if comparison.higher_is_better else "lower"
    against = f"; {comparison.baseline.name} is the baseline" if comparison.baseline else ""
    levels = len(comparison.levels)
    repeats = max(len(at.seeds) for versus in comparison.versus for at in versus.levels)
    return (
        f"{column.name}{unit}{function}, {better} is better; {_many(levels, 'level')}, "
        f"{_many(repeats, 'repeat')}{against}."
    )


def _many(n: int, word: str) -> str:
    return f"{n} {word}" + ("s" if n != 1 else "")


def _card(versus: Versus, unit: str | None) -> dict[str, str]:
    d = versus.overall.value
    texts = {
        "first": f"{versus.first.name} better",
        "second": f"{versus.second.name} better",
        "equal": "equal",
        "one repeat": "one repeat: no inference",
        "no pair": "not compared",
        "too few": too_few(d)[0].lower() + too_few(d)[1:],
    }.get(d.verdict, "no difference shown")
    return {
        "label": f"{versus.second.name} against {versus.first.name}, the sweep as a whole",
        "value": texts,
        "note": _spread(d.difference, unit),
    }


def _spread(d: Interval, unit: str | None) -> str:
    if d.mean is None:
        return ""
    behind = f" {written_unit(unit)}" if unit else ""
    text = f"difference {d.mean:.3g}{behind}"
    if d.low is not None and d.high is not None:
        low, high = told_apart(d.low, d.high)
        text += f", 95 % interval {low} to {high}{behind}"
    return text.replace("-", "−")


def _about(result: Result) -> list[tuple[str, str]]:
    """What differs from result to result: parameters, seeds, versions."""
    run = result.run
    seeds = sorted({s for at in success_rates(result) for s in at.seeds if s is not None})
    versions = {"mode": run.mode, "version": run.version, "renderer": run.renderer}
    return [
        ("algorithm", run.algorithm or ""),
        *((f"parameter {name}", _word(value)) for name, value in (run.parameters or {}).items()),
        ("seeds", " ".join(map(str, seeds))),
        *((name, value) for name, value in versions.items() if value is not None),
    ]


def _word(value: object) -> str:
    return f"{value:.10g}" if isinstance(value, float) else str(value)


def _data_url(data: bytes) -> str:
    return f"data:image/png;base64,{base64.b64encode(data).decode('ascii')}"
