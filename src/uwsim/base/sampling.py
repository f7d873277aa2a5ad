"""Timers that determine when sensors take samples, and samplers that take them in compiled code.

A sample is due at the first step at or after its time. Timers are rows of a table, which compiled
code reads (`take_due`) at the steps at which a timer is due. A timer may have a sampler: a compiled
function that writes the numbers of a sample (`uwsim.base.numerics.calls`).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from .numerics.calls import address_of, call, evaluate, function_address, prepare_nothing
from .numerics.jit import njit
from .numerics.linear import Array
from .numerics.memory import Ints64, carray, pointer, read_double, view_doubles, view_int64s
from .record import Record

START, N_SAMPLES, DUE = range(3)
"""The indices in a timer's counts: step of the first sample, number of samples, next step."""
NO_STEP = 2**62
"""The step at which the next timer is due in a table without timers."""

TIMER = np.dtype(
    [
        ("rate", np.float64),  # [Hz]
        ("counts", np.int64),  # the address of `TimerState.counts`
        ("function", np.int64),  # the address of the sampler's function; 0: there is no sampler
        ("parameters", np.int64),  # the address of the sampler's parameters
        ("values", np.int64),  # the address of `Sample.numbers`
        ("is_needed", np.int64),  # 1 if samples are taken, else 0
        ("is_fired", np.int64),  # 1 if the timer was due and needed at the last `take_due`
    ]
)
"""A timer in a table."""
TABLE = np.dtype(
    [
        ("timers", np.int64),  # the address of the records of `TIMER`
        ("n", np.int64),  # the number of timers
        ("due", np.int64),  # the address of the step at which the next timer is due
        ("timestep", np.float64),  # [s]
    ]
)
"""A table of timers."""

Records = Any


@njit
def sample_step(n: int, rate: float, timestep: float) -> int:
    """Return the step at which sample ``n`` of a sensor with ``rate`` [Hz] is taken."""
    return math.ceil(n / (rate * timestep) - 1e-9)


@njit
def count_sample(counts: Ints64, rate: float, timestep: float) -> None:
    """Count a sample of a timer, and compute the step of the next sample."""
    counts[N_SAMPLES] += 1
    counts[DUE] = counts[START] + sample_step(counts[N_SAMPLES], rate, timestep)


@njit
def take_due(tables: Records, step: int) -> None:
    """Count the timers that are due at a step, and take the samples of those with a sampler."""
    table = tables[0]
    timers = carray(pointer(table.timers), (table.n,), TIMER)
    next_due = NO_STEP
    for i in range(table.n):
        timer = timers[i]
        counts = view_int64s(timer.counts, 3)
        is_due = step >= counts[DUE]
        timer.is_fired = timer.is_needed if is_due else 0
        if is_due:
            count_sample(counts, timer.rate, table.timestep)
            if timer.function != 0 and timer.is_needed != 0:
                time = step * table.timestep
                view_doubles(timer.values, 1)[0] = time
                call(timer.function, timer.parameters, timer.values + 8, time)
        next_due = min(next_due, counts[DUE])
    view_int64s(table.due, 1)[0] = next_due


@dataclass(slots=True)
class TimerState(Record):
    """The state of a timer."""

    counts: npt.NDArray[np.int64]
    """The step of the first sample, the number of samples, the step of the next sample, (3,)."""

    @staticmethod
    def starting_at(step: int) -> TimerState:
        """Return the state of a timer whose first sample is due at a step."""
        return TimerState(np.array([step, 0, step], np.int64))


class SampleTimer:
    """A timer that calls a Python function at a rate.

    Args:
        start: the step of the first call.
        rate: the rate [Hz].
        timestep: the duration of a step [s].
        call: the function.
    """

    def __init__(self, start: int, rate: float, timestep: float, call: Callable[[], None]) -> None:
        self._rate, self._timestep, self._call = rate, timestep, call
        self.state = TimerState.starting_at(start)
        """The state of the timer."""

    @property
    def due(self) -> int:
        """The step of the next sample."""
        return int(self.state.counts[DUE])

    def tick(self, step: int) -> None:
        """Call the function if a sample is due at this step."""
        if step >= self.due:
            count_sample(self.state.counts, self._rate, self._timestep)
            self._call()


