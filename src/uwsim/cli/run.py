"""``uwsim run``: run a scene for a time, with or without a user's program."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, nullcontext, redirect_stdout
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from ..base.exceptions import convert_to_run_failed
from ..base.interrupts import raise_on_interrupt
from ..base.terminal import print_warnings, report, warn
from ..base.tracked_parameters import describe_unread_parameters
from ..devices.ardupilot import ArduPilotLink
from ..devices.mavlink import MavlinkDevice
from ..devices.px4 import Px4
from ..errors import BadSetting, ErrorCollector, RunFailed
from ..runs.foreign_code import announce_code, refuse_code
from ..runs.planning.ardupilot_scene import connect_ardupilot, connect_mavlink, exchange_timestep
from ..runs.planning.autopilot_scene import disconnect_autopilots
from ..runs.planning.make_plan import ALGORITHM_PREFIX, check_parameters
from ..runs.planning.option_values import compatibility_of, number_or_text, pairs_of
from ..runs.planning.px4_scene import connect_px4
from ..runs.program import load_program
from ..runs.substituted_files import warn_of_substituted_files
from ..world import TIMESTEP
from .options.connections import ConnectionOptions, open_connections
from .options.follow import FollowOptions
from .options.live import LiveOptions
from .options.options import DataPathOption, NoCodeOption, SceneArgument, SettingOptions
from .options.run_options import ProgramOptions, RecordOptions, SeedOption
from .options.strict_options import StrictOptions
from .options.virtual import CompositionOptions
from .output.strict_report import (
    hold_garbage,
    make_strict_clock,
    print_streams,
    raise_if_late,
    warn_of_invalid_input,
)
from .output.topic_table import print_json, print_topics
from .render import load_scene
from .simulated_time import read_duration, run_pieces

if TYPE_CHECKING:
    from ..bus import Algorithm
    from ..middleware.recording import ImageStorage, Recorder, TopicRates
    from ..middleware.strict import StrictClock
    from ..scene.spec import SceneSpec
    from ..simulation import Simulation
    from ..viewer.scene_topics import SceneTopics


def run(
    scene: SceneArgument,
    *,
    program_options: ProgramOptions,
    changes: SettingOptions,
    connections: ConnectionOptions,
    strict_options: StrictOptions,
    live_options: LiveOptions,
    follow: FollowOptions,
    composition: CompositionOptions,
    seed: SeedOption = 0,
    output: RecordOptions,
    no_code: NoCodeOption = False,
    data_path: DataPathOption = None,
) -> None:
    """Run a scene for a time, and list its topics; with --hz, the rates of their messages.

    Time is simulation time: the scene runs as fast as possible, and waits for your program, whose
    callbacks take no simulation time. The same files, program and seed give the same messages, and
    the same bytes of the recording. Without --hz and --record, images that no program reads are not
    rendered. Ctrl-C ends the run; the recording is complete up to that time.

    With --view the scene runs in real time in a browser. Unless a program runs, the user pilots the
    first vehicle that can be steered.

    With a connection (--ros1, --ros2, --web) external programs read and write topics and call
    services. Unless --client or --speed is given, the scene then runs in real time. The run is
    repeatable only with --client.

    With --strict the scene runs in real time with hardware in the loop. A table shows how late
    steps, sent bytes and commands were; the status is 3 if anything was late or missing.

    With --follow a vehicle follows the poses of a real one. The sensors of the scene observe from
    there. --compose draws virtual objects into the images of the real camera.
    """
    from ..checks import model_warnings
    from ..physics.compile_scene import compile_scene
    from ..simulation import Simulation

    folders = tuple(data_path or ())
    errors = ErrorCollector()
    spec = load_scene(scene, folders, scene_settings(changes), errors)
    with errors.collect():
        if spec is not None and no_code:
            refuse_code(spec)
    with errors.collect():
        if spec is not None:
            spec = connect_autopilots(spec, program_options)
    quirks = compatibility_of(changes.compat or [], errors)
    with errors.collect():
        live_options.check()
    strict_options.check(connections, errors, is_viewed=live_options.view)
    connections, udp_address = strict_options.apply(connections, program_options.port_address)
    run_settings = check_run_options(
        program_options,
        output,
        changes,
        connections,
        errors,
        is_endless=(live_options.view or strict_options.is_strict or program_options.has_autopilot),
    )
    follow.check(connections, errors)
    composition.check(errors)
    errors.raise_errors()
    assert spec is not None
    announce_code(spec)
    warn_of_substituted_files(spec, folders)
    spec, connections = follow.change_scene(spec), follow.choose_pace(connections)
    timestep = exchange_timestep(spec) if program_options.ardupilot else TIMESTEP
    model = compile_scene(
        spec, seed=seed, timestep=timestep, data_path=folders, compatibility=quirks
    )
    with Simulation(model, udp_address=follow.find_address(udp_address)) as simulation:
        print_warnings(model_warnings(model))
        print_streams(simulation)
        raise_on_interrupt()
        strict_clock = make_strict_clock(simulation, connections, strict_options)
        scene_topics = make_scene_topics(simulation, connections, output)
        with (
            open_parts(
                simulation, spec, run_settings, live_options, connections, strict_clock=strict_clock
            ),
            follow.open_report(simulation, as_json=output.as_json),
            composition.open_composition(simulation, follow.find_vehicle(spec)),
        ):
            run_and_report(
                simulation, spec, run_settings, output, scene_topics, (strict_clock, strict_options)
            )
        warn_of_invalid_input(simulation)
        if strict_clock is not None:
            raise_if_late(strict_clock.report())


def connect_autopilots(spec: SceneSpec, options: ProgramOptions) -> SceneSpec:
    """Return the scene with the elements of the autopilots that the options name, and no others."""
    if options.ardupilot and options.px4:
        raise BadSetting("--ardupilot and --px4 exclude each other.")
    if options.ardupilot:
        return connect_mavlink(connect_ardupilot(spec))
    return connect_px4(spec) if options.px4 else disconnect_autopilots(spec)


def make_scene_topics(
    simulation: Simulation, connections: ConnectionOptions, output: RecordOptions
) -> SceneTopics | None:
    """Return the publisher of the topics that describe the scene; None if nothing reads them."""
    if not connections.is_connected and output.record is None:
        return None
    from ..viewer.scene_topics import SceneTopics

    return SceneTopics(simulation, is_on_bus=connections.is_connected)


@contextmanager
def open_parts(
    simulation: Simulation,
    spec: SceneSpec,
    run_settings: RunSettings,
    live_options: LiveOptions,
    connections: ConnectionOptions,
    *,
    strict_clock: StrictClock | None,
) -> Iterator[None]:
    """Open the process of images, the connections and the live view within the block."""
    # the live view paces the run itself
    pace_options = replace(connections, speed=0.0) if live_options.view else connections
    with (
        open_image_process(simulation, pace_options),
        open_connections(simulation, pace_options, strict_clock),
        open_live_view(simulation, spec, run_settings, live_options, connections),
        nullcontext() if strict_clock is None else hold_garbage(),
    ):
        yield


@contextmanager
def open_image_process(simulation: Simulation, connections: ConnectionOptions) -> Iterator[None]:
    """Render images in a separate process, if the run is in real time with external programs.

    With --view no such process is started: the live view paces the run, so the speed is 0 here.
    """
    if not connections.is_connected or connections.real_time_factor == 0 or connections.client:
        yield
        return
    from ..simulation.scenery.image_process import ImageProcess

    process = ImageProcess(simulation, warn)
    try:
        yield
    finally:
        process.close()


@contextmanager
def open_live_view(
    simulation: Simulation,
    spec: SceneSpec,
    run_settings: RunSettings,
    live_options: LiveOptions,
    connections: ConnectionOptions,
) -> Iterator[None]:
    """Open the live view that the options request; its users pilot if no program runs."""
    from ..runs.trial.pilot_inputs import PilotInputs
    from ..runs.trial.pilot_topics import pilot_topics

    title, is_piloted = Path(spec.path).stem, run_settings.program is None
    speed = 1.0 if connections.speed is None else connections.speed
    with live_options.open_session(
        title, speed=speed, is_piloted=is_piloted, resets=is_piloted
    ) as session:
        if session is not None:
            pilot = pilot_topics(simulation) if is_piloted else None
            if pilot is not None:
                from ..algorithms.pilot import Pilot

                PilotInputs(simulation, session.pilot)
                simulation.attach(Pilot(), parameters={**pilot, "start": ""})
            session.open(simulation, title, pilot)
        yield
        if session is not None:
            session.close()


@dataclass(frozen=True, kw_only=True)
class RunSettings:
    """The checked values of the options of a run."""

    duration: float
    """The simulation time [s]; inf for no end."""
    program: type[Algorithm] | None
    """The class of the program."""
    parameters: dict[str, float | str]
    """The parameters of the program."""
    images: ImageStorage
    """The form in which a recording stores images."""


def check_run_options(
    program_options: ProgramOptions,
    output: RecordOptions,
    changes: SettingOptions,
    connections: ConnectionOptions,
    errors: ErrorCollector,
    *,
    is_endless: bool = False,
) -> RunSettings:
    """Check the options; collect their errors."""
    from ..algorithms import ALGORITHMS
    from ..middleware.recording import check_path, image_storage

    duration, program, images = 0.0, None, image_storage("raw")
    settings = [setting for setting in changes.all_settings if setting.startswith(ALGORITHM_PREFIX)]
    connections.check(errors)
    with errors.collect():
        has_end = not (connections.is_connected or is_endless)
        is_endless = program_options.duration is None and not has_end
        duration = math.inf if is_endless else read_duration(program_options.duration or "10s")
    with errors.collect():
        if program_options.program is not None:
            program = load_program(program_options.program, ALGORITHMS)
        elif settings:
            raise BadSetting(
                f"--set {settings[0]} sets a parameter of a program, but no --program is given."
            )
    parameters = {
        name.removeprefix(ALGORITHM_PREFIX): number_or_text(value)
        for name, value in pairs_of(settings, errors)
    }
    check_parameters(program, parameters, errors)
    with errors.collect():
        images = image_storage(output.images)
    with errors.collect():
        if output.record is not None:
            check_path(output.record, overwrite=output.overwrite)
    return RunSettings(duration=duration, program=program, parameters=parameters, images=images)


def scene_settings(changes: SettingOptions) -> list[str]:
    """Return the settings of the scene, without those of the program."""
    return [setting for setting in changes.all_settings if not setting.startswith(ALGORITHM_PREFIX)]


def run_and_report(
    simulation: Simulation,
    spec: SceneSpec,
    settings: RunSettings,
    output: RecordOptions,
    scene_topics: SceneTopics | None = None,
    strict_run: tuple[StrictClock | None, StrictOptions] | None = None,
) -> None:
    """Run, and print the table of topics, even if the run fails or is interrupted."""
    from ..middleware.recording import Recorder, TopicRates

    node = None
    # the output of a program is not part of the JSON
    output_redirect = redirect_stdout(sys.stderr) if output.as_json else nullcontext()
    if settings.program is not None:
        with output_redirect:
            node = simulation.attach(
                settings.program(), parameters=settings.parameters, raises=False
            )
        for sentence in node.describe_unconnected_topics():
            warn(sentence)
    with convert_to_run_failed(), ExitStack() as report_stack, ExitStack() as stack:
        stack.enter_context(output_redirect)
        recorder = None
        if output.record is not None:
            recorder = Recorder(simulation.bus, output.record, images=settings.images)
            stack.enter_context(recorder)
            recorder.start(lambda: simulation.time)
            if scene_topics is not None:
                scene_topics.record(recorder)
            stack.callback(warn_left_out, recorder)
        rates = TopicRates(
            simulation.bus,
            lambda: simulation.time,
            is_counted=lambda type: (
                output.hz or (recorder is not None and recorder.is_recorded(type))
            ),
        )
        report_stack.push(
            lambda kind, *_: report_run(
                simulation, spec, rates, output, strict_run, is_stopped=kind is not None
            )
        )
        for _ in run_pieces(simulation, settings.duration, Path(spec.path).stem):
            if recorder is not None:
                recorder.check()
            if node is not None and node.error is not None:
                raise RunFailed(f"{node.name} {node.failure_verb}: {node.error}")
        if node is not None:
            parameters = node.parameters
            if note := describe_unread_parameters(
                node.name, parameters.plain_copy, parameters.names_read
            ):
                warn(note)


def report_run(
    simulation: Simulation,
    spec: SceneSpec,
    rates: TopicRates,
    output: RecordOptions,
    strict_run: tuple[StrictClock | None, StrictOptions] | None = None,
    *,
    is_stopped: bool,
) -> None:
    """Print the table of topics, or that the run was stopped before its first step."""
    from .output.strict_table import draw_latency, print_strict_report, strict_document

    clock, options = strict_run or (None, None)
    if clock is not None:
        clock.stop()
    strict_report = None if clock is None else clock.report()
    if strict_report is not None and options is not None and options.latency is not None:
        draw_latency(strict_report, options.latency)
    if output.as_json:
        document = None if strict_report is None else strict_document(strict_report)
        print_json(spec.path, simulation, rates.rates(), output.record, strict_report=document)
    elif is_stopped and simulation.step == 0:
        print(f"{Path(spec.path).name}: stopped before the first step; no topic has a message")
    else:
        print_topics(spec.path, simulation, rates.rates(), output.record)
        if strict_report is not None:
            print_strict_report(strict_report)
    for device in simulation.world.devices:
        if isinstance(device, ArduPilotLink | Px4 | MavlinkDevice) and (
            not isinstance(device, MavlinkDevice) or device.is_open
        ):
            report(device.describe())


def warn_left_out(recorder: Recorder) -> None:
    """Warn about the topics that cannot be recorded."""
    for topic, type_name in recorder.left_out.items():
        warn(f"/{topic} is not recorded: {type_name} has no message definition")
