"""Checks for levels that never begin, and for times shorter than half a simulation step.

Such a benchmark file is readable, but cannot do what its author intends: a time is rounded to a
whole number of steps, so a time below half a step is 0.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..schema import Spec, line_of
from .measures import EuclideanNormSpec, MeasureSpec
from .spec import BenchmarkSpec, FunctionSpec
from .triggers import NeverSpec, ServiceSpec
from .updaters import SceneUpdaterSpec, chain, interval

LocatedMessage = tuple[Spec | int | None, str]
"""A spec or a line, and the message about it."""


def warn_never_started(spec: BenchmarkSpec) -> Iterator[LocatedMessage]:
    """Yield a warning for each reason why the start trigger can never start a level."""
    start, line = spec.start_on, line_of(spec, "startOn")
    if isinstance(start, NeverSpec):
        yield line, "<startOn> is 'never': no level will ever begin"
    init_services = [
        measure.ground_truth.publish_on
        for measure in spec.measures
        if isinstance(measure, EuclideanNormSpec)
    ]
    if isinstance(start, ServiceSpec) and start.target in init_services:
        yield (
            line,
            f"<startOn> waits for the service {start.target!r}, which the algorithm serves "
            "(<publishOn>): it cannot be called in this run, so no level will begin",
        )


def find_short_times(
    measures: Sequence[MeasureSpec],
    updater: SceneUpdaterSpec | None,
    function: FunctionSpec | None,
    timestep: float,
) -> Iterator[LocatedMessage]:
    """Yield an error for each time that is shorter than half a simulation step.

    Args:
        measures: the measures that could be read.
        updater: the outermost updater, if it could be read.
        function: the score function, if it could be read.
        timestep: the length of a simulation step [s].
    """
    step = f"less than half a step of {timestep:g} s"
    for spec in measures:
        if spec.log is not None and _is_too_short(spec.log, timestep):
            yield line_of(spec, "log"), f"<log> is {spec.log:g} s: {step}"
    rate = 0.0 if function is None else function.publish_rate
    if rate > 0.0 and _is_too_short(rate, timestep):
        message = f"publishRate is {rate:g} s: {step}; 0 publishes at every step"
        yield function, message
    if updater is not None:
        yield from _short_intervals(updater, timestep, step)


def _short_intervals(
    updater: SceneUpdaterSpec, timestep: float, step: str
) -> Iterator[LocatedMessage]:
    length, deepest_updater = interval(updater), chain(updater)[-1]
    if length is not None and _is_too_short(length, timestep):
        message = f"<interval> is {length:g} s: {step}, so no step is run"
        yield line_of(deepest_updater, "interval"), message
    for part in chain(updater):
        if part.settling_time > 0.0 and _is_too_short(part.settling_time, timestep):
            yield part, f"u:settlingTime is {part.settling_time:g} s: {step}"


def _is_too_short(seconds: float, timestep: float) -> bool:
    return round(seconds / timestep) < 1
