"""A measure with its triggers startOn and stopOn, and with its log."""

from __future__ import annotations

import math
from collections.abc import Sequence
from numbers import Real

from ...benchmark.measures import MeasureSpec, Outcome, connect_outcomes
from ...benchmark.plugin_checks import log_sample
from ...results.result import MAX_VALUE
from ...world import World

Sample = tuple[float | None, ...]


def finite_value(value: object) -> tuple[float | None, str | None]:
    """Return a measure's value, or None if a result cannot hold it, and the reason for None."""
    if value is None:
        return None, None
    if isinstance(value, Real) and not isinstance(value, bool):
        try:
            number = value if isinstance(value, int | float) else float(value)
            if math.isfinite(number):
                message = f"it gave {number:.3g}, beyond what can be reckoned with ({MAX_VALUE:g})"
                return (number, None) if abs(number) <= MAX_VALUE else (None, message)
            return None, f"it gave {number}"
        except OverflowError:
            return None, "it gave a whole number beyond float64"
    return None, f"it gave {type(value).__name__} {str(value)[:40]!r}, which is no number"


class TriggeredMeasure:
    """A measure that is on from its start trigger until its stop trigger."""

    def __init__(self, spec: MeasureSpec, world: World) -> None:
        self.spec = spec
        self.measure = spec.bind(world)
        self.log: list[Sample] = []
        """The samples so far: time in the level [s], then the measure's `log_values`."""
        self._world = world
        self._start = spec.start_on.bind(world)
        self._stop = spec.stop_on.bind(world)
        self._has_triggers = not (self._start.is_constant and self._stop.is_constant)
        self._is_on = not self._has_triggers and self._read_triggers()
        self._step0 = world.step
        self._was_on = False
        self._log_due = 0 if spec.log is not None else None
        self.never_started = True
        """True if the measure has never been on."""

    @property
    def value(self) -> object:
        """The measure's value.

        It is None if the measure never started. With the compatibility quirk ``never-started`` it
        is the start value instead, unless the original UWSim reports a missing value as an error.
        """
        return self.spec.start_value if self.has_start_value else self.measure.value

    @property
    def has_start_value(self) -> bool:
        """True if `value` is the start value of a measure that never started."""
        is_selected = "never-started" in self._world.compatibility
        is_valid = self.spec.error_flag == 0 and self.spec.start_value is not None
        return self.never_started and is_selected and is_valid

    def tick(self) -> None:
        """Start, update or stop the measure according to its triggers, after a step."""
        is_on = self._read_triggers() if self._has_triggers else self._is_on
        if is_on and not self._was_on:
            self.never_started = False
            self.measure.start()
        elif is_on:
            self.measure.update()
        elif self._was_on:
            self.measure.stop()
        if is_on and self._log_due is not None and self._world.step - self._step0 >= self._log_due:
            self._take_log()
        self._was_on = is_on

    def end(self) -> None:
        """Stop the measure at the end of the level."""
        if self._was_on:
            self.measure.stop()
            self._was_on = False

    def close(self) -> None:
        """Remove the subscriptions and services of measure and triggers."""
        self.measure.close()
        self._start.close()
        self._stop.close()

    def _read_triggers(self) -> bool:
        return self._start.is_on() and not self._stop.is_on()

    def _take_log(self) -> None:
        """Take a sample; the next is due at the next multiple of the period."""
        assert self.spec.log is not None
        timestep = self._world.timestep
        time = (self._world.step - self._step0) * timestep
        self.log.append((time, *(finite_value(value)[0] for value in log_sample(self.measure))))
        n_next = math.floor(time / self.spec.log + 1e-9) + 1
        self._log_due = math.ceil(n_next * self.spec.log / timestep - 1e-9)


def bind_measures(specs: Sequence[MeasureSpec], world: World) -> list[TriggeredMeasure]:
    """Bind all measures of a benchmark, and connect its outcome with them.

    Raises:
        UwsimError: a name in a spec is unknown.
    """
    measures = [TriggeredMeasure(spec, world) for spec in specs]
    connect_outcomes([(measure.spec.name, measure.measure) for measure in measures])
    return measures


def tick_all(measures: Sequence[TriggeredMeasure]) -> None:
    """Start, update or stop measures after a step."""
    for measure in measures:
        measure.tick()


def find_outcome(measures: Sequence[TriggeredMeasure]) -> Outcome | None:
    """Return the measure that judges the level by the others; None if there is none."""
    judges = (measure.measure for measure in measures)
    return next((judge for judge in judges if isinstance(judge, Outcome)), None)


def find_ending(measures: Sequence[TriggeredMeasure]) -> str | None:
    """Return the reason for which a measure ends the level; None if no measure does."""
    for measure in measures:
        if reason := measure.measure.ends_level:
            return reason
    return None
