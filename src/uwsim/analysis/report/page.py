"""The page of a report, rendered from its template.

Drawn from the result directory alone (``result.json``, logs, images, ``provenance.json``), so an
old run can be drawn again. The file holds its images and its style in itself, loads nothing, runs
no script (a content security policy forbids both), and every name that came from a file is text.

A directory ``control`` inside it, the same benchmark run with `frozen`, gives every plot its
dashed line.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from ...errors import ResultError
from ...results.atomic_file import write_text
from ...results.directory import CONTROL, REPLAY, REPORT
from ...results.journal import recorded_trials
from ...results.journal_check import check_rows
from ...results.log import logs_of
from ...results.measures_file import load_measures
from ...results.per_level import LevelInterval, intervals_of, rows_by_level
from ...results.provenance import load_provenance
from ...results.result import Result
from ...results.result_file import file_of, load
from ...results.table import MAX_FIXED, number_text, sensible_decimals, unit_of
from ..plots import (
    LEVEL_WORDS,
    MAX_INSIDE,
    OVERVIEW,
    RunPlot,
    algorithm_of,
    draw_plots,
    draw_run_plots,
    is_fog_swept,
    repeats_of,
    written_unit,
)
from ..templates import template
from .captions import Notes, caption, marks, over_time_caption, seeds_text, statistic_of
from .caveats import floor, is_static, optics
from .configuration import (
    command,
    facts,
    logs_text,
    machine,
    remarks,
    settings,
    variations,
    warnings,
)
from .images import data_url, images_text, phase_images, shown_images
from .outcomes import Ending, breaks, endings, named_level
from .rows import all_cells, heads, level_rows
from .task_section import task_section

MAX_CARDS = 12
SHORT_LIST = 6
"""Greatest number of image streams with an open list."""


@dataclass(frozen=True, kw_only=True)
class Card:
    """A number worth reading first."""

    label: str
    """What it is."""
    value: str
    """The number with its unit."""
    note: str = ""
    """How it was found."""


def write_report(path: Path, *, pdf: bool = False) -> Path:
    """Draw plots and ``report.html`` of a result directory (or its ``result.json``).

    Args:
        path: the directory, or the file in it.
        pdf: also draw every plot as PDF.

    Raises:
        ResultError: there is no result, it cannot be read, or it contradicts its journals.
    """
    directory = file_of(path).parent
    result = load(path)
    unchecked = check_rows(result, directory)
    control = _control(directory)
    plots = draw_plots(result, directory / "plots", control=control, pdf=pdf)
    run_plots = draw_run_plots(result, directory, directory / "plots", pdf=pdf)
    target = directory / REPORT
    page = render(
        result,
        directory,
        plots=plots,
        run_plots=run_plots,
        control=control,
        unchecked=unchecked,
    )
    write_text(target, page)
    return target


def render(
    result: Result,
    directory: Path,
    *,
    plots: Iterable[Path],
    run_plots: Iterable[RunPlot] = (),
    control: Result | None = None,
    unchecked: str | None = None,
) -> str:
    """Return the report's HTML; ``unchecked`` is the text returned by `check_rows`."""
    found = endings(result)
    provenance, notes = load_provenance(directory), load_measures(directory)
    images = shown_images(result, directory)
    return template("report.html.j2").render(
        title=result.inputs.title,
        algorithm=algorithm_of(result) or "no algorithm",
        lead=_lead(result),
        task=task_section(result, directory / "plots"),
        phases=phase_images(result, directory),
        remarks=remarks(result),
        warnings=warnings(result, unchecked),
        command=command(result, provenance),
        cards=_cards(result, found),
        heads=heads(result),
        table=level_rows(result),
        n_levels=len(rows_by_level(result)),
        values=_values(result, notes),
        repeats=len(set(repeats_of(result))) or 1,
        full=all_cells(result),
        replay=REPLAY if (directory / REPLAY).is_file() else None,
        has_motion=bool(recorded_trials(directory)),
        n_rows=len(result.rows),
        plots=_captioned_plots(result, notes, plots),
        run_plots=_captioned_run_plots(result, notes, run_plots),
        are_wide=_n_curves(result) > MAX_INSIDE,
        marks=marks(result, has_control=control is not None),
        images=images,
        which_images=images_text(result, len(images)),
        endings=found,
        breaks=breaks(result),
        settings=settings(result),
        inputs=list(result.inputs.files()),
        facts=facts(result),
        variations=variations(result),
        streams=[
            (
                f"seed {stream.seed}"
                + (f", {named_level(result, stream.level)}" if stream.level else ""),
                stream,
            )
            for stream in result.image_streams
        ],
        short_list=SHORT_LIST,
        logs=logs_text(logs_of(directory)),
        is_static=is_static(result),
        floor=floor(result),
        optics=optics(result, found),
        provenance=machine(provenance),
        version=result.run.version or "?",
    )


def _captioned_plots(result: Result, notes: Notes, plots: Iterable[Path]) -> list[tuple[str, str]]:
    """Return caption and image of the plot of each score and measure over the levels."""
    if len(rows_by_level(result)) < 2:
        return []
    columns = result.columns_of_kind("score") + result.columns_of_kind("measure")
    return [
        (caption(result, column, notes), data_url(plot.read_bytes(), "png"))
        for column, plot in zip(
            columns, (plot for plot in plots if plot.stem != OVERVIEW), strict=False
        )
    ]


