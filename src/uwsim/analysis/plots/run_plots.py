"""Plots of what happens within the levels of a run: measures over time, tracks, and repeats."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from matplotlib.figure import Figure

from ...base.files.file_names import file_names
from ...errors import ResultError
from ...results.log import load_log, logs_of
from ...results.per_level import rows_by_level
from ...results.result import Result
from .one_level import MARKS_NOTE, one_level_plot
from .save import save_pdf, save_plot
from .time_plots import marks_note, time_plot
from .track_plot import read_tracks, track_plot

TRACK_PLOT_NAME = "track"
ONE_LEVEL_PLOT_NAME = "repeats"
TIME_PLOT_SUFFIX = "-over-time"


@dataclass(frozen=True, kw_only=True)
class RunPlot:
    """A plot of a run that is not a column over the levels."""

    path: Path
    """The path of the PNG file."""
    measure: str | None
    """The name of the measure that the plot shows over time; None for other plots."""
    caption: str
    """The caption; for a measure, the part that follows the measure's name and meaning."""


def draw_run_plots(
    result: Result, directory: Path, folder: Path, *, pdf: bool = False
) -> tuple[RunPlot, ...]:
    """Draw every logged measure over time, the tracks, and the repeats of a single level.

    Args:
        result: the result.
        directory: the result directory, with its logs and motion tracks.
        folder: the folder for the plots.
        pdf: True to write each plot as PDF, too.

    Returns:
        The plots in this order: the repeats, if the result has a single level; the measures, in
        the order of their columns; the tracks from above. A plot without data is left out.
    """
    plots: list[RunPlot] = []

    def add_plot(figure: Figure | None, name: str, caption: str, measure: str | None) -> None:
        if figure is not None:
            path = save_plot(figure, folder / f"{name}.png")
            plots.append(RunPlot(path=path, measure=measure, caption=caption))
            if pdf:
                save_pdf(figure, path.with_suffix(".pdf"))

    if len(rows_by_level(result)) == 1 and len(result.rows) > 1:
        caption = f"The repeats; {MARKS_NOTE}"
        add_plot(one_level_plot(result), ONE_LEVEL_PLOT_NAME, caption, None)
    logs = {}
    for path in logs_of(directory):
        try:
            log = load_log(path)
        except ResultError:
            continue  # a damaged log has no plot
        logs[path.stem] = log
    order = {column.name: i for i, column in enumerate(result.columns_of_kind("measure"))}
    files = file_names(logs, existing_names=[TRACK_PLOT_NAME, ONE_LEVEL_PLOT_NAME])
    for stem, log in sorted(logs.items(), key=lambda item: order.get(item[1].measure, len(order))):
        name = files[stem].removeprefix("measure-") + TIME_PLOT_SUFFIX
        n_seeds = len({row[0] for row in result.rows}) if result.columns_of_kind("run") else 1
        note = marks_note(n_seeds)
        caption = "over the time of the level" + (f"; {note}" if note else "")
        add_plot(time_plot(result, log), name, caption, log.measure)
    caption = "Tracks of the vehicles and free objects from above, in the world frame"
    add_plot(track_plot(result, read_tracks(result, directory)), TRACK_PLOT_NAME, caption, None)
    return tuple(plots)
