"""Times in a benchmark file that are shorter than time itself: the world goes in whole steps.

A level of less than half a step would be one of none at all; a log's period of less than half a
step would be played as another one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lxml import etree

from ..schema import Faults
from .measures import MeasureSpec
from .spec import FunctionSpec
from .updaters import SceneUpdaterSpec, chain, interval

Said = tuple[etree._Element | None, str]


def too_short(
    faults: Faults,
    measures: Sequence[MeasureSpec],
    updater: SceneUpdaterSpec | None,
    function: FunctionSpec | None,
    timestep: float,
) -> Iterator[Said]:
    """Yield what is shorter than half a step, and the element that says so.

    Args:
        faults: knows from which element a spec was read.
        measures: what could be read.
        updater: the outermost, if it could be read.
        function: the score's element, if it could be read.
        timestep: length of a step [s].
    """
    step = f"less than half a step of {timestep:g} s"
    for spec in measures:
        if spec.log is not None and _is_nothing(spec.log, timestep):
            yield _child(faults.node_of(spec), "log"), f"<log> is {spec.log:g} s: {step}"
    rate = 0.0 if function is None else function.publish_rate
    if rate > 0.0 and _is_nothing(rate, timestep):
        said = f"publishRate is {rate:g} s: {step}; 0 publishes at every step"
        yield faults.node_of(function), said
    if updater is not None:
        yield from _empty_level(faults, updater, timestep, step)


def _empty_level(
    faults: Faults, updater: SceneUpdaterSpec, timestep: float, step: str
) -> Iterator[Said]:
    """Say that levels are over before they begin, or that a settling time is none."""
    length, deepest = interval(updater), chain(updater)[-1]
    if length is not None and _is_nothing(length, timestep):
        place = _child(faults.node_of(deepest), "interval")
        yield place, f"<interval> is {length:g} s: {step}, so nothing would be played"
    for each in chain(updater):
        if each.settling_time > 0.0 and _is_nothing(each.settling_time, timestep):
            yield faults.node_of(each), f"u:settlingTime is {each.settling_time:g} s: {step}"


def _is_nothing(seconds: float, timestep: float) -> bool:
    return round(seconds / timestep) < 1


def _child(node: etree._Element | None, tag: str) -> etree._Element | None:
    child = None if node is None else node.find(tag)
    return node if child is None else child
