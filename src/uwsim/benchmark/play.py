"""Playing one unit of work: an algorithm, a seed, and one level after the other.

*Sequential*: algorithm and scene live on from level to level. *Independent*: a level stands alone
and begins with a prelude at the updaters' initial values: the algorithm starts, is told where its
target is and runs 1 s; then the level's values are ramped in over 1 s; only then is measured.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from ..bus import Algorithm, Inbox
from ..errors import NeverStarted
from ..messages import String
from ..simulation import InProcessNode, Simulation
from ..world import World
from .facts import Fact, visibility_facts
from .measures import MeasureSpec
from .pictures import Shot, shoot
from .plan import Plan, Unit
from .score import Expression, parse
from .triggers import TriggerSpec
from .updaters import (
    Level,
    SceneUpdater,
    apply_level,
    bind_updaters,
    blend,
    calm,
    initial_level,
    interval,
    ramp_level,
)

STATUS_TOPIC = "algorithmStatus"
SETTLING = 1.0
"""How long an independent level runs at the initial values before the ramp [s]."""
RAMP = 1.0
"""How long the values of an independent level are ramped in [s]."""
SILENCE = 1.0
"""A measure that waits longer than this for an estimate ends in ``timeout`` [s]."""
LONGEST_TASK = 600.0
"""A level without an interval ends after this, in ``timeout`` [s]."""

Sample = tuple[float | None, ...]


@dataclass(frozen=True, kw_only=True)
class Row:
    """What one level leaves behind."""

    values: tuple[tuple[str, float], ...]
    """The level: updaters' references and values, outermost first."""
    measures: dict[str, tuple[float | None, str]]
    """Measure -> value and unit."""
    details: dict[str, tuple[float | None, str]]
    """``measure.detail`` -> value and unit."""
    total: float | None
    """The score."""
    status: str
    """``ok``, or the first of DESIGN 5 that applies."""
    missing: dict[str, str]
    """Column -> why it is null."""
    ended_at: float
    """Simulation time at the end of the level [s]."""
    duration: float
    """How long the level was measured [s]."""
    logs: dict[str, list[Sample]]
    """Measure -> samples: time in the level [s], then `log_headers`."""
    log_headers: dict[str, tuple[str, ...]]
    """Measure -> names of what stands in its samples after the time."""
    shots: tuple[Shot, ...]
    """The cameras' last pictures."""


@dataclass(frozen=True, kw_only=True)
class UnitEnd:
    """What a unit knows when it is done, beside its rows."""

    facts: dict[str, Fact]
    """Constants of the scene, measured before the first level."""
    parameters: dict[str, float | str]
    """Parameters of the algorithm, defaults included."""
    streams: tuple[tuple[str, int, str], ...]
    """Topic, number of images, SHA-256 over their pixels."""
    notes: tuple[str, ...]
    """What the reader of the result should know, besides the values."""


class Gated:
    """A measure that is on from its start trigger until its stop trigger."""

    def __init__(self, spec: MeasureSpec, world: World) -> None:
        self.spec = spec
        self.measure = spec.bind(world)
        self.log: list[Sample] = []
        """Samples taken so far."""
        self._world = world
        self._start = spec.start_on.bind(world)
        self._stop = spec.stop_on.bind(world)
        self._began = world.step
        self._was_on = False
        self._log_due = 0 if spec.log is not None else None

    def tick(self) -> None:
        """Start or update the measure, whichever the triggers ask for."""
        on = self._start.is_on() and not self._stop.is_on()
        if on and not self._was_on:
            self.measure.start()
        elif on:
            self.measure.update()
        if on and self._log_due is not None and self._world.step - self._began >= self._log_due:
            self._take_log()
        self._was_on = on

    def close(self) -> None:
        """Let go of the measure's and the triggers' subscriptions and services."""
        self.measure.close()
        self._start.close()
        self._stop.close()

    def _take_log(self) -> None:
        """Take a sample; the next is due at the next multiple of the period."""
        assert self.spec.log is not None
        timestep = self._world.timestep
        elapsed = (self._world.step - self._began) * timestep
        self.log.append((elapsed, *self.measure.log_values))
        n_next = math.floor(elapsed / self.spec.log + 1e-9) + 1
        self._log_due = math.ceil(n_next * self.spec.log / timestep - 1e-9)


