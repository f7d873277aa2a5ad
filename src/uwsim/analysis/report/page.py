"""The page of a report, rendered from its template.

The page is made from the result directory alone (``result.json``, logs, images,
``provenance.json``), so reports of old runs can be written again. The file contains its images and
its style. A content security policy forbids scripts and other files, and every name from a file is
escaped.

The folder ``control``, if present, holds the result of the control run: a baseline that ignores the
images (the algorithm ``frozen``). Every plot then shows it as a dashed line.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from ...errors import ResultError
from ...results.atomic_file import write_text
from ...results.directory import CONTROL_FOLDER, REPLAY, REPORT
from ...results.journal import recorded_trials
from ...results.journal_check import check_rows
from ...results.log import logs_of
from ...results.measures_file import load_measures
from ...results.per_level import LevelInterval, intervals_of, rows_by_level
from ...results.provenance import load_provenance
from ...results.result import ImageStream, Result
from ...results.result_file import file_of, load
from ...results.table import MAX_FIXED, number_text, sensible_decimals, unit_of
from ..plots import (
    MAX_INSIDE,
    OVERVIEW_NAME,
    RunPlot,
    algorithm_of,
    draw_plots,
    draw_run_plots,
    is_fog_swept,
    level_word,
    repeats_of,
    written_unit,
)
from ..templates import data_url, template
from .captions import Notes, caption_over_time, figure_caption, marks_text, seeds_text, statistic_of
from .caveats import error_floor_text, is_static, optics_texts
from .configuration import (
    command,
    facts,
    logs_text,
    provenance_texts,
    remarks,
    settings,
    variations,
    warnings,
)
from .images import images_text, phase_images, shown_images
from .outcomes import Ending, endings, first_failures, result_level_text
from .rows import all_cells, column_heads, level_rows
from .task_section import task_section

MAX_CARDS = 12
MAX_OPEN_STREAMS = 6
"""The greatest number of image streams for which the list is shown unfolded."""


@dataclass(frozen=True, kw_only=True)
class Card:
    """One of the main values at the top of the page."""

    label: str
    """The name of the value."""
    value: str
    """The value with its unit."""
    note: str = ""
    """The levels to which the value applies, or the reason for the status."""


def write_report(path: Path, *, pdf: bool = False) -> Path:
    """Write the plots and ``report.html`` of a result directory (or its ``result.json``).

    Args:
        path: the directory, or the file in it.
        pdf: write every plot as PDF, too.

    Raises:
        ResultError: there is no result, it cannot be read, or it contradicts its journals.
    """
    directory = file_of(path).parent
    result = load(path)
    check_note = check_rows(result, directory)
    control = _load_control(directory)
    plots = draw_plots(result, directory / "plots", control=control, pdf=pdf)
    run_plots = draw_run_plots(result, directory, directory / "plots", pdf=pdf)
    target = directory / REPORT
    page = render(
        result,
        directory,
        plots=plots,
        run_plots=run_plots,
        control=control,
        check_note=check_note,
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
    check_note: str | None = None,
) -> str:
    """Return the HTML of the report.

    Args:
        result: the result.
        directory: the directory of the result.
        plots: the files of the plots over the levels.
        run_plots: the plots over the time of a run.
        control: the result of the control run (`frozen`); None without one.
        check_note: the note on rows that could not be checked against their journals; None if all
            were checked (`check_rows`).
    """
    ending_groups = endings(result)
    provenance, notes = load_provenance(directory), load_measures(directory)
    images = shown_images(result, directory)
    return template("report.html.j2").render(
        title=result.inputs.title,
        algorithm=algorithm_of(result) or "no algorithm",
        lead=_lead(result),
        task=task_section(result, directory / "plots"),
        phases=phase_images(result, directory),
        remarks=remarks(result),
        warnings=warnings(result, check_note),
        command=command(result, provenance),
        cards=_cards(result, ending_groups),
        heads=column_heads(result),
        table=level_rows(result),
        n_levels=len(rows_by_level(result)),
        value_notes=_value_notes(result, notes),
        repeats=len(set(repeats_of(result))) or 1,
        all_cells=all_cells(result),
        replay=REPLAY if (directory / REPLAY).is_file() else None,
        has_motion=bool(recorded_trials(directory)),
        n_rows=len(result.rows),
        plots=_captioned_plots(result, notes, plots),
        run_plots=_captioned_run_plots(result, notes, run_plots),
        are_wide=_count_curves(result) > MAX_INSIDE,
        marks=marks_text(result, has_control=control is not None),
        images=images,
        images_text=images_text(result, len(images)),
        endings=ending_groups,
        first_failures=first_failures(result),
        settings=settings(result),
        inputs=list(result.inputs.files()),
        facts=facts(result),
        variations=variations(result),
        streams=[
            (_stream_name(result, stream), stream)
            for stream in result.image_streams
            if stream.frames > 0
        ],
        max_open_streams=MAX_OPEN_STREAMS,
        logs=logs_text(logs_of(directory)),
        is_static=is_static(result),
        error_floor=error_floor_text(result),
        optics=optics_texts(result, ending_groups),
        provenance=provenance_texts(provenance),
        version=result.run.version or "?",
    )


def _stream_name(result: Result, stream: ImageStream) -> str:
    seed = f"seed {stream.seed}"
    return f"{seed}, {result_level_text(result, stream.level)}" if stream.level else seed


def _captioned_plots(result: Result, notes: Notes, plots: Iterable[Path]) -> list[tuple[str, str]]:
    if len(rows_by_level(result)) < 2:
        return []
    columns = result.columns_of_kind("score") + result.columns_of_kind("measure")
    column_plots = [plot for plot in plots if plot.stem != OVERVIEW_NAME]
    return [
        (figure_caption(result, column, notes), data_url(plot.read_bytes(), "png"))
        for column, plot in zip(columns, column_plots, strict=False)
    ]


def _captioned_run_plots(
    result: Result, notes: Notes, plots: Iterable[RunPlot]
) -> list[tuple[str, str]]:
    return [
        (
            plot.caption
            if plot.measure is None
            else caption_over_time(result, plot.measure, plot.caption, notes),
            data_url(plot.path.read_bytes(), "png"),
        )
        for plot in plots
    ]


def _lead(result: Result) -> str:
    levels = rows_by_level(result)
    ranges, counts = [], []
    for i, column in enumerate(result.columns_of_kind("level")):
        values = sorted({level[i] for level in levels})
        label = level_word(column)
        if label and values:
            span = f"{values[0]:g}" + (f" to {values[-1]:g}" if len(values) > 1 else "")
            ranges.append(f"{label} {span}{_unit_suffix(column.unit)}")
            counts.append(len(values))
    swept_ranges = " and ".join(ranges) or "one scene"
    n_repeats = len(set(repeats_of(result)))
    repeats_text = f", {n_repeats} repeats" if n_repeats > 1 else ""
    count = f"{len(levels)} level" + ("s" if len(levels) != 1 else "")
    if len(counts) > 1:
        count += f" ({' × '.join(map(str, counts))})"
    mode = result.run.mode or "sequential"
    return f"{count}, {swept_ranges}{repeats_text}; {mode}, {seeds_text(result)}."


def _cards(result: Result, ending_groups: Sequence[Ending]) -> list[Card]:
    n_ok = sum(ending.n for ending in ending_groups if ending.status == "ok")
    share = f"{n_ok} of {len(result.rows)}"
    cards = [Card(label="rows that ended ok", value=share, note="a row: one level of one repeat")]
    for ending in ending_groups:
        if ending.status != "ok" and ending.n:
            note = ending.reasons[0][1] if ending.reasons else "no reason was recorded"
            cards.append(Card(label=f"first {ending.status}", value=ending.first_levels, note=note))
    star = result.fact("f_star")
    if star is not None and is_fog_swept(result):
        note = "fog at which the patch's ZNCC should fall to its threshold"
        value = f"{rounded_text(star[0], star[0])}{_unit_suffix(star[1])}"
        cards.append(Card(label="predicted loss of tracking (fog f*)", value=value, note=note))
    for column in result.columns_of_kind("score") + result.columns_of_kind("measure"):
        means = [e for e in intervals_of(result, column.name) if e.interval.mean is not None]
        if not means:
            continue
        value, other_value, note = (
            _mean_text(means[0], means[-1]),
            _mean_text(means[-1], means[0]),
            "",
        )
        if len(means) > 1:
            value += f" to {other_value}" if value != other_value else ""
            ends = [result_level_text(result, entry.level) for entry in (means[0], means[-1])]
            note = f"at {' and '.join(ends)}"
        unit = _unit_suffix(unit_of(result, column))
        cards.append(Card(label=column.name, value=value + unit, note=note))
    return cards[:MAX_CARDS]


def _mean_text(entry: LevelInterval, other: LevelInterval) -> str:
    return rounded_text(entry.interval.mean or 0.0, other.interval.mean or 0.0)


def rounded_text(value: float, reference: float) -> str:
    """Return a number with three significant digits, or with the decimals of a larger reference.

    Integers with an integer reference, such as counts, have no decimals.
    """
    if (
        value == round(value)
        and reference == round(reference)
        and max(abs(value), abs(reference)) < MAX_FIXED
    ):
        return f"{value:.0f}".replace("-", "−")
    scale_value = reference if abs(value) < 1e-3 * abs(reference) else value
    decimals = sensible_decimals([scale_value])
    rounded_value = 0.0 if abs(value) < 0.5 * 10**-decimals and scale_value is not value else value
    if 1e3 <= abs(rounded_value) < MAX_FIXED:
        rounded_value = float(f"{rounded_value:.3g}")
    return number_text(rounded_value, decimals).replace("-", "−")


def _value_notes(result: Result, notes: Notes) -> list[str]:
    """Return the meaning of the values in the table: statistic of each measure, score, time."""
    by_statistic: dict[str, list[str]] = {}
    for column in result.columns_of_kind("measure"):
        if statistic := statistic_of(result, column.name, notes):
            by_statistic.setdefault(statistic, []).append(column.name)
    messages = [f"{', '.join(names)}: {statistic}" for statistic, names in by_statistic.items()]
    messages += [f"total = {c.expression}" for c in result.columns_of_kind("score") if c.expression]
    if result.columns_of_kind("time"):
        is_independent = result.run.mode == "independent"
        origin = "from its start" if is_independent else "summed over the levels"
        messages.append(f"ended_at: simulation time at the end of the level, {origin}")
    return messages


def _count_curves(result: Result) -> int:
    """Return the number of curves of a plot, one for each combination of the outer levels."""
    return len({level[:-1] for level in rows_by_level(result)})


def _unit_suffix(unit: str | None) -> str:
    return f" {written_unit(unit)}" if unit else ""


def _load_control(directory: Path) -> Result | None:
    try:
        control = load(directory / CONTROL_FOLDER)
    except ResultError:
        return None
    check_rows(control, directory / CONTROL_FOLDER)
    return control
