"""``uwsim play``: put a recording onto the bus, alone or in a scene."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..base.interrupts import raise_on_interrupt
from ..base.terminal import print_warnings, warn
from ..errors import ErrorCollector
from ..runs.foreign_code import announce_code, refuse_code
from ..runs.stand_ins import warn_of_stand_ins
from .options.connections import ConnectionOptions, connected
from .options.help_texts import INPUT, in_group
from .options.options import DataPathOption, NoCodeOption, SettingOptions
from .options.run_options import ProgramOptions, RecordOptions, SeedOption
from .render import scene_of
from .run import run_and_report, settings_of_scene, wanted_of

if TYPE_CHECKING:
    from ..middleware.recording import BagReader, Player
    from ..simulation import Simulation


def play(
    recording: Annotated[
        Path,
        typer.Argument(
            metavar="FILE",
            help="A recording: .bag of ROS 1, .mcap or .db3 of ROS 2, or a rosbag2 folder.",
        ),
    ],
    scene: Annotated[
        str | None,
        typer.Argument(metavar="SCENE", help="A scene that runs along; without it none."),
    ] = None,
    *,
    commands: Annotated[
        bool,
        in_group(
            INPUT,
            "--commands",
            help="Vehicles of the scene obey the recorded commands instead of following the "
            "recorded odometry.",
        ),
    ] = False,
    what: ProgramOptions,
    changes: SettingOptions,
    connections: ConnectionOptions,
    seed: SeedOption = 0,
    output: RecordOptions,
    no_code: NoCodeOption = False,
    data_path: DataPathOption = None,
) -> None:
    """Put the messages of a recording onto the bus, each at its time, and list the topics.

    Alone, its topics are there for your --program, for programs outside (--ros1, --ros2, --web),
    and for --record, which so turns a .bag into an .mcap and back. With a scene its vehicles are
    ghosts: they follow the recorded odometry and joint states, and the scene's sensors see what
    they would have seen. What both have is played as /recorded/TOPIC. With --commands the recorded
    commands drive the vehicles.
    """
    from ..checks import model_warnings
    from ..middleware.recording import BagReader
    from ..physics.compile_scene import compile_scene
    from ..scene.spec import SceneSpec
    from ..simulation import Simulation

    folders = tuple(data_path or ())
    wrong = ErrorCollector()
    settings = settings_of_scene(changes)
    spec = SceneSpec(path=str(recording))
    with wrong.collect():
        if scene is not None:
            spec = scene_of(scene, folders, settings, wrong) or spec
            if no_code:
                refuse_code(spec)
    wanted = wanted_of(what, output, changes, connections, wrong)
    wrong.raise_errors()
    announce_code(spec)
    warn_of_stand_ins(spec, folders)
    model = compile_scene(spec, seed=seed, data_path=folders)
    with BagReader(recording) as reader, Simulation(model) as simulation:
        print_warnings(model_warnings(model))
        for topic, type_name in reader.left_out.items():
            warn(f"{topic} is not played: {type_name} has no message definition here")
        player = player_of(reader, simulation, commands)
        simulation.attach(player, name="recording")
        if what.duration is None:
            wanted = replace(wanted, duration=reader.duration)
        raise_on_interrupt()
        with connected(simulation, connections):
            run_and_report(simulation, spec, wanted, output)


def player_of(reader: BagReader, simulation: Simulation, obeys: bool) -> Player:
    """Return what plays the recording in a scene, with its ghosts."""
    from ..middleware.recording import Player
    from ..simulation.ghosts import commanded_topics, follow_recorded, odometry_vehicles

    published = {f"/{name}" for name in simulation.topics if _is_published(simulation, name)}
    recorded = frozenset(reader.topics)
    ghosts = () if obeys else odometry_vehicles(simulation, recorded)
    left_out = commanded_topics(simulation, ghosts)
    player = Player(reader, simulation.timestep, bus_topics=published, left_out=left_out)
    if ghosts:
        follow_recorded(simulation, player.topics)
    return player


def _is_published(simulation: Simulation, topic: str) -> bool:
    ends = simulation.bus.endpoints(topic)
    return ends is not None and ends.is_published
