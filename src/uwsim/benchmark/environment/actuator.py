"""The commands of an environment: an action becomes messages on topics."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ...base.geometry import Array
from ...errors import BadSetting, UnknownName
from ...messages import (
    Float64MultiArray,
    JointState,
    MultiArrayLayout,
    Twist,
    TwistStamped,
    Vector3,
    Wrench,
    WrenchStamped,
    header,
)
from ...world import World
from ..metrics.held_commands import TWIST_UNITS, WRENCH_UNITS
from .spec import ActionSpec, EnvironmentSpec

Make = Callable[[tuple[str, ...], Array, float], Any]
"""The function that makes a message of axes, their commands, and the time [s]."""


class Actuator:
    """The publisher of an environment's actions.

    Raises:
        UnknownName: the scene has no such topic, or its commands lack an axis.
        BadSetting: a topic has another type, or the number of commands is not known.
    """

    def __init__(self, spec: EnvironmentSpec, world: World) -> None:
        self._commands = [_Command(action, spec.vehicle, world) for action in spec.action]
        self.layout = tuple((command.topic, command.size) for command in self._commands)
        """The topic and the number of commands of each part of an action, in order."""
        self.size = sum(command.size for command in self._commands)
        """The number of numbers of an action."""

    def apply(self, action: Array) -> None:
        """Publish an action, (size,), whose numbers are commands to -1 ... 1."""
        commands = np.clip(action, -1.0, 1.0)
        start = 0
        for command in self._commands:
            command.publish(commands[start : start + command.size])
            start += command.size


class _Command:
    """The commands on one topic."""

    def __init__(self, spec: ActionSpec, vehicle: str, world: World) -> None:
        self.topic, self._world = spec.topic, world
        message_type = world.bus.message_type(spec.topic)
        if message_type is None:
            raise UnknownName("topic", spec.topic, [f"/{name}" for name in world.bus.topics])
        if message_type not in MAKERS:
            expected = ", ".join(kind.__name__ for kind in MAKERS)
            raise BadSetting(
                f"<action> is on {spec.topic!r}, which carries {message_type.__name__}; "
                f"expected one of {expected}."
            )
        known_axes = KNOWN_AXES.get(message_type)
        self._axes = tuple(spec.axes.split())
        for axis in self._axes if known_axes is not None else ():
            if axis not in (known_axes or ()):
                raise UnknownName("axis", axis, known_axes or ())
        if not self._axes and known_axes is not None:
            self._axes = tuple(known_axes)
        n_limits = len(spec.limits)
        self.size = len(self._axes) or (n_limits if n_limits > 1 else _n_thrusters(world, vehicle))
        if message_type is JointState and not self._axes:
            raise BadSetting(f"<action> on {spec.topic!r} needs <axes>: the names of the joints.")
        if n_limits > 1 and n_limits != self.size:
            raise BadSetting(
                f"<limits> of {spec.topic!r} has {n_limits} numbers; expected {self.size}."
            )
        self._limits = np.array(spec.limits) if n_limits else np.ones(1)
        self._make = MAKERS[message_type]
        self._publish: Callable[[Any], None] = world.bus.publisher(spec.topic, message_type)

    def publish(self, action: Array) -> None:
        self._publish(self._make(self._axes, action * self._limits, self._world.time))


def _n_thrusters(world: World, vehicle: str) -> int:
    """Return the number of thrusters of a vehicle."""
    actuators = world.actuators(vehicle)
    if actuators is None:
        raise BadSetting(f"{vehicle!r} is kinematic and has no thrusters; expected <u:dynamics>.")
    return len(actuators.thrusters)


def _vectors(axes: tuple[str, ...], values: Array, names: tuple[str, ...]) -> list[Vector3]:
    by_axis = dict(zip(axes, values.tolist(), strict=True))
    x, y, z, rx, ry, rz = (by_axis.get(name, 0.0) for name in names)
    return [Vector3(x=x, y=y, z=z), Vector3(x=rx, y=ry, z=rz)]


def _twist(axes: tuple[str, ...], values: Array, _: float) -> Twist:
    linear, angular = _vectors(axes, values, tuple(TWIST_UNITS))
    return Twist(linear=linear, angular=angular)


def _wrench(axes: tuple[str, ...], values: Array, _: float) -> Wrench:
    force, torque = _vectors(axes, values, tuple(WRENCH_UNITS))
    return Wrench(force=force, torque=torque)


def _thrusters(_: tuple[str, ...], values: Array, __: float) -> Float64MultiArray:
    return Float64MultiArray(layout=MultiArrayLayout(dim=[], data_offset=0), data=values.copy())


def _joints(axes: tuple[str, ...], values: Array, time: float) -> JointState:
    return JointState(
        header=header(time),
        name=list(axes),
        position=np.zeros(0),
        velocity=values.copy(),
        effort=np.zeros(0),
    )


MAKERS: dict[type, Make] = {
    Float64MultiArray: _thrusters,
    JointState: _joints,
    Twist: _twist,
    TwistStamped: lambda axes, values, time: TwistStamped(
        header=header(time), twist=_twist(axes, values, time)
    ),
    Wrench: _wrench,
    WrenchStamped: lambda axes, values, time: WrenchStamped(
        header=header(time), wrench=_wrench(axes, values, time)
    ),
}
"""The function that makes the message of each type; joints are commanded by their velocities."""
KNOWN_AXES: dict[type, tuple[str, ...]] = {
    Twist: tuple(TWIST_UNITS),
    TwistStamped: tuple(TWIST_UNITS),
    Wrench: tuple(WRENCH_UNITS),
    WrenchStamped: tuple(WRENCH_UNITS),
}
"""The axes of the types of messages that have fixed axes."""
