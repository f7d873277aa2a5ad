r"""Base of the two fog updaters: a sweep of fog density, or of a length that defines it.

.. code-block:: xml

    <sceneFogUpdater u:unit="attenuationLength">
      <initialValue>10</initialValue> <finalValue>1</finalValue> <step>-1</step>
      <interval>2</interval>
    </sceneFogUpdater>

Fog of density f leaves :math:`e^{-(fd)^2}` of the contrast of what is d away. ``u:unit`` says what
the values of the sweep are:

``density``
    f itself [1/m], as in the original.
``attenuationLength``
    The distance at which contrast has fallen to 1/e, :math:`L = 1/f` [m].
``visibilityRange``
    The distance at which it has fallen to 2 %, the smallest that the eye distinguishes (Koschmieder
    1924), :math:`V = \sqrt{\ln 50}/f = 1.98\,L` [m].

Lengths shrink as the water grows murky, so a sweep in metres may run downward, with a negative
step. Its last value is a level if it is a whole number of steps away; nothing is left to rounding.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Literal

from ...base.optics import DENSITY, LENGTHS
from ...schema import Original, element
from .sweep import SweepSpec, endless
from .updater import MAX_LEVELS


@dataclass(frozen=True, kw_only=True)
class FogSweepSpec(SweepSpec):
    """An updater of fog. Its levels are counted in float32, unless its values are lengths."""

    name: ClassVar[str] = "fog"
    unit: ClassVar[str] = "1/m"
    is_single: ClassVar[bool] = True

    initial_value: float = element(original=Original(aliases=("initialFog",)), minimum=0.0)
    """Fog density of the first level [1/m]; or a length [m] with another ``u:unit``."""
    final_value: float = element(original=Original(aliases=("finalFog",)), minimum=0.0)
    """Fog density, or length, that is not passed."""
    step: float = element()
    """What each level adds; below 0 only where lengths shrink."""
    quantity: Literal["density", "attenuationLength", "visibilityRange"] = element(
        "unit", default="density", attribute=True, namespaced=True
    )
    """What the values are (``u:unit``): ``density`` [1/m], or the length [m] at which contrast has
    fallen to 1/e, ``attenuationLength``, or to 2 %, ``visibilityRange``."""

    @property
    def parameter(self) -> str:
        """``fog``, or the name of the length."""
        return self.name if self.quantity == DENSITY else self.quantity

    @property
    def parameter_unit(self) -> str:
        """1/m, or m."""
        return self.unit if self.quantity == DENSITY else "m"

    def density(self, value: float) -> float:
        """Return the fog density [1/m] of a level."""
        return value if self.quantity == DENSITY else LENGTHS[self.quantity](value)

    def values(self) -> tuple[float, ...]:
        """Return the densities [1/m], or the lengths [m]."""
        if self.quantity == DENSITY:
            return super().values()
        initial, final, step = self.initial_value, self.final_value, self.step
        span = (final - initial) / step
        if not span < MAX_LEVELS:
            raise endless(initial, final, step)
        return tuple(initial + i * step for i in range(math.floor(span + 1e-9) + 1))

    def errors(self) -> Iterator[str]:
        """Report a sweep without levels."""
        initial, final, step = self.initial_value, self.final_value, self.step
        if self.quantity == DENSITY:
            if step <= 0.0:
                yield (
                    f"<step> is '{step:g}'; expected a number > 0 [1/m]: fog density runs upward. "
                    'A sweep of lengths may run downward: u:unit="attenuationLength" [m]'
                )
            yield from super().errors()
            return
        for tag, value in (("initialValue", initial), ("finalValue", final)):
            if value <= 0.0:
                yield f"<{tag}> is {value:g}; expected a length > 0 [m] (u:unit={self.quantity!r})"
        if step == 0.0:
            yield "<step> is 0; expected a length above or below 0 [m]"
        elif (final - initial) * step < 0.0:
            yield (
                f"<step> {step:g} leads away from <finalValue> {final:g}, as <initialValue> is "
                f"{initial:g}: change its sign"
            )
