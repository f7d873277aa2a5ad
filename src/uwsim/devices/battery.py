r"""The battery of a vehicle, drained by its thrusters, its joints and a constant load.

.. code-block:: xml

    <u:battery>
      <name>battery</name> <capacity>2000</capacity> <voltage>48</voltage>
      <resistance>0.05</resistance> <hotelLoad>60</hotelLoad>
    </u:battery>

With the open-circuit voltage :math:`V_0` and the internal resistance R, a load P draws the current

.. math:: I = \frac{V_0 - \sqrt{V_0^2 - 4 R P}}{2 R}, \qquad V = V_0 - R I ,

and the store loses :math:`V_0 I`. What the thrusters and joints draw is the law of the measure
``<u:energy>``, looked at 50 times a second. Not modelled: a voltage that falls with the charge,
temperature, ageing. With ``<stopsThrusters>`` an empty battery stops the thrusters; arms hold their
place, as those with self-locking gears do. Without it the vehicle goes on.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

from ..messages import BatteryState, header
from ..schema import element
from ..world import Actuators, Stage
from .device import Device, DeviceSpec, DeviceVehicle

RATE = 50.0
"""How often the load is looked at [Hz]."""


@dataclass(frozen=True, kw_only=True)
class BatterySpec(DeviceSpec):
    """A ``<u:battery>``."""

    message_type: ClassVar[type] = BatteryState

    name: str
    """Its name."""
    capacity: float = element(above=0.0, maximum=1e9)
    """Energy of a full battery [Wh]."""
    voltage: float = element(default=24.0, above=0.0, maximum=10000.0)
    """Without a load [V]."""
    resistance: float = element(default=0.0, minimum=0.0, maximum=100.0)
    """Inside the battery [ohm]."""
    charge: float = element(default=1.0, minimum=0.0, maximum=1.0)
    """Share of the capacity that is there at the start [0..1]."""
    hotel_load: float = element(default=0.0, minimum=0.0, maximum=1e6)
    """What computers, sensors and lamps draw all the time [W]."""

    stops_thrusters: bool = False
    """Whether the thrusters of a simulated vehicle stop when it is empty."""

    def bind(self, stage: Stage, vehicle: DeviceVehicle) -> Battery:
        """Find the consumers; of a vehicle that is not simulated there is the constant load."""
        actuators = stage.actuators(vehicle.name)
        stopped = actuators.thrusters if actuators is not None and self.stops_thrusters else ()
        cuts = tuple(vehicle.loss_setter(name) for name in stopped)
        battery = Battery(self, stage, actuators, cuts)
        stage.every(RATE, battery.drain)
        return battery


class Battery(Device):
    """The charge that is left, and the voltage and current of now."""

    STATE = ("_drawn", "_current", "_time")

    def __init__(
        self,
        spec: BatterySpec,
        stage: Stage,
        actuators: Actuators | None,
        cuts: tuple[Callable[[float], None], ...],
    ) -> None:
        self._spec, self._stage, self._actuators, self._cuts = spec, stage, actuators, cuts
        self._drawn = (1.0 - spec.charge) * self._full  # [A s]
        self._current, self._time = 0.0, stage.time

    @property
    def _full(self) -> float:
        """Charge of the full battery [A s]."""
        return 3600.0 * self._spec.capacity / self._spec.voltage

    def drain(self) -> None:
        """Take what was drawn since the last time, by the trapezoidal rule."""
        now, current = self._stage.time, self._current_of(self._load())
        self._drawn += 0.5 * (self._current + current) * (now - self._time)
        self._drawn = min(self._drawn, self._full)
        self._current, self._time = current, now
        if self._drawn >= self._full:
            for cut in self._cuts:
                cut(1.0)

    def _load(self) -> float:
        """Power that is drawn now [W]."""
        drawn = 0.0 if self._actuators is None else math.fsum(self._actuators.powers().tolist())
        return self._spec.hotel_load + drawn

    def _current_of(self, load: float) -> float:
        """Current that a load [W] draws; at most that of the largest load it can feed [A]."""
        voltage, resistance = self._spec.voltage, self._spec.resistance
        root = math.sqrt(max(voltage**2 - 4.0 * resistance * load, 0.0))
        return 2.0 * load / (voltage + root) if root else 0.5 * voltage / resistance

    def sample(self, time: float) -> BatteryState:
        """Read it now, at ``time`` [s]."""
        current = self._current_of(self._load())
        left = max(self._full - self._drawn, 0.0)
        unknown, dead = (
            BatteryState.POWER_SUPPLY_HEALTH_UNKNOWN,
            BatteryState.POWER_SUPPLY_HEALTH_DEAD,
        )
        return BatteryState(
            header=header(time, self._spec.name),
            voltage=self._spec.voltage - self._spec.resistance * current,
            temperature=math.nan,
            current=-current,
            charge=left / 3600.0,
            capacity=self._full / 3600.0,
            design_capacity=self._full / 3600.0,
            percentage=left / self._full,
            power_supply_status=BatteryState.POWER_SUPPLY_STATUS_DISCHARGING,
            power_supply_health=unknown if left > 0.0 else dead,
            present=True,
        )
