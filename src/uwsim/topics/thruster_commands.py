"""u:ROSThrustersToPAT, u:ROSFinsToPAT, u:ROSWrenchToPAT: commands for vehicles with ``u:dynamics``.

A command to thrusters or a wrench is held until the next command of any kind; the autopilot is
inactive meanwhile. A message with a value that is not finite is ignored, values beyond 1e6 are
clamped, both with a warning. A wrong number of values raises an error in the publisher.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..base.external_values import MAX_COMMAND
from ..base.message_fields import find_invalid_number
from ..errors import BadMessage, UnknownName
from ..messages import Float64MultiArray, WrenchStamped
from ..schema import NAMESPACE, Original, element
from ..vehicle import Autopilot, Vehicle
from .interface import Interface, TopicWorld, VehicleTopicSpec

WRENCH = tuple(f"wrench.{part}.{axis}" for part in ("force", "torque") for axis in "xyz")
"""The paths of the numbers in a WrenchStamped."""


@dataclass(frozen=True, kw_only=True)
class AutopilotTopicSpec(VehicleTopicSpec):
    """An interface of a vehicle that must have ``u:dynamics``."""

    subscribes: ClassVar[bool] = True

    topic: str = element(original=Original(aliases=(f"{{{NAMESPACE}}}topic",)))
    """The name of the topic."""
    vehicle_name: str = element(original=Original(aliases=(f"{{{NAMESPACE}}}vehicleName",)))
    """The name of the vehicle; it has ``u:dynamics``."""

    def find_autopilot(self, world: TopicWorld) -> Autopilot:
        """Find the autopilot of the vehicle; raise UnknownName if it has no ``u:dynamics``."""
        autopilot = world.vehicle(self.vehicle_name).autopilot
        if autopilot is None:
            raise UnknownName("vehicle with u:dynamics", self.vehicle_name, ())
        return autopilot


@dataclass(frozen=True, kw_only=True)
class ROSThrustersToPATSpec(AutopilotTopicSpec):
    """A subscription to thruster commands for a vehicle as std_msgs/Float64MultiArray.

    One value from -1 to 1 for each thruster, in the order of the vehicle's hydrodynamics file. The
    vehicle has ``u:dynamics``; it holds a command until the next command of any kind. The autopilot
    is inactive meanwhile.
    """

    messages: ClassVar[Mapping[str, type]] = {"topic": Float64MultiArray}

    def bind(self, world: TopicWorld) -> ThrusterCommand:
        """Start to subscribe; raise UnknownName if no such vehicle has ``u:dynamics``."""
        autopilot, vehicle = self.find_autopilot(world), world.vehicle(self.vehicle_name)
        command = ThrusterCommand(autopilot, vehicle.name, vehicle.thrusters)
        world.bus.subscribe(
            self.topic,
            Float64MultiArray,
            world.defer_to_next_step(command.apply_command),
            check=command.check,
            remark=lambda m: find_invalid_number(m, ("data",), MAX_COMMAND),
        )
        return command


class ThrusterCommand(Interface):
    """The application of commands to all thrusters of a vehicle."""

    def __init__(self, autopilot: Autopilot, vehicle: str, thrusters: tuple[str, ...]) -> None:
        self._autopilot, self._vehicle, self._thrusters = autopilot, vehicle, thrusters

    def check(self, message: Float64MultiArray) -> None:
        """Raise BadMessage for a wrong number of values."""
        names = self._thrusters
        if message.data.shape != (len(names),):
            raise BadMessage(
                f"A message for the thrusters of {self._vehicle!r} has "
                f"{message.data.size} values; expected {len(names)}: {', '.join(names)}."
            )

    def apply_command(self, message: Float64MultiArray) -> None:
        """Apply one value from -1 to 1 for each thruster; ignore values that are not finite."""
        if all(map(math.isfinite, message.data.tolist())):
            self._autopilot.set_thrusters(message.data)


@dataclass(frozen=True, kw_only=True)
class ROSFinsToPATSpec(AutopilotTopicSpec):
    """A subscription to fin angles for a vehicle as std_msgs/Float64MultiArray.

    One angle for each fin [rad], in the order of the vehicle's hydrodynamics file. The vehicle has
    ``u:dynamics``; it holds the angles until the next command to the fins. Thrusters and autopilot
    keep their commands.
    """

    messages: ClassVar[Mapping[str, type]] = {"topic": Float64MultiArray}

    def bind(self, world: TopicWorld) -> FinCommand:
        """Start to subscribe; raise UnknownName if no such vehicle has ``u:dynamics``."""
        self.find_autopilot(world)
        vehicle = world.vehicle(self.vehicle_name)
        command = FinCommand(vehicle)
        world.bus.subscribe(
            self.topic,
            Float64MultiArray,
            world.defer_to_next_step(command.apply_command),
            check=command.check,
            remark=lambda m: find_invalid_number(m, ("data",), MAX_COMMAND),
        )
        return command


class FinCommand(Interface):
    """The application of commands to all fins of a vehicle."""

    def __init__(self, vehicle: Vehicle) -> None:
        self._vehicle = vehicle

    def check(self, message: Float64MultiArray) -> None:
        """Raise BadMessage for a wrong number of values."""
        names = self._vehicle.fins
        if message.data.shape != (len(names),):
            raise BadMessage(
                f"A message for the fins of {self._vehicle.name!r} has "
                f"{message.data.size} values; expected {len(names)}: {', '.join(names)}."
            )

    def apply_command(self, message: Float64MultiArray) -> None:
        """Apply one angle for each fin [rad]; ignore values that are not finite."""
        if all(map(math.isfinite, message.data.tolist())):
            self._vehicle.turn_fins(message.data)


@dataclass(frozen=True, kw_only=True)
class ROSWrenchToPATSpec(AutopilotTopicSpec):
    """A subscription to wrenches for a vehicle as geometry_msgs/WrenchStamped.

    Force and torque at the origin of the vehicle's base, in the axes of the base, which the
    thrusters produce as far as they can. The vehicle has ``u:dynamics``; it holds a wrench until
    the next command of any kind. The autopilot is inactive meanwhile.
    """

    messages: ClassVar[Mapping[str, type]] = {"topic": WrenchStamped}

    def bind(self, world: TopicWorld) -> WrenchCommand:
        """Start to subscribe; raise UnknownName if no such vehicle has ``u:dynamics``."""
        command = WrenchCommand(self.find_autopilot(world))
        world.bus.subscribe(
            self.topic,
            WrenchStamped,
            world.defer_to_next_step(command.apply_command),
            remark=lambda m: find_invalid_number(m, WRENCH, MAX_COMMAND),
        )
        return command


class WrenchCommand(Interface):
    """The application of commands for the wrench of all thrusters of a vehicle."""

    def __init__(self, autopilot: Autopilot) -> None:
        self._autopilot = autopilot

    def apply_command(self, message: WrenchStamped) -> None:
        """Apply a wrench, in the axes of the base [N, N m]; ignore one that is not finite."""
        f, t = message.wrench.force, message.wrench.torque
        force, torque = np.array([f.x, f.y, f.z]), np.array([t.x, t.y, t.z])
        if np.isfinite(force).all() and np.isfinite(torque).all():
            self._autopilot.set_wrench(force, torque)
