"""The validated request of ``uwsim envelope``: swept parameter, range, tolerance and criterion."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..errors import BadSetting, ErrorCollector, UwsimError, did_you_mean

if TYPE_CHECKING:
    from ..benchmark.updaters import Level, SceneUpdaterSpec
    from ..runs.planning.plan import Plan
    from . import Criterion, Range, SearchSettings

MAX_CUTS = 30
"""The largest number of halvings of the range that a tolerance may require."""


@dataclass(frozen=True, kw_only=True)
class SearchRequest:
    """The validated request of a search."""

    parameter: str
    """The name of the swept parameter that the search varies."""
    spec: SceneUpdaterSpec
    """The spec of the scene updater that sets the parameter."""
    criterion: Criterion
    """The criterion of a broken run."""
    bounds: Range
    """The searched range of the parameter, with its tolerance."""
    level: Level
    """The values of all swept parameters; the search replaces the value of its parameter."""

    def settings(self, seeds: tuple[int, ...], confidence: float) -> SearchSettings:
        """Return the settings of the search as the envelope stores them."""
        from . import SearchSettings

        return SearchSettings(
            parameter=self.parameter,
            unit=self.spec.parameter_unit,
            criterion=self.criterion.text,
            fixed={name: value for name, value in self.level.values if name != self.parameter},
            bounds=self.bounds,
            seeds=seeds,
            confidence=confidence,
        )


def search_request(
    plan: Plan,
    parameter: str,
    criterion_text: str,
    ends: tuple[float | None, float | None, float | None],
    fixed_values: list[tuple[str, float]],
    errors: ErrorCollector,
) -> SearchRequest | None:
    """Validate a request; return None, with the errors collected, if it is invalid.

    Args:
        plan: the plan of the benchmark.
        parameter: the name of the swept parameter that the search varies.
        criterion_text: the text of the criterion.
        ends: the near end and the far end of the range, and the tolerance; None for a default.
        fixed_values: the names and values of other swept parameters.
        errors: receives the errors.
    """
    from . import parse_criterion

    spec = bounds = level = criterion = None
    with errors.collect():
        spec = updater_of(plan, parameter)
        bounds = range_of(spec, parameter, *ends)
    with errors.collect():
        if spec is not None:
            level = fixed_levels(plan, parameter, fixed_values)
    with errors.collect():
        try:
            criterion = parse_criterion(criterion_text, [m.name for m in plan.benchmark.measures])
        except UwsimError as error:
            raise BadSetting(f"--until: {error}") from None
    if spec is None or bounds is None or level is None or criterion is None:
        return None
    return SearchRequest(
        parameter=parameter, spec=spec, criterion=criterion, bounds=bounds, level=level
    )


def updater_of(plan: Plan, parameter: str) -> SceneUpdaterSpec:
    """Return the spec of the scene updater that sets the searched parameter.

    Raises:
        BadSetting: the benchmark does not sweep the parameter, or the parameter has no values
            between two levels.
    """
    from ..benchmark.updaters import chain, swept_parameters

    names = swept_parameters(plan.benchmark.scene_updater)
    if parameter not in names:
        sweep = ", ".join(name for name in names if name != "none") or "nothing"
        raise BadSetting(
            f"--over {parameter}: this benchmark sweeps {sweep}.{did_you_mean(parameter, names)}"
        )
    spec = chain(plan.benchmark.scene_updater)[names.index(parameter)]
    if spec.name == "none" or spec.blend(spec.first_value + 1.0, 0.5) == spec.first_value + 1.0:
        raise BadSetting(f"--over {parameter}: the parameter has no values between two levels.")
    return spec


def range_of(
    spec: SceneUpdaterSpec,
    parameter: str,
    start: float | None,
    stop: float | None,
    tolerance: float | None,
) -> Range:
    """Return the searched range; the first and last level are the default ends.

    Raises:
        BadSetting: the range is empty, the tolerance is too fine, or the scene updater does not
            allow an end.
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
        if limit := violated_limit(spec, value):
            raise BadSetting(f"{option} {value:g}: {parameter} must be {limit}.")
    near, far = ends.values()
    width = abs(far - near)
    if width == 0.0:
        raise BadSetting(f"--from and --to are both {near:g}; expected different values.")
    step = round_down(width / 100) if tolerance is None else tolerance
    if not 0.0 < step < width:
        raise BadSetting(f"--tolerance is {step:g}; expected more than 0 and less than {width:g}.")
    if width / step > 2.0**MAX_CUTS:
        raise BadSetting(f"--tolerance {step:g} is too fine for a range of {width:g}.")
    return Range(start=near, stop=far, tolerance=step)


def violated_limit(spec: SceneUpdaterSpec, value: float) -> str | None:
    """Return a description of the allowed values if a value is not allowed, else None."""
    from ..schema import fields_of

    field = {field.name: field for field in fields_of(type(spec))}.get("initial_value")
    if field is None:
        low, high = min(spec.values()), max(spec.values())
        return None if low <= value <= high else f"from {low:g} to {high:g}"
    return None if field.allows(value) else field.expected


def round_down(width: float) -> float:
    """Return the greatest number of the form 1, 2 or 5 times a power of ten up to ``width``."""
    power = 10.0 ** math.floor(math.log10(width))
    digit = next(d for d in (5.0, 2.0, 1.0) if d * power <= width * (1 + 1e-9))
    return float(f"{digit * power:.1g}")


def fixed_levels(plan: Plan, parameter: str, fixed_values: list[tuple[str, float]]) -> Level:
    """Return the values of all swept parameters, with the chosen values of the fixed ones.

    Raises:
        BadSetting: a parameter is not in the sweep, is chosen twice, is the searched one, or has
            several levels and no chosen value.
    """
    from ..benchmark.updaters import Level, chain, swept_parameters

    names = swept_parameters(plan.benchmark.scene_updater)
    for name, _ in fixed_values:
        if name == parameter:
            raise BadSetting(f"--level {name}: the search varies this parameter itself.")
        if name not in names:
            near = did_you_mean(name, names)
            raise BadSetting(f"--level {name}: this benchmark sweeps {', '.join(names)}.{near}")
    values = []
    for name, spec in zip(names, chain(plan.benchmark.scene_updater), strict=True):
        choices = [value for chosen_name, value in fixed_values if chosen_name == name]
        if len(choices) > 1:
            raise BadSetting(f"--level {name} is given twice; a search uses one value.")
        if name != parameter and not choices and len(spec.values()) > 1:
            raise BadSetting(
                f"The benchmark also sweeps {name} ({len(spec.values())} levels); choose one, as "
                f"--level {name}={spec.values()[0]:g}."
            )
        if choices and (limit := violated_limit(spec, choices[0])):
            raise BadSetting(f"--level {name}={choices[0]:g}: {name} must be {limit}.")
        values.append((name, choices[0] if choices else spec.first_value))
    return Level(tuple(values))
