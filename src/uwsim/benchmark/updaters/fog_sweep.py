r"""The base of the two fog updaters: a sweep of fog density, or of a length that defines it.

.. code-block:: xml

    <sceneFogUpdater u:unit="attenuationLength">
      <initialValue>10</initialValue> <finalValue>1</finalValue> <step>-1</step>
      <interval>2</interval>
    </sceneFogUpdater>

Fog of density f reduces contrast at the distance d by the factor :math:`e^{-(fd)^2}`. ``u:unit`` is
the quantity of the values of the sweep:

``density``
    f itself [1/m], as in the original.
``attenuationLength``
    The distance at which contrast has fallen to 1/e, :math:`L = 1/f` [m].
``visibilityRange``
    The distance at which it has fallen to 2 %, the smallest that the eye distinguishes (Koschmieder
    1924), :math:`V = \sqrt{\ln 50}/f = 1.98\,L` [m].

Lengths decrease as fog increases, so a sweep in metres may have a negative step. Its last value is
a level if it is a whole number of steps away, independent of rounding.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Literal

from ...base.optics import DENSITY, LENGTHS
from ...schema import Original, element
from .sweep import SweepSpec, endless_error
from .updater import MAX_LEVELS


@dataclass(frozen=True, kw_only=True)
class FogSweepSpec(SweepSpec):
    """An updater of fog. Its levels are counted in float32, unless its values are lengths."""

    name: ClassVar[str] = "fog"
    unit: ClassVar[str] = "1/m"
    is_single: ClassVar[bool] = True

    initial_value: float = element(original=Original(aliases=("initialFog",)), minimum=0.0)
    """The fog density of the first level [1/m]; or a length [m] with another ``u:unit``."""
    final_value: float = element(original=Original(aliases=("finalFog",)), minimum=0.0)
    """The fog density, or length, that is not passed."""
    step: float = element()
    """The increment from level to level; below 0 only for lengths."""
    quantity: Literal["density", "attenuationLength", "visibilityRange"] = element(
        "unit", default="density", attribute=True, namespaced=True
    )
    """The quantity of the values (``u:unit``): ``density`` [1/m], or the length [m] at which
    contrast has fallen to 1/e, ``attenuationLength``, or to 2 %, ``visibilityRange``."""

    @property
    def parameter(self) -> str:
        """The name ``fog``, or that of the length."""
        return self.name if self.quantity == DENSITY else self.quantity

    @property
    def parameter_unit(self) -> str:
        """The unit 1/m, or m."""
        return self.unit if self.quantity == DENSITY else "m"

    def density(self, value: float) -> float:
        """Return the fog density [1/m] of a level."""
        return value if self.quantity == DENSITY else LENGTHS[self.quantity](value)

    def values(self) -> tuple[float, ...]:
        """Return the densities [1/m], or the lengths [m]."""
        if self.quantity == DENSITY:
            return super().values()
        start, end, step = self.initial_value, self.final_value, self.step
        span = (end - start) / step
        if not span < MAX_LEVELS:
            raise endless_error(start, end, step)
        return tuple(start + i * step for i in range(math.floor(span + 1e-9) + 1))

    def errors(self) -> Iterator[str]:
        """Report a sweep without levels."""
        start, end, step = self.initial_value, self.final_value, self.step
        if self.quantity == DENSITY:
            if step <= 0.0:
                yield (
                    f"<step> is '{step:g}'; expected a number > 0 [1/m]: fog density increases. "
                    'A sweep of lengths may decrease: u:unit="attenuationLength" [m]'
                )
            yield from super().errors()
            return
        for tag, value in (("initialValue", start), ("finalValue", end)):
            if value <= 0.0:
                yield f"<{tag}> is {value:g}; expected a length > 0 [m] (u:unit={self.quantity!r})"
        if step == 0.0:
            yield "<step> is 0; expected a length above or below 0 [m]"
        elif (end - start) * step < 0.0:
            yield (
                f"<step> {step:g} points away from <finalValue> {end:g}, as <initialValue> is "
                f"{start:g}: change its sign"
            )
