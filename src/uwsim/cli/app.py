"""The command line ``uwsim``: the table of commands, and the handling of errors.

A command is a function with typer's annotations in a separate module. `COMMANDS` lists them; only
the requested one is imported, so that ``uwsim --help`` takes less than 0.3 s.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Annotated

import typer

from ..base.terminal import suppress_cast_warnings
from ..version import __version__
from .exit_status import INTERRUPT_STATUS, exit_status, format_error
from .old_options import reject_old_options
from .options.command import Command
from .options.completion import typed_words
from .options.help_texts import HELP_NAMES, ErrorCollectingCommand
from .suites.commands import SUITE_COMMANDS

COMMANDS: dict[str, Command] = {
    "bathymetry": Command(
        module="charts.bathymetry",
        function="bathymetry",
        summary="Make a synthetic sea floor, or describe, convert, draw a chart.",
        examples=(
            "uwsim bathymetry --rocks 5 --channels 1 --picture bay.png -o bay.tif",
            "uwsim bathymetry gebco.nc --picture gebco.png",
        ),
    ),
    "bench": Command(
        module="bench",
        function="bench",
        summary="Run a benchmark: levels, scores, table, plots and a report.",
        examples=(
            "uwsim bench visibility --seed 1",
            "uwsim bench visibility --algorithm ecc --level fog=0.5 --out ecc.result",
        ),
    ),
    "calibrate": Command(
        module="calibrate",
        function="calibrate",
        summary="Identify a tank's water from pictures of LEDs and a lit board.",
        examples=(
            "uwsim calibrate --example tank",
            "uwsim calibrate tank/setup.xml -o tank-water",
        ),
    ),
    "check": Command(
        module="check",
        function="check",
        summary="Find all errors of scene and benchmark files, with line numbers.",
        examples=("uwsim check my-scene.xml my-benchmark.xml",),
    ),
    "compare": Command(
        module="compare",
        function="compare",
        summary="Report which result is better, by how much, how certainly.",
        examples=(
            "uwsim compare esm.result ic.result",
            "uwsim compare --baseline esm.result ic.result ecc.result --measure corners",
        ),
    ),
    "container": Command(
        module="campaigns.container",
        function="container",
        summary="Print the definition of an image with uwsim, for clusters.",
        examples=(
            "uwsim container apptainer > image.def",
            "uwsim container oci --extra export > Containerfile",
        ),
    ),
    "copy": Command(
        module="copy",
        function="copy",
        summary="Copy a bundled scene or benchmark with its files, to edit.",
        examples=("uwsim copy grasp-scene", "uwsim copy grasp my-grasp"),
    ),
    "dataset": Command(
        module="learning.dataset",
        function="dataset",
        summary="Make labelled images of a scene, for learning.",
        examples=(
            "uwsim dataset shipwreck-scene -n 1000 --workers 2 --format coco,yolo -o wreck",
            "uwsim dataset visibility -n 500 --target blackbox --light 0.4..1.2 -o boxes",
        ),
    ),
    "envelope": Command(
        module="envelope",
        function="envelope",
        summary="Find the level at which a benchmark fails, with its bound.",
        examples=(
            'uwsim envelope visibility --over fog --until "corners > 5" --to 2 --repeat 20',
            "uwsim envelope grasp --over current --level fog=0",
            'uwsim envelope visibility-moving --over fog --until "status == lost" --algorithm orb',
        ),
    ),
    "export": Command(
        module="learning.export",
        function="export",
        summary="Export a recording as CSV, LeRobot or Minari.",
        examples=(
            "uwsim export dive.mcap --csv -o tables",
            "uwsim export dive.mcap --lerobot --observation /girona500/odom "
            "--action /dataNavigator -o episode",
        ),
    ),
    "gap": Command(
        module="logs.gap",
        function="gap",
        summary="Measure the error of the simulation of a real vehicle's log.",
        examples=(
            "uwsim gap dive.mcap bluerov2-scene -o dive-gap",
            "uwsim gap dive.csv pool.xml --mapping dive.toml --horizons 1,5,20",
        ),
    ),
    "identify": Command(
        module="logs.identify",
        function="identify",
        summary="Fit a vehicle's coefficients to logs, with intervals.",
        examples=(
            "uwsim identify --example swim",
            "uwsim identify dive.csv my_rov.xml --free added_mass,drag,thrust -o fit",
        ),
    ),
    "import": Command(
        module="vehicles.import_file",
        function="import_scene",
        summary="Import a world or model of Gazebo (SDF) or VRML as a scene.",
        examples=(
            "uwsim import my_world.sdf -o my_scene",
            "uwsim import models/my_rov -o my_rov",
        ),
    ),
    "info": Command(
        module="info",
        function="info",
        summary="List parts of a scene: vehicles, cameras, topics, joints, floor.",
        examples=("uwsim info visibility-scene", "uwsim info my-scene.xml --json"),
    ),
    "list": Command(
        module="list",
        function="list_names",
        summary="List scenes, benchmarks, algorithms and parts that have names.",
        examples=("uwsim list", "uwsim list benchmarks"),
    ),
    "kubernetes": Command(
        module="campaigns.kubernetes",
        function="kubernetes",
        summary="Print jobs that run a benchmark or suite on Kubernetes.",
        examples=(
            "uwsim kubernetes --tasks 500 --image uwsim --volume-claim shared "
            "-- bench currents --repeat 100 --out /campaign/pi.result > jobs.yaml",
        ),
    ),
    "manoeuvres": Command(
        module="vehicles.manoeuvres",
        function="manoeuvres",
        summary="Measure how a vehicle turns, stops and holds its course.",
        examples=(
            "uwsim manoeuvres remus-scene",
            "uwsim manoeuvres my-scene.xml --vehicle my_rov -o my-rov-manoeuvres",
        ),
    ),
    "merge": Command(
        module="campaigns.merge",
        function="merge",
        summary="Write the result of a benchmark that ran in shards.",
        examples=(
            "uwsim merge both.result",
            "uwsim merge both.result --no-report --workers 2",
        ),
    ),
    "play": Command(
        module="play",
        function="play",
        summary="Play a recording: to a program, to ROS, with ghosts in a scene.",
        examples=(
            "uwsim play dive.mcap --record dive.bag",
            "uwsim play dive.bag cirs --ros1",
            "uwsim play dive.mcap pool.xml --virtual-sensors --compose "
            "camera=/camera/image_raw --record virtual.mcap",
        ),
    ),
    "render": Command(
        module="render",
        function="render",
        summary="Draw the image of a camera: colour, depth, segmentation.",
        examples=(
            "uwsim render visibility-scene --camera bowtech1 -o view.png",
            "uwsim render my-scene.xml --camera bowtech1 -o view.png --depth "
            "--set oceanState.fog.density=0.4",
            "uwsim render pier-waves-scene --view viewer --time 20 -o waves.png",
        ),
    ),
    "replay": Command(
        module="replay",
        function="replay",
        summary="Show a trial of a result again, with its curves, as a film.",
        examples=(
            "uwsim replay visibility.result -o visibility.mp4",
            "uwsim replay currents.result --trial 3 --view chase --speed 4 -o currents.webp",
        ),
    ),
    "report": Command(
        module="report",
        function="report",
        summary="Draw the report and the plots of a result again.",
        examples=("uwsim report visibility.result",),
    ),
    "run": Command(
        module="run",
        function="run",
        summary="Run a scene for a time: topics, rates, recording, your program.",
        examples=(
            "uwsim run cirs --for 10s --hz",
            "uwsim run my-scene.xml --program my_controller.py --for 1min --record dive.mcap",
            "uwsim run bluerov2-scene --ardupilot --view",
            "uwsim run pool.xml --ros1 --follow ros1:/odom --follow-axes enu",
        ),
    ),
    "scenario": Command(
        module="logs.scenario",
        function="scenario",
        summary="Make a benchmark from the log of a real mission.",
        examples=(
            "uwsim scenario dive.mcap --scene tank.xml --images /camera/image_raw --target box",
            "uwsim scenario dive.csv --mapping dive.toml --scene tank.xml -o tank-scenario",
        ),
    ),
    "slurm": Command(
        module="campaigns.slurm",
        function="slurm",
        summary="Print a script that runs a benchmark or suite on Slurm.",
        examples=(
            "uwsim slurm --tasks 500 -- bench currents --repeat 100 --out /shared/pi.result "
            "> job.sh",
            "uwsim slurm --parallel 100 --time 2:00:00 --container image.sif "
            "-- bench my.xml --repeat 100 --out /shared/my.result > job.sh",
        ),
    ),
    "suite": Command(
        module="suites.suite",
        function="suite",
        summary="Enter an algorithm into a suite of tasks; verify and rank.",
        examples=(
            "uwsim suite list",
            "uwsim suite run intervention --algorithm position-pi --tasks station-v1 --short "
            "--out entry",
        ),
        subcommands=SUITE_COMMANDS,
    ),
    "verify": Command(
        module="verify",
        function="verify",
        summary="Replay a sample of a result and compare it, byte for byte.",
        examples=(
            "uwsim verify visibility.result",
            "uwsim verify currents.result --sample 5 --workers 2",
        ),
    ),
}

FIRST_STEPS = """\b
First steps:
  $ uwsim list benchmarks
  $ uwsim info visibility-scene
  $ uwsim run cirs --for 5s --hz
  $ uwsim bench visibility --seed 1
  $ uwsim COMMAND -h                    what a command does, with examples
