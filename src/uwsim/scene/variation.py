r"""Variations, ``<u:vary>``: values that are drawn at random for each seed.

.. code-block:: xml

    <u:vary>
      <u:uniform>
        <u:path>object[blackbox].position.x</u:path> <u:low>1.95</u:low> <u:high>2.05</u:high>
      </u:uniform>
      <u:normal>
        <u:path>vehicle[girona500].sway[x].amplitude</u:path>
        <u:mean>0.1</u:mean> <u:deviation>0.01</u:deviation> <u:low>0.07</u:low>
      </u:normal>
    </u:vary>

``<u:path>`` is a path as in ``--set`` (`uwsim.scene.settings`) to one number; integers are drawn as
integers. Each number has its own random stream of the run's seed, ``vary/<path>``: an additional
variation does not change the others, and all levels of a seed have the same scene. ``--set`` on a
varied value, or on an element that contains it, removes the variation.
"""

from __future__ import annotations

import abc
import dataclasses
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, TypeVar, cast

from ..base.rng import stream
from ..errors import BadSetting
from ..schema import NAMESPACE, Diagnostics, Spec, element
from .settings import ValueLocation, locate, overlaps

T = TypeVar("T")
Find = Callable[[Any, str], ValueLocation]
N_DEVIATIONS = 3.0
"""The default bounds of a normal distribution, in standard deviations from the mean."""


@dataclass(frozen=True, kw_only=True)
class VariationSpec(Spec, abc.ABC):
    """The spec of a number that is drawn at random for each seed."""

    path: str = element(namespaced=True)
    """The path of the number, as in ``--set``: ``vehicle[girona500].position.x``."""

    @property
    @abc.abstractmethod
    def bounds(self) -> tuple[float, float]:
        """The minimum and maximum number that can be drawn, in the unit of the varied value."""

    @property
    @abc.abstractmethod
    def description(self) -> str:
        """The distribution in words, without the unit: ``uniform 1.95 to 2.05``."""

    @abc.abstractmethod
    def quantile(self, share: float) -> float:
        """Return the value below which ``share`` (0..1) of the distribution lies."""

    def diagnostic(self) -> str | None:
        """Return the error in the combination of parameters; None if they are valid."""
        low, high = self.bounds
        return None if low < high else f"<u:low> {low:g} is not below <u:high> {high:g}"


@dataclass(frozen=True, kw_only=True)
class UniformSpec(VariationSpec):
    """A ``<u:uniform>``: a uniform distribution between two bounds, bounds included."""

    low: float = element(namespaced=True)
    """The lower bound, in the unit of the varied value."""
    high: float = element(namespaced=True)
    """The upper bound, in the unit of the varied value."""

    @property
    def bounds(self) -> tuple[float, float]:
        """The lower and the upper bound."""
        return self.low, self.high

    @property
    def description(self) -> str:
        """The distribution in words, ``uniform 1.95 to 2.05``."""
        return f"uniform {self.low:g} to {self.high:g}"

    def quantile(self, share: float) -> float:
        """Return ``low + share (high - low)``."""
        return self.low + share * (self.high - self.low)


@dataclass(frozen=True, kw_only=True)
class NormalSpec(VariationSpec):
    """A ``<u:normal>``: a normal distribution, truncated at bounds.

    Values beyond the bounds are never drawn; they are not clamped.
    """

    mean: float = element(namespaced=True)
    """The mean before truncation, in the unit of the varied value."""
    deviation: float = element(namespaced=True, exclusive_minimum=0.0)
    """The standard deviation before truncation, in the unit of the varied value."""
    low: float | None = element(namespaced=True, default=None)
    """The lower bound; without it the mean minus three standard deviations."""
    high: float | None = element(namespaced=True, default=None)
    """The upper bound; without it the mean plus three standard deviations."""

    @property
    def bounds(self) -> tuple[float, float]:
        """The bounds in the file, by default three standard deviations from the mean."""
        reach = N_DEVIATIONS * self.deviation
        low = self.mean - reach if self.low is None else self.low
        return low, self.mean + reach if self.high is None else self.high

    @property
    def description(self) -> str:
        """The distribution in words, ``normal 0.1 ± 0.01, 0.07 to 0.13``."""
        low, high = self.bounds
        return f"normal {self.mean:g} ± {self.deviation:g}, {low:g} to {high:g}"

    def quantile(self, share: float) -> float:
        """Return the value below which ``share`` (0..1) of the truncated distribution lies."""
        from scipy.special import ndtr, ndtri

        lower_share, upper_share = (float(ndtr(self._score(bound))) for bound in self.bounds)
        value = self.mean + self.deviation * float(
            ndtri(lower_share + share * (upper_share - lower_share))
        )
        low, high = self.bounds
        return min(max(value, low), high)

    def diagnostic(self) -> str | None:
        """Return the error for bounds in the wrong order or far from the mean; None if valid."""
        if error := super().diagnostic():
            return error
        low, high = map(self._score, self.bounds)
        if low > 2.0 * N_DEVIATIONS or high < -2.0 * N_DEVIATIONS:
            return f"its bounds are more than {2 * N_DEVIATIONS:g} deviations from <u:mean>"
        return None

    def _score(self, value: float) -> float:
        return (value - self.mean) / self.deviation


