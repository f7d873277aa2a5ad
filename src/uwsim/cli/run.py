"""``uwsim run``: run a scene for a time, with or without a program of one's own."""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, nullcontext, redirect_stdout
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from ..base.exceptions import convert_to_run_failed
from ..base.interrupts import raise_on_interrupt
from ..base.terminal import print_warnings, warn
from ..base.tracked_parameters import describe_unread_parameters
from ..errors import BadSetting, ErrorCollector, RunFailed, did_you_mean
from ..runs.foreign_code import announce_code, refuse_code
from ..runs.planning.make_plan import ALGORITHM_PREFIX, check_parameters
from ..runs.planning.option_values import compatibility_of, number_or_text, pairs_of
from ..runs.program import load_program
from ..runs.stand_ins import warn_of_stand_ins
from .options.connections import ConnectionOptions, connected
from .options.live import LiveOptions
from .options.options import DataPathOption, NoCodeOption, SceneArgument, SettingOptions
from .options.run_options import ProgramOptions, RecordOptions, SeedOption
from .output.progress import progress
from .output.topic_table import print_json, print_topics
from .render import scene_of

if TYPE_CHECKING:
    from ..bus import Algorithm
    from ..middleware.recording import ImageStorage, Recorder, TopicRates
    from ..scene.spec import SceneSpec
    from ..simulation import Simulation
    from ..viewer.scene_topics import SceneTopics

UNITS = {"ms": 1e-3, "s": 1.0, "min": 60.0, "h": 3600.0}
DURATION = re.compile(r"\s*(\d+\.?\d*|\.\d+)\s*([a-z]*)\s*")
MAX_DURATION = 1e8
"""Longest simulation time; longer is taken for a typing error [s]."""


def run(
    scene: SceneArgument,
    *,
    what: ProgramOptions,
    changes: SettingOptions,
    connections: ConnectionOptions,
    live: LiveOptions,
    seed: SeedOption = 0,
    output: RecordOptions,
    no_code: NoCodeOption = False,
    data_path: DataPathOption = None,
) -> None:
    """Run a scene for a time, and list its topics; with --hz, how often their messages came.

    Time is simulation time: the scene runs as fast as it can, and waits for your program, whose
    callbacks take no simulation time. Same files, program and seed: the same messages, and the
    same bytes of the recording. Without --hz and --record, images that no program reads are not
    drawn. Ctrl-C ends the run; the recording is complete up to there.

    With --view the scene runs in real time and is seen in a browser, where its first vehicle is
    piloted, unless a program runs.

    With a connection (--ros1, --ros2, --web) programs outside read and write topics and call
    services while the scene runs in real time, and the run is not repeatable.
    """
    from ..checks import model_warnings
    from ..physics.compile_scene import compile_scene
    from ..simulation import Simulation

    folders = tuple(data_path or ())
    wrong = ErrorCollector()
    spec = scene_of(scene, folders, settings_of_scene(changes), wrong)
    with wrong.collect():
        if spec is not None and no_code:
            refuse_code(spec)
    quirks = compatibility_of(changes.compat or [], wrong)
    with wrong.collect():
        live.check()
    wanted = wanted_of(what, output, changes, connections, wrong, is_viewed=live.view)
    wrong.raise_errors()
    assert spec is not None
    announce_code(spec)
    warn_of_stand_ins(spec, folders)
    model = compile_scene(spec, seed=seed, data_path=folders, compatibility=quirks)
    with Simulation(model, udp_address=what.udp_address) as simulation:
        print_warnings(model_warnings(model))
        raise_on_interrupt()
        scene_topics = None
        if connections.is_connected or output.record is not None:
            from ..viewer.scene_topics import SceneTopics

            scene_topics = SceneTopics(simulation, is_on_bus=connections.is_connected)
        pace = connections if not live.view else replace(connections, speed=0.0)
        with (
            images_elsewhere(simulation, pace),
            connected(simulation, pace),
            viewed(simulation, spec, wanted, live, connections),
        ):
            run_and_report(simulation, spec, wanted, output, scene_topics)


@contextmanager
def images_elsewhere(simulation: Simulation, pace: ConnectionOptions) -> Iterator[None]:
    """In a run in real time with programs outside, draw images in a process of their own."""
    if not pace.is_connected or pace.pace == 0 or pace.client:
        yield
        return
    from ..simulation.scenery.image_process import ImageProcess

    process = ImageProcess(simulation, warn)
    try:
        yield
    finally:
        process.close()


@contextmanager
def viewed(
    simulation: Simulation,
    spec: SceneSpec,
    wanted: Wanted,
    live: LiveOptions,
    connections: ConnectionOptions,
) -> Iterator[None]:
    """Open the live view that the options ask for; where no program runs its viewers pilot."""
    from ..runs.trial.pilot_inputs import PilotInputs
    from ..runs.trial.pilot_topics import pilot_topics

    title, is_piloted = Path(spec.path).stem, wanted.program is None
    speed = 1.0 if connections.speed is None else connections.speed
    with live.opened(title, speed=speed, is_piloted=is_piloted, resets=is_piloted) as session:
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
class Wanted:
    """What the options ask for, checked."""

    duration: float
    """Simulation time [s]; inf for no end."""
    program: type[Algorithm] | None
    """What is attached."""
    parameters: dict[str, float | str]
    """Its parameters."""
    images: ImageStorage
    """How images are recorded."""


