"""constant: a uniform, steady current.

.. code-block:: xml

    <u:constant> <u:velocity> <x>0.2</x> <y>0</y> <z>0</z> </u:velocity> </u:constant>
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..base.geometry import Triple
from ..base.numerics.memory import carray, pointer, view_doubles
from ..schema import element
from .compiled import CompiledCurrent
from .current import MAX_SPEED, CurrentSpec, SceneContext
from .flow_function import QUERY, FlowFunction, write_everywhere


@dataclass(frozen=True, kw_only=True)
class ConstantSpec(CurrentSpec):
    """A ``<u:constant>``: the same velocity everywhere and always."""

    velocity: Triple = element(namespaced=True, minimum=-MAX_SPEED, maximum=MAX_SPEED)
    """The velocity of the water, in L [m/s]."""

    def bind(self, context: SceneContext) -> Constant:
        """Create the current; ``context`` is not used."""
        return Constant(self.velocity)


@dataclass(frozen=True)
class Constant(CompiledCurrent):
    """A uniform, steady current. Not modelled: boundary layers, turbulence."""

    components: Triple
    """The velocity of the water, in L [m/s]."""

    @cached_property
    def _flow(self) -> FlowFunction:  # type: ignore[override]  # read-only to mypy
        parameters = np.array(self.components, dtype=np.float64)
        return FlowFunction(function=flow_constant, parameters=parameters)

    def __getstate__(self) -> dict[str, object]:
        """Return the fields without the cached function, whose addresses must not be pickled."""
        return {"components": self.components}

    @property
    def is_uniform(self) -> bool:
        """True if the velocity is the same at every point; it always is."""
        return True

    @property
    def is_steady(self) -> bool:
        """True if the velocity is constant in time; it always is."""
        return True

    @property
    def is_still(self) -> bool:
        """True if the velocity is zero."""
        return not any(self.components)


def flow_constant(parameters_address: int, query_address: int, time: float) -> None:
    """Evaluate a query of a constant current; see `uwsim.currents.flow_function`."""
    query = carray(pointer(query_address), (1,), QUERY)[0]
    write_everywhere(query, view_doubles(parameters_address, 3), np.zeros(3))
