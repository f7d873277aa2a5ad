"""``uwsim play --virtual-sensors``: a scene whose vehicle follows the poses of a log."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, cast

from ...base.interrupts import raise_on_interrupt
from ...base.terminal import print_warnings, warn
from ...errors import BadSetting
from ..options.connections import ConnectionOptions, open_connections
from ..options.run_options import RecordOptions
from ..options.virtual import CompositionOptions, FollowLogOptions
from ..run import RunSettings, run_and_report

if TYPE_CHECKING:
    from ...devices.motion.pose_track import GapPolicy
    from ...scene.spec import SceneSpec
    from ...simulation import Simulation

RECORDING_SUFFIXES = (".bag", ".mcap", ".db3")
"""The suffixes of logs whose messages are played, too."""


@dataclass(frozen=True, kw_only=True)
class VirtualPlay:
    """A play of a log in a scene with virtual sensors."""

    path: Path
    """The log."""
    scene: SceneSpec
    """The scene."""
    seed: int
    """The seed."""
    folders: tuple[Path, ...]
    """The folders in which files are searched."""
    follow: FollowLogOptions
    """The options of the followed log."""
    composition: CompositionOptions
    """The options of composed images."""
    connections: ConnectionOptions
    """The options of connections."""
    output: RecordOptions
    """The options of the output."""


def play_virtual(request: VirtualPlay, settings: RunSettings, *, is_whole: bool) -> None:
    """Play a log in a scene whose vehicle follows it.

    Args:
        request: the log, the scene and the options.
        settings: the settings of the run.
        is_whole: True to run for the duration of the log.

    Raises:
        UwsimError: the log or the scene is invalid.
    """
    from ...checks import model_warnings
    from ...logs import read_log
    from ...physics.compile_scene import compile_scene
    from ...simulation import Simulation
    from ...virtual_sensors import (
        FollowSettings,
        choose_vehicle,
        describe_track,
        follow_log,
        make_followed_scene,
        make_track,
    )

    follow = request.follow
    log = read_log(request.path, mapping=follow.mapping, vehicle=None)
    vehicle = choose_vehicle(request.scene, log, follow.vehicle)
    gaps = cast("GapPolicy", follow.gaps)
    track = make_track(log, FollowSettings(gaps=gaps, max_gap=follow.max_gap))
    for remark in describe_track(track, log):
        warn(f"{request.path.name}: {remark}")
    spec = make_followed_scene(request.scene, vehicle)
    model = compile_scene(spec, seed=request.seed, data_path=request.folders)
    with Simulation(model) as simulation, ExitStack() as stack:
        print_warnings(model_warnings(model))
        follow_log(simulation, vehicle, track)
        duration = _attach_player(request.path, simulation, vehicle, stack)
        if is_whole:
            settings = replace(settings, duration=max(duration, track.duration))
        camera = request.composition.open_camera(simulation, vehicle)
        raise_on_interrupt()
        stack.enter_context(open_connections(simulation, request.connections))
        run_and_report(simulation, spec, settings, request.output)
        if camera is not None and not camera.n_images:
            raise BadSetting(f"--compose: no image on {request.composition.compose} was composed.")
        if camera is not None and not request.output.as_json:
            print(f"{camera.n_images} images composed, {camera.n_refused} left out")


def _attach_player(path: Path, simulation: Simulation, vehicle: str, stack: ExitStack) -> float:
    """Publish the messages of a recording; return its duration [s], 0 for other logs."""
    from ...middleware.recording import BagReader, Player
    from ...simulation.ghosts import commanded_topics

    if not path.is_dir() and path.suffix.lower() not in RECORDING_SUFFIXES:
        return 0.0
    reader = stack.enter_context(BagReader(path))
    for topic, type_name in reader.left_out.items():
        warn(f"{topic} is not played: {type_name} has no message definition here")
    player = Player(reader, simulation.timestep, left_out=commanded_topics(simulation, (vehicle,)))
    simulation.attach(player, name="recording")
    return reader.duration
