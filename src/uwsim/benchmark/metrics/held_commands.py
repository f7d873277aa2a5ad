r"""Commands: values held from one message to the next, and their effort and variation.

A command :math:`u_k` arrives at the time :math:`t_k` and is in force until the next. Over the
measured time it has

.. math::
    \text{variation} = \sum_k |u_k - u_{k-1}| \qquad
    \text{effort} = \int u^2\,dt = \sum_k u_k^2\,(t_{k+1} - t_k)

The first is the total variation, a measure of the use of the actuators (Skogestad, *J. Process
Control* 13, 2003, 291-309); the second is the control term of a quadratic cost (Anderson and Moore,
*Optimal Control: Linear Quadratic Methods*, 1990).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from ...messages import Float64MultiArray, JointState, Twist, TwistStamped, Wrench, WrenchStamped

Quantity = tuple[float | None, str]
"""A number, if there is one, and its unit."""
TWIST = {**dict.fromkeys(("vx", "vy", "vz"), "m/s"), **dict.fromkeys(("wx", "wy", "wz"), "rad/s")}
"""The axes of a twist and their units."""
WRENCH = {**dict.fromkeys(("fx", "fy", "fz"), "N"), **dict.fromkeys(("tx", "ty", "tz"), "N m")}
"""The axes of a wrench and their units."""
JOINTS = {"position": "rad or m", "velocity": "rad/s or m/s", "effort": "N m or N"}
"""The command modes of joints and their units; the first that a message has is used."""


@dataclass(frozen=True, kw_only=True)
class AxisValues:
    """The command in one message."""

    values: Mapping[str, float]
    """The number of each axis; axes that are absent keep theirs."""
    units: Mapping[str, str]
    """The unit of each axis."""


def read_twist(message: Twist) -> AxisValues:
    """Return a twist's six numbers."""
    v, w = message.linear, message.angular
    return AxisValues(
        values=dict(zip(TWIST, (v.x, v.y, v.z, w.x, w.y, w.z), strict=True)), units=TWIST
    )


def read_wrench(message: Wrench) -> AxisValues:
    """Return a wrench's six numbers."""
    f, t = message.force, message.torque
    return AxisValues(
        values=dict(zip(WRENCH, (f.x, f.y, f.z, t.x, t.y, t.z), strict=True)), units=WRENCH
    )


def read_thrusters(message: Float64MultiArray) -> AxisValues:
    """Return the numbers of an array, ``u0``, ``u1``, ...: shares of full command."""
    values = {f"u{i}": float(value) for i, value in enumerate(message.data)}
    return AxisValues(values=values, units=dict.fromkeys(values, "1"))


def read_joints(message: JointState) -> AxisValues:
    """Return the commands of the joints: positions, else velocities, else efforts.

    Axes have the joints' names, or ``q0``, ``q1``, ... if the message has none.
    """
    for kind, unit in JOINTS.items():
        commands = getattr(message, kind)
        if len(commands):
            names = message.name or [f"q{i}" for i in range(len(commands))]
            values = {name: float(value) for name, value in zip(names, commands, strict=False)}
            return AxisValues(values=values, units=dict.fromkeys(values, unit))
    return AxisValues(values={}, units={})


READERS: dict[type, Callable[[Any], AxisValues]] = {
    Float64MultiArray: read_thrusters,
    JointState: read_joints,
    Twist: read_twist,
    TwistStamped: lambda message: read_twist(message.twist),
    Wrench: read_wrench,
    WrenchStamped: lambda message: read_wrench(message.wrench),
}
"""The functions that read the command of each message type."""
KNOWN_AXES: dict[type, Mapping[str, str]] = {
    Twist: TWIST,
    TwistStamped: TWIST,
    Wrench: WRENCH,
    WrenchStamped: WRENCH,
}
"""The axes and units of the message types that determine them."""


