"""``uwsim manoeuvres``: standard manoeuvres and tank experiments of a vehicle."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ...base.terminal import clean_text
from ..options.help_texts import INPUT, option
from ..options.options import JsonOption, OutputOption, OverwriteOption
from ..output.console import standard_output
from ..output.progress import progress

if TYPE_CHECKING:
    from rich.console import Console

    from ...manoeuvres.report.tables import NumberTable

SceneArgument = Annotated[
    str, typer.Argument(metavar="SCENE", help="Scene file or bundled scene with the vehicle.")
]


@dataclass(frozen=True, kw_only=True)
class ManoeuvreOptions:
    """The vehicle of the manoeuvres."""

    vehicle: Annotated[
        str | None,
        option(
            INPUT,
            "--vehicle",
            metavar="NAME",
            help="Vehicle with <u:dynamics>; the first by default.",
        ),
    ] = None
    length: Annotated[
        float | None,
        option(
            INPUT,
            "--length",
            metavar="L",
            help="Length of the vehicle [m]; that of its hull by default.",
            min=0.01,
            max=1000.0,
        ),
    ] = None
    tank: Annotated[
        bool, option(INPUT, "--tank/--no-tank", help="Tow, bollard pull and free decay, too.")
    ] = True


@dataclass(frozen=True, kw_only=True)
class ReportOutput:
    """The directory of the report."""

    out: OutputOption = Path("manoeuvres")
    overwrite: OverwriteOption = False


def manoeuvres(
    scene: SceneArgument,
    options: ManoeuvreOptions,
    output: ReportOutput,
    as_json: JsonOption = False,
) -> None:
    """Measure a vehicle: turning circle, zig-zag, spiral, pull-out, crash stop, tank.

    The vehicle of SCENE is alone in still, deep water. It is steered by its fins, or by its
    thrusters, where a rudder angle is a share of their yaw moment. Numbers are those of IMO
    MSC.137(76) and ITTC's procedures, in lengths of the vehicle.

    It writes manoeuvres.json, tracks, plots and report.html. docs/manoeuvres.md defines each
    number.
    """
    from ...assets.bundled import scene_file
    from ...manoeuvres.experiment import make_experiment
    from ...manoeuvres.report import WRITTEN_FILES, WRITTEN_FOLDERS, write_report
    from ...manoeuvres.report.document import json_text
    from ...manoeuvres.report.tables import make_tables
    from ...manoeuvres.tank import run_tank
    from ...manoeuvres.trials import N_RUNS, run_trials
    from ...results.directory import check_output
    from ...scene.reader import read_scene

    out = output.out
    check_output(
        out,
        overwrite=output.overwrite,
        pattern=WRITTEN_FILES,
        folders=WRITTEN_FOLDERS,
        hint="Use --overwrite to replace its content.",
    )
    path = scene_file(scene)
    experiment = make_experiment(read_scene(path), vehicle=options.vehicle, length=options.length)
    with progress("manoeuvres", N_RUNS, unit="runs") as count:
        trials = run_trials(experiment, count)
    tank = run_tank(experiment) if options.tank else None
    write_report(experiment, trials, tank, out, path.name, overwrite=output.overwrite)
    if as_json:
        print(json_text(experiment, trials, tank, path.name), end="")
        return
    for table in make_tables(trials, tank, experiment.length):
        print_table(table, standard_output())
    print(clean_text(f"written: {out}/report.html, manoeuvres.json, plots, tracks"))


def print_table(table: NumberTable, console: Console) -> None:
    """Print a table of the report."""
    from rich.markup import escape
    from rich.table import Table

    grid = Table(title=table.title, title_justify="left")
    for index, name in enumerate(table.columns):
        grid.add_column(escape(name), justify="left" if index == 0 else "right", no_wrap=index > 0)
    for row in table.rows:
        grid.add_row(*map(escape, row))
    console.print(grid)
