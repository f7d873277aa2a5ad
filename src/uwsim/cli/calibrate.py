"""``uwsim calibrate``: identify the water of a tank from pictures of LEDs and a lit board."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from ..base.terminal import clean_text
from ..errors import BadSetting
from .exit_status import RUN_FAILED
from .options.help_texts import INPUT, option
from .options.options import JsonOption, OutputOption, OverwriteOption
from .output.console import standard_output

SetupArgument = Annotated[
    Path | None,
    typer.Argument(
        metavar="SETUP",
        help="Set-up file: camera, channels, LEDs, board, waters and their pictures.",
    ),
]


@dataclass(frozen=True, kw_only=True)
class CalibrateOptions:
    """The input of a calibration, and the conditions of its quantities."""

    readings: Annotated[
        Path | None,
        option(
            INPUT,
            "--readings",
            metavar="CSV",
            help="Table of readings in place of the pictures, as readings.csv of a calibration.",
        ),
    ] = None
    distance: Annotated[
        float,
        option(
            INPUT,
            "--distance",
            metavar="D",
            help="Range of contrast and fog [m].",
            min=0.01,
            max=1000.0,
        ),
    ] = 1.36
    feature: Annotated[
        float,
        option(
            INPUT,
            "--feature",
            metavar="W",
            help="Width of the features that an algorithm needs [m].",
            min=0.0001,
            max=100.0,
        ),
    ] = 0.02
    seed: Annotated[
        int, option(INPUT, "--seed", metavar="N", min=0, help="Seed of the intervals' samples.")
    ] = 0
    example: Annotated[
        Path | None,
        option(
            INPUT,
            "--example",
            metavar="DIR",
            help="Write a set-up with synthetic pictures into DIR, to try the command.",
        ),
    ] = None


@dataclass(frozen=True, kw_only=True)
class CalibrationOutput:
    """The directory of the calibration."""

    out: OutputOption = Path("calibration")
    overwrite: OverwriteOption = False


def calibrate(
    options: CalibrateOptions,
    output: CalibrationOutput,
    setup: SetupArgument = None,
    as_json: JsonOption = False,
) -> None:
    """Identify the water of a tank: attenuation, scattering and phase function, with intervals.

    SETUP lists pictures of LEDs and of a lit board with checkers, through clear water and through
    the water to identify. A joint fit gives c, b, a and the shape of the phase function per colour
    channel. Without clear water, a board at three or more distances is sufficient.

    It writes a water file that a scene names, readings.csv, calibration.json, plots and
    report.html. docs/calibration.md gives the protocol for a tank and a phone. The exit status is 3
    if a quality gate is failed: the files are written, but the water is not to be trusted.
    """
    from ..results.directory import check_output

    if options.example is not None:
        if setup is not None:
            raise BadSetting("--example writes a set-up; omit SETUP.")
        print_example(options.example)
        return
    if setup is None:
        raise BadSetting("Missing SETUP; uwsim calibrate --example DIR writes one to try.")
    from ..calibration import View
    from ..calibration import calibrate as compute_calibration
    from ..calibration.measurements import make_measurements
    from ..calibration.pictures.picture_readings import read_pictures
    from ..calibration.quality import summarize_failures
    from ..calibration.readings_file import read_readings
    from ..calibration.report import WRITTEN_FILES, WRITTEN_FOLDERS, print_tables, write_calibration
    from ..calibration.report.document import json_text
    from ..calibration.setup import read_setup

    out = output.out
    hint = "Use --overwrite to replace its content."
    check_output(
        out,
        overwrite=output.overwrite,
        pattern=WRITTEN_FILES,
        folders=WRITTEN_FOLDERS,
        hint=hint,
    )
    spec = read_setup(setup, needs_pictures=options.readings is None)
    if options.readings is None:
        waters = read_pictures(spec, setup.parent)
    else:
        waters = read_readings(
            options.readings,
            [channel.name for channel in spec.channels],
            [water.name for water in spec.waters],
        )
    view = View(distance=options.distance, feature_width=options.feature)
    calibration = compute_calibration(make_measurements(spec, waters), view, seed=options.seed)
    water_files = write_calibration(calibration, out, setup.name, overwrite=output.overwrite)
    if as_json:
        print(json_text(calibration), end="")
    else:
        print_tables(calibration, standard_output())
        names = ", ".join(path.name for path in water_files)
        print(clean_text(f"written: {out}/{names}, readings.csv, calibration.json, report.html"))
    if summary := summarize_failures(calibration.gates):
        print(f"uwsim: {summary}", file=sys.stderr)
        raise typer.Exit(RUN_FAILED)


def print_example(directory: Path) -> None:
    """Write the example and print how to use it."""
    from ..base.files.staging import stage_directory
    from ..calibration.example.write_example import SETUP_NAME, write_example

    if directory.exists() and (not directory.is_dir() or any(directory.iterdir())):
        raise BadSetting(f"--example {directory}: not an empty directory.")
    with stage_directory(directory) as draft:
        files = write_example(draft)
    setup = directory / SETUP_NAME
    print(clean_text(f"written: {len(files)} files; next: uwsim calibrate {setup}"))