DISTRIBUTIONS: dict[str, type[VariationSpec]] = {
    f"{{{NAMESPACE}}}normal": NormalSpec,
    f"{{{NAMESPACE}}}uniform": UniformSpec,
}
"""The spec of each element in ``<u:vary>``, in alphabetical order."""


@dataclass(frozen=True)
class Draw:
    """The value that is drawn for a variation with a seed."""

    path: str
    """The full path of the value: `uwsim.scene.settings.ValueLocation.path`."""
    value: float
    """The drawn value; an integer if the field is an integer."""
    unit: str
    """The unit, if the documentation of the field has one."""
    drawn_from: str
    """The distribution in words."""


def draw(spec: Any, seed: int, *, find: Find = locate) -> tuple[Draw, ...]:
    """Draw a value for each variation of ``spec``, in their order.

    Args:
        spec: the spec of a scene or benchmark whose variations are valid (`check_variations`).
        seed: the seed of the run.
        find: the function that resolves a path in the spec.
    """
    return tuple(
        Draw(location.path, value, location.unit, variation.description)
        for variation, location, value in _values(spec, seed, find)
    )


def apply_variations(spec: T, seed: int, *, find: Find = locate) -> T:
    """Return the scene or benchmark for a seed, in which drawn values replace the variations."""
    if not spec.vary:  # type: ignore[attr-defined]
        return spec
    new_spec: Any = dataclasses.replace(spec, vary=())  # type: ignore[type-var]
    for _, location, value in _values(spec, seed, find):
        new_spec = find(new_spec, location.path).with_value(_to_exact_text(value))
    return cast(T, new_spec)


def _values(
    spec: Any, seed: int, find: Find
) -> Iterator[tuple[VariationSpec, ValueLocation, float]]:
    """Yield each variation of ``spec``, in their order, with its location and its drawn value."""
    for variation in spec.vary:
        try:
            location = find(spec, variation.path)
        except BadSetting as error:  # the spec was changed after it was read
            hint = "The scene without variations is its `nominal_scene`."
            raise BadSetting(f"<u:vary> {variation.path}: {error} {hint}") from None
        share = float(stream(seed, vary_stream(location)).uniform())
        yield variation, location, value_at(variation, location.is_integer, share)


def vary_stream(location: ValueLocation) -> str:
    """Return the name of the random stream of a variation."""
    return f"vary/{location.path}"


def check_variations(
    spec: Any,
    diagnostics: Diagnostics,
    *,
    find: Find = locate,
    check_bound: Callable[[Any], None] = lambda new_spec: None,
) -> None:
    """Report variations with an invalid path, value or bound, and two variations of one value.

    Args:
        spec: the spec of a scene or benchmark.
        diagnostics: receives the errors.
        find: the function that resolves a path in the spec.
        check_bound: raises BadSetting if a spec is invalid whose value is set to a bound.
    """
    locations: list[ValueLocation] = []
    for variation in spec.vary:
        try:
            location = find(spec, variation.path)
            for new_spec in _specs_at_bounds(location, variation):
                check_bound(new_spec)
            if twin := next(
                (
                    other_location
                    for other_location in locations
                    if overlaps(other_location, location)
                ),
                None,
            ):
                raise BadSetting(f"{twin.path} varies already.")
        except BadSetting as error:
            diagnostics.error(variation, f"<u:path> {variation.path}: {error}".rstrip("."))
        else:
            locations.append(location)


def _specs_at_bounds(location: ValueLocation, variation: VariationSpec) -> list[Any]:
    """Return the root specs with the value at each bound; raise BadSetting if it cannot vary."""
    if location.components and not location.has_parts:
        raise BadSetting(f"<{location.field.label}> is a value; it has no elements.")
    if not location.is_number:
        raise BadSetting(f"it is {location.kind}; only a number can vary.")
    if error := variation.diagnostic():
        raise BadSetting(error + ".")
    specs = []
    for bound in variation.bounds:
        if location.is_integer and not float(bound).is_integer():
            raise BadSetting(f"it is an integer, and {bound:g} is not.")
        specs.append(
            location.with_value(_to_exact_text(int(bound) if location.is_integer else bound))
        )
    return specs


def value_at(variation: VariationSpec, is_integer: bool, share: float) -> float:
    """Return the value of a variation for a uniform number from 0 to 1 (excluded).

    Args:
        variation: the distribution.
        is_integer: true if the varied number is an integer.
        share: the uniform number.
    """
    if not is_integer:
        return float(f"{variation.quantile(share):.12g}")  # the same on every processor
    low, high = variation.bounds
    if isinstance(variation, UniformSpec):  # all are equally likely
        return int(min(math.floor(low + share * (high - low + 1.0)), high))
    return round(variation.quantile(share))


def _to_exact_text(value: float) -> str:
    return repr(value)
