r"""fault: a thruster that fails at a given time; an extension of the dialect.

.. code-block:: xml

    <vehicle> ... <u:dynamics>g500_physical</u:dynamics>
      <u:fault> <u:thruster>sway</u:thruster> <u:loss>1</u:loss> <u:start>30</u:start> </u:fault>
    </vehicle>
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from ..schema import element
from ..world import Stage
from .device import Device, DeviceSpec, DeviceVehicle


@dataclass(frozen=True, kw_only=True)
class ThrusterFaultSpec(DeviceSpec):
    """A ``<u:fault>``: a thruster of a simulated vehicle loses thrust."""

    thruster: str = element(namespaced=True)
    """Its name in the vehicle's hydrodynamics file."""
    loss: float = element(namespaced=True, default=1.0, minimum=0.0, maximum=1.0)
    """Share of the thrust that is lost; 1 is dead [1]."""
    start: float = element(namespaced=True, default=0.0, minimum=0.0)
    """Simulation time from which on [s]."""
    end: float | None = element(namespaced=True, default=None, above=0.0)
    """Simulation time up to which; without it stays so [s]."""

    def acts(self, time: float) -> bool:
        """Whether the fault is present at ``time`` [s]."""
        return time >= self.start and (self.end is None or time < self.end)

    def bind(self, stage: Stage, vehicle: DeviceVehicle) -> ThrusterFault:
        """Find the thruster; raises UnknownName if the vehicle has none of that name."""
        return ThrusterFault(self, vehicle.loss_setter(self.thruster))


class ThrusterFault(Device):
    """A thruster that fails at the times given in the scene."""

    def __init__(self, spec: ThrusterFaultSpec, lose: Callable[[float], None]) -> None:
        self._spec, self._lose = spec, lose

    def step(self, time: float) -> None:
        """Set the loss of the step that begins at ``time`` [s]."""
        self._lose(self._spec.loss if self._spec.acts(time + 1e-9) else 0.0)

    def rests_until(self, time: float) -> float:
        """Return when it begins or ends next [s]."""
        ends = (self._spec.start, self._spec.end)
        return min((end for end in ends if end is not None and end > time), default=math.inf)
