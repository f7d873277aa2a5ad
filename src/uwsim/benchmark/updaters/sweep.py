"""Base of updaters that sweep one value from an initial to a final one by a step."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...errors import BadSetting
from ...schema import element
from .updater import MAX_LEVELS, SceneUpdater, SceneUpdaterSpec


@dataclass(frozen=True, kw_only=True)
class SweepSpec(SceneUpdaterSpec):
    """An updater whose value grows by a step from level to level."""

    is_single: ClassVar[bool] = False
    """Whether the original counts its levels in float32."""

    initial_value: float
    """Value of the first level."""
    final_value: float
    """Value that is not exceeded."""
    step: float = element(above=0.0)
    """What each level adds."""
    interval: float = element(above=0.0)
    """Length of a level [s]."""

    def values(self) -> tuple[float, ...]:
        """Return the value of each level."""
        return sweep(self.initial_value, self.final_value, self.step, single=self.is_single)

    def errors(self) -> Iterator[str]:
        """Report a sweep that ends before it begins."""
        if self.final_value < self.initial_value:
            yield (
                f"<finalValue> {self.final_value:g} is below <initialValue> "
                f"{self.initial_value:g}: no level. Exchange them: a sweep runs upward"
            )

    @property
    def seconds_per_level(self) -> float:
        """The interval [s]."""
        return self.interval


class Setter(SceneUpdater):
    """Sets one value of the scene to that of the level."""

    def __init__(self, setter: Callable[[float], None]) -> None:
        self._set = setter

    def apply(self, value: float) -> None:
        """Call the setter with ``value``."""
        self._set(value)


def sweep(initial: float, final: float, step: float, *, single: bool = False) -> tuple[float, ...]:
    """Return ``initial + i * step`` for as many i as the original runs.

    The original adds ``step`` until the sum *exceeds* ``final``, in float64 or (``single``, the
    fog) in float32, so rounding decides whether the last value is included: fog 0..1.3 by 0.05 has
    27 levels, current 0..0.2 by 0.01 only 20. The number is kept; the values are exact.

    Raises:
        BadSetting: it would never end, or has more than 100 000 levels.
    """
    kind = np.float32 if single else np.float64
    value, last, increment = kind(initial), kind(final), kind(step)
    if final > initial and not (final - initial) < MAX_LEVELS * step:
        raise endless(initial, final, step)
    count = 1
    while (grown := value + increment) <= last:
        if grown <= value:
            raise endless(initial, final, step)
        value, count = grown, count + 1
    return tuple(initial + i * step for i in range(count))


def endless(initial: float, final: float, step: float) -> BadSetting:
    """Report a sweep with too many levels."""
    return BadSetting(
        f"From {initial:g} to {final:g} by steps of {step:g} "
        f"there are more than {MAX_LEVELS} levels."
    )
