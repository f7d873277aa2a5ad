"""Warnings about benchmark files that are valid but probably wrong.

Levels that never begin or measure nothing; times shorter than half a step of the simulation, which
would be read as none or as another time.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..schema import Spec, line_of
from .measures import EuclideanNormSpec, MeasureSpec
from .spec import BenchmarkSpec, FunctionSpec
from .triggers import NeverSpec, ServiceSpec
from .updaters import SceneUpdaterSpec, chain, interval

Said = tuple[Spec | int | None, str]
"""A spec or a line, and what is said about it."""


def never_started(spec: BenchmarkSpec) -> Iterator[Said]:
    """Warn that no level can begin."""
    start, place = spec.start_on, line_of(spec, "startOn")
    if isinstance(start, NeverSpec):
        yield place, "<startOn> is 'never': no level will ever begin"
    answered = [
        each.ground_truth.publish_on
        for each in spec.measures
        if isinstance(each, EuclideanNormSpec)
    ]
    if isinstance(start, ServiceSpec) and start.target in answered:
        yield (
            place,
            f"<startOn> waits for the service {start.target!r}, which the algorithm serves "
            "(<publishOn>): it cannot be called in this run, so no level will begin",
        )


def too_short(
    measures: Sequence[MeasureSpec],
    updater: SceneUpdaterSpec | None,
    function: FunctionSpec | None,
    timestep: float,
) -> Iterator[Said]:
    """Yield durations shorter than half a step, with their places.

    Args:
        measures: what could be read.
        updater: the outermost, if it could be read.
        function: the score's element, if it could be read.
        timestep: length of a step [s].
    """
    step = f"less than half a step of {timestep:g} s"
    for spec in measures:
        if spec.log is not None and _is_nothing(spec.log, timestep):
            yield line_of(spec, "log"), f"<log> is {spec.log:g} s: {step}"
    rate = 0.0 if function is None else function.publish_rate
    if rate > 0.0 and _is_nothing(rate, timestep):
        message = f"publishRate is {rate:g} s: {step}; 0 publishes at every step"
        yield function, message
    if updater is not None:
        yield from _empty_level(updater, timestep, step)


def _empty_level(updater: SceneUpdaterSpec, timestep: float, step: str) -> Iterator[Said]:
    """Report intervals and settling times of less than half a step."""
    length, deepest = interval(updater), chain(updater)[-1]
    if length is not None and _is_nothing(length, timestep):
        yield (
            line_of(deepest, "interval"),
            f"<interval> is {length:g} s: {step}, so nothing would be run",
        )
    for each in chain(updater):
        if each.settling_time > 0.0 and _is_nothing(each.settling_time, timestep):
            yield each, f"u:settlingTime is {each.settling_time:g} s: {step}"


def _is_nothing(seconds: float, timestep: float) -> bool:
    return round(seconds / timestep) < 1
