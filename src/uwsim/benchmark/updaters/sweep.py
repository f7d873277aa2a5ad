"""The base class of updaters that increase one value from level to level by a constant step."""

from __future__ import annotations

import math
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

    uses_float32: ClassVar[bool] = False
    """True if the original UWSim computes the number of levels in float32; False: in float64
    (`sweep_values`)."""

    initial_value: float
    """The value of the first level."""
    final_value: float
    """The greatest value of a level."""
    step: float = element(exclusive_minimum=0.0)
    """The increment from level to level."""
    interval: float = element(exclusive_minimum=0.0)
    """The length of a level [s]."""

    def values(self) -> tuple[float, ...]:
        """Return the initial value, the next value one step above, and so on."""
        return sweep_values(
            self.initial_value, self.final_value, self.step, uses_float32=self.uses_float32
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
    """An updater that sets one value of the scene by calling a function.

    Args:
        setter: the function, called with the value of each level.
    """

    def __init__(self, setter: Callable[[float], None]) -> None:
        self._set = setter

    def apply(self, value: float) -> None:
        """Call the setter with ``value``."""
        self._set(value)


def sweep_values(
    start: float, end: float, step: float, *, uses_float32: bool = False
) -> tuple[float, ...]:
    """Return ``start + i * step`` for as many levels i as the original UWSim runs.

    The original UWSim adds ``step`` until the sum *exceeds* ``end``. Rounding therefore determines
    whether ``end`` is the last level: a fog sweep from 0 to 1.3 by 0.05 has 27 levels, a current
    sweep from 0 to 0.2 by 0.01 only 20. uwsim runs the same number of levels, but computes each
    value by a multiplication, without the accumulated rounding errors.

    Args:
        start: the first value.
        end: the value that is not exceeded.
        step: the increment from level to level.
        uses_float32: True if the sums are computed in float32 (fog), False in float64.

    Raises:
        BadSetting: the sweep never ends, or has more than 100 000 levels.
    """
    kind = np.float32 if uses_float32 else np.float64
    value, end_value, increment = kind(start), kind(end), kind(step)
    if end > start and not (end - start) < MAX_LEVELS * step:
        raise endless_error(start, end, step)
    count = 1
    while (next_value := value + increment) <= end_value:
        if next_value <= value:
            raise endless_error(start, end, step)
        value, count = next_value, count + 1
    return tuple(start + i * step for i in range(count))


def step_values(start: float, end: float, step: float) -> tuple[float, ...]:
    """Return ``start + i * step`` up to ``end``, which is one of them if whole steps lead to it.

    Args:
        start: the first value.
        end: the value that is not passed.
        step: the increment from level to level, of the sign of ``end - start``.

    Raises:
        BadSetting: the sweep has more than 100 000 levels.
    """
    span = (end - start) / step
    if not span < MAX_LEVELS:
        raise endless_error(start, end, step)
    return tuple(start + i * step for i in range(math.floor(span + 1e-9) + 1))


def endless_error(start: float, end: float, step: float) -> BadSetting:
    """Return the error of a sweep with too many levels."""
    return BadSetting(
        f"From {start:g} to {end:g} by steps of {step:g} there are more than {MAX_LEVELS} levels."
    )
