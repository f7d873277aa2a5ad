"""``uwsim gap``: the error of the simulation of a log, window by window."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from ...base.terminal import clean_text, print_warnings
from ...errors import BadSetting, ErrorCollector
from ..options.help_texts import INPUT, option
from ..options.options import (
    DataPathOption,
    JsonOption,
    OutputOption,
    OverwriteOption,
    SettingOptions,
)
from ..output.console import standard_output
from ..output.progress import progress
from ..render import load_scene
from ..run import scene_settings


@dataclass(frozen=True, kw_only=True)
class GapOptions:
    """The input of a measurement of the gap."""

    mapping: Annotated[
        Path | None,
        option(
            INPUT,
            "--mapping",
            metavar="FILE",
            help="Mapping file: columns, topics or channels of the log, with units and frames.",
        ),
    ] = None
    write_mapping: Annotated[
        Path | None,
        option(
            INPUT,
            "--write-mapping",
            metavar="FILE",
            help="Write a mapping file to edit, for a CSV log, and stop.",
        ),
    ] = None
    vehicle: Annotated[
        str | None,
        option(
            INPUT,
            "--vehicle",
            metavar="NAME",
            help="The vehicle of the scene, and of the recording's topics.",
        ),
    ] = None
    windows: Annotated[
        int,
        option(
            INPUT,
            "--windows",
            metavar="N",
            help="Greatest number of windows, from 2 to 1000.",
            min=2,
            max=1000,
        ),
    ] = 60
    horizons: Annotated[
        str,
        option(
            INPUT,
            "--horizons",
            metavar="T,T,...",
            help="Times after the beginning of a window at which the error is taken [s].",
        ),
    ] = "1,5,20"
    seed: Annotated[
        int, option(INPUT, "--seed", metavar="N", min=0, help="Seed of the intervals' resamples.")
    ] = 0
    open_water: Annotated[
        bool,
        option(
            INPUT,
            "--open-water",
            help="Leave out the objects of the scene, such as floor and walls: the log may have "
            "another origin.",
        ),
    ] = False
    attribution: Annotated[
        bool,
        option(
            INPUT,
            "--attribution/--no-attribution",
            help="Search for the coefficient that explains the error.",
        ),
    ] = True


@dataclass(frozen=True, kw_only=True)
class GapOutput:
    """The directory of the gap."""

    out: OutputOption = Path("gap")
    overwrite: OverwriteOption = False


def gap(
    log: Annotated[
        Path,
        typer.Argument(
            metavar="LOG",
            help="A log: .csv, .mcap, .bag, .db3, a rosbag2 folder, DataFlash .bin, or .tlog.",
        ),
    ],
    scene: Annotated[
        str | None,
        typer.Argument(metavar="SCENE", help="A scene with the vehicle, or a bundled name."),
    ] = None,
    *,
    options: GapOptions,
    changes: SettingOptions,
    output: GapOutput,
    as_json: JsonOption = False,
    data_path: DataPathOption = None,
) -> None:
    """Measure the reality gap: simulate a log's commands from its states, and compare.

    At the beginning of each window the simulated vehicle gets the pose, twist and rotor speeds of
    the log, then its commands. The report has the error of each degree of freedom after 1, 5 and
    20 s with intervals. It also has the spectrum of the residual, and the residuals of sensors. One
    sentence states which error dominates and which coefficient explains it.

    It writes report.html, gap.json, windows.csv and plots. docs/reality-gap.md explains the
    numbers, docs/logs.md the formats of logs and the mapping file.
    """
    if options.write_mapping is not None:
        write_template(log, options.write_mapping)
        return
    if scene is None:
        raise BadSetting("Missing SCENE; expected a scene with the vehicle of the log.")
    from ...checks import model_warnings
    from ...logs import read_log
    from ...physics.compile_scene import compile_scene
    from ...reality_gap import measure_gap, remove_objects
    from ...reality_gap.report import PAGE, WRITTEN_FILES, WRITTEN_FOLDERS, print_gap, write_gap
    from ...reality_gap.report.document import json_text
    from ...reality_gap.settings import GapSettings
    from ...results.directory import check_output
    from ...runs.planning.option_values import compatibility_of

    folders, errors = tuple(data_path or ()), ErrorCollector()
    settings, spec, vehicle_log = GapSettings(), None, None
    with errors.collect():
        settings = GapSettings(
            n_windows=options.windows,
            horizons=parse_horizons(options.horizons),
            seed=options.seed,
            has_attribution=options.attribution,
        )
    with errors.collect():
        check_output(
            output.out,
            overwrite=output.overwrite,
            pattern=WRITTEN_FILES,
            folders=WRITTEN_FOLDERS,
            hint="Use --overwrite to replace its content.",
        )
    with errors.collect():
        spec = load_scene(scene, folders, scene_settings(changes), errors)
    quirks = compatibility_of(changes.compat or [], errors)
    with errors.collect():
        vehicle_log = read_log(log, mapping=options.mapping, vehicle=options.vehicle)
    errors.raise_errors()
    assert spec is not None
    assert vehicle_log is not None
    if options.open_water:
        spec = remove_objects(spec)
    model = compile_scene(spec, seed=settings.seed, data_path=folders, compatibility=quirks)
    print_warnings(model_warnings(model))
    measured_gap = measure_gap(
        vehicle_log,
        model,
        vehicle=options.vehicle,
        settings=settings,
        progress=lambda title, total: progress(title, total, unit="runs"),
    )
    write_gap(measured_gap, output.out, overwrite=output.overwrite)
    if as_json:
        print(json_text(measured_gap), end="")
        return
    print_gap(measured_gap, standard_output())
    print(clean_text(f"written: {output.out}/{PAGE}, gap.json, windows.csv, plots"))


def parse_horizons(text: str) -> tuple[float, ...]:
    """Return the horizons of a text, ``1,5,20`` [s]; raise BadSetting."""
    try:
        return tuple(float(part) for part in text.split(","))
    except ValueError:
        raise BadSetting(
            f"--horizons {text!r:.60}: expected times [s] with commas, as 1,5,20."
        ) from None


def write_template(log: Path, path: Path) -> None:
    """Write a mapping file to edit."""
    from ...logs.csv_columns import template_text
    from ...logs.csv_log import read_header
    from ...results.atomic_file import write_text

    if log.suffix.lower() != ".csv":
        raise BadSetting(f"{log}: --write-mapping writes the template of a CSV log.")
    if path.exists():
        raise BadSetting(f"{path} exists; choose another name.")
    write_text(path, template_text(read_header(log)))
    print(clean_text(f"written: {path}"))
