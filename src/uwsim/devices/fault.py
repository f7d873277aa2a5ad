r"""A fault of a thruster or a sensor, at given or at random times; an extension of the dialect.

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

The kinds of faults of sensors: ``dropout``, no message; ``freeze``, the last message with a new
time stamp; ``bias``, ``size`` is added to each number; ``latency``, messages arrive ``delay``
later; ``outliers``, a normally distributed number with the standard deviation ``size`` is added to
each number. The kinds of faults of thrusters: ``loss``, a fraction of the thrust is lost;
``dropout``, all thrust is lost.
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
"""The kind of a fault."""
THRUSTER_KINDS = ("loss", "dropout")
"""The kinds of faults of thrusters."""
SENSOR_KINDS = ("dropout", "freeze", "bias", "latency", "outliers")
"""The kinds of faults of sensors."""
NUMERIC_KINDS = ("bias", "outliers")
"""The kinds that change the numbers of messages."""
SENSOR_FAULT = Device()
"""The device of every fault of a sensor: such faults change messages, and do nothing in a step."""


@dataclass(frozen=True, kw_only=True)
class FaultSpec(DeviceSpec):
    """A ``<u:fault>``: a thruster of a vehicle with dynamics loses thrust, or a sensor fails."""

    thruster: str | None = element(namespaced=True, default=None)
    """The thruster that fails, by its name in the vehicle's hydrodynamics file."""
    sensor: str | None = element(namespaced=True, default=None)
    """The sensor of the vehicle that fails, on all its topics."""
    kind: Kind = element(namespaced=True, default="loss")
    """``loss`` or ``dropout`` of a thruster; ``dropout``, ``freeze``, ``bias``, ``latency`` or
    ``outliers`` of a sensor."""
    loss: float = element(namespaced=True, default=1.0, minimum=0.0, maximum=1.0)
    """The fraction of the thrust that is lost; 1: all of it [1]."""
    size: float = element(namespaced=True, default=0.0, minimum=-1e9, maximum=1e9)
    """The bias, or the standard deviation of outliers, in the unit of the field."""
    field: str | None = element(namespaced=True, default=None)
    """The field of the message that has the bias or the outliers, such as ``angular_velocity.z``;
    without it all numbers outside the header and the covariances."""
    delay: float = element(namespaced=True, default=0.0, minimum=0.0, maximum=3600.0)
    """The delay of messages of the kind ``latency`` [s]."""
    start: float = element(namespaced=True, default=0.0, minimum=0.0)
    """The simulation time from which on the fault may be present [s]."""
    end: float | None = element(namespaced=True, default=None, exclusive_minimum=0.0)
    """The simulation time until which the fault may be present [s]; by default there is no end."""
    rate: float | None = element(
        namespaced=True, default=None, exclusive_minimum=0.0, maximum=1000.0
    )
    """The mean rate of random occurrences from ``start`` to ``end`` [1/s]; by default the fault is
    present all the time."""
    duration: float = element(namespaced=True, default=0.0, minimum=0.0)
    """The duration of each random occurrence [s]; 0: one sample or step."""

    STREAM: ClassVar[str] = "fault"

    def errors(self, sensors: Sequence[str]) -> list[str]:
        """Return the errors of the fault on a vehicle with these sensors."""
        if (self.thruster is None) == (self.sensor is None):
            return ["a <u:fault> names a <u:thruster> or a <u:sensor>; expected one of them"]
        errors = []
        kinds = SENSOR_KINDS if self.thruster is None else THRUSTER_KINDS
        if self.sensor is not None and self.sensor not in sensors:
            errors.append(str(UnknownName("sensor", self.sensor, sensors)))
        if self.kind not in kinds:
            part = "sensor" if self.thruster is None else "thruster"
            errors.append(f"<u:kind> of a {part} is {self.kind!r}; expected {', '.join(kinds)}")
        if self.sensor is not None and self.kind == "latency" and not self.delay:
            errors.append("<u:kind> latency without <u:delay>; expected how long messages take [s]")
        if self.sensor is not None and self.kind in NUMERIC_KINDS and not self.size:
            errors.append(f"<u:kind> {self.kind} without <u:size>; expected a number that is not 0")
        if self.end is not None and self.end <= self.start:
            errors.append(
                f"<u:fault> ends at {self.end:g} s and begins at {self.start:g} s; "
                "expected an end after its start"
            )
        return errors

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> Device:
        """Resolve the thruster; raise UnknownName if the vehicle has no thruster of that name."""
        if self.thruster is None:
            return SENSOR_FAULT
        rng = world.stream(f"{vehicle.name}/{self.thruster}/{self.STREAM}")
        return ThrusterFault(self, vehicle.loss_setter(self.thruster), FaultTimes(self, rng))


class ThrusterFault(Device):
    """A fault of a thruster, at the times that the scene gives."""

    def __init__(
        self, spec: FaultSpec, set_loss: Callable[[float], None], times: FaultTimes
    ) -> None:
        self._loss = 1.0 if spec.kind == "dropout" else spec.loss
        self._set_loss, self._times = set_loss, times
        self.state: FaultState = times.state

    def step(self, time: float) -> None:
        """Set the loss of the step that begins at ``time`` [s]."""
        self._set_loss(self._loss if self._times.is_present(time) else 0.0)

    def idle_until(self, time: float) -> float:
        """Return the next time at which the fault begins or ends [s]."""
        return self._times.next_change(time)
