"""Plots of what happened within the levels of a run: measures over time, tracks from above."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ...base.files.file_names import file_names
from ...errors import ResultError
from ...results.log import load_log, logs_of
from ...results.per_level import rows_by_level
from ...results.result import Result
from .one_level import NOTE, one_level_plot
from .over_time import note_of, over_time_plot
from .save import save_pdf, save_plot
from .track_plot import read_tracks, track_plot

TRACK = "track"
ONE_LEVEL = "repeats"
OVER_TIME = "-over-time"


@dataclass(frozen=True, kw_only=True)
class RunPlot:
    """A plot of what happened within the levels."""

    path: Path
    """The PNG."""
    measure: str | None
    """The measure that it shows over time; None for the tracks."""
    caption: str
    """What it shows; the caption of a measure comes before it."""


def draw_run_plots(
    result: Result, directory: Path, folder: Path, *, pdf: bool = False
) -> tuple[RunPlot, ...]:
    """Draw every measure that has a log over time, and the tracks of the vehicles from above.

    Args:
        result: the result.
        directory: of the result; its logs and motion tracks are read.
        folder: the plots are written there.
        pdf: also draw each as PDF.
    """
    plots: list[RunPlot] = []
    if len(rows_by_level(result)) == 1 and len(result.rows) > 1:
        figure = one_level_plot(result)
        if figure is not None:
            path = save_plot(figure, folder / f"{ONE_LEVEL}.png")
            plots.append(RunPlot(path=path, measure=None, caption=f"The repeats; {NOTE}"))
            if pdf:
                save_pdf(figure, path.with_suffix(".pdf"))
    logs = {}
    for path in logs_of(directory):
        try:
            log = load_log(path)
        except ResultError:
            continue  # a damaged log has no plot
        logs[path.stem] = log
    order = {column.name: i for i, column in enumerate(result.columns_of_kind("measure"))}
    files = file_names(logs, existing_names=[TRACK, ONE_LEVEL])
    for stem, log in sorted(logs.items(), key=lambda each: order.get(each[1].measure, len(order))):
        figure = over_time_plot(result, log)
        if figure is not None:
            name = files[stem].removeprefix("measure-")
            path = save_plot(figure, folder / f"{name}{OVER_TIME}.png")
            n_seeds = len({row[0] for row in result.rows}) if result.columns_of_kind("run") else 1
            note = note_of(n_seeds)
            caption = "over the time of the level" + (f"; {note}" if note else "")
            plots.append(RunPlot(path=path, measure=log.measure, caption=caption))
            if pdf:
                save_pdf(figure, path.with_suffix(".pdf"))
    figure = track_plot(result, read_tracks(result, directory))
    if figure is not None:
        path = save_plot(figure, folder / f"{TRACK}.png")
        caption = "Tracks of the vehicles and loose objects from above, in the world frame"
        plots.append(RunPlot(path=path, measure=None, caption=caption))
        if pdf:
            save_pdf(figure, path.with_suffix(".pdf"))
    return tuple(plots)
