r"""Held commands: the effort and variation of commands that stay in force until the next one.

A command :math:`u_k` arrives at the time :math:`t_k` and is in force until :math:`t_{k+1}`. Over
the measured time

.. math::
    \text{variation} = \sum_k |u_k - u_{k-1}| \qquad
    \text{effort} = \int u^2\,dt = \sum_k u_k^2\,(t_{k+1} - t_k)

The total variation measures the use of the actuators (Skogestad, *J. Process Control* 13, 2003,
291-309). The effort is the control term of a quadratic cost (Anderson and Moore, *Optimal Control:
Linear Quadratic Methods*, 1990).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from ...messages import Float64MultiArray, JointState, Twist, TwistStamped, Wrench, WrenchStamped

Quantity = tuple[float | None, str]
"""A value, or None without commands, and its unit."""
TWIST_UNITS = {
    **dict.fromkeys(("vx", "vy", "vz"), "m/s"),
    **dict.fromkeys(("wx", "wy", "wz"), "rad/s"),
}
"""The axes of a twist and their units."""
WRENCH_UNITS = {
    **dict.fromkeys(("fx", "fy", "fz"), "N"),
    **dict.fromkeys(("tx", "ty", "tz"), "N m"),
}
"""The axes of a wrench and their units."""
JOINT_UNITS = {"position": "rad or m", "velocity": "rad/s or m/s", "effort": "N m or N"}
"""The command fields of a JointState and their units; the first that is not empty is used."""


@dataclass(frozen=True, kw_only=True)
class AxisValues:
    """The command in one message."""

    values: Mapping[str, float]
    """The value of each axis in the message; axes that are absent keep their values."""
    units: Mapping[str, str]
    """The unit of each axis."""


def read_twist(message: Twist) -> AxisValues:
    """Return the six components of a twist."""
    v, w = message.linear, message.angular
    return AxisValues(
        values=dict(zip(TWIST_UNITS, (v.x, v.y, v.z, w.x, w.y, w.z), strict=True)),
        units=TWIST_UNITS,
    )


def read_wrench(message: Wrench) -> AxisValues:
    """Return the six components of a wrench."""
    f, t = message.force, message.torque
    return AxisValues(
        values=dict(zip(WRENCH_UNITS, (f.x, f.y, f.z, t.x, t.y, t.z), strict=True)),
        units=WRENCH_UNITS,
    )


def read_thrusters(message: Float64MultiArray) -> AxisValues:
    """Return the thruster commands ``u0``, ``u1``, ..., as shares of the full command."""
    values = {f"u{i}": float(value) for i, value in enumerate(message.data)}
    return AxisValues(values=values, units=dict.fromkeys(values, "1"))


def read_joints(message: JointState) -> AxisValues:
    """Return the commands of the joints: positions, or else velocities, or else efforts.

    Axes have the names of the joints, or ``q0``, ``q1``, ... if the message has no names.
    """
    for kind, unit in JOINT_UNITS.items():
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
"""The function that reads the command in a message of each type."""
KNOWN_AXES: dict[type, Mapping[str, str]] = {
    Twist: TWIST_UNITS,
    TwistStamped: TWIST_UNITS,
    Wrench: WRENCH_UNITS,
    WrenchStamped: WRENCH_UNITS,
}
"""The axes and units of the message types that have fixed axes."""


@dataclass
class HeldCommand:
    """The command of one axis: its present value, and its variation and effort so far."""

    unit: str
    """The unit of the value."""
    value: float | None = None
    """The value in force; None before the first command."""
    variation: float = 0.0
    """The total variation [unit]."""
    effort: float = 0.0
    """The integral of the squared value [unit^2 s]."""
    max: float = 0.0
    """The largest absolute value that was in force [unit]."""

    def change(self, value: float) -> None:
        """Set the next value; the first value adds no variation."""
        if self.value is not None:
            self.variation += abs(value - self.value)
        self.value = value
        self.update_max()

    def update_max(self) -> None:
        """Update the largest absolute value with the value in force."""
        if self.value is not None:
            self.max = max(self.max, abs(self.value))

    def integrate(self, seconds: float) -> None:
        """Add the effort of the value in force over a time [s]."""
        if self.value is not None:
            self.effort += self.value * self.value * seconds


@dataclass
class HeldCommands:
    """The commands of all axes, or of selected axes."""

    selection: tuple[str, ...] = ()
    """The names of the selected axes; empty for all axes."""
    axes: dict[str, HeldCommand] = field(default_factory=dict)
    """The axes by name, in the order in which messages first have them."""

    def expect(self, units: Mapping[str, str]) -> None:
        """Add the axes with these names and units, unless they exist or are not selected."""
        for name, unit in units.items():
            if name not in self.axes and (not self.selection or name in self.selection):
                self.axes[name] = HeldCommand(unit)

    def hold(self, command: AxisValues) -> None:
        """Set the command without changing variation, effort or largest value."""
        self.expect(command.units)
        for name, value in command.values.items():
            if name in self.axes:
                self.axes[name].value = value

    def update_max(self) -> None:
        """Update the largest value of each axis with the command in force."""
        for axis in self.axes.values():
            axis.update_max()

    def change(self, command: AxisValues) -> None:
        """Set the next command, and update variation and largest value."""
        self.expect(command.units)
        for name, value in command.values.items():
            if name in self.axes:
                self.axes[name].change(value)

    def integrate(self, seconds: float) -> None:
        """Add the effort of the command in force over a time [s]."""
        for axis in self.axes.values():
            axis.integrate(seconds)

    @property
    def is_known(self) -> bool:
        """True if a command is in force on any of these axes."""
        return any(axis.value is not None for axis in self.axes.values())

    @property
    def variation(self) -> float | None:
        """The sum of the variations of all axes."""
        return sum(axis.variation for axis in self.axes.values()) if self.is_known else None

    @property
    def effort(self) -> float | None:
        """The sum of the efforts of all axes."""
        return sum(axis.effort for axis in self.axes.values()) if self.is_known else None

    @property
    def max(self) -> float | None:
        """The largest absolute value on any axis."""
        return max(axis.max for axis in self.axes.values()) if self.is_known else None

    def total(self, name: str) -> Quantity:
        """Return ``variation``, ``effort`` or ``max`` over all axes, with its unit or units."""
        units = [axis.unit for axis in self.axes.values()]
        if name == "effort":
            return self.effort, join_units(map(effort_unit, units))
        return (self.variation if name == "variation" else self.max), join_units(units)

    def quantities(self) -> dict[str, Quantity]:
        """Return all quantities by column suffix: first over all axes, then of each axis."""
        quantities = {name: self.total(name) for name in ("variation", "effort", "max")}
        for name, axis in self.axes.items():
            has_value = axis.value is not None
            quantities[f"{name}.variation"] = (axis.variation if has_value else None, axis.unit)
            effort = axis.effort if has_value else None
            quantities[f"{name}.effort"] = (effort, effort_unit(axis.unit))
            quantities[f"{name}.max"] = (axis.max if has_value else None, axis.unit)
        return quantities


def join_units(units: Iterable[str]) -> str:
    """Return the different units, separated by commas; ``1`` if there is none."""
    return ", ".join(dict.fromkeys(units)) or "1"


def effort_unit(unit: str) -> str:
    """Return the unit of an effort, the integral of a square over time: ``(m/s)^2 s``."""
    if unit == "1":
        return "s"
    return f"{unit}^2 s" if unit.isalpha() else f"({unit})^2 s"