def _captioned_run_plots(
    result: Result, notes: Notes, plots: Iterable[RunPlot]
) -> list[tuple[str, str]]:
    """Return caption and image of each plot over time."""
    return [
        (
            plot.caption
            if plot.measure is None
            else over_time_caption(result, plot.measure, plot.caption, notes),
            data_url(plot.path.read_bytes(), "png"),
        )
        for plot in plots
    ]


def _lead(result: Result) -> str:
    """One sentence: what was swept, over what, how often."""
    levels = rows_by_level(result)
    spans, counts = [], []
    for i, column in enumerate(result.columns_of_kind("level")):
        values = sorted({level[i] for level in levels})
        word = LEVEL_WORDS.get(column.name, column.name)
        if word and values:
            span = f"{values[0]:g}" + (f" to {values[-1]:g}" if len(values) > 1 else "")
            spans.append(f"{word} {span}{_space(column.unit)}")
            counts.append(len(values))
    over = " and ".join(spans) or "one scene"
    n_repeats = len(set(repeats_of(result)))
    many = f", {n_repeats} repeats" if n_repeats > 1 else ""
    count = f"{len(levels)} level" + ("s" if len(levels) != 1 else "")
    if len(counts) > 1:
        count += f" ({' × '.join(map(str, counts))})"
    mode = result.run.mode or "sequential"
    return f"{count}, {over}{many}; {mode}, {seeds_text(result)}."


def _cards(result: Result, found: Sequence[Ending]) -> list[Card]:
    n_ok = sum(ending.n for ending in found if ending.status == "ok")
    share = f"{n_ok} of {len(result.rows)}"
    cards = [Card(label="rows that ended ok", value=share, note="a row: one level of one repeat")]
    for ending in found:
        if ending.status != "ok" and ending.n:
            note = ending.reasons[0][1] if ending.reasons else "no reason was given"
            cards.append(Card(label=f"first {ending.status}", value=ending.first, note=note))
    star = result.fact("f_star")
    if star is not None and is_fog_swept(result):
        note = "fog at which the patch's ZNCC should fall to its threshold"
        value = f"{rounded(star[0], star[0])}{_space(star[1])}"
        cards.append(Card(label="loss predicted at f*", value=value, note=note))
    for column in result.columns_of_kind("score") + result.columns_of_kind("measure"):
        known = [e for e in intervals_of(result, column.name) if e.interval.mean is not None]
        if not known:
            continue
        first, last = known[0], known[-1]
        value, other, at = _mean_text(first, last), _mean_text(last, first), ""
        if len(known) > 1:
            value += f" to {other}" if value != other else ""
            at = f"at {named_level(result, first.level)} and {named_level(result, last.level)}"
        unit = _space(unit_of(result, column))
        cards.append(Card(label=column.name, value=value + unit, note=at))
    return cards[:MAX_CARDS]


def _mean_text(entry: LevelInterval, other: LevelInterval) -> str:
    """The mean of a level, beside that of another one."""
    return rounded(entry.interval.mean or 0.0, other.interval.mean or 0.0)


def rounded(value: float, against: float) -> str:
    """Return a number in three digits; in those of another one where it is nothing against that.

    Whole numbers beside whole numbers, as counts, have no decimals.
    """
    if (
        value == round(value)
        and against == round(against)
        and max(abs(value), abs(against)) < MAX_FIXED
    ):
        return f"{value:.0f}".replace("-", "−")
    measure = against if abs(value) < 1e-3 * abs(against) else value
    decimals = sensible_decimals([measure])
    shown = 0.0 if abs(value) < 0.5 * 10**-decimals and measure is not value else value
    if 1e3 <= abs(shown) < MAX_FIXED:
        shown = float(f"{shown:.3g}")
    return number_text(shown, decimals).replace("-", "−")


def _values(result: Result, notes: Notes) -> list[str]:
    """Say what the values in the table are: the statistic of each measure, the score, the time."""
    by_statistic: dict[str, list[str]] = {}
    for column in result.columns_of_kind("measure"):
        if statistic := statistic_of(result, column.name, notes):
            by_statistic.setdefault(statistic, []).append(column.name)
    messages = [f"{', '.join(names)}: {statistic}" for statistic, names in by_statistic.items()]
    messages += [f"total = {c.expression}" for c in result.columns_of_kind("score") if c.expression]
    if result.columns_of_kind("time"):
        over = "from its start" if result.run.mode == "independent" else "summed over the levels"
        messages.append(f"ended_at: running time when the level ended, {over}")
    return messages


def _n_curves(result: Result) -> int:
    """How many curves one plot has: one for each combination of the outer levels."""
    return len({level[:-1] for level in rows_by_level(result)})


def _space(unit: str | None) -> str:
    return f" {written_unit(unit)}" if unit else ""


def _control(directory: Path) -> Result | None:
    try:
        control = load(directory / CONTROL)
    except ResultError:
        return None
    check_rows(control, directory / CONTROL)
    return control
