"""Executing one trial: an algorithm, a seed, and one level after the other.

*Sequential*: algorithm and scene live on from level to level. *Independent*: a level is run alone
and begins with a prelude at the updaters' initial values: the algorithm starts, gets the place of
its target and runs 1 s; then the level's values are ramped in over 1 s; only then is measured. A
benchmark with ``u:prelude="false"`` has none: the level's values hold from the first image on.
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
from ...errors import NeverStarted, SimulationFailed
from ...messages import String
from ...simulation import Calls, Simulation
from ...simulation.markers import SERVICE as SPAWN_MARKER
from ..own_process.program import Program, program_of, take_refused_messages
from ..planning.plan import Plan, Trial
from ..planning.trial_cache import TrialCache, compile_plan
from .fingerprint import Fingerprinter
from .floor import Floor
from .known_corners import known_corners
from .level_row import LevelRow, TrialEnd, cells_of
from .level_triggers import LevelTriggers
from .live_topics import LiveTopics
from .log_columns import log_columns
from .make_algorithm import make_algorithm, parameters_said, unread_parameters
from .moments import Moments, all_snapshots
from .motion_recorder import MotionRecorder
from .onlooker import Onlooker
from .pilot_inputs import pilot_inputs
from .pilot_topics import pilot_topics
from .status import SIMULATION_ERROR, StatusMonitor, legible
from .trial_recorder import TrialRecorder
from .triggered_measure import TriggeredMeasure, finite
from .visibility import Fact, TargetMotion, visibility_facts

STATUS_TOPIC = "algorithmStatus"
SETTLING = 1.0
"""How long an independent level runs at the initial values before the ramp [s]."""
RAMP = 1.0
"""How long the values of an independent level are ramped in [s]."""


def execute(
    plan: Plan,
    trial: Trial,
    *,
    cache: TrialCache | None = None,
    calls: Calls | None = None,
    onlooker: Onlooker | None = None,
    recorder: TrialRecorder | None = None,
) -> Iterator[LevelRow | TrialEnd]:
    """Run a trial; yields a LevelRow as each level ends, and at last the TrialEnd.

    Args:
        plan: the benchmark to run.
        trial: one of its trials.
        cache: keeps what does not change from trial to trial; without one the trial compiles its
            scene and has a renderer of its own.
        calls: counts those into the algorithm.
        onlooker: looks on between the steps.
        recorder: writes down the messages.

    Raises:
        NeverStarted: the start trigger did not go on within the benchmark's patience.
    """
    calls = calls or Calls()
    with program_of(plan, calls.limit) as program:  # its process starts while the scene is opened
        simulation = Simulation(
            compile_plan(plan, trial.seed) if cache is None else cache.model(plan, trial.seed),
            stream_prefix=trial.stream_prefix,
            is_blind=plan.is_blind,
            pool=None if cache is None else cache.renderers,
        )
        try:
            with (
                nullcontext() if recorder is None else recorder.recording(simulation, trial),
                attribute_errors_to(plan.plugins, when=partial(_moment, simulation, trial)),
                closing(_Execution(plan, trial, simulation, program, calls, onlooker)) as running,
                attribute_errors_to(plan.plugins, when=running.moment),
            ):
                yield from running.rows()
        finally:
            simulation.close()


def _moment(simulation: Simulation, trial: Trial) -> str:
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
        onlooker: Onlooker | None,
    ) -> None:
        self._plan, self._trial, self._simulation = plan, trial, simulation
        benchmark = benchmark_of_seed(plan.benchmark, trial.seed)
        self._updater = benchmark.scene_updater
        self._fingerprinter = Fingerprinter(simulation)
        self._motion = MotionRecorder(simulation, benchmark.measures)
        self._updaters = bind_updaters(self._updater, simulation.world.stage_view)
        if "no-markers" in plan.compatibility:
            simulation.bus.services.withdraw(SPAWN_MARKER)
        simulation.bus.keeps_unread = False  # all who read subscribe
        self._expression = parse(benchmark.function.text, [m.name for m in benchmark.measures])
        self._measures = benchmark.measures  # as they are bound for the next level
        ramp_level(self._updaters, self._before())
        for triggered in self._bind_measures():
            triggered.close()  # the bus now keeps the messages that they read when they start
        self._triggers = LevelTriggers(benchmark, simulation.world.measure_view)
        self._live = LiveTopics(benchmark.function, self._expression, simulation)
        status = simulation.bus.inbox(STATUS_TOPIC, String)
        self._calls = calls
        self._onlooker = onlooker
        self._inputs = pilot_inputs(plan, trial, simulation, onlooker)
        found = {} if self._inputs is None else pilot_topics(simulation)
        self._parameters = {**found, **known_corners(plan), **plan.algorithm.parameters}
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
        self._floor: Floor | None = None
        self._level: Level | None = None  # the last one
        self._level_began: int | None = None  # step in which the level began that runs
        self._n_measured = 0  # steps of the levels so far
        has_images = trial.index == 0 and not plan.is_blind
        self._moments = Moments(simulation) if has_images else None

    def moment(self) -> str:
        """``level fog=0.4, seed 7, at 3.02 s``."""
        level = f"level {self._level}, " if self._level else ""
        return level + _moment(self._simulation, self._trial)

    def rows(self) -> Iterator[LevelRow | TrialEnd]:
        """Run the levels."""
        plan, simulation = self._plan, self._simulation
        simulation.advance(0.0)
        self._motion.start()
        if self._onlooker is not None:
            pilot = None if self._inputs is None else self._parameters
            self._onlooker.open(simulation, self._title(), pilot)
        parameters = parameters_said(plan, self._algorithm, self._parameters, self._calls)
        if not plan.is_blind:
            self._facts = visibility_facts(simulation, plan, parameters)
        n_rows = 0
        try:
            for row in self._level_rows():
                n_rows += 1
                yield self._ended(row)
        except SimulationFailed as error:
            for level in self._trial.levels[n_rows:]:
                yield self._ended(self._failed_row(level, str(error)))
        for seen in (self._target_motion, self._floor):
            self._facts |= {} if seen is None else seen.facts
        yield TrialEnd(
            facts=self._facts,
            parameters=parameters,
            streams=() if plan.is_blind else self._streams(),
            notes=(*self._notes, *unread_parameters(plan, self._algorithm, self._node)),
            checkpoints=self._fingerprinter.checkpoints(),
            motion=self._motion.track(),
            inputs=b"" if self._inputs is None else self._inputs.data(),
        )

    def _level_rows(self) -> Iterator[LevelRow]:
        """Run the levels; raises SimulationFailed where nothing can follow."""
        plan = self._plan
        self._wait("The benchmark never started")
        if not plan.is_blind:
            self._target_motion = TargetMotion(self._simulation, plan)
            self._floor = Floor(self._simulation, plan)
        floor = self._floor
        before: Level | None = None
        for level in self._trial.levels:
            self._level = level
            if self._trial.is_alone:
                if floor is not None:
                    floor.start()
                if plan.benchmark.prelude:
                    self._prelude(level)
            self._begin(level, before)
            self._settle(settling_time(self._updater, level, after=before))
            if floor is not None:
                floor.begin()
            row = self._run_level(level)
            self._level_began = None
            if floor is not None:
                floor.end()
            yield row
            before = level

    def _ended(self, row: LevelRow) -> LevelRow:
        """Have it noted that a level is over."""
        row = replace(row, refused=take_refused_messages(self._algorithm))
        self._motion.end_level(row)
        if self._onlooker is not None:
            self._onlooker.end_level(row)
        return row

    def _failed_row(self, level: Level, why: str) -> LevelRow:
        """Return the row of a level whose simulation failed, in it or before it."""
        began = self._simulation.step if self._level_began is None else self._level_began
        self._level_began = None
        measures = self._bind_measures()  # what they were is not true
        row = self._row(level, measures, SIMULATION_ERROR, legible(why), began)
        self._close_measures(measures)
        return row

    def _before(self) -> Level:
        """The values before the first level."""
        if self._trial.is_alone and not self._plan.benchmark.prelude:
            return self._trial.levels[0]
        return initial_level(self._updater)

    def _title(self) -> str:
        """``currents, pi, seed 7``."""
        name = Path(self._plan.benchmark.path).stem
        return f"{name}, {self._plan.algorithm.name}, seed {self._trial.seed}"

    def close(self) -> None:
        """Close what updaters hold open, and let nobody look any more."""
        if self._onlooker is not None:
            self._onlooker.close()
        for updater in self._updaters:
            updater.close()

    def _streams(self) -> tuple[tuple[str, int, str], ...]:
        """Topic, number and SHA-256 of the images published, by topic."""
        cameras = [
            (topic, images.n_frames, images.sha256)
            for topic, images in self._simulation.world.images.items()
        ]
        return tuple(sorted([*cameras, *(s for u in self._updaters for s in u.streams)]))

    def _wait(self, never: str) -> bool:
        """Advance until a level may begin; return whether that took any time.

        Raises:
            NeverStarted: it did not within the benchmark's patience, or the algorithm raised.
        """
        simulation, node, patience = self._simulation, self._node, self._plan.patience
        began = simulation.time
        while not self._triggers.may_begin():
            if node.error is not None:
                raise NeverStarted(
                    f"{never}: algorithm {node.name!r} {node.how} before: {legible(node.error)}"
                )
            if simulation.time - began >= patience:
                why = self._triggers.why_not(patience)
                doubt = f"{never}: {why}. Does algorithm {node.name!r} see to it?"
                raise NeverStarted(" ".join([doubt, *node.unfed()]))
            simulation.advance()
        return simulation.time > began

    def _prelude(self, level: Level) -> None:
        """Let the algorithm settle at the initial values, then ramp in the level's."""
        plan, simulation = self._plan, self._simulation
        measures = self._bind_measures()
        settling, ramp = round(SETTLING / plan.timestep), round(RAMP / plan.timestep)
        initial = initial_level(self._updater)
        _tick(measures)
        for _ in range(settling):
            ramp_level(self._updaters, initial)
            simulation.advance()
            _tick(measures)
        for i in range(1, ramp + 1):
            ramp_level(self._updaters, blend(self._updater, level, i / ramp))
            simulation.advance()
        self._close_measures(measures)

    def _bind_measures(self) -> list[TriggeredMeasure]:
        """Bind every measure anew."""
        return [
            TriggeredMeasure(spec, self._simulation.world.measure_view) for spec in self._measures
        ]

    def _close_measures(self, measures: list[TriggeredMeasure]) -> None:
        """Close them, and remember which have initialised an algorithm."""
        self._measures = tuple(
            triggered.spec.once_initialised if triggered.measure.has_initialised else triggered.spec
            for triggered in measures
        )
        for triggered in measures:
            triggered.close()

    def _step_to(self, level: Level, before: Level | None) -> None:
        """Bring the scene to a level; the first of a sequence is no step."""
        if before is None and not self._trial.is_alone:
            begin_level(self._updaters, level)
        else:
            apply_level(self._updaters, level, after=before)

    def _begin(self, level: Level, before: Level | None) -> None:
        """Bring the scene to a level, and wait until it may begin."""
        self._step_to(level, before)
        from_initial = self._before() if self._trial.is_alone else before
        self._live.changed(level, after=from_initial)
        self._triggers.arm()
        if self._wait(f"Level {level} never began"):
            self._step_to(level, before)
            self._triggers.arm()

    def _settle(self, seconds: float) -> None:
        """Advance through the settling time, which is not measured."""
        for _ in range(round(seconds / self._plan.timestep)):
            self._simulation.advance()
            self._monitor.listen(self._simulation.time)

    def _run_level(self, level: Level) -> LevelRow:
        """Run one level, with newly bound triggers and measures."""
        plan, simulation, monitor = self._plan, self._simulation, self._monitor
        began = self._level_began = simulation.step
        monitor.begin_level()
        measures = self._bind_measures()
        self._motion.begin_level(measures)
        if self._onlooker is not None:
            self._onlooker.begin_level(level, measures)
        length = interval(self._updater)
        n_steps = round((MAX_TASK_DURATION if length is None else length) / plan.timestep)
        stopped, ended = False, None
        _tick(measures)
        monitor.listen(simulation.time)
        for _ in range(n_steps):
            simulation.advance()
            self._n_measured += 1
            _tick(measures)
            self._live.update(level, self._n_measured * plan.timestep, measures)
            if self._moments is not None:
                self._moments.look(measures)
            monitor.listen(simulation.time)
            stopped = not self._triggers.is_open()
            ended = _end_of_level(measures)
            is_over = self._trial.is_alone and monitor.failed is not None  # nothing can follow
            if stopped or ended is not None or is_over:
                break
        for triggered in measures:
            triggered.end()
            check_values(triggered.measure)
        if self._moments is not None:
            self._moments.end(measures)
        overran = MAX_TASK_DURATION if length is None and not stopped and ended is None else None
        status, why = monitor.status(measures, overran=overran, ended=ended)
        for triggered in measures:
            self._notes.update(
                (f"{triggered.spec.name}: {note}", None) for note in triggered.measure.notes
            )
        row = self._row(level, measures, status, why, began)
        self._close_measures(measures)
        return row

    def _row(
        self,
        level: Level,
        measures: list[TriggeredMeasure],
        status: str,
        why: str | None,
        began: int,
    ) -> LevelRow:
        simulation = self._simulation
        cells = cells_of(measures, status, why)
        score = self._expression.score(cells.values)
        total, reason = finite(score.value if status == "ok" else None)
        if total is None:
            cells.missing["total"] = why or score.reason or f"the function: {reason}"
        logged = [triggered for triggered in measures if triggered.spec.log is not None]
        return LevelRow(
            values=level.values,
            measures={name: (value, cells.units[name]) for name, value in cells.values.items()},
            details=cells.details,
            total=total,
            status=status,
            missing=cells.missing,
            ended_at=simulation.time,
            duration=(simulation.step - began) * simulation.timestep,
            logs={triggered.spec.name: triggered.log for triggered in logged},
            log_headers={
                triggered.spec.name: log_columns(triggered.measure) for triggered in logged
            },
            fingerprint=self._fingerprinter.fingerprint,
            remarks=_remarks(measures),
            snapshots=()
            if self._plan.is_blind or status == SIMULATION_ERROR
            else all_snapshots(simulation, measures, self._moments, is_tracking=status == "ok"),
        )


def _tick(measures: list[TriggeredMeasure]) -> None:
    """Let every measure see the world as it is now."""
    for triggered in measures:
        triggered.tick()


def _remarks(measures: list[TriggeredMeasure]) -> tuple[str, ...]:
    """What measures remark of a level, each remark once with the measures that make it."""
    names: dict[str, list[str]] = {}
    for triggered in measures:
        for remark in triggered.measure.remarks:
            names.setdefault(remark, []).append(triggered.spec.name)
    return tuple(f"{', '.join(found)}: {remark}" for remark, found in names.items())


def _end_of_level(measures: list[TriggeredMeasure]) -> str | None:
    """Why a measure ends the level now; None if it continues."""
    for triggered in measures:
        if why := triggered.measure.ends_level:
            return why
    return None
