"""``uwsim identify``: fit the coefficients of a vehicle to logs of its motion and commands."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from ...base.terminal import clean_text
from ...errors import BadSetting, ErrorCollector
from ..options.help_texts import INPUT, SEARCH, option
from ..options.options import JsonOption, OutputOption, OverwriteOption
from ..output.console import standard_output

if TYPE_CHECKING:
    from ...identification import IdentifySettings
    from ...scene.spec import SceneSpec

LogArguments = Annotated[
    list[Path] | None,
    typer.Argument(
        metavar="LOG... VEHICLE",
        help="Logs, then the vehicle: its hydrodynamics file, a bundled name, or its name in "
        "--scene.",
    ),
]


@dataclass(frozen=True, kw_only=True)
class IdentifyInput:
    """The input of an identification."""

    coefficients: Annotated[
        str,
        option(
            INPUT,
            "--free",
            metavar="NAMES",
            help="Coefficients to fit, as added_mass,drag,thrust or added_mass[surge].",
        ),
    ] = "added_mass,drag"
    scene: Annotated[
        str | None,
        option(
            INPUT,
            "--scene",
            metavar="SCENE",
            help="Scene with the vehicle: its frame L, density and robot.",
        ),
    ] = None
    robot: Annotated[
        str | None,
        option(INPUT, "--robot", metavar="URDF", help="Robot, without --scene [VEHICLE.urdf]."),
    ] = None
    mapping: Annotated[
        Path | None,
        option(
            INPUT,
            "--mapping",
            metavar="TOML",
            help="Mapping file: columns or topics, units and frames of the logs.",
        ),
    ] = None
    noise: Annotated[
        str,
        option(
            INPUT,
            "--noise",
            metavar="LIST",
            help="Noise of the motion, as position=0.005,velocity=0.003 [estimated].",
        ),
    ] = ""
    planar_mode: Annotated[
        bool | None,
        option(
            INPUT,
            "--planar/--no-planar",
            help="Surface craft: hold heave, roll and pitch [for logs without depth and heave].",
        ),
    ] = None
    example: Annotated[
        Path | None,
        option(
            INPUT,
            "--example",
            metavar="DIR",
            help="Write a simulated log and a first guess into DIR, to try the command.",
        ),
    ] = None


@dataclass(frozen=True, kw_only=True)
class FitOptions:
    """The windows, the starts and the loss of a fit."""

    window: Annotated[
        float,
        option(SEARCH, "--window", metavar="S", help="Length of a window [s].", min=0.1, max=600.0),
    ] = 5.0
    step: Annotated[
        float,
        option(
            SEARCH, "--step", metavar="S", help="Step of the simulation [s].", min=1e-4, max=0.02
        ),
    ] = 0.005
    rate: Annotated[
        float,
        option(
            SEARCH, "--rate", metavar="HZ", help="Greatest rate of samples.", min=0.1, max=1000.0
        ),
    ] = 10.0
    starts: Annotated[
        int, option(SEARCH, "--starts", metavar="N", help="Number of starts.", min=1, max=100)
    ] = 4
    folds: Annotated[
        int,
        option(
            SEARCH,
            "--folds",
            metavar="N",
            help="Folds of the cross-validation; 0: none.",
            min=0,
            max=100,
        ),
    ] = 4
    loss: Annotated[
        str,
        option(SEARCH, "--loss", metavar="NAME", help="linear, or huber for logs with outliers."),
    ] = "linear"
    seed: Annotated[
        int, option(SEARCH, "--seed", metavar="N", min=0, help="Seed of the starts.")
    ] = 0


@dataclass(frozen=True, kw_only=True)
class IdentificationOutput:
    """The directory of an identification."""

    out: OutputOption = Path("identification")
    overwrite: OverwriteOption = False


def identify(
    source: IdentifyInput,
    fit: FitOptions,
    output: IdentificationOutput,
    words: LogArguments = None,
    as_json: JsonOption = False,
) -> None:
    """Fit hydrodynamic coefficients of a vehicle to logs of its motion and commands.

    Windows of the logs are simulated from initial states that are fitted, too. The result is a
    hydrodynamics file with 95 % intervals and provenance, identification.json, plots and
    report.html. It names coefficients that the logs do not determine, and manoeuvres that would.
    docs/identification.md lists the names for --free and explains the numbers.
    """
    from ...results.directory import check_output

    if source.example is not None:
        if words:
            raise BadSetting("--example writes a log and a first guess; omit LOG and VEHICLE.")
        print_example(source.example)
        return
    if not words or len(words) < 2:
        raise BadSetting(
            "Expected LOG... VEHICLE; uwsim identify --example DIR writes a log and a vehicle."
        )
    from ...identification import identify as compute_identification
    from ...identification import open_vehicle
    from ...identification.report import (
        WRITTEN_FILES,
        WRITTEN_FOLDERS,
        print_tables,
        write_identification,
    )
    from ...identification.report.document import json_text
    from ...logs import read_log
    from ..output.progress import progress

    check_output(
        output.out,
        overwrite=output.overwrite,
        pattern=WRITTEN_FILES,
        folders=WRITTEN_FOLDERS,
        hint="Use --overwrite to replace its content.",
    )
    paths, vehicle = words[:-1], str(words[-1])
    errors = ErrorCollector()
    settings, logs = None, []
    with errors.collect():
        settings = make_settings(source, fit)
    for path in paths:
        with errors.collect():
            logs.append(read_log(path, mapping=source.mapping))
    errors.raise_errors()
    assert settings is not None
    scene = read_scene_of(source, vehicle)
    model = open_vehicle(scene, vehicle if source.scene is not None else None)
    with progress("identify", settings.n_pieces, unit="pieces") as count_piece:
        result = compute_identification(logs, model, settings, on_progress=lambda *_: count_piece())
    names = write_identification(result, output.out, overwrite=output.overwrite)
    if as_json:
        print(json_text(result), end="")
        return
    print_tables(result, standard_output())
    print(clean_text(f"written: {output.out}/{', '.join(names)}"))


def make_settings(source: IdentifyInput, fit: FitOptions) -> IdentifySettings:
    """Return the settings; raise BadSetting with every error."""
    from ...identification import IdentifySettings, WindowSettings
    from ...identification.noise import parse_noise

    losses: dict[str, Literal["linear", "huber"]] = {"linear": "linear", "huber": "huber"}
    if fit.loss not in losses:
        raise BadSetting(f"--loss {fit.loss!r}: expected linear or huber.")
    return IdentifySettings(
        free_names=tuple(name for name in source.coefficients.split(",") if name.strip()),
        windows=WindowSettings(length=fit.window, step=fit.step, rate=fit.rate),
        n_starts=fit.starts,
        n_folds=fit.folds,
        loss=losses[fit.loss],
        noise=parse_noise(source.noise),
        is_planar=source.planar_mode,
        seed=fit.seed,
    )


def read_scene_of(source: IdentifyInput, vehicle: str) -> SceneSpec:
    """Return the scene of ``--scene``, or one that is made for the vehicle."""
    from ...assets.bundled import scene_file
    from ...identification import make_scene
    from ...scene.reader import read_scene

    if source.scene is None:
        return make_scene(vehicle, source.robot)
    if source.robot is not None:
        raise BadSetting("--robot: the scene names the robot; omit --robot, or --scene.")
    return read_scene(scene_file(source.scene, ()))


def print_example(directory: Path) -> None:
    """Write the example and print how to use it."""
    from ...identification.example import ROBOT, write_example

    if directory.exists() and (not directory.is_dir() or any(directory.iterdir())):
        raise BadSetting(f"--example {directory}: not an empty directory.")
    log, guess = write_example(directory)
    print(
        clean_text(
            f"written: {log}, {guess}; next: "
            f"uwsim identify {log} {guess} --robot {ROBOT} --free added_mass,drag"
        )
    )
