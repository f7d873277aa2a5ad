r"""Commands: values held from one message to the next, and their effort and variation.

A command :math:`u_k` arrives at the time :math:`t_k` and is in force until the next. Over the time
measured it has

.. math::
    \text{variation} = \sum_k |u_k - u_{k-1}| \qquad
    \text{effort} = \int u^2\,dt = \sum_k u_k^2\,(t_{k+1} - t_k)

The first is the total variation, how much the actuators are worked back and forth (Skogestad,
*J. Process Control* 13, 2003, 291-309); the second the control term of a quadratic cost (Anderson
and Moore, *Optimal Control: Linear Quadratic Methods*, 1990).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from ...messages import (
    Float64MultiArray,
    JointState,
    Twist,
    TwistStamped,
    Wrench,
    WrenchStamped,
)

Figure = tuple[float | None, str]
"""A number, if there is one, and its unit."""
TWIST = {**dict.fromkeys(("vx", "vy", "vz"), "m/s"), **dict.fromkeys(("wx", "wy", "wz"), "rad/s")}
"""Axes of a twist -> unit."""
WRENCH = {**dict.fromkeys(("fx", "fy", "fz"), "N"), **dict.fromkeys(("tx", "ty", "tz"), "N m")}
"""Axes of a wrench -> unit."""
JOINTS = {"position": "rad or m", "velocity": "rad/s or m/s", "effort": "N m or N"}
"""Command modes of joints and their units; the first that a message has is used."""


@dataclass(frozen=True, kw_only=True)
class AxisValues:
    """The command in one message."""

    values: Mapping[str, float]
    """Axis -> number; axes that are not in it keep theirs."""
    units: Mapping[str, str]
    """Axis -> unit."""


def twist(message: Twist) -> AxisValues:
    """Return a twist's six numbers."""
    v, w = message.linear, message.angular
    return AxisValues(
        values=dict(zip(TWIST, (v.x, v.y, v.z, w.x, w.y, w.z), strict=True)), units=TWIST
    )


def wrench(message: Wrench) -> AxisValues:
    """Return a wrench's six numbers."""
    f, t = message.force, message.torque
    return AxisValues(
        values=dict(zip(WRENCH, (f.x, f.y, f.z, t.x, t.y, t.z), strict=True)), units=WRENCH
    )


def thrusters(message: Float64MultiArray) -> AxisValues:
    """Return the numbers of an array, ``u0``, ``u1``, ...: shares of full command."""
    values = {f"u{i}": float(value) for i, value in enumerate(message.data)}
    return AxisValues(values=values, units=dict.fromkeys(values, "1"))


def joints(message: JointState) -> AxisValues:
    """Return the commands of the joints: positions, else velocities, else efforts.

    Axes have the joints' names, or ``q0``, ``q1``, ... where the message has none.
    """
    for kind, unit in JOINTS.items():
        given = getattr(message, kind)
        if len(given):
            names = message.name or [f"q{i}" for i in range(len(given))]
            values = {name: float(value) for name, value in zip(names, given, strict=False)}
            return AxisValues(values=values, units=dict.fromkeys(values, unit))
    return AxisValues(values={}, units={})


READERS: dict[type, Callable[[Any], AxisValues]] = {
    Float64MultiArray: thrusters,
    JointState: joints,
    Twist: twist,
    TwistStamped: lambda message: twist(message.twist),
    Wrench: wrench,
    WrenchStamped: lambda message: wrench(message.wrench),
}
"""Types of message that command something."""
FIXED: dict[type, Mapping[str, str]] = {
    Twist: TWIST,
    TwistStamped: TWIST,
    Wrench: WRENCH,
    WrenchStamped: WRENCH,
}
"""Types whose axes are known before a message has come -> axis -> unit."""


@dataclass
class HeldCommand:
    """One axis of a command with its sums."""

    unit: str
    """Of its numbers."""
    value: float | None = None
    """The number in force; None before the first."""
    variation: float = 0.0
    """Total variation."""
    effort: float = 0.0
    """Integral of the square [unit^2 s]."""
    largest: float = 0.0
    """The largest absolute value in force."""

    def change(self, value: float) -> None:
        """Take the next number; the first changes nothing."""
        if self.value is not None:
            self.variation += abs(value - self.value)
        self.value = value
        self.notice()

    def notice(self) -> None:
        """Count the size of the number in force."""
        if self.value is not None:
            self.largest = max(self.largest, abs(self.value))

    def last(self, seconds: float) -> None:
        """Integrate the number in force over a time [s]."""
        if self.value is not None:
            self.effort += self.value * self.value * seconds


@dataclass
class HeldCommands:
    """All axes of a command, or a selection."""

    chosen: tuple[str, ...] = ()
    """Axes that count; all when empty."""
    axes: dict[str, HeldCommand] = field(default_factory=dict)
    """By name, in the order of their first message."""

    def expect(self, units: Mapping[str, str]) -> None:
        """Declare the axes of the messages to come."""
        for name, unit in units.items():
            if name not in self.axes and (not self.chosen or name in self.chosen):
                self.axes[name] = HeldCommand(unit)

    def hold(self, command: AxisValues) -> None:
        """Set the command without changing the sums."""
        self.expect(command.units)
        for name, value in command.values.items():
            if name in self.axes:
                self.axes[name].value = value

    def notice(self) -> None:
        """Count the size of what is in force."""
        for axis in self.axes.values():
            axis.notice()

    def change(self, command: AxisValues) -> None:
        """Take the next command."""
        self.expect(command.units)
        for name, value in command.values.items():
            if name in self.axes:
                self.axes[name].change(value)

    def last(self, seconds: float) -> None:
        """Integrate the command in force over a time [s]."""
        for axis in self.axes.values():
            axis.last(seconds)

    @property
    def is_known(self) -> bool:
        """Whether there is any command yet."""
        return any(axis.value is not None for axis in self.axes.values())

    @property
    def variation(self) -> float | None:
        """Total variation of all axes."""
        return sum(axis.variation for axis in self.axes.values()) if self.is_known else None

    @property
    def effort(self) -> float | None:
        """Effort of all axes."""
        return sum(axis.effort for axis in self.axes.values()) if self.is_known else None

    @property
    def max(self) -> float | None:
        """The largest absolute value of any axis."""
        return max(axis.largest for axis in self.axes.values()) if self.is_known else None

    def total(self, name: str) -> Figure:
        """``variation``, ``effort`` or ``max`` of all axes, with its unit or units."""
        units = [axis.unit for axis in self.axes.values()]
        if name == "effort":
            return self.effort, joined(map(squared_seconds, units))
        return (self.variation if name == "variation" else self.max), joined(units)

    def figures(self) -> dict[str, Figure]:
        """Of all axes together, then of each: column suffix -> number and unit."""
        found = {name: self.total(name) for name in ("variation", "effort", "max")}
        for name, axis in self.axes.items():
            has = axis.value is not None
            found[f"{name}.variation"] = (axis.variation if has else None, axis.unit)
            found[f"{name}.effort"] = (axis.effort if has else None, squared_seconds(axis.unit))
            found[f"{name}.max"] = (axis.largest if has else None, axis.unit)
        return found


def joined(units: Iterable[str]) -> str:
    """One unit where all are the same, else each of them; ``1`` where there is none."""
    return ", ".join(dict.fromkeys(units)) or "1"


def squared_seconds(unit: str) -> str:
    """Unit of the integral of a square over time: ``(m/s)^2 s``."""
    if unit == "1":
        return "s"
    return f"{unit}^2 s" if unit.isalpha() else f"({unit})^2 s"
