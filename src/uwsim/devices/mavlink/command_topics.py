"""The topics by which programs command an autopilot, and by which it reports."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from ...autopilots.mavlink import Message, commands
from ...autopilots.mavlink.commands import Sticks, Target
from ...autopilots.mavlink.modes import SUB_MODES, mode_number, modes_of
from ...autopilots.mavlink.status import AutopilotStatus
from ...base.geometry import rotation_from_quaternion
from ...base.numerics.linear import length, product
from ...base.record import Record
from ...bus import Bus, Remark
from ...errors import BadSetting
from ...messages import Bool, Float64MultiArray, PoseStamped, String, TwistStamped
from ..device import DeviceTopic
from .axes import HomeFrame

STICK_NAMES = ("surge", "sway", "heave", "yaw", "pitch", "roll")
"""The numbers of a message of sticks, in their order; missing ones are 0."""
SETPOINT_TIMEOUT = 0.5
"""The age up to which a velocity belongs to a position that follows it [s]."""
COMMANDS: Mapping[str, type] = {
    "arm": Bool,
    "mode": String,
    "sticks": Float64MultiArray,
    "setpoint_position": PoseStamped,
    "setpoint_velocity": TwistStamped,
}
"""The last part of the name, and the type, of each topic to which the device subscribes."""
REPORTS: Mapping[str, type] = {
    "is_armed": Bool,
    "flight_mode": String,
    "status_text": String,
    "estimate": PoseStamped,
}
"""The last part of the name, and the type, of each topic on which the device publishes."""


def command_topics(name: str) -> tuple[DeviceTopic, ...]:
    """Return the topics of a device of a name."""
    return (
        *(
            DeviceTopic(name=f"{name}/{part}", is_subscribed=True, message_type=type_)
            for part, type_ in COMMANDS.items()
        ),
        *(
            DeviceTopic(name=f"{name}/{part}", message_type=type_)
            for part, type_ in REPORTS.items()
        ),
    )


@dataclass(slots=True)
class CommandState(Record):
    """The commands that are repeated or combined."""

    sticks: tuple[float, ...] = ()
    """The last positions of the sticks, (6,) [1]; empty before the first."""
    velocity: tuple[float, ...] = ()
    """The last velocity, north, east, down (3,) [m/s]; empty before the first."""
    velocity_time: float = -math.inf
    """The time of that velocity [s]."""


class CommandTopics:
    """The commands of programs as messages for the autopilot.

    Args:
        bus: the topics.
        name: the name of the device, with which its topics begin.
        home: the frame of the autopilot's local positions.
        status: the status of the autopilot.
        clock: the function that returns the simulation time [s].
        send: the function that sends a message.
    """

    def __init__(
        self,
        bus: Bus,
        name: str,
        *,
        home: HomeFrame,
        status: AutopilotStatus,
        clock: Callable[[], float],
        send: Callable[[Message], None],
    ) -> None:
        self._home = home
        self._status, self._clock, self._send = status, clock, send
        self.state = CommandState()
        """The commands that are repeated or combined."""
        bus.subscribe(f"{name}/arm", Bool, self._arm)
        bus.subscribe(f"{name}/mode", String, self._set_mode, remark=check_mode)
        bus.subscribe(f"{name}/sticks", Float64MultiArray, self._set_sticks, remark=check_sticks)
        bus.subscribe(f"{name}/setpoint_position", PoseStamped, self._set_position)
        bus.subscribe(f"{name}/setpoint_velocity", TwistStamped, self._set_velocity)

    @property
    def target(self) -> Target:
        """The autopilot; system 1 before its first heartbeat."""
        return Target(self._status.system or 1)

    def send_sticks(self) -> None:
        """Send the last positions of the sticks; nothing before the first."""
        if self.state.sticks:
            surge, sway, heave, yaw, pitch, roll = self.state.sticks
            sticks = Sticks(surge=surge, sway=sway, heave=heave, yaw=yaw, pitch=pitch, roll=roll)
            self._send(commands.manual_control(self.target, sticks))

    def _arm(self, message: Bool) -> None:
        self._send(commands.arm(self.target, message.data))

    def _set_mode(self, message: String) -> None:
        modes = modes_of(self._status.vehicle_type)
        number = modes.get(message.data.strip().upper())
        if number is not None:
            self._send(commands.set_mode(self.target, number))

    def _set_sticks(self, message: Float64MultiArray) -> None:
        if check_sticks(message) is not None:
            return
        values = np.zeros(len(STICK_NAMES))
        values[: len(message.data)] = np.clip(message.data, -1.0, 1.0)
        self.state.sticks = tuple(values.tolist())
        self.send_sticks()

    def _set_position(self, message: PoseStamped) -> None:
        """Send a position and heading, and the velocity if one came just before."""
        pose, state = message.pose, self.state
        point = np.array([pose.position.x, pose.position.y, pose.position.z])
        q = pose.orientation
        quaternion = np.array([q.w, q.x, q.y, q.z])
        if not np.isfinite([*point, *quaternion]).all():
            return
        yaw = None
        if length(quaternion) > 0.5:
            bow = rotation_from_quaternion(quaternion / length(quaternion))[:, 0]
            north, east, _ = product(self._home.ned_from_localized, bow).tolist()
            yaw = math.atan2(east, north)
        time = self._clock()
        has_velocity = state.velocity and time - state.velocity_time <= SETPOINT_TIMEOUT
        self._send(
            commands.local_target(
                self.target,
                time,
                position=self._home.position(point).tolist(),
                velocity=state.velocity if has_velocity else None,
                yaw=yaw,
            )
        )

    def _set_velocity(self, message: TwistStamped) -> None:
        """Store a velocity in the axes of L for the position that follows it."""
        linear = message.twist.linear
        velocity = product(self._home.ned_from_localized, (linear.x, linear.y, linear.z))
        if np.isfinite(velocity).all():
            self.state.velocity = tuple(velocity.tolist())
            self.state.velocity_time = self._clock()


def check_mode(message: String) -> Remark | None:
    """Report a mode that neither ArduSub nor ArduRover has."""
    try:
        mode_number(message.data)
    except BadSetting:
        if message.data.strip().upper() not in modes_of(11):
            return f"data is {message.data[:40]!r}", f"{', '.join(SUB_MODES)}; it is ignored"
    return None


def check_sticks(message: Float64MultiArray) -> Remark | None:
    """Report positions of sticks that are too many, or not finite."""
    values = np.asarray(message.data, dtype=np.float64)
    if values.ndim != 1 or len(values) > len(STICK_NAMES) or not np.isfinite(values).all():
        return (
            f"data has {values.size} numbers, or some are not finite",
            f"{', '.join(STICK_NAMES)}, -1 to 1; it is ignored",
        )
    return None
