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

import numpy as np

from ..base.geometry import Array
from ..base.numerics.calls import FUNCTION, address_of, call, function_address
from ..base.numerics.exact_sum import exact_sum
from ..base.numerics.jit import njit
from ..base.numerics.memory import carray, pointer, view_doubles
from ..base.record import Record
from ..base.sampling import Sample, Sampler, Sampling
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
    is_pure: ClassVar[bool] = True

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
        sampling = Sampling(battery.sampler, battery.state.sample)
        world.every(RATE, battery.stop, is_needed=battery.must_stop, sampling=sampling)
        return battery


DRAWN, CURRENT, TIME = range(3)
"""The numbers of `BatteryRecord`."""
BATTERY = np.dtype(
    [
        ("powers", FUNCTION),  # of thrusters and joints; 0: it has none
        ("n", np.int64),  # how many they are
        ("hotel_load", np.float64),  # [W]
        ("voltage", np.float64),  # without a load [V]
        ("resistance", np.float64),  # [ohm]
        ("full", np.float64),  # charge of the full battery [A s]
        ("numbers", np.int64),  # the address of those of the record
    ]
)
"""A battery, for compiled code."""


@dataclass(slots=True)
class BatteryRecord(Record):
    """What a battery has given."""

    numbers: Array
    """The charge that was drawn [A s], the current when it was last looked at [A], and when that
    was [s], (3,)."""
    sample: Sample
    """When compiled code looked last."""
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
        self._spec, self._actuators, self._cuts = spec, actuators, cuts
        drawn = (1.0 - spec.charge) * self._full
        numbers = np.array([drawn, 0.0, world.time])
        powers = None if actuators is None else actuators.compiled_powers
        row = np.zeros(1, BATTERY)
        if actuators is not None and powers is not None:
            row["powers"] = powers.addresses
            row["n"] = len(actuators.thrusters) + len(actuators.joints)
        row["hotel_load"], row["voltage"] = spec.hotel_load, spec.voltage
        row["resistance"], row["full"] = spec.resistance, self._full
        row["numbers"] = address_of(numbers)
        self.sampler = Sampler(
            function=function_address(drain),
            parameters=row,
            n_values=0,
            prepare=(lambda _: None) if powers is None else powers.prepare,
            is_alone=self._lasts,
            kept=(powers, numbers),
        )
        """What takes the charge that was drawn since the last time."""
        self.state: BatteryRecord = BatteryRecord(numbers, Sample.of(self.sampler))
        greatest = 0.0 if actuators is None else actuators.greatest_power
        self._can_overload = bool(cuts) and spec.hotel_load + greatest > spec.greatest_load

    @property
    def _full(self) -> float:
        """Charge of the full battery [A s]."""
        return 3600.0 * self._spec.capacity / self._spec.voltage

    def _lasts(self, until: float) -> bool:
        """Whether it cannot be empty before a time [s], or that stops nothing."""
        spec, numbers = self._spec, self.state.numbers
        if not spec.stops_thrusters:
            return True
        most = 0.5 * spec.voltage / spec.resistance if spec.resistance > 0.0 else math.inf
        return bool(numbers[DRAWN] + most * (until - numbers[TIME]) < self._full)

    def stop(self) -> None:
        """Let the thrusters give nothing: it is empty."""
        self._cut(1.0)

    def must_stop(self) -> bool:
        """Whether it is empty and stops the thrusters then."""
        return bool(self._spec.stops_thrusters and self.state.numbers[DRAWN] >= self._full)

    def rests_until(self, time: float) -> float:
        """Return when it looks at the load again: at the next step, if that may be too much."""
        return time if self._can_overload else math.inf

    def animate(self, time: float) -> None:
        """Limit the thrusts, at the end of a step, to what it can feed."""
        if self._can_overload and not self.must_stop():
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

    def sample(self, time: float) -> BatteryState:
        """Read it now, at ``time`` [s]."""
        load = self._load()
        current = current_of(load, self._spec.voltage, self._spec.resistance)
        left = max(self._full - float(self.state.numbers[DRAWN]), 0.0)
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


@njit
def current_of(load: float, voltage: float, resistance: float) -> float:
    """Return the current that a load [W] draws, at most that of the largest that can be fed [A]."""
    root = math.sqrt(max(voltage * voltage - 4.0 * resistance * load, 0.0))
    return 2.0 * load / (voltage + root) if root != 0.0 else 0.5 * voltage / resistance


def drain(parameters: int, values: int, time: float) -> None:
    """Take what was drawn since the last time, by the trapezoidal rule.

    See `uwsim.base.numerics.calls`.
    """
    battery = carray(pointer(parameters), (1,), BATTERY)[0]
    numbers, load = view_doubles(battery.numbers, 3), battery.hotel_load
    if battery.powers.function != 0:
        powers = np.empty(battery.n)
        call(battery.powers.function, battery.powers.parameters, powers.ctypes.data, time)
        load += exact_sum(powers)
    current = current_of(load, battery.voltage, battery.resistance)
    numbers[DRAWN] += 0.5 * (numbers[CURRENT] + current) * (time - numbers[TIME])
    numbers[DRAWN] = min(numbers[DRAWN], battery.full)
    numbers[CURRENT], numbers[TIME] = current, time