"""
TRACEBACK = "--traceback"
CLOSED_OUTPUT = 1
"""The exit status if the reading program closes the pipe, as in ``uwsim list | head -1``."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run ``uwsim`` and return its exit status: 0 done, 2 invalid input, 3 the run failed."""
    all_words = list(sys.argv[1:] if arguments is None else arguments)
    words = [word for word in all_words if word != TRACEBACK] or ["--help"]
    if len(words) == 1 and words[0] in COMMANDS and COMMANDS[words[0]].subcommands:
        words.append("--help")
    suppress_cast_warnings()
    try:
        reject_old_options(words, COMMANDS)
        application = build_application(words)
        result = application(words, prog_name="uwsim", standalone_mode=False, obj=words)
        sys.stdout.flush()
    except BrokenPipeError:
        sys.stdout = None  # the reader has closed the pipe
        return CLOSED_OUTPUT
    except SystemExit as error:  # of rich, for a closed pipe; or of typer, after completion
        return error.code if isinstance(error.code, int) else CLOSED_OUTPUT
    except (Exception, KeyboardInterrupt) as error:
        if TRACEBACK in all_words:
            raise
        return print_error(error)
    if result == INTERRUPT_STATUS:
        return print_error(KeyboardInterrupt())
    return result if isinstance(result, int) else 0


