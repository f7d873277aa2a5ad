"""Thrusters, fins and wrenches of simulated vehicles; extensions of the dialect.

A command is held until the next of any kind; the autopilot holds nothing meanwhile. What is not
finite is passed over, what is beyond 1e6 taken as that, and both are told; a wrong number of
thruster commands is the sender's error, raised where it publishes them.
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
"""Numbers of a wrench."""


@dataclass(frozen=True, kw_only=True)
class AutopilotTopicSpec(VehicleTopicSpec):
    """An interface of a vehicle that must be simulated."""

    subscribes: ClassVar[bool] = True

    topic: str = element(original=Original(aliases=(f"{{{NAMESPACE}}}topic",)))
    """Name of the topic."""
    vehicle_name: str = element(original=Original(aliases=(f"{{{NAMESPACE}}}vehicleName",)))
    """Name of the vehicle; it has ``u:dynamics``."""

    def autopilot(self, world: TopicWorld) -> Autopilot:
        """Find the autopilot of the vehicle; raises UnknownName if it is not simulated."""
        autopilot = world.vehicle(self.vehicle_name).autopilot
        if autopilot is None:
            raise UnknownName("simulated vehicle", self.vehicle_name, ())
        return autopilot


@dataclass(frozen=True, kw_only=True)
class ROSThrustersToPATSpec(AutopilotTopicSpec):
    """Commands the thrusters of a simulated vehicle by std_msgs/Float64MultiArray.

    One value from -1 to 1 a thruster, in the order of the vehicle's hydrodynamics file; held until
    the next command of any kind. The autopilot holds nothing meanwhile.
    """

    messages: ClassVar[Mapping[str, type]] = {"topic": Float64MultiArray}

    def bind(self, world: TopicWorld) -> ThrusterCommand:
        """Listen from now on; raises UnknownName if no such vehicle is simulated."""
        autopilot, vehicle = self.autopilot(world), world.vehicle(self.vehicle_name)
        command = ThrusterCommand(autopilot, vehicle.name, vehicle.thrusters)
        world.bus.subscribe(
            self.topic,
            Float64MultiArray,
            world.at_next_step(command.obey),
            check=command.check,
            remark=lambda m: find_invalid_number(m, ("data",), MAX_COMMAND),
        )
        return command


class ThrusterCommand(Interface):
    """Sets the commands of all thrusters of a vehicle."""

    def __init__(self, autopilot: Autopilot, vehicle: str, thrusters: tuple[str, ...]) -> None:
        self._autopilot, self._vehicle, self._thrusters = autopilot, vehicle, thrusters

    def check(self, message: Float64MultiArray) -> None:
        """Refuse a wrong number of values."""
        names = self._thrusters
        if message.data.shape != (len(names),):
            raise BadMessage(
                f"A message for the thrusters of {self._vehicle!r} has "
                f"{message.data.size} values; expected {len(names)}: {', '.join(names)}."
            )

    def obey(self, message: Float64MultiArray) -> None:
        """Take one value per thruster."""
        if all(map(math.isfinite, message.data.tolist())):
            self._autopilot.set_thrusters(message.data)


@dataclass(frozen=True, kw_only=True)
class ROSFinsToPATSpec(AutopilotTopicSpec):
    """Turns the fins of a simulated vehicle by std_msgs/Float64MultiArray.

    One angle a fin, in radians, in the order of the vehicle's hydrodynamics file; held until the
    next. Thrusters and autopilot go on as they were commanded.
    """

    messages: ClassVar[Mapping[str, type]] = {"topic": Float64MultiArray}

    def bind(self, world: TopicWorld) -> FinCommand:
        """Listen from now on; raises UnknownName if no such vehicle is simulated."""
        self.autopilot(world)
        vehicle = world.vehicle(self.vehicle_name)
        command = FinCommand(vehicle)
        world.bus.subscribe(
            self.topic,
            Float64MultiArray,
            world.at_next_step(command.obey),
            check=command.check,
            remark=lambda m: find_invalid_number(m, ("data",), MAX_COMMAND),
        )
        return command


class FinCommand(Interface):
    """Turns all fins of a vehicle."""

    def __init__(self, vehicle: Vehicle) -> None:
        self._vehicle = vehicle

    def check(self, message: Float64MultiArray) -> None:
        """Refuse a wrong number of values."""
        names = self._vehicle.fins
        if message.data.shape != (len(names),):
            raise BadMessage(
                f"A message for the fins of {self._vehicle.name!r} has "
                f"{message.data.size} values; expected {len(names)}: {', '.join(names)}."
            )

    def obey(self, message: Float64MultiArray) -> None:
        """Take one angle per fin."""
        if all(map(math.isfinite, message.data.tolist())):
            self._vehicle.turn_fins(message.data)


@dataclass(frozen=True, kw_only=True)
class ROSWrenchToPATSpec(AutopilotTopicSpec):
    """Pushes a simulated vehicle with its thrusters by geometry_msgs/WrenchStamped.

    Force and torque at the origin of its base, in its axes, as far as the thrusters reach; held
    until the next command of any kind. The autopilot holds nothing meanwhile.
    """

    messages: ClassVar[Mapping[str, type]] = {"topic": WrenchStamped}

    def bind(self, world: TopicWorld) -> WrenchCommand:
        """Listen from now on; raises UnknownName if no such vehicle is simulated."""
        command = WrenchCommand(self.autopilot(world))
        world.bus.subscribe(
            self.topic,
            WrenchStamped,
            world.at_next_step(command.obey),
            remark=lambda m: find_invalid_number(m, WRENCH, MAX_COMMAND),
        )
        return command


class WrenchCommand(Interface):
    """Applies a wrench to a vehicle by its thrusters."""

    def __init__(self, autopilot: Autopilot) -> None:
        self._autopilot = autopilot

    def obey(self, message: WrenchStamped) -> None:
        """Take a wrench in the base's axes."""
        f, t = message.wrench.force, message.wrench.torque
        force, torque = np.array([f.x, f.y, f.z]), np.array([t.x, t.y, t.z])
        if np.isfinite(force).all() and np.isfinite(torque).all():
            self._autopilot.push(force, torque)