class Verdict:
    """What the algorithm says of itself, and what befell it."""

    def __init__(self, node: InProcessNode, inbox: Inbox[String], timestep: float) -> None:
        self._node, self._inbox, self._timestep = node, inbox, timestep
        self.lost: str | None = None
        """Why and when it said it was lost."""
        self.failed: str | None = None
        """Why and when it failed or raised."""

    def listen(self, time: float) -> None:
        """Take note of what came in since the last call."""
        if self._inbox.last is None and self._node.error is None:
            return
        for message in self._inbox.take():
            state, _, why = message.data.partition(":")
            said = legible(f"{self._node.name} {state.strip()} at {time:g} s: {why.strip()}")
            if state.strip() == "lost" and self.lost is None:
                self.lost = said
            elif state.strip() == "failed" and self.failed is None:
                self.failed = said
        if self._node.error is not None and self.failed is None:
            self.failed = legible(f"{self._node.name} raised at {time:g} s: {self._node.error}")


def play(plan: Plan, unit: Unit) -> Iterator[Row | UnitEnd]:
    """Play a unit; yields a Row as each level ends, and at last the UnitEnd.

    Raises:
        NeverStarted: the start trigger did not go on within the benchmark's patience.
    """
    simulation = Simulation(
        plan.scene,
        seed=unit.seed,
        stream_prefix=unit.stream_prefix,
        timestep=plan.timestep,
        data_path=plan.data_path,
        compatibility=plan.compatibility,
        is_blind=plan.is_blind,
    )
    try:
        yield from _play(plan, unit, simulation)
    finally:
        simulation.close()


def bind_all(plan: Plan, simulation: Simulation) -> None:
    """Look up every name of the benchmark once, so that none can fail after hours.

    Raises:
        UnknownName: a body, a camera or a link is not there.
    """
    benchmark = plan.benchmark
    bind_updaters(benchmark.scene_updater, simulation)
    for gated in [Gated(spec, simulation) for spec in benchmark.measures]:
        gated.close()
    for trigger in (benchmark.start_on, benchmark.stop_on):
        trigger.bind(simulation).close()


def _play(plan: Plan, unit: Unit, simulation: Simulation) -> Iterator[Row | UnitEnd]:
    benchmark = plan.benchmark
    updaters = bind_updaters(benchmark.scene_updater, simulation)
    expression = parse(benchmark.function.text, [spec.name for spec in benchmark.measures])
    apply_level(updaters, initial_level(benchmark.scene_updater))
    start = benchmark.start_on.bind(simulation)
    status = simulation.inbox(STATUS_TOPIC, String)
    algorithm = _make(plan)
    node = simulation.attach(algorithm, name=plan.algorithm_name, parameters=plan.parameters)
    verdict = Verdict(node, status, plan.timestep)
    simulation.open()
    facts: dict[str, Fact] = {}
    if not plan.is_blind:
        facts = visibility_facts(simulation, plan, getattr(algorithm, "parameters", {}))
    while not start.is_on():
        if simulation.time >= plan.patience or node.error is not None:
            raise NeverStarted(_never(benchmark.start_on, plan, node, simulation.time))
        simulation.advance()
    notes: dict[str, None] = {}
    before: Level | None = None
    for level in unit.levels:
        if unit.is_alone:
            _prelude(plan, level, simulation, updaters)
        apply_level(updaters, level, after=before)
        still = calm(benchmark.scene_updater, level, after=before)
        before = level
        yield _play_level(plan, level, still, simulation, verdict, expression, notes)
    yield UnitEnd(
        facts=facts,
        parameters=dict(getattr(algorithm, "parameters", plan.parameters)),
        streams=tuple(
            (topic, images.n_frames, images.sha256)
            for topic, images in sorted(simulation.images.items())
            if not plan.is_blind
        ),
        notes=tuple(notes),
    )


def _make(plan: Plan) -> Algorithm:
    """Make the algorithm; what its constructor raises keeps the benchmark from starting."""
    try:
        return plan.algorithm()
    except (Exception, SystemExit) as error:
        raise NeverStarted(
            f"Algorithm {plan.algorithm_name!r} cannot be made: "
            f"{legible(f'{type(error).__name__}: {error}')}"
        ) from error


def legible(text: str) -> str:
    """Return what an algorithm says as one printable line of at most 300 characters."""
    line = "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)
    return line if len(line) <= 300 else line[:297] + "..."


def _prelude(
    plan: Plan, level: Level, simulation: Simulation, updaters: tuple[SceneUpdater, ...]
) -> None:
    """Let the algorithm settle at the initial values, then ramp in the level's."""
    measures = [Gated(spec, simulation) for spec in plan.benchmark.measures]
    settling, ramp = round(SETTLING / plan.timestep), round(RAMP / plan.timestep)
    initial = initial_level(plan.benchmark.scene_updater)
    _tick(measures)
    for _ in range(settling):
        ramp_level(updaters, initial)
        simulation.advance()
        _tick(measures)
    for i in range(1, ramp + 1):
        ramp_level(updaters, blend(plan.benchmark.scene_updater, level, i / ramp))
        simulation.advance()
    for gated in measures:
        gated.close()