def print_error(error: BaseException) -> int:
    """Print an error, or several on separate lines; return the exit status."""
    message = format_error(error)
    if message:
        print(message, file=sys.stderr)
    return exit_status(error)


def build_application(arguments: Sequence[str]) -> typer.Typer:
    """Build the application, importing only the command in ``arguments``.

    During completion by the shell, it is the command on the line that the user is typing.
    """
    words = [word for word in typed_words() or arguments if not word.startswith("-")]
    command_name = next(iter(words), None)
    app = typer.Typer(
        help="Underwater robots, simulated and measured.",
        epilog=FIRST_STEPS,
        rich_markup_mode=None,
        context_settings=HELP_NAMES,
    )
    app.callback()(global_options)
    for name, command in COMMANDS.items():
        is_named = name == command_name
        if command.subcommands and is_named:
            app.add_typer(build_group(name, command, words[1:]), name=name)
        else:
            add_command(app, name, command, is_loaded=is_named)
    return app


def build_group(name: str, group: Command, words: Sequence[str]) -> typer.Typer:
    """Build a group of commands, importing only the one that is the first of ``words``."""
    subcommand_name = next(iter(words), None)
    app = typer.Typer(
        name=name,
        help=group.load().__doc__,
        short_help=group.summary,
        epilog=format_examples(group),
        rich_markup_mode=None,
        context_settings=HELP_NAMES,
    )
    for subcommand, command in group.subcommands.items():
        add_command(app, subcommand, command, is_loaded=subcommand == subcommand_name)
    return app


def add_command(app: typer.Typer, name: str, command: Command, *, is_loaded: bool) -> None:
    """Add a command, or its placeholder, which is not imported."""
    app.command(
        name,
        cls=ErrorCollectingCommand,
        short_help=command.summary,
        epilog=format_examples(command),
        context_settings=HELP_NAMES,
    )(command.load() if is_loaded else skip_command)


def format_examples(command: Command) -> str:
    """Return the text of the examples of a command."""
    return "\b\nExamples:\n" + "\n".join(f"  $ {line}" for line in command.examples)


def skip_command() -> None:
    """Do nothing: the placeholder of a command that is not imported."""


def show_version(is_requested: bool) -> None:
    """Print the version and exit, if requested."""
    if is_requested:
        print(f"uwsim {__version__}")
        raise typer.Exit


def global_options(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=show_version, is_eager=True, help="Show the version and stop."
        ),
    ] = False,
    traceback: Annotated[
        bool, typer.Option(TRACEBACK, help="Show where in the program an error was raised.")
    ] = False,
) -> None:
    """Accept the options before the command, which ``main`` has already read."""
