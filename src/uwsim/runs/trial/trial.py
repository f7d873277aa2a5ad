"""The execution of one trial: an algorithm and a seed at one level after the other.

*Sequential*: algorithm and scene continue from level to level. *Independent*: a level is run alone
and begins with a *prelude*, which is not measured. In the prelude the algorithm starts at the
updaters' initial values, receives the image position of its target and runs for 1 s; then the
values change linearly to those of the level within 1 s. Without the prelude
(``u:prelude="false"``) the level's values hold from the first image on.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator
from contextlib import closing, contextmanager, nullcontext
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
    initial_level,
    interval,
    ramp_level,
    settling_time,
)
from ...errors import NeverStarted, SimulationFailed
from ...messages import String
from ...simulation import Calls, Simulation
from ...simulation.markers import SERVICE as SPAWN_MARKER
from ..own_process.program import Program, pop_refused_messages, program_of
from ..planning.ardupilot_scene import link_notes
from ..planning.plan import Plan, Trial
from ..planning.trial_cache import TrialCache, compile_plan
from ..tracks.withheld_topics import withhold_topics
from .error_floor import ErrorFloor
from .fingerprint import Fingerprinter
from .images.phase_images import PhaseImages, all_snapshots
from .known_corners import known_corners
from .level_row import LevelRow, TrialEnd, row_of
from .level_triggers import LevelTriggers
from .live_topics import LiveTopics
from .make_algorithm import (
    make_algorithm,
    reported_parameters,
    unread_parameters,
    warn_of_topics,
)
from .motion_recorder import MotionRecorder
from .pilot_inputs import pilot_inputs
from .pilot_topics import pilot_topics
from .policy_channel import agent_parameters, image_parameters, open_channels
from .prelude import prelude_levels
from .status import SIMULATION_ERROR, StatusMonitor, to_line
from .trial_observer import TrialObserver
from .trial_recorder import TrialRecorder
from .triggered_measure import TriggeredMeasure, bind_measures, find_ending, tick_all
from .visibility import Fact, TargetMotion, visibility_facts

STATUS_TOPIC = "algorithmStatus"
"""The topic on which an algorithm reports its status."""


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
    with open_trial(
        plan, trial, cache=cache, calls=calls, observer=observer, recorder=recorder
    ) as execution:
        for row in execution.rows():
            if row is not None:
                yield row


@contextmanager
def open_trial(
    plan: Plan,
    trial: Trial,
    *,
    cache: TrialCache | None = None,
    calls: Calls | None = None,
    observer: TrialObserver | None = None,
    recorder: TrialRecorder | None = None,
) -> Iterator[TrialExecution]:
    """Open the scene of a trial and start its algorithm; the arguments are those of `execute`."""
    calls = calls or Calls()
    plan = plan.plan_of(trial)
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
                closing(
                    TrialExecution(plan, trial, simulation, program, calls, observer)
                ) as execution,
                attribute_errors_to(plan.plugins, describe_progress=execution.describe_progress),
            ):
                yield execution
        finally:
            simulation.close()


def _describe_time(simulation: Simulation, trial: Trial) -> str:
    return f"seed {trial.seed}, at {simulation.time:g} s"


class TrialExecution:
    """A trial during its execution, which pauses before each step if a policy may act."""

    def __init__(
        self,
        plan: Plan,
        trial: Trial,
        simulation: Simulation,
        program: Program,
        calls: Calls,
        observer: TrialObserver | None,
    ) -> None:
        self._plan, self._trial = plan, trial
        self._simulation = self.simulation = simulation
        benchmark = benchmark_of_seed(plan.benchmark, trial.seed)
        self._updater = benchmark.scene_updater
        self._fingerprinter = Fingerprinter(simulation)
        self._motion = MotionRecorder(simulation, benchmark.measures, is_active=plan.records_motion)
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
        withhold_topics(plan, simulation.bus)
        scene_parameters = {} if self._inputs is None else pilot_topics(simulation)
        self._parameters = {
            **scene_parameters,
            **known_corners(plan),
            **agent_parameters(benchmark, plan.algorithm.facts),
            **image_parameters(benchmark, plan.algorithm.facts),
            **plan.algorithm.parameters,
        }
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
        self.channels = open_channels(benchmark, simulation)
        """The observations and actions of policies, one for each ``<u:environment>``."""
        self.active_measures: tuple[TriggeredMeasure, ...] = ()
        """The measures of the running level; none outside of levels."""
        self._level: Level | None = None  # the latest level
        self._level_start: int | None = None  # the step at which the running level began
        self._n_measured = 0  # the number of measured steps of all levels so far
        has_images = trial.index == 0 and not plan.is_blind
        self._phases = PhaseImages(simulation) if has_images else None

    def describe_progress(self) -> str:
        """Return the level, seed and time for a message: ``level fog=0.4, seed 7, at 3.02 s``."""
        level = f"level {self._level}, " if self._level else ""
        return level + _describe_time(self._simulation, self._trial)

    def rows(self) -> Iterator[LevelRow | TrialEnd | None]:
        """Run the levels; yield a row for each, and finally the end of the trial.

        If the benchmark has an environment, None is yielded before each step.
        """
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
                n_rows += row is not None
                yield None if row is None else self._finish_row(row)
        except SimulationFailed as error:
            for level in self._trial.levels[n_rows:]:
                yield self._finish_row(self._failed_row(level, str(error)))
        for part in (self._target_motion, self._error_floor):
            self._facts |= {} if part is None else part.facts
        warn_of_topics(plan, self._trial, self._node)
        yield TrialEnd(
            facts=self._facts,
            parameters=parameters,
            streams=() if plan.is_blind else self._streams(),
            notes=(
                *self._notes,
                *unread_parameters(plan, self._algorithm, self._node),
                *link_notes(simulation),
            ),
            checkpoints=self._fingerprinter.checkpoints(),
            motion=self._motion.track(),
            inputs=b"" if self._inputs is None else self._inputs.data(),
        )

    def _step(self) -> Iterator[None]:
        """Take one step, with the new action of a policy, before which this pauses."""
        if self.channels:
            yield None
        for channel in self.channels:
            channel.apply()
        self._simulation.advance()

    def _level_rows(self) -> Iterator[LevelRow | None]:
        """Run the levels; raise SimulationFailed when no further level can run."""
        plan = self._plan
        yield from self._wait("The benchmark never started")
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
                    yield from self._prelude(level)
            yield from self._begin(level, last_level)
            yield from self._settle(settling_time(self._updater, level, last_level=last_level))
            if error_floor is not None:
                error_floor.begin()
            row = yield from self._run_level(level)
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

    def _wait(self, message: str) -> Generator[None, None, bool]:
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
            yield from self._step()
        return simulation.time > start_time

    def _prelude(self, level: Level) -> Iterator[None]:
        """Run the algorithm at the initial values, then change them linearly to the level's."""
        measures = self._bind_measures()
        tick_all(measures)
        for values, is_measured in prelude_levels(self._updater, level, self._plan.timestep):
            ramp_level(self._updaters, values)
            yield from self._step()
            if is_measured:
                tick_all(measures)
        self._close_measures(measures)

    def _bind_measures(self) -> list[TriggeredMeasure]:
        return bind_measures(self._measures, self._simulation.world.measure_view)

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

    def _begin(self, level: Level, last_level: Level | None) -> Iterator[None]:
        self._step_to(level, last_level)
        from_initial = self._base_level() if self._trial.is_independent else last_level
        self._live_topics.record_change(level, last_level=from_initial)
        self._triggers.arm()
        if (yield from self._wait(f"Level {level} never began")):
            self._step_to(level, last_level)
            self._triggers.arm()

    def _settle(self, duration: float) -> Iterator[None]:
        """Run without measurement for the settling time of the updaters [s]."""
        for _ in range(round(duration / self._plan.timestep)):
            yield from self._step()
            self._monitor.read_reports(self._simulation.time)

    def _run_level(self, level: Level) -> Generator[None, None, LevelRow]:
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
        self.active_measures = tuple(measures)
        for _ in range(n_steps):
            yield from self._step()
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
        self.active_measures = ()
        return row

    def _row(
        self,
        level: Level,
        measures: list[TriggeredMeasure],
        status: str,
        status_reason: str | None,
        start_step: int,
    ) -> LevelRow:
        is_blind = self._plan.is_blind or status == SIMULATION_ERROR
        is_tracking = status == "ok"
        return row_of(
            level,
            measures,
            (status, status_reason),
            expression=self._expression,
            simulation=self._simulation,
            start_step=start_step,
            fingerprint=self._fingerprinter.fingerprint,
            snapshots=()
            if is_blind
            else all_snapshots(self._simulation, measures, self._phases, is_tracking=is_tracking),
        )
