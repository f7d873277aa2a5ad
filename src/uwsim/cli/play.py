"""``uwsim play``: publish a recording on the bus, alone or in a scene."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..base.interrupts import raise_on_interrupt
from ..base.terminal import print_warnings, warn
from ..errors import BadSetting, ErrorCollector
from ..runs.foreign_code import announce_code, refuse_code
from ..runs.substituted_files import warn_of_substituted_files
from .logs.virtual_play import VirtualPlay, play_virtual
from .options.connections import ConnectionOptions, open_connections
from .options.help_texts import INPUT, option
from .options.options import DataPathOption, NoCodeOption, SettingOptions
from .options.run_options import ProgramOptions, RecordOptions, SeedOption
from .options.virtual import CompositionOptions, FollowLogOptions
from .render import load_scene
from .run import check_run_options, run_and_report, scene_settings

if TYPE_CHECKING:
    from ..middleware.recording import BagReader, Player
    from ..simulation import Simulation


def play(
    recording: Annotated[
        Path,
        typer.Argument(
            metavar="FILE",
            help="A recording: .bag of ROS 1, .mcap or .db3 of ROS 2, or a rosbag2 folder; with "
            "--virtual-sensors any log.",
        ),
    ],
    scene: Annotated[
        str | None,
        typer.Argument(
            metavar="SCENE", help="A scene that runs with the recording; without it none."
        ),
    ] = None,
    *,
    commands: Annotated[
        bool,
        option(
            INPUT,
            "--commands",
            help="Vehicles of the scene apply the recorded commands instead of following the "
            "recorded odometry.",
        ),
    ] = False,
    follow: FollowLogOptions,
    composition: CompositionOptions,
    program_options: ProgramOptions,
    changes: SettingOptions,
    connections: ConnectionOptions,
    seed: SeedOption = 0,
    output: RecordOptions,
    no_code: NoCodeOption = False,
    data_path: DataPathOption = None,
) -> None:
    """Publish the messages of a recording on the bus, each at its time, and list the topics.

    Without a scene, your --program and external programs (--ros1, --ros2, --web) use the topics of
    the recording. With --record the messages are written to a new recording, which converts a .bag
    to an .mcap or back. The vehicles of a scene are ghosts: they follow the recorded odometry and
    joint states, and the sensors of the scene measure along that motion. A topic of both recording
    and scene is published as /recorded/TOPIC. With --commands the recorded commands drive the
    vehicles.

    With --virtual-sensors a vehicle follows the poses of any log at every step. The scene then
    publishes on /virtual/TOPIC. --compose draws its virtual objects into the recorded images.
    """
    from ..checks import model_warnings
    from ..middleware.recording import BagReader
    from ..physics.compile_scene import compile_scene
    from ..scene.spec import SceneSpec
    from ..simulation import Simulation

    folders = tuple(data_path or ())
    errors = ErrorCollector()
    settings = scene_settings(changes)
    spec = SceneSpec(path=str(recording))
    with errors.collect():
        if scene is not None:
            spec = load_scene(scene, folders, settings, errors) or spec
            if no_code:
                refuse_code(spec)
    run_settings = check_run_options(program_options, output, changes, connections, errors)
    follow.check(scene, errors)
    composition.check(errors)
    with errors.collect():
        if composition.compose and not follow.virtual_sensors:
            raise BadSetting("--compose needs --virtual-sensors.")
    errors.raise_errors()
    announce_code(spec)
    warn_of_substituted_files(spec, folders)
    if follow.virtual_sensors:
        request = VirtualPlay(
            path=recording,
            scene=spec,
            seed=seed,
            folders=folders,
            follow=follow,
            composition=composition,
            connections=connections,
            output=output,
        )
        play_virtual(request, run_settings, is_whole=program_options.duration is None)
        return
    model = compile_scene(spec, seed=seed, data_path=folders)
    with BagReader(recording) as reader, Simulation(model) as simulation:
        print_warnings(model_warnings(model))
        for topic, type_name in reader.left_out.items():
            warn(f"{topic} is not played: {type_name} has no message definition here")
        player = make_player(reader, simulation, commands)
        simulation.attach(player, name="recording")
        if program_options.duration is None:
            run_settings = replace(run_settings, duration=reader.duration)
        raise_on_interrupt()
        with open_connections(simulation, connections):
            run_and_report(simulation, spec, run_settings, output)


def make_player(reader: BagReader, simulation: Simulation, applies_commands: bool) -> Player:
    """Return the player of the recording in a scene, with its ghosts."""
    from ..middleware.recording import Player
    from ..simulation.ghosts import commanded_topics, follow_recorded, odometry_vehicles

    bus_topics = {f"/{name}" for name in simulation.topics if _is_published(simulation, name)}
    recorded_topics = frozenset(reader.topics)
    ghosts = () if applies_commands else odometry_vehicles(simulation, recorded_topics)
    left_out = commanded_topics(simulation, ghosts)
    player = Player(reader, simulation.timestep, bus_topics=bus_topics, left_out=left_out)
    if ghosts:
        follow_recorded(simulation, player.topics)
    return player


def _is_published(simulation: Simulation, topic: str) -> bool:
    ends = simulation.bus.endpoints(topic)
    return ends is not None and ends.is_published
