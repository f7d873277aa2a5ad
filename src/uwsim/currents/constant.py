"""constant: a uniform, steady current.

.. code-block:: xml

    <u:constant> <u:velocity> <x>0.2</x> <y>0</y> <z>0</z> </u:velocity> </u:constant>
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..base.geometry import Triple
from ..base.numerics.calls import function_address
from ..base.numerics.memory import carray, floats, pointer
from ..schema import element
from .compiled import CompiledCurrent
from .current import MAX_SPEED, CurrentSpec, Place
from .flow_function import QUERY, FlowFunction, write_everywhere


@dataclass(frozen=True, kw_only=True)
class ConstantSpec(CurrentSpec):
    """A ``<u:constant>``: the same velocity everywhere and always."""

    velocity: Triple = element(namespaced=True, minimum=-MAX_SPEED, maximum=MAX_SPEED)
    """Velocity of the water, in L [m/s]."""

    def bind(self, place: Place) -> Constant:
        """Make the current; it needs nothing of the scene."""
        return Constant(self.velocity)


class Constant(CompiledCurrent):
    """A uniform, steady velocity; no boundary layer, no turbulence.

    Args:
        velocity: of the water, in L [m/s].
    """

    def __init__(self, velocity: Triple) -> None:
        self._velocity = velocity
        self._flow = FlowFunction(
            function=function_address(flow_constant),
            parameters=np.array(velocity, dtype=np.float64),
        )

    @property
    def is_uniform(self) -> bool:
        """Whether it is the same everywhere."""
        return True

    @property
    def is_steady(self) -> bool:
        """Whether it is the same at all times: yes."""
        return True

    @property
    def is_still(self) -> bool:
        """Whether its velocity is zero."""
        return not any(self._velocity)


def flow_constant(parameters: int, values: int, time: float) -> None:
    """Answer a query about a constant current; see `uwsim.currents.flow_function`."""
    query = carray(pointer(values), (1,), QUERY)[0]
    write_everywhere(query, floats(parameters, 3), np.zeros(3))