def _play_level(
    plan: Plan,
    level: Level,
    still: float,
    simulation: Simulation,
    verdict: Verdict,
    expression: Expression,
    notes: dict[str, None],
) -> Row:
    """Play one level, with triggers and measures that have seen nothing before.

    Its first ``still`` seconds are not measured.
    """
    benchmark = plan.benchmark
    for _ in range(round(still / plan.timestep)):
        simulation.advance()
        verdict.listen(simulation.time)
    began = simulation.step
    stop = benchmark.stop_on.bind(simulation)
    measures = [Gated(spec, simulation) for spec in benchmark.measures]
    length = interval(benchmark.scene_updater)
    n_steps = round((LONGEST_TASK if length is None else length - still) / plan.timestep)
    stopped = False
    _tick(measures)
    verdict.listen(simulation.time)
    for _ in range(n_steps):
        simulation.advance()
        _tick(measures)
        verdict.listen(simulation.time)
        if stop.is_on():
            stopped = True
            break
    overran = length is None and not stopped
    status, why = _status(measures, verdict, LONGEST_TASK if overran else None)
    for gated in measures:
        notes.update((f"{gated.spec.name}: {note}", None) for note in gated.measure.notes)
    row = _row(level, simulation, measures, expression, status, why, began, is_blind=plan.is_blind)
    for gated in measures:
        gated.close()
    stop.close()
    return row


def _tick(measures: list[Gated]) -> None:
    """Let every measure see the world as it is now."""
    for gated in measures:
        gated.tick()


def _status(
    measures: list[Gated], verdict: Verdict, overran: float | None
) -> tuple[str, str | None]:
    """Status of a row and, unless it is ``ok``, why: the first that applies (DESIGN 5).

    An algorithm that declared itself lost or failed owes no more estimates.
    """
    if verdict.failed is not None:
        return "algorithm error", verdict.failed
    if overran is not None:
        return "timeout", f"stopOn did not go on within {overran:g} s"
    if verdict.lost is not None:
        return "lost", verdict.lost
    for gated in measures:
        if gated.measure.longest_silence > SILENCE:
            return "timeout", gated.measure.why or f"no estimate for more than {SILENCE:g} s"
    return "ok", None


def _row(
    level: Level,
    simulation: Simulation,
    measures: list[Gated],
    expression: Expression,
    status: str,
    why: str | None,
    began: int,
    *,
    is_blind: bool,
) -> Row:
    values: dict[str, float | None] = {}
    units: dict[str, str] = {}
    details: dict[str, tuple[float | None, str]] = {}
    missing: dict[str, str] = {}
    for gated in measures:
        name, measure = gated.spec.name, gated.measure
        blank = status != "ok" and measure.fed_by_algorithm
        units[name] = measure.unit
        values[name] = None if blank else measure.value
        if values[name] is None:
            missing[name] = (why if blank else measure.why) or "nothing to measure"
        for detail, value in measure.details.items():
            unit = "1" if detail.split(".")[-1] == "n" else measure.unit
            unit = measure.detail_units.get(detail, unit)
            details[f"{name}.{detail}"] = (None if blank else value, unit)
    total = None if status != "ok" else expression.evaluate(values)
    if total is None:
        absent = [name for name, value in values.items() if value is None]
        missing["total"] = why or (
            f"no value for {', '.join(absent)}" if absent else "the function has no value here"
        )
    logged = [gated for gated in measures if gated.spec.log is not None]
    return Row(
        values=level.values,
        measures={name: (value, units[name]) for name, value in values.items()},
        details=details,
        total=total,
        status=status,
        missing=missing,
        ended_at=simulation.time,
        duration=(simulation.step - began) * simulation.timestep,
        logs={gated.spec.name: gated.log for gated in logged},
        log_headers={gated.spec.name: gated.measure.log_header for gated in logged},
        shots=()
        if is_blind
        else shoot(
            simulation,
            [(gated.spec, gated.measure) for gated in measures],
            is_tracking=status == "ok",
        ),
    )


def _never(start: TriggerSpec, plan: Plan, node: InProcessNode, time: float) -> str:
    if node.error is not None:
        return f"Algorithm {node.name!r} raised before the benchmark started: {legible(node.error)}"
    return (
        f"The benchmark never started: its startOn ({start}) did not go on within "
        f"{plan.patience:g} s of simulation time. Does algorithm {node.name!r} call it?"
    )