def _needs_no_preparation(end: float) -> bool:
    return True


@dataclass(frozen=True, kw_only=True, eq=False)
class Sampler:
    """A compiled function that takes the samples of a sensor."""

    function: int
    """The address of the function that writes a sample (`uwsim.base.numerics.calls`)."""
    parameters: npt.NDArray[Any]
    """The array that the function reads at its address."""
    n_values: int
    """The number of numbers that the function writes."""
    prepare: Callable[[float], None] = prepare_nothing
    """A Python function that updates the inputs of the sampler to a time [s]; it is called before
    each sample that is taken from Python."""
    can_skip_prepare: Callable[[float], bool] = _needs_no_preparation
    """A function that returns whether compiled steps until a time [s] need no preparation."""
    memory_owners: tuple[object, ...] = field(default=())
    """The objects whose memory the parameters refer to; they must not be freed."""

    def take(self, time: float) -> Array:
        """Take a sample at ``time`` [s] and return its numbers, (n,)."""
        self.prepare(time)
        return evaluate(self.function, address_of(self.parameters), self.n_values, time)


@dataclass(slots=True)
class Sample(Record):
    """The last sample that was taken for a topic."""

    numbers: Array
    """The time [s], NaN before the first sample, and the numbers of its `Sampler`, (1 + n,)."""

    @staticmethod
    def create(sampler: Sampler) -> Sample:
        """Return the sample of a sampler that has not taken one."""
        return Sample(np.full(1 + sampler.n_values, math.nan))


@dataclass(frozen=True, eq=False)
class Sampling:
    """A sampler with its last sample."""

    sampler: Sampler
    """The sampler that takes the samples."""
    sample: Sample
    """The last sample."""
    is_needed: Callable[[], bool] | None = None
    """A check whether a sample is needed now; None where each sample changes the sensor."""


ADDRESSES = np.dtype([("addresses", np.int64), ("n", np.int64)])
"""The address of the addresses of some doubles, and their number."""
Addresses = npt.NDArray[np.int64]


def number_addresses(
    array: npt.NDArray[np.float64], numbers: npt.ArrayLike | None = None
) -> Addresses:
    """Return the addresses of elements of a contiguous array, which must not be freed, (n,).

    Args:
        array: the array.
        numbers: the indices of the elements in row-major order; None: all elements.
    """
    indices = np.arange(array.size) if numbers is None else np.asarray(numbers, dtype=np.int64)
    return address_of(array) + array.itemsize * indices.ravel()


def gather_sampler(
    addresses: Addresses,
    *,
    prepare: Callable[[float], None],
    can_skip_prepare: Callable[[float], bool],
) -> Sampler:
    """Return a sampler that copies the numbers at some addresses, in their order.

    Args:
        addresses: addresses of doubles, (n,); ``prepare`` may change them.
        prepare: as in `Sampler`.
        can_skip_prepare: as in `Sampler`.
    """
    row = np.zeros(1, ADDRESSES)
    row["addresses"], row["n"] = address_of(addresses), len(addresses)
    return Sampler(
        function=function_address(gather),
        parameters=row,
        n_values=len(addresses),
        prepare=prepare,
        can_skip_prepare=can_skip_prepare,
        memory_owners=(addresses,),
    )


def gather(parameters_address: int, values_address: int, time: float) -> None:
    """Copy numbers from their addresses (`ADDRESSES`); see `uwsim.base.numerics.calls`."""
    row = carray(pointer(parameters_address), (1,), ADDRESSES)[0]
    addresses, values = view_int64s(row.addresses, row.n), view_doubles(values_address, row.n)
    for i in range(row.n):
        values[i] = read_double(addresses[i])
