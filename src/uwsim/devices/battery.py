r"""The battery of a vehicle, drained by its thrusters, its joints and a constant load.

.. code-block:: xml

    <u:battery>
      <name>battery</name> <capacity>2000</capacity> <voltage>48</voltage>
      <resistance>0.05</resistance> <hotelLoad>60</hotelLoad>
    </u:battery>

With the open-circuit voltage :math:`V_0` and the internal resistance R, a load P draws the current

.. math:: I = \frac{V_0 - \sqrt{V_0^2 - 4 R P}}{2 R}, \qquad V = V_0 - R I ,

and the store loses :math:`V_0 I`. What the thrusters and joints draw is the law of the measure
``<u:energy>``, looked at 50 times a second. The battery can feed

.. math:: P_{max} = V_0^2 / 4R

at most. Where thrusters, joints and the constant load ask for more, the thrusters get what is left:
all give the same smaller share of their thrust, found at the end of every step, so that thrust,
current and charge agree. The message reports such an overload as an unspecified failure. Not
modelled: a voltage that falls with the charge, thrust that falls with the voltage, joints that are
weaker in an overload, temperature, ageing. With ``<stopsThrusters>`` an empty battery stops the
thrusters; arms hold their place, as those with self-locking gears do. Without it the vehicle goes
on.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

from ..base.record import Record
from ..messages import BatteryState, header
from ..schema import element
from ..world import Actuators, DeviceWorld
from .device import Device, DeviceSpec, DeviceVehicle

RATE = 50.0
"""How often the charge is reckoned [Hz]."""
ROUNDS = 30
"""Corrections of the share of the thrusts at most."""
TOLERANCE = 1e-9
"""Of the power fed, share of the greatest."""


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

    @property
    def greatest_load(self) -> float:
        """The greatest power that it can feed [W]."""
        return self.voltage**2 / (4.0 * self.resistance) if self.resistance > 0.0 else math.inf

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> Battery:
        """Find the consumers; of a vehicle that is not simulated there is the constant load."""
        actuators = world.actuators(vehicle.name)
        limited = self.stops_thrusters or self.greatest_load < math.inf
        reduced = actuators.thrusters if actuators is not None and limited else ()
        cuts = tuple(vehicle.loss_setter(name) for name in reduced)
        battery = Battery(self, world, actuators, cuts)
        world.every(RATE, battery.drain)
        return battery


@dataclass(slots=True)
class BatteryRecord(Record):
    """What a battery has given."""

    drawn: float
    """The charge that was drawn [A s]."""
    current: float
    """The current when it was last looked at [A]."""
    time: float
    """When that was [s]."""
    is_overloaded: bool = False
    """Whether the load is more than it can feed."""


class Battery(Device):
    """The charge that is left, and the voltage and current of now."""

    def __init__(
        self,
        spec: BatterySpec,
        world: DeviceWorld,
        actuators: Actuators | None,
        cuts: tuple[Callable[[float], None], ...],
    ) -> None:
        self._spec, self._world, self._actuators, self._cuts = spec, world, actuators, cuts
        drawn = (1.0 - spec.charge) * self._full
        self.state: BatteryRecord = BatteryRecord(drawn, 0.0, world.time)
        greatest = 0.0 if actuators is None else actuators.greatest_power
        self._can_overload = bool(cuts) and spec.hotel_load + greatest > spec.greatest_load

    @property
    def _full(self) -> float:
        """Charge of the full battery [A s]."""
        return 3600.0 * self._spec.capacity / self._spec.voltage

    def drain(self) -> None:
        """Take what was drawn since the last time, by the trapezoidal rule."""
        now, current = self._world.time, self._current_of(self._load())
        state = self.state
        state.drawn += 0.5 * (state.current + current) * (now - state.time)
        state.drawn = min(state.drawn, self._full)
        state.current, state.time = current, now
        if self._is_empty:
            self._cut(1.0)

    @property
    def _is_empty(self) -> bool:
        """Whether it is empty and stops the thrusters then."""
        return self._spec.stops_thrusters and self.state.drawn >= self._full

    def rests_until(self, time: float) -> float:
        """Return when it looks at the load again: at the next step, if that may be too much."""
        return time if self._can_overload else math.inf

    def animate(self, time: float) -> None:
        """Limit the thrusts, at the end of a step, to what it can feed."""
        if self._can_overload and not self._is_empty:
            self._limit()

    def _limit(self) -> None:
        """Find the share of the thrusts that it can feed.

        The law of power is the thrust to the power of 1.5: one round corrects the share. Measured
        polynomials take some more.
        """
        assert self._actuators is not None
        n, share = len(self._actuators.thrusters), 1.0
        self._cut(0.0)
        self.state.is_overloaded = False
        for _ in range(ROUNDS):
            powers = self._actuators.powers().tolist()
            thrusters = math.fsum(powers[:n])
            left = self._spec.greatest_load - self._spec.hotel_load - math.fsum(powers[n:])
            if thrusters - left <= TOLERANCE * self._spec.greatest_load:
                return
            self.state.is_overloaded = True
            if left <= 0.0 or thrusters <= 0.0:
                self._cut(1.0)
                return
            share *= (left / thrusters) ** (2.0 / 3.0)
            self._cut(1.0 - share)

    def _cut(self, loss: float) -> None:
        """Take a share of all thrusts away [0..1]."""
        for cut in self._cuts:
            cut(loss)

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
        load = self._load()
        current = self._current_of(load)
        left = max(self._full - self.state.drawn, 0.0)
        greatest = self._spec.greatest_load * (1.0 + 1e-6)
        health = BatteryState.POWER_SUPPLY_HEALTH_UNKNOWN
        if left <= 0.0:
            health = BatteryState.POWER_SUPPLY_HEALTH_DEAD
        elif self.state.is_overloaded or load > greatest:
            health = BatteryState.POWER_SUPPLY_HEALTH_UNSPEC_FAILURE
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
            power_supply_health=health,
            present=True,
        )
