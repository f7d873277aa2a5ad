r"""The base class of the fog updaters: a sweep of fog density, or of a length that defines it.

.. code-block:: xml

    <sceneFogUpdater u:unit="attenuationLength">
      <initialValue>10</initialValue> <finalValue>1</finalValue> <step>-1</step>
      <interval>2</interval>
    </sceneFogUpdater>

Fog of the density f [1/m] reduces contrast at the distance d [m] by the factor
:math:`e^{-(fd)^2}`. ``u:unit`` selects the quantity that the sweep changes:

``density``
    The density f [1/m], as in the original UWSim.
``attenuationLength``
    The distance at which contrast has fallen to 1/e, :math:`L = 1/f` [m].
``visibilityRange``
    The distance at which contrast has fallen to 2 %, the smallest that the eye distinguishes
    (Koschmieder 1924), :math:`V = \sqrt{\ln 50}/f = 1.98\,L` [m].

These lengths decrease as the density increases, so a sweep of a length may have a negative step.
Its final value is a level if it is a whole number of steps away from the initial value, regardless
of rounding errors.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Literal

from ...base.optics import DENSITY, LENGTHS
from ...schema import Original, element
from .sweep import SweepSpec, step_values


@dataclass(frozen=True, kw_only=True)
class FogSweepSpec(SweepSpec):
    """An updater that sweeps the density of fog, or a length that defines the density.

    The number of levels of a density is computed in float32, as in the original UWSim.
    """

    name: ClassVar[str] = "fog"
    unit: ClassVar[str] = "1/m"
    uses_float32: ClassVar[bool] = True

    initial_value: float = element(original=Original(aliases=("initialFog",)), minimum=0.0)
    """The fog density of the first level [1/m], or the length that ``u:unit`` selects [m]."""
    final_value: float = element(original=Original(aliases=("finalFog",)), minimum=0.0)
    """The fog density, or the length, beyond which there is no level."""
    step: float = element()
    """The increment from level to level; only the increment of a length may be negative."""
    quantity: Literal["density", "attenuationLength", "visibilityRange"] = element(
        "unit", default="density", attribute=True, namespaced=True
    )
    """The quantity that the sweep changes (``u:unit``): ``density`` [1/m], or the distance [m] at
    which contrast has fallen to 1/e (``attenuationLength``) or to 2 % (``visibilityRange``)."""

    @property
    def parameter(self) -> str:
        """The name of the column: ``fog`` for a density, or the name of the length."""
        return self.name if self.quantity == DENSITY else self.quantity

    @property
    def parameter_unit(self) -> str:
        """The unit of the column: 1/m for a density, m for a length."""
        return self.unit if self.quantity == DENSITY else "m"

    def density(self, value: float) -> float:
        """Return the fog density [1/m] for a value of the sweep."""
        return value if self.quantity == DENSITY else LENGTHS[self.quantity](value)

    def values(self) -> tuple[float, ...]:
        """Return the density [1/m] or the length [m] of each level."""
        if self.quantity == DENSITY:
            return super().values()
        return step_values(self.initial_value, self.final_value, self.step)

    def errors(self) -> Iterator[str]:
        """Report a step of 0 or of the wrong sign, and lengths that are not positive."""
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
