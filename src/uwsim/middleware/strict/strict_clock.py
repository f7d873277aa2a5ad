r"""The strict clock: a simulation in real time, in which late data is an error.

The clock starts at the end of the first step. From then on, the simulation time t is due at the
real time :math:`w(t) = w_0 + (t - t_0) / f`, with the real-time factor f.

- A *step* that ends at t is late by the real time of its end minus w(t).
- An *output* of a stream is late by the real time at which it is sent minus w of the time at which
  it is due. Its age is counted from the time of its measurement.
- An *input* with the period T is late by the real time since the last input of its stream, minus T.
  Each further whole period without an input is a missing one. An output is missing if it cannot be
  sent, because its reader has gone or does not read. An output that is lost before the first reader
  comes has no reader, which is no error; it counts as nothing else.

What is late by more than the deadline is counted. The clock only reads the simulation: late data
is used, and no state depends on real time. The resolution of inputs is one step.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace

from ..pacing import Pace
from .delays import Delays

DEFAULT_DEADLINE = 0.010
"""The default deadline [s]."""


@dataclass
class StreamReport:
    """The counts of a stream, or of the steps."""

    name: str
    """The name of the stream."""
    kind: str
    """The kind: ``step``, ``output`` or ``input``."""
    rate: float | None = None
    """The rate at which inputs are expected [Hz]; None for others."""
    n: int = 0
    """The number of steps or messages."""
    n_late: int = 0
    """The number of late ones."""
    n_missing: int = 0
    """The number of inputs that did not come, or of outputs that could not be sent."""
    n_unread: int = 0
    """The number of outputs that were lost because there was no reader yet; no errors."""
    lateness: Delays = field(default_factory=Delays)
    """The times by which they were late [s]."""
    ages: Delays = field(default_factory=Delays)
    """The real times from the measurement of outputs to their sending [s]."""
    last_arrival: float = math.nan
    """The real time of the last input [s]; NaN before the first."""

    @property
    def n_on_time(self) -> int:
        """The number of those that were not late."""
        return self.n - self.n_late

    def count(self, lateness: float, deadline: float) -> None:
        """Count one that is late by a time [s]; negative if it is early."""
        self.n += 1
        self.n_late += lateness > deadline
        self.lateness.add(lateness)


@dataclass(frozen=True, kw_only=True)
class StrictReport:
    """The late and missing data of a run, and its delays."""

    deadline: float
    """The time by which data may be late [s]."""
    duration: float
    """The real time since the start of the clock [s]."""
    lost_time: float
    """The real time by which the simulation fell behind and did not catch up [s]."""
    streams: tuple[StreamReport, ...]
    """The steps, then the streams in the order of the scene."""
    step_time: Delays
    """The computing time of a step [s]."""
    output_age: Delays
    """The real time from a measurement to the sending of its bytes [s]."""
    input_to_effect: Delays
    """The real time from a measurement to the effect of the command that answers it [s]."""

    @property
    def n_errors(self) -> int:
        """The number of late and missing steps and messages."""
        return sum(stream.n_late + stream.n_missing for stream in self.streams)


class StrictClock:
    """A pace that counts what is late.

    Args:
        clock: a function that returns the simulation time [s].
        real_time_factor: the simulation time per real time [1], > 0.
        deadline: the time by which data may be late [s].
        max_lag: the lag above which the run ends [s]; None: no limit.
        now: a function that returns the real time [s].
        sleep: a function that waits for a time [s].
    """

    def __init__(
        self,
        clock: Callable[[], float],
        real_time_factor: float = 1.0,
        *,
        deadline: float = DEFAULT_DEADLINE,
        max_lag: float | None = None,
        now: Callable[[], float] = time.perf_counter,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self._deadline, self._now = deadline, now
        self._steps = StreamReport("steps", "step")
        self._streams: dict[str, StreamReport] = {}
        self._has_reader: dict[str, Callable[[], bool]] = {}
        self._step_time, self._input_to_effect = Delays(), Delays()
        self._step_start = self._clock_start = math.nan
        self._end: float | None = None
        self._pace = Pace(
            clock, real_time_factor, max_lag=max_lag, now=now, sleep=sleep, on_lag=self._note_lag
        )

    def watch_output(self, name: str, has_reader: Callable[[], bool] = lambda: True) -> None:
        """Report a stream of outputs, also if it sends nothing.

        Args:
            name: the name of the stream.
            has_reader: a function that returns False if nobody has read what was sent.
        """
        self._streams.setdefault(name, StreamReport(name, "output"))
        self._has_reader[name] = has_reader

    def watch_input(self, name: str, rate: float) -> None:
        """Report a stream of inputs that is expected at a rate [Hz]."""
        self._streams.setdefault(name, StreamReport(name, "input", rate))

    def step(self) -> None:
        """Measure the step that has just ended, and wait until the next one begins.

        Raises:
            RunFailed: the simulation lags behind real time by more than ``max_lag``.
        """
        now = self._now()
        if math.isnan(self._clock_start):
            self._clock_start = now
        else:
            self._step_time.add(now - self._step_start)
        try:
            self._pace.step()
        finally:
            self._step_start = self._now()

    def _note_lag(self, lag: float) -> None:
        self._steps.count(lag, self._deadline)

    def note_sent(self, name: str, time: float, due_time: float) -> None:
        """Count an output.

        Args:
            name: the name of the stream.
            time: the simulation time of the measurement [s].
            due_time: the simulation time at which it is to be sent [s].
        """
        if not self._pace.is_started:
            return
        now = self._now()
        stream = self._streams[name]
        stream.count(now - self._pace.due_at(due_time), self._deadline)
        stream.ages.add(now - self._pace.due_at(time))

    def note_unsent(self, name: str) -> None:
        """Count an output that could not be sent: missing, or unread before the first reader."""
        stream = self._streams[name]
        if self._pace.is_started and stream.n:
            stream.n_missing += 1
        elif self._pace.is_started:
            stream.n_unread += 1

    def note_command(self, name: str, stamp: float | None) -> None:
        """Count an input.

        Args:
            name: the name of the stream.
            stamp: the simulation time of the measurement that it answers [s], if known.
        """
        if not self._pace.is_started:
            return
        now, stream = self._now(), self._streams[name]
        assert stream.rate is not None
        period, gap = 1.0 / stream.rate, now - stream.last_arrival
        stream.last_arrival = now
        if math.isnan(gap):  # the first: the other side decides when it begins
            stream.count(0.0, self._deadline)
        else:
            stream.count(gap - period, self._deadline)
            stream.n_missing += max(math.floor(gap / period) - 1, 0)
        if stamp is not None:
            self._input_to_effect.add(now - self._pace.due_at(stamp))

    def stop(self) -> None:
        """End the counting of inputs that do not come; `report` is that of now from here on."""
        if self._end is None:
            self._end = self._now()

    def report(self) -> StrictReport:
        """Return what was late until now or the stop, and the inputs that have not come."""
        now = self._now() if self._end is None else self._end
        streams = [self._count_waiting(stream, now) for stream in self._streams.values()]
        output_age = Delays()
        for stream in streams:
            output_age.merge(stream.ages)
        return StrictReport(
            deadline=self._deadline,
            duration=now - self._clock_start if self._pace.is_started else 0.0,
            lost_time=self._pace.lost_time,
            streams=(self._steps, *streams),
            step_time=self._step_time,
            output_age=output_age,
            input_to_effect=self._input_to_effect,
        )

    def _count_waiting(self, stream: StreamReport, now: float) -> StreamReport:
        """Return a copy of a stream with missing inputs, or outputs that nobody has read."""
        if stream.kind == "output" and not self._has_reader[stream.name]():
            n_unread = stream.n + stream.n_missing + stream.n_unread
            return StreamReport(stream.name, "output", n_unread=n_unread)
        if stream.rate is None or not self._pace.is_started:
            return stream
        has_begun = not math.isnan(stream.last_arrival)
        waiting_time = now - (stream.last_arrival if has_begun else self._clock_start)
        n_waiting = max(math.floor((waiting_time - self._deadline) * stream.rate), 0)
        return replace(stream, n_missing=stream.n_missing + n_waiting)
