"""The base of updaters that sweep one value from an initial to a final one by a step."""

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
    """An updater whose value increases by a step from level to level."""

    is_single: ClassVar[bool] = False
    """True if the original counts its levels in float32."""

    initial_value: float
    """The value of the first level."""
    final_value: float
    """The value that is not exceeded."""
    step: float = element(exclusive_minimum=0.0)
    """The increment from level to level."""
    interval: float = element(exclusive_minimum=0.0)
    """The length of a level [s]."""

    def values(self) -> tuple[float, ...]:
        """Return the value of each level."""
        return sweep_values(
            self.initial_value, self.final_value, self.step, is_single=self.is_single
        )

    def errors(self) -> Iterator[str]:
        """Report a sweep that ends before it begins."""
        if self.final_value < self.initial_value:
            yield (
                f"<finalValue> {self.final_value:g} is below <initialValue> "
                f"{self.initial_value:g}: no level. Exchange them: the values of a sweep increase"
            )

    @property
    def seconds_per_level(self) -> float:
        """The interval [s]."""
        return self.interval


class Setter(SceneUpdater):
    """An updater that sets one value of the scene to that of the level."""

    def __init__(self, setter: Callable[[float], None]) -> None:
        self._set = setter

    def apply(self, value: float) -> None:
        """Call the setter with ``value``."""
        self._set(value)


def sweep_values(
    start: float, end: float, step: float, *, is_single: bool = False
) -> tuple[float, ...]:
    """Return ``initial + i * step`` for as many i as the original runs.

    The original adds ``step`` until the sum *exceeds* ``end``, in float64 or (``is_single``, the
    fog) in float32, so rounding determines whether the last value is included: fog 0..1.3 by 0.05
    has 27 levels, current 0..0.2 by 0.01 only 20. The number is kept; the values are exact.

    Raises:
        BadSetting: it never ends, or has more than 100 000 levels.
    """
    kind = np.float32 if is_single else np.float64
    value, end_value, increment = kind(start), kind(end), kind(step)
    if end > start and not (end - start) < MAX_LEVELS * step:
        raise endless_error(start, end, step)
    count = 1
    while (next_value := value + increment) <= end_value:
        if next_value <= value:
            raise endless_error(start, end, step)
        value, count = next_value, count + 1
    return tuple(start + i * step for i in range(count))


def endless_error(start: float, end: float, step: float) -> BadSetting:
    """Return the error of a sweep with too many levels."""
    return BadSetting(
        f"From {start:g} to {end:g} by steps of {step:g} there are more than {MAX_LEVELS} levels."
    )
