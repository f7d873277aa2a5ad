"""The request of ``uwsim envelope``: swept parameter, range, criterion and tolerance."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..errors import BadSetting, ErrorCollector, UwsimError, did_you_mean

if TYPE_CHECKING:
    from ..benchmark.updaters import Level, SceneUpdaterSpec
    from ..runs.planning.plan import Plan
    from . import Asked, Criterion, Range

MAX_CUTS = 30
"""A range is not cut finer than 2 to the power of minus this."""


@dataclass(frozen=True, kw_only=True)
class SearchRequest:
    """What is searched for."""

    over: str
    """The swept parameter that grows."""
    spec: SceneUpdaterSpec
    """Its updater."""
    criterion: Criterion
    """When a run counts as broken."""
    where: Range
    """From where to where, and how finely."""
    at: Level
    """Where the other swept parameters stay."""

    def asked(self, seeds: tuple[int, ...], confidence: float) -> Asked:
        """Return the same as the envelope stores it."""
        from . import Asked

        return Asked(
            over=self.over,
            unit=self.spec.parameter_unit,
            until=self.criterion.text,
            fixed={name: value for name, value in self.at.values if name != self.over},
            where=self.where,
            seeds=seeds,
            confidence=confidence,
        )


def search_request(
    plan: Plan,
    over: str,
    until: str,
    ends: tuple[float | None, float | None, float | None],
    chosen: list[tuple[str, float]],
    wrong: ErrorCollector,
) -> SearchRequest | None:
    """Make the request; None with collected errors if it is invalid.

    Args:
        plan: the benchmark to run.
        over: the swept parameter that grows.
        until: the criterion.
        ends: near end, far end and tolerance, as far as they were given.
        chosen: where other swept parameters stay.
        wrong: keeps what is wrong.
    """
    from . import parse_criterion

    spec = where = at = criterion = None
    with wrong.collect():
        spec = updater_of(plan, over)
        where = range_of(spec, over, *ends)
    with wrong.collect():
        if spec is not None:
            at = fixed_levels(plan, over, chosen)
    with wrong.collect():
        try:
            criterion = parse_criterion(until, [m.name for m in plan.benchmark.measures])
        except UwsimError as error:
            raise BadSetting(f"--until: {error}") from None
    if spec is None or where is None or at is None or criterion is None:
        return None
    return SearchRequest(over=over, spec=spec, criterion=criterion, where=where, at=at)


def updater_of(plan: Plan, over: str) -> SceneUpdaterSpec:
    """Find the updater that is searched over.

    Raises:
        BadSetting: the benchmark does not sweep it, or there is nothing between its values.
    """
    from ..benchmark.updaters import chain, swept_parameters

    names = swept_parameters(plan.benchmark.scene_updater)
    if over not in names:
        swept = ", ".join(name for name in names if name != "none") or "nothing"
        raise BadSetting(
            f"--over {over}: this benchmark sweeps {swept}.{did_you_mean(over, names)}"
        )
    spec = chain(plan.benchmark.scene_updater)[names.index(over)]
    if spec.name == "none" or spec.blend(spec.initial + 1.0, 0.5) == spec.initial + 1.0:
        raise BadSetting(f"--over {over}: there is nothing between two values of it.")
    return spec


def range_of(
    spec: SceneUpdaterSpec,
    over: str,
    start: float | None,
    stop: float | None,
    tolerance: float | None,
) -> Range:
    """Return the range.

    Raises:
        BadSetting: it is empty, too fine, or reaches where the updater cannot go.
    """
    from ..schema import MAX_NUMBER
    from . import Range

    values = spec.values()
    ends = {"--from": values[0] if start is None else start}
    ends["--to"] = values[-1] if stop is None else stop
    for option, value in ends.items():
        if not math.isfinite(value):
            raise BadSetting(f"{option} is {value}; expected a number.")
        if abs(value) > MAX_NUMBER:
            raise BadSetting(f"{option} is {value:g}; no quantity is beyond {MAX_NUMBER:g}.")
        if limit := beyond(spec, value):
            raise BadSetting(f"{option} {value:g}: {over} must be {limit}.")
    near, far = ends.values()
    width = abs(far - near)
    if width == 0.0:
        raise BadSetting(f"--from and --to are both {near:g}: there is nothing to search.")
    step = round_down(width / 100) if tolerance is None else tolerance
    if not 0.0 < step < width:
        raise BadSetting(f"--tolerance is {step:g}; expected more than 0 and less than {width:g}.")
    if width / step > 2.0**MAX_CUTS:
        raise BadSetting(f"--tolerance {step:g} is too fine for a range of {width:g}.")
    return Range(start=near, stop=far, tolerance=step)


def beyond(spec: SceneUpdaterSpec, value: float) -> str | None:
    """Return the expected values of the updater, if a value is beyond them."""
    from ..schema import fields_of

    field = {field.name: field for field in fields_of(type(spec))}.get("initial_value")
    if field is None:
        low, high = min(spec.values()), max(spec.values())
        return None if low <= value <= high else f"from {low:g} to {high:g}"
    return None if field.allows(value) else field.expected


def round_down(width: float) -> float:
    """Return the nearest 1, 2 or 5 of a power of ten that is not larger."""
    power = 10.0 ** math.floor(math.log10(width))
    digit = next(d for d in (5.0, 2.0, 1.0) if d * power <= width * (1 + 1e-9))
    return float(f"{digit * power:.1g}")


def fixed_levels(plan: Plan, over: str, chosen: list[tuple[str, float]]) -> Level:
    """Return the value of every swept parameter but the one that is searched over.

    Raises:
        BadSetting: a parameter is not in the sweep, or has several values and none was chosen.
    """
    from ..benchmark.updaters import Level, chain, swept_parameters

    names = swept_parameters(plan.benchmark.scene_updater)
    for name, _ in chosen:
        if name == over:
            raise BadSetting(f"--level {name}: that is what is searched over.")
        if name not in names:
            near = did_you_mean(name, names)
            raise BadSetting(f"--level {name}: this benchmark sweeps {', '.join(names)}.{near}")
    values = []
    for name, spec in zip(names, chain(plan.benchmark.scene_updater), strict=True):
        given = [value for wanted, value in chosen if wanted == name]
        if len(given) > 1:
            raise BadSetting(f"--level {name} is given twice; a search uses one value.")
        if name != over and not given and len(spec.values()) > 1:
            raise BadSetting(
                f"The benchmark also sweeps {name} ({len(spec.values())} levels); choose one, as "
                f"--level {name}={spec.values()[0]:g}."
            )
        if given and (limit := beyond(spec, given[0])):
            raise BadSetting(f"--level {name}={given[0]:g}: {name} must be {limit}.")
        values.append((name, given[0] if given else spec.initial))
    return Level(tuple(values))