@dataclass
class HeldCommand:
    """One axis of a command with its sums."""

    unit: str
    """The unit of the numbers."""
    value: float | None = None
    """The number in force; None before the first."""
    variation: float = 0.0
    """The total variation."""
    effort: float = 0.0
    """The integral of the square [unit^2 s]."""
    max: float = 0.0
    """The largest absolute value in force."""

    def change(self, value: float) -> None:
        """Apply the next number; the first adds no variation."""
        if self.value is not None:
            self.variation += abs(value - self.value)
        self.value = value
        self.update_max()

    def update_max(self) -> None:
        """Update the largest value with the number in force."""
        if self.value is not None:
            self.max = max(self.max, abs(self.value))

    def integrate(self, seconds: float) -> None:
        """Integrate the number in force over a time [s]."""
        if self.value is not None:
            self.effort += self.value * self.value * seconds


@dataclass
class HeldCommands:
    """All axes of a command, or a selection."""

    selection: tuple[str, ...] = ()
    """The axes that count; all when empty."""
    axes: dict[str, HeldCommand] = field(default_factory=dict)
    """The axes by name, in the order of their first message."""

    def expect(self, units: Mapping[str, str]) -> None:
        """Declare the axes of the messages to come."""
        for name, unit in units.items():
            if name not in self.axes and (not self.selection or name in self.selection):
                self.axes[name] = HeldCommand(unit)

    def hold(self, command: AxisValues) -> None:
        """Set the command without changing the sums."""
        self.expect(command.units)
        for name, value in command.values.items():
            if name in self.axes:
                self.axes[name].value = value

    def update_max(self) -> None:
        """Update the largest values with the command in force."""
        for axis in self.axes.values():
            axis.update_max()

    def change(self, command: AxisValues) -> None:
        """Apply the next command."""
        self.expect(command.units)
        for name, value in command.values.items():
            if name in self.axes:
                self.axes[name].change(value)

    def integrate(self, seconds: float) -> None:
        """Integrate the command in force over a time [s]."""
        for axis in self.axes.values():
            axis.integrate(seconds)

    @property
    def is_known(self) -> bool:
        """True if there is a command."""
        return any(axis.value is not None for axis in self.axes.values())

    @property
    def variation(self) -> float | None:
        """The total variation of all axes."""
        return sum(axis.variation for axis in self.axes.values()) if self.is_known else None

    @property
    def effort(self) -> float | None:
        """The effort of all axes."""
        return sum(axis.effort for axis in self.axes.values()) if self.is_known else None

    @property
    def max(self) -> float | None:
        """The largest absolute value of any axis."""
        return max(axis.max for axis in self.axes.values()) if self.is_known else None

    def total(self, name: str) -> Quantity:
        """Return ``variation``, ``effort`` or ``max`` of all axes, with its unit or units."""
        units = [axis.unit for axis in self.axes.values()]
        if name == "effort":
            return self.effort, join_units(map(effort_unit, units))
        return (self.variation if name == "variation" else self.max), join_units(units)

    def quantities(self) -> dict[str, Quantity]:
        """Return number and unit by column suffix: of all axes together, then of each."""
        quantities = {name: self.total(name) for name in ("variation", "effort", "max")}
        for name, axis in self.axes.items():
            has_value = axis.value is not None
            quantities[f"{name}.variation"] = (axis.variation if has_value else None, axis.unit)
            effort = axis.effort if has_value else None
            quantities[f"{name}.effort"] = (effort, effort_unit(axis.unit))
            quantities[f"{name}.max"] = (axis.max if has_value else None, axis.unit)
        return quantities


def join_units(units: Iterable[str]) -> str:
    """Return one unit if all are the same, else each of them; ``1`` if there is none."""
    return ", ".join(dict.fromkeys(units)) or "1"


def effort_unit(unit: str) -> str:
    """Return the unit of the integral of a square over time: ``(m/s)^2 s``."""
    if unit == "1":
        return "s"
    return f"{unit}^2 s" if unit.isalpha() else f"({unit})^2 s"
