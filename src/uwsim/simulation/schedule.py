"""The schedule of a simulation: periodic timers with their samples, and deferred commands."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from ..base.numerics.calls import address_of
from ..base.record import Record
from ..base.sampling import DUE, NO_STEP, TABLE, TIMER, Sampling, TimerState, take_due
from ..bus import Bus

M = TypeVar("M")


@dataclass(slots=True)
class ScheduleState(Record):
    """The state of a schedule."""

    due: npt.NDArray[np.int64]
    """The step before which no timer is due, (1,)."""
    timers: list[TimerState] = field(default_factory=list)
    """The state of each timer."""
    commands: list[tuple[int, object]] = field(default_factory=list)
    """The commands for the next step: the number of the handler and the message of each."""


@dataclass(frozen=True, eq=False)
class _Timer:
    """A timer, its callback, and the samples that it takes."""

    rate: float  # [Hz]
    call: Callable[[], None]
    is_needed: Callable[[], bool] | None
    sampling: Sampling | None
    state: TimerState

    def can_skip_prepare(self, end_time: float) -> bool:
        """Return whether samples until ``end_time`` [s] need no preparation in Python."""
        return self.sampling is None or self.sampling.sampler.can_skip_prepare(end_time)

    @property
    def is_called(self) -> bool:
        """True if the callback has something to do now."""
        return self.is_needed is None or self.is_needed()


class Schedule:
    """The timers of a simulation, and the commands for the next step.

    Args:
        bus: the bus, which counts the steps.
        timestep: the length of a step [s].
    """

    def __init__(self, bus: Bus, timestep: float) -> None:
        self._bus, self._timestep = bus, timestep
        self._timers: list[_Timer] = []
        self._command_handlers: list[Callable[[Any], None]] = []
        self.state = ScheduleState(np.full(1, NO_STEP))
        """The state of the schedule."""

    def create_timer(
        self,
        rate: float,
        call: Callable[[], None],
        *,
        is_needed: Callable[[], bool] | None = None,
        sampling: Sampling | None = None,
    ) -> Callable[[], None]:
        """Call ``call`` periodically from now on.

        Args:
            rate: the number of calls per second of simulation time [Hz].
            call: the callback.
            is_needed: returns whether the callback has something to do; None: always. Compiled
                steps do not end where it has nothing to do.
            sampling: the sampler that takes a sample before each call; None: no samples.

        Returns:
            A function that stops the timer.
        """
        state = TimerState.starting_at(self._bus.state.step)
        timer = _Timer(rate, call, is_needed, sampling, state)
        self._set_timers([*self._timers, timer])

        def stop() -> None:
            self._set_timers([t for t in self._timers if t is not timer])

        return stop

    def _set_timers(self, timers: list[_Timer]) -> None:
        self._timers, self.state.timers = timers, [timer.state for timer in timers]
        self.state.due[0] = min((timer.counts[DUE] for timer in self.state.timers), default=NO_STEP)
        self.__dict__.pop("_rows", None)
        self.__dict__.pop("table", None)

    @cached_property
    def _rows(self) -> npt.NDArray[np.void]:
        """The timers for compiled code, records of `TIMER`."""
        rows = np.zeros(len(self._timers), TIMER)
        rows["is_needed"] = 1
        for row, timer in zip(rows, self._timers, strict=True):
            row["rate"], row["counts"] = timer.rate, address_of(timer.state.counts)
            if timer.sampling is not None:
                sampler, sample = timer.sampling.sampler, timer.sampling.sample
                row["function"] = sampler.function
                row["parameters"] = address_of(sampler.parameters)
                row["values"] = address_of(sample.numbers)
        return rows

    @cached_property
    def table(self) -> npt.NDArray[np.void]:
        """The timers for compiled code, a record of `TABLE`, (1,)."""
        table = np.zeros(1, TABLE)
        table["timers"], table["n"] = address_of(self._rows), len(self._rows)
        table["due"], table["timestep"] = address_of(self.state.due), self._timestep
        return table

    def due_steps(self, last_step: int) -> tuple[int, int]:
        """Return the next steps at which compiled steps need Python.

        Args:
            last_step: the last step of interest.

        Returns:
            The step at which compiled steps have to end, because a callback is due; and the step
            of the first sample that compiled code cannot take without preparation.
        """
        python_due = preparation_due = NO_STEP
        for i, timer in enumerate(self._timers):
            due = int(timer.state.counts[DUE])
            if due > last_step or due >= preparation_due or not self._is_sampled(i, timer):
                continue
            if not timer.can_skip_prepare(last_step * self._timestep):
                preparation_due = due
            elif due < python_due and timer.is_called:
                python_due = due
        return min(python_due, preparation_due), preparation_due

    def _is_sampled(self, index: int, timer: _Timer) -> bool:
        """Return whether a timer takes its samples now, and write the flag for compiled code."""
        if timer.sampling is None or timer.sampling.is_needed is None:
            return True
        is_sampled = timer.sampling.is_needed()
        self._rows["is_needed"][index] = is_sampled
        return is_sampled

    def defer_to_next_step(self, apply: Callable[[M], None]) -> Callable[[M], None]:
        """Return a function that calls ``apply(message)`` at the start of the next step."""
        self._command_handlers.append(apply)
        index, state = len(self._command_handlers) - 1, self.state
        return lambda message: state.commands.append((index, message))

    def apply_commands(self) -> None:
        """Apply the commands that arrived during the last step, in the order of arrival."""
        commands, self.state.commands = self.state.commands, []
        for index, message in commands:
            self._command_handlers[index](message)

    def tick(self, step: int, *, is_sampled: bool = False) -> None:
        """Take the samples that are due at a step, and call the callbacks that are due.

        Args:
            step: the number of steps taken so far.
            is_sampled: True if compiled code has already taken the samples of this step.
        """
        if is_sampled:
            self._call_fired(self._timers)
        while step >= self.state.due[0]:  # a callback may create a timer that is due at once
            timers = self._timers
            for i, timer in enumerate(timers):
                if timer.sampling is None or step < timer.state.counts[DUE]:
                    continue
                if self._is_sampled(i, timer):
                    timer.sampling.sampler.prepare(step * self._timestep)
            take_due(self.table, step)
            self._call_fired(timers)

    def _call_fired(self, timers: Sequence[_Timer]) -> None:
        """Call the timers that were due when the table was last processed."""
        for timer, is_fired in zip(timers, self._rows["is_fired"].tolist(), strict=True):
            is_stopped = timers is not self._timers and timer not in self._timers
            if is_fired and timer.is_called and not is_stopped:
                timer.call()
