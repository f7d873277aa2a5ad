"""Captions of figures, with the meaning of their marks."""

from __future__ import annotations

from collections.abc import Mapping

from ...results.measures_file import MeasureNote
from ...results.per_level import seeds_of
from ...results.result import Column, Result
from ..plots import curves_of, is_fog_swept, label_of, repeats_of

Notes = Mapping[str, MeasureNote]
"""Measure -> what it is."""
STATISTICS = {
    "mean": "mean over each level",
    "rms": "root mean square over each level",
    "max": "greatest value of each level",
}
"""Detail of a measure -> its text in a caption."""


def caption(result: Result, column: Column, notes: Notes) -> str:
    """Return the caption of a figure.

    ``corners [px]: distance between truth g and estimate e; mean over each level``.
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


def over_time_caption(result: Result, measure: str, what: str, notes: Notes) -> str:
    """Return the caption of a measure over time: ``corners [px], distance ..., over the time``."""
    names = {column.name: column for column in result.columns_of_kind("measure")}
    label = label_of(result, names[measure]) if measure in names else measure
    note = notes.get(measure)
    if note is None or not note.meaning or note.value == "last":
        return f"{label} {what}"
    return f"{label}: {note.meaning}, {what}"


def statistic_of(result: Result, measure: str, notes: Notes) -> str:
    """Return which statistic a measure's values are; empty where nothing shows it.

    The benchmark file says it (``u:value``); of results without `notes` the details show it.
    """
    if (note := notes.get(measure)) is not None:
        return STATISTICS.get(note.value, "")
    names = {column.name for column in result.columns}
    values = result.values(measure)
    details = [key for key in STATISTICS if f"{measure}.{key}" in names]
    if not details or all(value is None for value in values):
        return ""
    same = [key for key in details if result.values(f"{measure}.{key}") == values]
    if len(same) > 1:
        return ""
    return STATISTICS[same[0]] if same else "last value of each level"


def marks(result: Result, *, has_control: bool) -> str:
    """Explain points, bands, lines and crosses of the figures."""
    n_repeats = len(set(repeats_of(result)))
    columns = result.columns_of_kind("score", "measure")
    curves = curves_of(result, columns[0].name) if columns else []
    messages = ["Points: one value a level."]
    if n_repeats > 1:
        messages = [
            f"Points: means over {n_repeats} repeats ({seeds_text(result)}).",
            "Bands: 95 % intervals of that mean (smoothed bootstrap-t over the repeats).",
            "Dots: one a repeat. Boxes: quartiles and median; whiskers: up to 1.5 times the box.",
            "Hollow points: levels at which not every repeat has a value.",
        ]
    if any(curve.losses for curve in curves):
        over = ", over the repeats from the first to the last" if n_repeats > 1 else ""
        messages.append(
            f"Solid vertical line: first level that did not end ok{over}."
            if len(curves) == 1
            else "Cross: last value before the first level that did not end ok."
        )
    if result.fact("f_star") is not None and is_fog_swept(result):
        messages.append("Dotted: f*, where a tracker that compares by ZNCC should lose the patch.")
    if has_control:
        messages.append(
            "Dashed: the control frozen, which never looks at an image; "
            "where it is far above, the legend gives its values."
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
