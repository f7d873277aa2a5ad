r"""vary: values that are drawn at random for each seed; an extension of the dialect.

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

A path is that of ``--set`` (`uwsim.scene.settings`) and leads to one number; whole numbers are
drawn as such. Each number has a random stream of its own under the run's seed, called
``vary/<path>``: one variation more changes no other, and every level of a seed has the same scene.
``--set`` on a varied value, or on something around it, puts the variation out of force.
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
from .settings import Place, locate, overlaps

T = TypeVar("T")
Find = Callable[[Any, str], Place]
BOUNDS = 3.0
"""Where a normal distribution without bounds is cut off, in deviations."""


@dataclass(frozen=True, kw_only=True)
class VariationSpec(Spec, abc.ABC):
    """The spec of one value that is drawn for each seed."""

    path: str = element(namespaced=True)
    """Which value, as ``--set`` names it: ``vehicle[girona500].position.x``."""

    @property
    @abc.abstractmethod
    def bounds(self) -> tuple[float, float]:
        """Least and largest value that can be drawn, in the unit of the value."""

    @property
    @abc.abstractmethod
    def shown(self) -> str:
        """The distribution in words, without the unit: ``uniform 1.95 to 2.05``."""

    @abc.abstractmethod
    def quantile(self, share: float) -> float:
        """Return the value below which ``share`` (0..1) of the distribution lies."""

    def diagnostic(self) -> str | None:
        """What is wrong with the distribution as a whole."""
        low, high = self.bounds
        return None if low < high else f"<u:low> {low:g} is not below <u:high> {high:g}"


@dataclass(frozen=True, kw_only=True)
class UniformSpec(VariationSpec):
    """A ``<u:uniform>``: every value between two bounds is as likely; bounds included."""

    low: float = element(namespaced=True)
    """Least value, in the unit of the value that varies."""
    high: float = element(namespaced=True)
    """Largest value, in the unit of the value that varies."""

    @property
    def bounds(self) -> tuple[float, float]:
        """As given."""
        return self.low, self.high

    @property
    def shown(self) -> str:
        """``uniform 1.95 to 2.05``."""
        return f"uniform {self.low:g} to {self.high:g}"

    def quantile(self, share: float) -> float:
        """Return ``low + share (high - low)``."""
        return self.low + share * (self.high - self.low)


@dataclass(frozen=True, kw_only=True)
class NormalSpec(VariationSpec):
    """A ``<u:normal>``: a normal distribution, cut off at bounds.

    What lies beyond the bounds is not moved to them; it is never drawn.
    """

    mean: float = element(namespaced=True)
    """Mean before it is cut off, in the unit of the value that varies."""
    deviation: float = element(namespaced=True, above=0.0)
    """Standard deviation before it is cut off, in the unit of the value that varies."""
    low: float | None = element(namespaced=True, default=None)
    """Least value; without it the mean less three deviations."""
    high: float | None = element(namespaced=True, default=None)
    """Largest value; without it the mean and three deviations."""

    @property
    def bounds(self) -> tuple[float, float]:
        """As given, else three deviations from the mean."""
        reach = BOUNDS * self.deviation
        low = self.mean - reach if self.low is None else self.low
        return low, self.mean + reach if self.high is None else self.high

    @property
    def shown(self) -> str:
        """``normal 0.1 ± 0.01, 0.07 to 0.13``."""
        low, high = self.bounds
        return f"normal {self.mean:g} ± {self.deviation:g}, {low:g} to {high:g}"

    def quantile(self, share: float) -> float:
        """Invert the distribution function between its values at the bounds."""
        from scipy.special import ndtr, ndtri

        below, above = (float(ndtr(self._score(bound))) for bound in self.bounds)
        value = self.mean + self.deviation * float(ndtri(below + share * (above - below)))
        low, high = self.bounds
        return min(max(value, low), high)

    def diagnostic(self) -> str | None:
        """Bounds in the wrong order, or where nothing is ever drawn."""
        if wrong := super().diagnostic():
            return wrong
        low, high = map(self._score, self.bounds)
        if low > 2.0 * BOUNDS or high < -2.0 * BOUNDS:
            return f"its bounds are more than {2 * BOUNDS:g} deviations from <u:mean>"
        return None

    def _score(self, value: float) -> float:
        """How many deviations from the mean."""
        return (value - self.mean) / self.deviation


DISTRIBUTIONS: dict[str, type[VariationSpec]] = {
    f"{{{NAMESPACE}}}normal": NormalSpec,
    f"{{{NAMESPACE}}}uniform": UniformSpec,
}
"""Element in ``<u:vary>`` -> its spec, in alphabetical order."""


@dataclass(frozen=True)
class Draw:
    """The value of one variation under one seed."""

    path: str
    """The value's full path: `uwsim.scene.settings.Place.path`."""
    value: float
    """What was drawn; a whole number where the value is one."""
    unit: str
    """Its unit, as far as its documentation names one."""
    drawn_from: str
    """The distribution in words."""


