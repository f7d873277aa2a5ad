"""The execution of one trial: an algorithm and a seed at one level after the other.

*Sequential*: algorithm and scene continue from level to level. *Independent*: a level is run alone
and begins with a *prelude*, which is not measured. In the prelude the algorithm starts at the
updaters' initial values, receives the image position of its target and runs for 1 s; then the
values change linearly to those of the level within 1 s. Without the prelude
(``u:prelude="false"``) the level's values hold from the first image on.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing, nullcontext
from dataclasses import replace
from functools import partial
from pathlib import Path

from ...base.expression import parse
from ...benchmark.plugin import attribute_errors_to
from ...benchmark.plugin_checks import check_values
from ...benchmark.spec import MAX_TASK_DURATION
from ...benchmark.updater_settings import benchmark_of_seed
from ...benchmark.updaters import (
    Level,
    apply_level,
    begin_level,
    bind_updaters,
    blend,
    initial_level,
    interval,
    ramp_level,
    settling_time,
)
from ...devices.ardupilot import ArduPilotLink
from ...devices.px4 import Px4
from ...errors import NeverStarted, SimulationFailed
from ...messages import String
from ...simulation import Calls, Simulation
from ...simulation.markers import SERVICE as SPAWN_MARKER
from ..own_process.program import Program, pop_refused_messages, program_of
from ..planning.plan import Plan, Trial
from ..planning.trial_cache import TrialCache, compile_plan
from .error_floor import ErrorFloor
from .fingerprint import Fingerprinter
from .known_corners import known_corners
from .level_row import LevelRow, TrialEnd, cells_of, collect_remarks
from .level_triggers import LevelTriggers
from .live_topics import LiveTopics
from .log_columns import log_columns
from .make_algorithm import make_algorithm, reported_parameters, unread_parameters
from .motion_recorder import MotionRecorder
from .phase_images import PhaseImages, all_snapshots
from .pilot_inputs import pilot_inputs
from .pilot_topics import pilot_topics
from .status import SIMULATION_ERROR, StatusMonitor, to_line
from .trial_observer import TrialObserver
from .trial_recorder import TrialRecorder
from .triggered_measure import TriggeredMeasure, find_ending, finite_value, tick_all
from .visibility import Fact, TargetMotion, visibility_facts

STATUS_TOPIC = "algorithmStatus"
"""The topic on which an algorithm reports its status."""
SETTLING_TIME = 1.0
"""The time of the prelude at the initial values, before the ramp [s of simulation time]."""
RAMP_TIME = 1.0
"""The time of the prelude in which the values change to those of the level [s of simulation
time]."""


def execute(
    plan: Plan,
    trial: Trial,
    *,
    cache: TrialCache | None = None,
    calls: Calls | None = None,
    observer: TrialObserver | None = None,
    recorder: TrialRecorder | None = None,
) -> Iterator[LevelRow | TrialEnd]:
    """Run a trial; yield a LevelRow at the end of each level, and finally the TrialEnd.

    Args:
        plan: the plan of the run.
        trial: a trial of the plan.
        cache: the cache of scene models and renderers; without one the trial compiles its scene and
            has its own renderer.
        calls: the counter of calls into the algorithm.
        observer: the observer, which is called between the steps.
        recorder: the recorder of the messages.

    Raises:
        NeverStarted: the start trigger did not go on within `Plan.start_timeout`.
    """
    calls = calls or Calls()
    with program_of(plan, calls.limit) as program:  # a process starts while the scene is opened
        simulation = Simulation(
            compile_plan(plan, trial.seed) if cache is None else cache.model(plan, trial.seed),
            stream_prefix=trial.stream_prefix,
            is_blind=plan.is_blind,
            udp_address=plan.udp_address,
            pool=None if cache is None else cache.renderers,
        )
        try:
            with (
                nullcontext() if recorder is None else recorder.recording(simulation, trial),
                attribute_errors_to(
                    plan.plugins, describe_progress=partial(_describe_time, simulation, trial)
                ),
                closing(_Execution(plan, trial, simulation, program, calls, observer)) as execution,
                attribute_errors_to(plan.plugins, describe_progress=execution.describe_progress),
            ):
                yield from execution.rows()
        finally:
            simulation.close()


def _describe_time(simulation: Simulation, trial: Trial) -> str:
    return f"seed {trial.seed}, at {simulation.time:g} s"


class _Execution:
    """A trial during its execution."""

    def __init__(
        self,
        plan: Plan,
        trial: Trial,
        simulation: Simulation,
        program: Program,
        calls: Calls,
        observer: TrialObserver | None,
    ) -> None:
        self._plan, self._trial, self._simulation = plan, trial, simulation
        benchmark = benchmark_of_seed(plan.benchmark, trial.seed)
        self._updater = benchmark.scene_updater
        self._fingerprinter = Fingerprinter(simulation)
        self._motion = MotionRecorder(simulation, benchmark.measures)
        self._updaters = bind_updaters(self._updater, simulation.world.stage_view)
        if "no-markers" in plan.compatibility:
            simulation.bus.services.withdraw(SPAWN_MARKER)
        simulation.bus.keeps_unread_messages = False  # all readers have subscribed
        self._expression = parse(benchmark.function.text, [m.name for m in benchmark.measures])
        self._measures = benchmark.measures  # the specs that the next level uses
        ramp_level(self._updaters, self._base_level())
        for measure in self._bind_measures():
            measure.close()  # from now on, the bus stores the messages that measures read first
        self._triggers = LevelTriggers(benchmark, simulation.world.measure_view)
        self._live_topics = LiveTopics(benchmark.function, self._expression, simulation)
        status = simulation.bus.inbox(STATUS_TOPIC, String)
        self._calls = calls
        self._observer = observer
        self._inputs = pilot_inputs(plan, trial, simulation, observer)
        scene_parameters = {} if self._inputs is None else pilot_topics(simulation)
        self._parameters = {**scene_parameters, **known_corners(plan), **plan.algorithm.parameters}
        self._algorithm = make_algorithm(
            plan, partial(program, simulation), self._parameters, calls
        )
        self._node = simulation.attach(
            self._algorithm,
            name=plan.algorithm.name,
            parameters=self._parameters,
            raises=False,
            calls=calls,
        )
        self._monitor = StatusMonitor(self._node, status)
        self._notes: dict[str, None] = {}
        self._facts: dict[str, Fact] = {}
        self._target_motion: TargetMotion | None = None
        self._error_floor: ErrorFloor | None = None
        self._level: Level | None = None  # the latest level
        self._level_start: int | None = None  # the step at which the running level began
        self._n_measured = 0  # the number of measured steps of all levels so far
        has_images = trial.index == 0 and not plan.is_blind
        self._phases = PhaseImages(simulation) if has_images else None

    def describe_progress(self) -> str:
        """Return the level, seed and time for a message: ``level fog=0.4, seed 7, at 3.02 s``."""
        level = f"level {self._level}, " if self._level else ""
        return level + _describe_time(self._simulation, self._trial)

    def rows(self) -> Iterator[LevelRow | TrialEnd]:
        """Run the levels; yield a row for each, and finally the end of the trial."""
        plan, simulation = self._plan, self._simulation
        simulation.advance(0.0)
        self._motion.start()
        if self._observer is not None:
            pilot = None if self._inputs is None else self._parameters
            self._observer.open(simulation, self._title(), pilot)
        parameters = reported_parameters(plan, self._algorithm, self._parameters, self._calls)
        if not plan.is_blind:
            self._facts = visibility_facts(simulation, plan, parameters)
        n_rows = 0
        try:
            for row in self._level_rows():
                n_rows += 1
                yield self._finish_row(row)
        except SimulationFailed as error:
            for level in self._trial.levels[n_rows:]:
                yield self._finish_row(self._failed_row(level, str(error)))
        for part in (self._target_motion, self._error_floor):
            self._facts |= {} if part is None else part.facts
        yield TrialEnd(
            facts=self._facts,
            parameters=parameters,
            streams=() if plan.is_blind else self._streams(),
            notes=(
                *self._notes,
                *unread_parameters(plan, self._algorithm, self._node),
                *_link_notes(simulation),
            ),
            checkpoints=self._fingerprinter.checkpoints(),
            motion=self._motion.track(),
            inputs=b"" if self._inputs is None else self._inputs.data(),
        )

    def _level_rows(self) -> Iterator[LevelRow]:
        """Run the levels; raise SimulationFailed when no further level can run."""
        plan = self._plan
        self._wait("The benchmark never started")
        if not plan.is_blind:
            self._target_motion = TargetMotion(self._simulation, plan)
            self._error_floor = ErrorFloor(self._simulation, plan)
        error_floor = self._error_floor
        last_level: Level | None = None
        for level in self._trial.levels:
            self._level = level
            if self._trial.is_independent:
                if error_floor is not None:
                    error_floor.start()
                if plan.benchmark.prelude:
                    self._prelude(level)
            self._begin(level, last_level)
            self._settle(settling_time(self._updater, level, last_level=last_level))
            if error_floor is not None:
                error_floor.begin()
            row = self._run_level(level)
            self._level_start = None
            if error_floor is not None:
                error_floor.end()
            yield row
            last_level = level

    def _finish_row(self, row: LevelRow) -> LevelRow:
        """Record the end of a level, and return its row with refused messages."""
        row = replace(row, refused_messages=pop_refused_messages(self._algorithm))
        self._motion.end_level(row)
        if self._observer is not None:
            self._observer.end_level(row)
        return row

    def _failed_row(self, level: Level, reason: str) -> LevelRow:
        """Return the row of a level in which, or before which, the simulation failed."""
        start_step = self._simulation.step if self._level_start is None else self._level_start
        self._level_start = None
        measures = self._bind_measures()  # without the values of the failed level
        row = self._row(level, measures, SIMULATION_ERROR, to_line(reason), start_step)
        self._close_measures(measures)
        return row

    def _base_level(self) -> Level:
        if self._trial.is_independent and not self._plan.benchmark.prelude:
            return self._trial.levels[0]
        return initial_level(self._updater)

    def _title(self) -> str:
        name = Path(self._plan.benchmark.path).stem
        return f"{name}, {self._plan.algorithm.name}, seed {self._trial.seed}"

    def close(self) -> None:
        """Close the files of updaters, and end the observation."""
        if self._observer is not None:
            self._observer.close()
        for updater in self._updaters:
            updater.close()

    def _streams(self) -> tuple[tuple[str, int, str], ...]:
        """Return topic, number and SHA-256 of the images published, in the order of the topics."""
        cameras = [
            (topic, images.n_frames, images.sha256)
            for topic, images in self._simulation.world.images.items()
        ]
        return tuple(sorted([*cameras, *(s for u in self._updaters for s in u.streams)]))

    def _wait(self, message: str) -> bool:
        """Advance until a level may begin; return whether that took any time.

        Raises:
            NeverStarted: no level began within `Plan.start_timeout`, or the algorithm failed.
        """
        simulation, node, timeout = self._simulation, self._node, self._plan.start_timeout
        start_time = simulation.time
        while not self._triggers.may_begin():
            if node.error is not None:
                raise NeverStarted(
                    f"{message}: algorithm {node.name!r} {node.failure_verb} before: "
                    f"{to_line(node.error)}"
                )
            if simulation.time - start_time >= timeout:
                reason = self._triggers.describe_wait(timeout)
                question = f"{message}: {reason}. Does algorithm {node.name!r} see to it?"
                raise NeverStarted(" ".join([question, *node.describe_unpublished_topics()]))
            simulation.advance()
        return simulation.time > start_time

    def _prelude(self, level: Level) -> None:
        """Run the algorithm at the initial values, then change them linearly to the level's."""
        plan, simulation = self._plan, self._simulation
        measures = self._bind_measures()
        settling, ramp = round(SETTLING_TIME / plan.timestep), round(RAMP_TIME / plan.timestep)
        initial_values = initial_level(self._updater)
        tick_all(measures)
        for _ in range(settling):
            ramp_level(self._updaters, initial_values)
            simulation.advance()
            tick_all(measures)
        for i in range(1, ramp + 1):
            ramp_level(self._updaters, blend(self._updater, level, i / ramp))
            simulation.advance()
        self._close_measures(measures)

    def _bind_measures(self) -> list[TriggeredMeasure]:
        return [
            TriggeredMeasure(spec, self._simulation.world.measure_view) for spec in self._measures
        ]

    def _close_measures(self, measures: list[TriggeredMeasure]) -> None:
        self._measures = tuple(
            measure.spec.spec_once_initialised if measure.measure.has_initialised else measure.spec
            for measure in measures
        )
        for measure in measures:
            measure.close()

    def _step_to(self, level: Level, last_level: Level | None) -> None:
        """Set the scene to a level; the first level of a sequence does not count as a step."""
        if last_level is None and not self._trial.is_independent:
            begin_level(self._updaters, level)
        else:
            apply_level(self._updaters, level, last_level=last_level)

    def _begin(self, level: Level, last_level: Level | None) -> None:
        self._step_to(level, last_level)
        from_initial = self._base_level() if self._trial.is_independent else last_level
        self._live_topics.record_change(level, last_level=from_initial)
        self._triggers.arm()
        if self._wait(f"Level {level} never began"):
            self._step_to(level, last_level)
            self._triggers.arm()

    def _settle(self, duration: float) -> None:
        """Run without measurement for the settling time of the updaters [s]."""
        for _ in range(round(duration / self._plan.timestep)):
            self._simulation.advance()
            self._monitor.read_reports(self._simulation.time)

    def _run_level(self, level: Level) -> LevelRow:
        """Run one level with newly bound measures; return its row."""
        plan, simulation, monitor = self._plan, self._simulation, self._monitor
        start_step = self._level_start = simulation.step
        monitor.begin_level()
        measures = self._bind_measures()
        self._motion.begin_level(measures)
        if self._observer is not None:
            self._observer.begin_level(level, measures)
        length = interval(self._updater)
        n_steps = round((MAX_TASK_DURATION if length is None else length) / plan.timestep)
        is_stopped, ending = False, None
        tick_all(measures)
        monitor.read_reports(simulation.time)
        for _ in range(n_steps):
            simulation.advance()
            self._n_measured += 1
            tick_all(measures)
            self._live_topics.update(level, self._n_measured * plan.timestep, measures)
            if self._phases is not None:
                self._phases.update(measures)
            monitor.read_reports(simulation.time)
            is_stopped = not self._triggers.is_open()
            ending = find_ending(measures)
            # an independent level may end early: no later level continues from its scene
            is_over = self._trial.is_independent and monitor.failure is not None
            if is_stopped or ending is not None or is_over:
                break
        for measure in measures:
            measure.end()
            check_values(measure.measure)
        if self._phases is not None:
            self._phases.end(measures)
        cutoff = MAX_TASK_DURATION if length is None and not is_stopped and ending is None else None
        status, reason = monitor.status(measures, cutoff=cutoff, ending=ending)
        for measure in measures:
            self._notes.update(
                (f"{measure.spec.name}: {note}", None) for note in measure.measure.notes
            )
        row = self._row(level, measures, status, reason, start_step)
        self._close_measures(measures)
        return row

    def _row(
        self,
        level: Level,
        measures: list[TriggeredMeasure],
        status: str,
        status_reason: str | None,
        start_step: int,
    ) -> LevelRow:
        simulation = self._simulation
        cells = cells_of(measures, status, status_reason)
        score = self._expression.score(cells.values)
        total, reason = finite_value(score.value if status == "ok" else None)
        if total is None:
            cells.missing_reasons["total"] = (
                status_reason or score.reason or f"the function: {reason}"
            )
        logged_measures = [measure for measure in measures if measure.spec.log is not None]
        return LevelRow(
            values=level.values,
            measures={name: (value, cells.units[name]) for name, value in cells.values.items()},
            details=cells.details,
            total=total,
            status=status,
            missing_reasons=cells.missing_reasons,
            ended_at=simulation.time,
            duration=(simulation.step - start_step) * simulation.timestep,
            logs={measure.spec.name: measure.log for measure in logged_measures},
            log_headers={
                measure.spec.name: log_columns(measure.measure) for measure in logged_measures
            },
            fingerprint=self._fingerprinter.fingerprint,
            remarks=collect_remarks(measures),
            snapshots=()
            if self._plan.is_blind or status == SIMULATION_ERROR
            else all_snapshots(simulation, measures, self._phases, is_tracking=status == "ok"),
        )


def _link_notes(simulation: Simulation) -> list[str]:
    """Return a note for each autopilot with lost, repeated or invalid packets."""
    return [
        part.describe()
        for part in simulation.world.devices
        if (isinstance(part, ArduPilotLink) and part.state.exchange.has_events)
        or (isinstance(part, Px4) and part.state.lock_step.has_events)
    ]