def wanted_of(
    what: ProgramOptions,
    output: RecordOptions,
    changes: SettingOptions,
    connections: ConnectionOptions,
    wrong: ErrorCollector,
    *,
    is_viewed: bool = False,
) -> Wanted:
    """Check the options; collects their errors."""
    from ..algorithms import ALGORITHMS
    from ..middleware.recording import check_path, image_storage

    duration, program, images = 0.0, None, image_storage("raw")
    own = [each for each in changes.all_settings if each.startswith(ALGORITHM_PREFIX)]
    connections.check(wrong)
    with wrong.collect():
        is_endless = what.duration is None and (connections.is_connected or is_viewed)
        duration = math.inf if is_endless else duration_of(what.duration or "10s")
    with wrong.collect():
        if what.program is not None:
            program = load_program(what.program, ALGORITHMS)
        elif own:
            raise BadSetting(f"--set {own[0]}: there is no --program whose parameter it could be.")
    parameters = {
        name.removeprefix(ALGORITHM_PREFIX): number_or_text(value)
        for name, value in pairs_of(own, wrong)
    }
    check_parameters(program, parameters, wrong)
    with wrong.collect():
        images = image_storage(output.images)
    with wrong.collect():
        if output.record is not None:
            check_path(output.record, overwrite=output.overwrite)
    return Wanted(duration=duration, program=program, parameters=parameters, images=images)


def settings_of_scene(changes: SettingOptions) -> list[str]:
    """Return the settings that are not of the program."""
    return [each for each in changes.all_settings if not each.startswith(ALGORITHM_PREFIX)]


def duration_of(text: str) -> float:
    """Return a time [s] as it is typed: ``10s``, ``2min``, ``0.5``; raises BadSetting."""
    found = DURATION.fullmatch(text)
    if found is None:
        raise BadSetting(f"--for {text!r}: expected a time, as 10s, 500ms, 2min or 1h.")
    number, unit = float(found[1]), found[2] or "s"
    if unit not in UNITS:
        near = did_you_mean(unit, UNITS)
        raise BadSetting(f"--for {text!r}: expected one of the units {', '.join(UNITS)}.{near}")
    if not number * UNITS[unit] <= MAX_DURATION:
        raise BadSetting(f"--for {text!r}: at most {MAX_DURATION:g} s of simulation time.")
    return number * UNITS[unit]


def run_and_report(
    simulation: Simulation,
    spec: SceneSpec,
    wanted: Wanted,
    output: RecordOptions,
    scene_topics: SceneTopics | None = None,
) -> None:
    """Run, and print what came; also of a run that fails or is interrupted."""
    from ..middleware.recording import Recorder, TopicRates

    node = None
    # what a program prints is no part of the JSON
    aside = redirect_stdout(sys.stderr) if output.as_json else nullcontext()
    if wanted.program is not None:
        with aside:
            node = simulation.attach(wanted.program(), parameters=wanted.parameters, raises=False)
        for sentence in node.describe_unconnected_topics():
            warn(sentence)
    with convert_to_run_failed(), ExitStack() as last, ExitStack() as stack:
        stack.enter_context(aside)
        recorder = None
        if output.record is not None:
            recorder = Recorder(simulation.bus, output.record, images=wanted.images)
            stack.enter_context(recorder)
            recorder.start(lambda: simulation.time)
            if scene_topics is not None:
                scene_topics.record(recorder)
            stack.callback(warn_of_left_out, recorder)
        rates = TopicRates(
            simulation.bus,
            lambda: simulation.time,
            is_counted=lambda type: (
                output.hz or (recorder is not None and recorder.is_recorded(type))
            ),
        )
        last.push(
            lambda how, *_: report(simulation, spec, rates, output, is_stopped=how is not None)
        )
        for _ in pieces(simulation, wanted.duration, Path(spec.path).stem):
            if recorder is not None:
                recorder.check()
            if node is not None and node.error is not None:
                raise RunFailed(f"{node.name} {node.failure_verb}: {node.error}")
        if node is not None:
            given = node.parameters
            if note := describe_unread_parameters(node.name, given.plain_copy, given.names_read):
                warn(note)


def report(
    simulation: Simulation,
    spec: SceneSpec,
    rates: TopicRates,
    output: RecordOptions,
    *,
    is_stopped: bool,
) -> None:
    """Print what came; of a run that was stopped before its first step, that it was."""
    if output.as_json:
        print_json(spec.path, simulation, rates.rates(), output.record)
    elif is_stopped and simulation.step == 0:
        print(f"{Path(spec.path).name}: stopped before the first step; nothing came on any topic")
    else:
        print_topics(spec.path, simulation, rates.rates(), output.record)


def pieces(simulation: Simulation, duration: float, title: str) -> Iterator[None]:
    """Advance by a second at a time, showing progress if there is an end."""
    if duration == math.inf:
        while True:
            simulation.advance(1.0)
            yield
    total = max(1, math.ceil(duration))
    with progress(title, total, of="s of simulation time") as on_piece:
        simulation.advance(0.0)
        yield
        for i in range(total):
            simulation.advance(duration * (i + 1) / total - simulation.time)
            on_piece()
            yield


def warn_of_left_out(recorder: Recorder) -> None:
    """Name the topics that cannot be recorded."""
    for topic, type_name in recorder.left_out.items():
        warn(f"/{topic} is not recorded: {type_name} has no message definition")
