"""The captions of figures, with the meaning of their marks."""

from __future__ import annotations

from collections.abc import Mapping

from ...results.measures_file import MeasureNote
from ...results.per_level import seeds_of
from ...results.result import Column, Result
from ..plots import curves_of, is_fog_swept, label_of, repeats_of

Notes = Mapping[str, MeasureNote]
"""The description of each measure, by its name."""
STATISTICS = {
    "mean": "mean over each level",
    "rms": "root mean square over each level",
    "max": "greatest value of each level",
    "last": "last value of each level",
}
"""The text in a caption for each statistic that can be the value of a measure."""


def figure_caption(result: Result, column: Column, notes: Notes) -> str:
    """Return the caption of the figure of a column.

    For example ``corners [px]: distance between truth g and estimate e; mean over each level``.
    """
    if column.kind == "score":
        return f"{label_of(result, column)} = {column.expression}" if column.expression else (
            label_of(result, column)
        )  # fmt: skip
    label, note = label_of(result, column), notes.get(column.name)
    statistic = statistic_of(result, column.name, notes)
    if note is None or not note.meaning:
        return label + (f", {statistic}" if statistic else "")
    return f"{label}: {note.meaning}" + (f"; {statistic}" if statistic else "")


def caption_over_time(result: Result, measure: str, time_text: str, notes: Notes) -> str:
    """Return the caption of a measure over time: ``corners [px]: distance ..., over the time``."""
    names = {column.name: column for column in result.columns_of_kind("measure")}
    label = label_of(result, names[measure]) if measure in names else measure
    note = notes.get(measure)
    if note is None or not note.meaning or note.value == "last":
        return f"{label} {time_text}"
    return f"{label}: {note.meaning}, {time_text}"


def statistic_of(result: Result, measure: str, notes: Notes) -> str:
    """Return the statistic that is the value of a measure, as text; empty if it is unknown.

    The benchmark file states the statistic (``u:value``). If the measure has no note, its values
    are compared with its details: if no detail is equal, the statistic is the last value; if
    several are equal, it is unknown.
    """
    if (note := notes.get(measure)) is not None:
        return STATISTICS.get(note.value, "")
    names = {column.name for column in result.columns}
    values = result.values(measure)
    details = [key for key in STATISTICS if f"{measure}.{key}" in names]
    if not details or all(value is None for value in values):
        return ""
    equal_details = [key for key in details if result.values(f"{measure}.{key}") == values]
    if len(equal_details) > 1:
        return ""
    return STATISTICS[equal_details[0] if equal_details else "last"]


def marks_text(result: Result, *, has_control: bool) -> str:
    """Explain points, bands, lines and crosses of the figures."""
    n_repeats = len(set(repeats_of(result)))
    columns = result.columns_of_kind("score", "measure")
    curves = curves_of(result, columns[0].name) if columns else []
    messages = ["Points: one value for each level."]
    if n_repeats > 1:
        messages = [
            f"Points: means over {n_repeats} repeats ({seeds_text(result)}).",
            "Bands: 95 % intervals of that mean (smoothed bootstrap-t over the repeats).",
            "Dots: repeats. Boxes: quartiles and median; whiskers: up to 1.5 times the box.",
            "Hollow points: levels at which a repeat has no value.",
        ]
    if any(curve.losses for curve in curves):
        line_text = (
            "Solid vertical lines and the band between them: earliest and latest of the first "
            "levels that did not end ok, over the repeats."
            if len({level for level, _ in curves[0].losses}) > 1
            else "Solid vertical line: first level that did not end ok."
        )
        messages.append(
            line_text
            if len(curves) == 1
            else "Cross: last value before the first level that did not end ok."
        )
    if result.fact("f_star") is not None and is_fog_swept(result):
        messages.append("Dotted: f*, the predicted loss of a tracker that compares by ZNCC.")
    if has_control:
        messages.append(
            "Dashed: the control run (frozen), which reads no image; "
            "where it is far above, the legend states its values."
        )
    return " ".join(messages)


def seeds_text(result: Result) -> str:
    """Return ``seed 1``, ``seeds 1 to 3`` or ``seeds 1, 5, 9``."""
    seeds = sorted({seed for seed in seeds_of(result) if seed is not None})
    if not seeds:
        return "no seed is known"
    if len(seeds) == 1:
        return f"seed {seeds[0]}"
    if seeds == list(range(seeds[0], seeds[-1] + 1)):
        return f"seeds {seeds[0]} to {seeds[-1]}"
    return "seeds " + ", ".join(map(str, seeds))
