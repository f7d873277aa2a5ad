r"""The battery of a vehicle: thrusters, joints and a constant load discharge it.

.. code-block:: xml

    <u:battery>
      <name>battery</name> <capacity>2000</capacity> <voltage>48</voltage>
      <resistance>0.05</resistance> <hotelLoad>60</hotelLoad>
    </u:battery>

With the open-circuit voltage :math:`V_0` and the internal resistance R, a load P draws the current

.. math:: I = \frac{V_0 - \sqrt{V_0^2 - 4 R P}}{2 R}, \qquad V = V_0 - R I ,

and its stored energy falls by :math:`V_0 I` per second. The power of thrusters and joints is that
of the measure ``<u:energy>``, sampled at 50 Hz. The battery can deliver

.. math:: P_{max} = V_0^2 / 4R

at most. If thrusters, joints and the constant load require more, a common factor reduces the
thrusts. It is computed at the end of every step, so that thrust, current and charge agree. The
message reports such an overload as an unspecified failure. Not modelled: a voltage that falls with
the charge, thrust that falls with the voltage, joints that are weaker in an overload, temperature,
ageing. With ``<stopsThrusters>`` an empty battery stops the thrusters; joints keep their position,
as with self-locking gears. Without it an empty battery has no effect.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..base.geometry import Array
from ..base.numerics.calls import FUNCTION, address_of, call, function_address, prepare_nothing
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
"""The rate at which the charge is computed [Hz]."""
MAX_ITERATIONS = 30
"""The greatest number of iterations for the common factor of the thrusts."""
TOLERANCE = 1e-9
"""The tolerance of the power, as a fraction of the greatest power."""


@dataclass(frozen=True, kw_only=True)
class BatterySpec(DeviceSpec):
    """A ``<u:battery>``."""

    message_type: ClassVar[type] = BatteryState
    is_pure: ClassVar[bool] = True

    name: str
    """The name of the battery."""
    capacity: float = element(exclusive_minimum=0.0, maximum=1e9)
    """The energy of a full battery [Wh]."""
    voltage: float = element(default=24.0, exclusive_minimum=0.0, maximum=10000.0)
    """The open-circuit voltage [V]."""
    resistance: float = element(default=0.0, minimum=0.0, maximum=100.0)
    """The internal resistance [ohm]."""
    charge: float = element(default=1.0, minimum=0.0, maximum=1.0)
    """The state of charge at the start, as a fraction of the capacity [0..1]."""
    hotel_load: float = element(default=0.0, minimum=0.0, maximum=1e6)
    """The constant power of computers, sensors and lamps [W]."""

    stops_thrusters: bool = False
    """True if the thrusters of a vehicle with dynamics stop when the battery is empty."""

    @property
    def max_load(self) -> float:
        """The greatest power that the battery can deliver [W]."""
        return self.voltage**2 / (4.0 * self.resistance) if self.resistance > 0.0 else math.inf

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> Battery:
        """Resolve the thrusters and joints; a kinematic vehicle has the constant load only."""
        actuators = world.actuators(vehicle.name)
        is_limited = self.stops_thrusters or self.max_load < math.inf
        limited_thrusters = actuators.thrusters if actuators is not None and is_limited else ()
        set_losses = tuple(vehicle.loss_setter(name) for name in limited_thrusters)
        battery = Battery(self, world, actuators, set_losses)
        sampling = Sampling(battery.sampler, battery.state.sample)
        world.create_timer(
            RATE, battery.stop_thrusters, is_needed=battery.must_stop_thrusters, sampling=sampling
        )
        return battery


DRAWN_CHARGE, CURRENT, TIME = range(3)
"""The indices of `BatteryRecord.numbers`."""
BATTERY = np.dtype(
    [
        ("powers", FUNCTION),  # the function of thrusters' and joints' powers; 0: none
        ("n", np.int64),  # the number of thrusters and joints
        ("hotel_load", np.float64),  # the constant load [W]
        ("voltage", np.float64),  # the open-circuit voltage [V]
        ("resistance", np.float64),  # the internal resistance [ohm]
        ("full", np.float64),  # the charge of the full battery [A s]
        ("numbers", np.int64),  # the address of `BatteryRecord.numbers`
    ]
)
"""The parameters of a battery, for compiled code."""


@dataclass(slots=True)
class BatteryRecord(Record):
    """The state of a battery."""

    numbers: Array
    """The charge drawn so far [A s], and the current [A] and time [s] of the last sample, (3,)."""
    sample: Sample
    """The last sample of the sampler."""
    is_overloaded: bool = False
    """True if the load exceeds the greatest power of the battery."""


class Battery(Device):
    """A battery, which measures the remaining charge, and the present voltage and current."""

    def __init__(
        self,
        spec: BatterySpec,
        world: DeviceWorld,
        actuators: Actuators | None,
        set_losses: tuple[Callable[[float], None], ...],
    ) -> None:
        self._spec, self._actuators, self._set_losses = spec, actuators, set_losses
        drawn_charge = (1.0 - spec.charge) * self._full_charge
        numbers = np.array([drawn_charge, 0.0, world.time])
        powers = None if actuators is None else actuators.compiled_powers
        row = np.zeros(1, BATTERY)
        if actuators is not None and powers is not None:
            row["powers"] = powers.addresses
            row["n"] = len(actuators.thrusters) + len(actuators.joints)
        row["hotel_load"], row["voltage"] = spec.hotel_load, spec.voltage
        row["resistance"], row["full"] = spec.resistance, self._full_charge
        row["numbers"] = address_of(numbers)
        self.sampler = Sampler(
            function=function_address(integrate_current),
            parameters=row,
            n_values=0,
            prepare=prepare_nothing if powers is None else powers.prepare,
            can_skip_prepare=self._lasts_until,
            memory_owners=(powers, numbers),
        )
        """The sampler that integrates the current."""
        self.state: BatteryRecord = BatteryRecord(numbers, Sample.create(self.sampler))
        max_power = 0.0 if actuators is None else actuators.greatest_power
        self._can_overload = bool(set_losses) and spec.hotel_load + max_power > spec.max_load

    @property
    def _full_charge(self) -> float:
        """The charge of the full battery [A s]."""
        return 3600.0 * self._spec.capacity / self._spec.voltage

    def _lasts_until(self, end_time: float) -> bool:
        """Return whether the battery stops no thruster before a time [s]."""
        spec, numbers = self._spec, self.state.numbers
        if not spec.stops_thrusters:
            return True
        max_current = 0.5 * spec.voltage / spec.resistance if spec.resistance > 0.0 else math.inf
        return bool(
            numbers[DRAWN_CHARGE] + max_current * (end_time - numbers[TIME]) < self._full_charge
        )

    def stop_thrusters(self) -> None:
        """Stop the thrusters, because the battery is empty."""
        self._set_thrust_loss(1.0)

    def must_stop_thrusters(self) -> bool:
        """Return whether the battery is empty and has ``<stopsThrusters>``."""
        return bool(
            self._spec.stops_thrusters and self.state.numbers[DRAWN_CHARGE] >= self._full_charge
        )

    def idle_until(self, time: float) -> float:
        """Return ``time`` if an overload is possible, which each step checks; otherwise inf."""
        return time if self._can_overload else math.inf

    def animate(self, time: float) -> None:
        """Limit the thrusts at the end of a step to the power that the battery can deliver."""
        if self._can_overload and not self.must_stop_thrusters():
            self._limit_thrusts()

    def _limit_thrusts(self) -> None:
        """Reduce the thrusts by a common factor until the battery can deliver the power.

        If power is proportional to thrust to the power of 1.5, one iteration suffices. Measured
        polynomials need some more.
        """
        assert self._actuators is not None
        n_thrusters, factor = len(self._actuators.thrusters), 1.0
        self._set_thrust_loss(0.0)
        self.state.is_overloaded = False
        for _ in range(MAX_ITERATIONS):
            powers = self._actuators.powers().tolist()
            thruster_power = math.fsum(powers[:n_thrusters])
            joint_power = math.fsum(powers[n_thrusters:])
            available_power = self._spec.max_load - self._spec.hotel_load - joint_power
            if thruster_power - available_power <= TOLERANCE * self._spec.max_load:
                return
            self.state.is_overloaded = True
            if available_power <= 0.0 or thruster_power <= 0.0:
                self._set_thrust_loss(1.0)
                return
            factor *= (available_power / thruster_power) ** (2.0 / 3.0)
            self._set_thrust_loss(1.0 - factor)

    def _set_thrust_loss(self, loss: float) -> None:
        for set_loss in self._set_losses:
            set_loss(loss)

    def _compute_load(self) -> float:
        power = 0.0 if self._actuators is None else math.fsum(self._actuators.powers().tolist())
        return self._spec.hotel_load + power

    def sample(self, time: float) -> BatteryState:
        """Return the state of the battery at ``time`` [s], which is now."""
        load = self._compute_load()
        current = compute_current(load, self._spec.voltage, self._spec.resistance)
        remaining_charge = max(self._full_charge - float(self.state.numbers[DRAWN_CHARGE]), 0.0)
        max_load = self._spec.max_load * (1.0 + 1e-6)
        health = BatteryState.POWER_SUPPLY_HEALTH_UNKNOWN
        if remaining_charge <= 0.0:
            health = BatteryState.POWER_SUPPLY_HEALTH_DEAD
        elif self.state.is_overloaded or load > max_load:
            health = BatteryState.POWER_SUPPLY_HEALTH_UNSPEC_FAILURE
        return BatteryState(
            header=header(time, self._spec.name),
            voltage=self._spec.voltage - self._spec.resistance * current,
            temperature=math.nan,
            current=-current,
            charge=remaining_charge / 3600.0,
            capacity=self._full_charge / 3600.0,
            design_capacity=self._full_charge / 3600.0,
            percentage=remaining_charge / self._full_charge,
            power_supply_status=BatteryState.POWER_SUPPLY_STATUS_DISCHARGING,
            power_supply_health=health,
            present=True,
        )


@njit
def compute_current(load: float, voltage: float, resistance: float) -> float:
    """Return the current that a load draws [A], at most the current at the greatest power.

    Args:
        load: the power of the load [W].
        voltage: the open-circuit voltage [V].
        resistance: the internal resistance [ohm].
    """
    root = math.sqrt(max(voltage * voltage - 4.0 * resistance * load, 0.0))
    return 2.0 * load / (voltage + root) if root != 0.0 else 0.5 * voltage / resistance


def integrate_current(parameters: int, values: int, time: float) -> None:
    """Add the charge drawn since the last call, by the trapezoidal rule.

    See `uwsim.base.numerics.calls`.
    """
    battery = carray(pointer(parameters), (1,), BATTERY)[0]
    numbers, load = view_doubles(battery.numbers, 3), battery.hotel_load
    if battery.powers.function != 0:
        powers = np.empty(battery.n)
        call(battery.powers.function, battery.powers.parameters, powers.ctypes.data, time)
        load += exact_sum(powers)
    current = compute_current(load, battery.voltage, battery.resistance)
    numbers[DRAWN_CHARGE] += 0.5 * (numbers[CURRENT] + current) * (time - numbers[TIME])
    numbers[DRAWN_CHARGE] = min(numbers[DRAWN_CHARGE], battery.full)
    numbers[CURRENT], numbers[TIME] = current, time
