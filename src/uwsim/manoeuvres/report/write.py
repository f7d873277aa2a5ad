"""The writing of the report of manoeuvres into its directory."""

from __future__ import annotations

import re
from pathlib import Path

from ...analysis.plots import save_pdf, save_plot
from ...base.files.staging import stage_directory
from ...results.atomic_file import write_text
from ...results.directory import clear_directory
from ..experiment import Experiment
from ..tank import TankResults
from ..trials import TrialResults
from .document import json_text, track_text
from .manoeuvre_plots import draw_spiral, draw_stop, draw_turning_circles, draw_zigzags
from .page import render
from .tables import make_tables
from .tank_plots import draw_tank, draw_tows

WRITTEN_FILES = re.compile(
    r"(manoeuvres\.json|report\.html|tracks/[a-z0-9-]+\.csv"
    r"|plots/(turning-circle|zigzag|spiral|stop|tow|tank)\.(png|pdf))"
)
"""The paths of the files that uwsim writes into the directory of a report."""
WRITTEN_FOLDERS = ("plots", "tracks")


def write_report(
    experiment: Experiment,
    trials: TrialResults,
    tank: TankResults | None,
    directory: Path,
    source: str,
    *,
    overwrite: bool = False,
) -> None:
    """Write numbers, tracks, plots and page.

    Args:
        experiment: the vehicle.
        trials: the results of the manoeuvres.
        tank: the results of the tank; None if they were not made.
        directory: the directory.
        source: the name of the scene.
        overwrite: whether to replace an earlier report.

    Raises:
        BadSetting: the directory holds other files, or an earlier report without `overwrite`.
    """
    with stage_directory(directory) as draft:
        figures = {
            "turning-circle": draw_turning_circles(trials),
            "zigzag": draw_zigzags(trials),
            "spiral": draw_spiral(trials),
            "stop": draw_stop(trials),
        }
        if tank is not None:
            figures |= {"tow": draw_tows(tank), "tank": draw_tank(tank)}
        plots = []
        for name, figure in figures.items():
            plots.append(save_plot(figure, draft / "plots" / f"{name}.png"))
            save_pdf(figure, draft / "plots" / f"{name}.pdf")
        (draft / "tracks").mkdir(parents=True, exist_ok=True)
        for name, run in zip(
            (
                "turning-circle-starboard", "turning-circle-port", "zigzag-10", "zigzag-20",
                "pull-out-starboard", "pull-out-port", "crash-stop",
            ),
            (*trials.turn_runs, *trials.zigzag_runs, *trials.pull_out_runs, trials.stop_run),
            strict=True,
        ):  # fmt: skip
            write_text(draft / "tracks" / f"{name}.csv", track_text(run.track))
        write_text(draft / "manoeuvres.json", json_text(experiment, trials, tank, source))
        tables = make_tables(trials, tank, experiment.length)
        write_text(draft / "report.html", render(experiment, trials, tables, plots, source))
        clear_directory(
            directory, overwrite=overwrite, pattern=WRITTEN_FILES, folders=WRITTEN_FOLDERS
        )
