r"""fault: a thruster or a sensor that fails, at given times or at random; an extension.

.. code-block:: xml

    <vehicle> ... <u:dynamics>g500_physical</u:dynamics>
      <u:fault> <u:thruster>sway</u:thruster> <u:loss>1</u:loss> <u:start>30</u:start> </u:fault>
      <u:fault> <u:sensor>dvl</u:sensor> <u:kind>dropout</u:kind>
        <u:rate>0.1</u:rate> <u:duration>2</u:duration>
      </u:fault>
      <u:fault> <u:sensor>depth</u:sensor> <u:kind>bias</u:kind> <u:size>0.3</u:size>
        <u:start>10</u:start> <u:end>20</u:end>
      </u:fault>
    </vehicle>

The kinds of sensors: ``dropout``, no message; ``freeze``, the last one again with a new time
stamp; ``bias``, ``size`` added; ``latency``, messages come ``delay`` later; ``outliers``, a normal
number of the standard deviation ``size`` added, anew for each number. A thruster has ``loss`` of a
share of its thrust, or ``dropout``, which is all of it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal

from ..errors import UnknownName
from ..schema import element
from ..world import DeviceWorld
from .device import Device, DeviceSpec, DeviceVehicle
from .fault_times import FaultState, FaultTimes

Kind = Literal["loss", "dropout", "freeze", "bias", "latency", "outliers"]
"""What fails."""
OF_THRUSTERS = ("loss", "dropout")
OF_SENSORS = ("dropout", "freeze", "bias", "latency", "outliers")
OF_NUMBERS = ("bias", "outliers")
"""Kinds that change the numbers of messages."""
IDLE = Device()
"""What a fault of a sensor does in a step: nothing; it acts on messages."""


@dataclass(frozen=True, kw_only=True)
class FaultSpec(DeviceSpec):
    """A ``<u:fault>``: a thruster of a simulated vehicle loses thrust, or a sensor fails."""

    thruster: str | None = element(namespaced=True, default=None)
    """The thruster that fails, by its name in the vehicle's hydrodynamics file."""
    sensor: str | None = element(namespaced=True, default=None)
    """The sensor of the vehicle that fails, on all its topics."""
    kind: Kind = element(namespaced=True, default="loss")
    """``loss`` or ``dropout`` of a thruster; ``dropout``, ``freeze``, ``bias``, ``latency`` or
    ``outliers`` of a sensor."""
    loss: float = element(namespaced=True, default=1.0, minimum=0.0, maximum=1.0)
    """Share of the thrust that is lost; 1 is dead [1]."""
    size: float = element(namespaced=True, default=0.0, minimum=-1e9, maximum=1e9)
    """Bias, or standard deviation of outliers, in the unit of the field."""
    field: str | None = element(namespaced=True, default=None)
    """Field of the message that is biased or has outliers, such as ``angular_velocity.z``; without
    it all numbers outside the header and the covariances."""
    delay: float = element(namespaced=True, default=0.0, minimum=0.0, maximum=3600.0)
    """Latency [s]."""
    start: float = element(namespaced=True, default=0.0, minimum=0.0)
    """Simulation time from which on [s]."""
    end: float | None = element(namespaced=True, default=None, above=0.0)
    """Simulation time up to which; without it stays so [s]."""
    rate: float | None = element(namespaced=True, default=None, above=0.0, maximum=1000.0)
    """How often it begins at random between these; without it is always there [1/s]."""
    duration: float = element(namespaced=True, default=0.0, minimum=0.0)
    """How long it stays each time that it begins at random; 0: for one sample or step [s]."""

    STREAM: ClassVar[str] = "fault"

    def errors(self, sensors: Sequence[str]) -> list[str]:
        """Return what is wrong with it on a vehicle with these sensors."""
        if (self.thruster is None) == (self.sensor is None):
            return ["a <u:fault> names a <u:thruster> or a <u:sensor>; expected one of them"]
        found = []
        kinds = OF_SENSORS if self.thruster is None else OF_THRUSTERS
        if self.sensor is not None and self.sensor not in sensors:
            found.append(str(UnknownName("sensor", self.sensor, sensors)))
        if self.kind not in kinds:
            what = "sensor" if self.thruster is None else "thruster"
            found.append(f"<u:kind> of a {what} is {self.kind!r}; expected {', '.join(kinds)}")
        if self.sensor is not None and self.kind == "latency" and not self.delay:
            found.append("<u:kind> latency without <u:delay>; expected how long messages take [s]")
        if self.sensor is not None and self.kind in OF_NUMBERS and not self.size:
            found.append(f"<u:kind> {self.kind} without <u:size>; expected a number that is not 0")
        if self.end is not None and self.end <= self.start:
            found.append(
                f"<u:fault> ends at {self.end:g} s and begins at {self.start:g} s; "
                "expected an end after its start"
            )
        return found

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> Device:
        """Find the thruster; raises UnknownName if the vehicle has none of that name."""
        if self.thruster is None:
            return IDLE
        random = world.stream(f"{vehicle.name}/{self.thruster}/{self.STREAM}")
        return ThrusterFault(self, vehicle.loss_setter(self.thruster), FaultTimes(self, random))


class ThrusterFault(Device):
    """A thruster that fails at the times given in the scene."""

    def __init__(self, spec: FaultSpec, lose: Callable[[float], None], times: FaultTimes) -> None:
        self._loss = 1.0 if spec.kind == "dropout" else spec.loss
        self._lose, self._times = lose, times
        self.state: FaultState = times.state

    def step(self, time: float) -> None:
        """Set the loss of the step that begins at ``time`` [s]."""
        self._lose(self._loss if self._times.acts(time) else 0.0)

    def rests_until(self, time: float) -> float:
        """Return when it begins or ends next [s]."""
        return self._times.next_change(time)
