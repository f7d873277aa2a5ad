r"""Energy: the electrical energy that a vehicle has drawn.

.. code-block:: xml

    <u:energy>
      <name>energy</name> <target>girona500</target>
      <hotelLoad>60</hotelLoad>
      <battery unit="Wh">2000</battery>
    </u:energy>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from ...schema import Spec, element
from ...world import Actuators, World
from .measure import Measure, MeasureSpec

JOULES = {"J": 1.0, "Wh": 3600.0}
"""The size of each unit of energy [J]."""


@dataclass(frozen=True, kw_only=True)
class BatterySpec(Spec):
    """A ``<battery>`` element, with the capacity of a battery as its text."""

    capacity: float = element(text=True, exclusive_minimum=0.0)
    """The energy in the full battery, in ``unit``."""
    unit: Literal["J", "Wh"] = element(default="J", attribute=True)
    """The unit of the capacity: joules or watt hours."""

    @property
    def joules(self) -> float:
        """The capacity [J]."""
        return self.capacity * JOULES[self.unit]


@dataclass(frozen=True, kw_only=True)
class EnergySpec(MeasureSpec):
    """A ``<u:energy>`` element of a benchmark file."""

    target: str = element(refers_to="actuators")
    """The name of the vehicle. A vehicle without ``<u:dynamics>`` has no value."""
    hotel_load: float = element(default=0.0, minimum=0.0)
    """The constant power of computers, sensors and lamps [W]."""
    battery: BatterySpec | None = None
    """The battery, full when the measure starts; None: no charge is computed."""

    def bind(self, world: World) -> Energy:
        """Resolve the vehicle's thrusters and joints; raises UnknownName if it does not exist."""
        return Energy(self, world, world.actuators(self.target))


class Energy(Measure):
    r"""The integral of electrical power over the time in which the measure is active.

    .. math:: E = \int \Big( P_{hotel} + \sum_i P_i \Big)\, dt

    The sum is over the thrusters and joints i of the vehicle; the integral is computed by the
    trapezoidal rule over the simulation steps. The section ``u:energy`` of ``docs/measures.md``
    has the formulas for the power :math:`P_i` of a thruster and of a joint, whose coefficients are
    in the vehicle's hydrodynamics file. Details: the energy of all thrusters, of all joints, of the
    hotel load, of each thruster and of each joint; the mean and the highest power; and the
    remaining charge, :math:`\max(0, 1 - E/C)`, of a battery of capacity C that was full when the
    measure first started.

    A vehicle without dynamics has no forces, and so no value.
    """

    unit = "J"
    detail_units: ClassVar[dict[str, str]] = {"mean_power": "W", "peak_power": "W", "charge": "1"}

    def __init__(self, spec: EnergySpec, world: World, actuators: Actuators | None) -> None:
        self._spec, self._world, self._actuators = spec, world, actuators
        self._capacity = None if spec.battery is None else spec.battery.joules
        thrusters = () if actuators is None else actuators.thrusters
        joints = () if actuators is None else actuators.joints
        self._n_thrusters = len(thrusters)
        self._names = [f"thruster.{name}" for name in thrusters]
        self._names += [f"joint.{name}" for name in joints]
        # Plain floats: a few numbers at every step cost more as arrays.
        self._powers = [0.0] * len(self._names)  # of each consumer at the last sample [W]
        self._power = 0.0  # total at the last sample, hotel load included [W]
        self._energies = [0.0] * len(self._names)  # of each consumer [J]
        self._peak: float | None = None  # largest total [W]
        self._last_step = 0  # step of the last sample
        self._n_steps = 0  # steps over which the power was integrated

    def start(self) -> None:
        """Start counting from the energy drawn so far."""
        if self._actuators is not None:
            self._sample(self._actuators)

    def update(self) -> None:
        """Add the energy drawn since the last step."""
        if self._actuators is None:
            return
        last_powers, last_step = self._powers, self._last_step
        self._sample(self._actuators)
        steps = self._last_step - last_step
        half_duration = 0.5 * steps * self._world.timestep  # [s]
        self._energies = [
            energy + (last_power + power) * half_duration
            for energy, last_power, power in zip(
                self._energies, last_powers, self._powers, strict=True
            )
        ]
        self._n_steps += steps

    def _sample(self, actuators: Actuators) -> None:
        self._powers, self._last_step = actuators.powers().tolist(), self._world.step
        self._power = self._spec.hotel_load + sum(self._powers)
        self._peak = max(self._power, self._peak or 0.0)

    @property
    def _active_time(self) -> float:
        return self._n_steps * self._world.timestep

    @property
    def value(self) -> float | None:
        """The energy drawn so far [J]; None for a vehicle without dynamics."""
        if self._peak is None:
            return None
        return self._spec.hotel_load * self._active_time + sum(self._energies)

    @property
    def missing_reason(self) -> str | None:
        """The reason why there is no value."""
        if self._actuators is None:
            return f"the vehicle {self._spec.target!r} has no <u:dynamics>: nothing drives it"
        return super().missing_reason

    @property
    def details(self) -> dict[str, float | None]:
        """The energy of each consumer [J], the mean and highest power [W], and the charge [1]."""
        is_known = self._peak is not None
        n = self._n_thrusters
        energies = self._energies
        by_kind = (sum(energies[:n]), sum(energies[n:]), self._spec.hotel_load * self._active_time)
        return {
            **{
                name: energy if is_known else None
                for name, energy in zip(("thrusters", "joints", "hotel"), by_kind, strict=True)
            },
            "mean_power": self._mean_power,
            "peak_power": self._peak,
            "charge": self._charge,
            **{
                name: energy if is_known else None
                for name, energy in zip(self._names, energies, strict=True)
            },
        }

    @property
    def _mean_power(self) -> float | None:
        energy = self.value
        return None if energy is None or not self._n_steps else energy / self._active_time

    @property
    def _charge(self) -> float | None:
        energy = self.value
        if energy is None or self._capacity is None:
            return None
        return max(0.0, 1.0 - energy / self._capacity)

    @property
    def reasons(self) -> dict[str, str]:
        """The reasons why there is no charge, or no mean power."""
        reasons = {}
        if self._capacity is None:
            reasons["charge"] = "no <battery> is given"
        if not self._n_steps:
            reasons["mean_power"] = "it was on for one step only"
        return reasons

    @property
    def log_header(self) -> tuple[str, ...]:
        """The names of the columns energy, power and charge."""
        return ("energy [J]", "power [W]", "charge [1]")

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """The present energy, power and charge."""
        power = None if self._peak is None else self._power
        return (self.value, power, self._charge)

    @property
    def notes(self) -> tuple[str, ...]:
        """The note on an empty battery."""
        if self._charge != 0.0:
            return ()
        return (f"the battery of {self._spec.target!r} ran empty; it was drawn on all the same",)