def draw(spec: Any, seed: int, *, find: Find = locate) -> tuple[Draw, ...]:
    """Draw a value for each variation of ``spec``, in their order.

    Args:
        spec: a scene, or a benchmark; its variations are right (`check_variations`).
        seed: the run's seed.
        find: where a path leads in it.
    """
    return tuple(
        Draw(place.path, value, place.unit, variation.shown)
        for variation, place, value in _values(spec, seed, find)
    )


def varied(spec: T, seed: int, *, find: Find = locate) -> T:
    """Return the scene, or benchmark, of a seed: its variations are drawn, and none is left."""
    if not spec.vary:  # type: ignore[attr-defined]
        return spec
    drawn: Any = dataclasses.replace(spec, vary=())  # type: ignore[type-var]
    for _, place, value in _values(spec, seed, find):
        drawn = find(drawn, place.path).with_value(_text(value))
    return cast(T, drawn)


def _values(spec: Any, seed: int, find: Find) -> Iterator[tuple[VariationSpec, Place, float]]:
    """Draw a value for each variation of ``spec``, in their order, and say for which place."""
    for variation in spec.vary:
        try:
            place = find(spec, variation.path)
        except BadSetting as error:  # of a spec that was changed after it was read
            raise BadSetting(
                f"<u:vary> {variation.path}: {error} The scene without variations is its `nominal`."
            ) from None
        share = float(stream(seed, f"vary/{place.path}").uniform())
        yield variation, place, _drawn(variation, place, share)


def check_variations(
    spec: Any,
    diagnostics: Diagnostics,
    *,
    find: Find = locate,
    also: Callable[[Any], None] = lambda changed: None,
) -> None:
    """Report errors in variations: paths, kinds, bounds, and two of one value.

    Args:
        spec: a scene, or a benchmark.
        diagnostics: receives the errors.
        find: where a path leads in it.
        also: raises BadSetting at what is wrong with the whole when a value is at its bound.
    """
    places: list[Place] = []
    for variation in spec.vary:
        try:
            place = find(spec, variation.path)
            for changed in _at_its_bounds(place, variation):
                also(changed)
            if twin := next((each for each in places if overlaps(each, place)), None):
                raise BadSetting(f"{twin.path} varies already.")
        except BadSetting as error:
            diagnostics.error(variation, f"<u:path> {variation.path}: {error}".rstrip("."))
        else:
            places.append(place)


def _at_its_bounds(place: Place, variation: VariationSpec) -> list[Any]:
    """Return the whole with the value at either bound; BadSetting if it cannot vary so."""
    if place.rest and not place.has_parts:
        raise BadSetting(f"<{place.field.label}> is a value; it has no elements.")
    if not place.is_number:
        raise BadSetting(f"it is {place.kind}; only a number can vary.")
    if wrong := variation.diagnostic():
        raise BadSetting(wrong + ".")
    found = []
    for bound in variation.bounds:
        if place.is_whole and not float(bound).is_integer():
            raise BadSetting(f"it is a whole number, and {bound:g} is none.")
        found.append(place.with_value(_text(int(bound) if place.is_whole else bound)))
    return found


def _drawn(variation: VariationSpec, place: Place, share: float) -> float:
    if not place.is_whole:
        return float(f"{variation.quantile(share):.12g}")  # the same on every processor
    low, high = variation.bounds
    if isinstance(variation, UniformSpec):  # each of them as likely
        return int(min(math.floor(low + share * (high - low + 1.0)), high))
    return round(variation.quantile(share))


def _text(value: float) -> str:
    """The number as a file would say it, to be read back exactly."""
    return repr(value)
