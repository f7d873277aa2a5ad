r"""A vehicle that follows the poses of a real vehicle, so that virtual sensors observe from there.

.. code-block:: xml

    <vehicle> ...
      <u:followPose>
        <u:topic>/odom</u:topic> <u:type>odometry</u:type> <u:axes>enu</u:axes>
        <u:delay>0.04</u:delay> <u:horizon>0.3</u:horizon>
        <u:timeout>0.5</u:timeout> <u:onTimeout>stop</u:onTimeout>
      </u:followPose>
    </vehicle>

The poses arrive on a topic (nav_msgs/Odometry, geometry_msgs/PoseStamped) or, with
``<u:mavlinkPort>``, as MAVLink messages by UDP. `uwsim.devices.motion.pose_filter` checks them and
predicts the present pose. At each step the vehicle is placed there; neither forces nor commands
move it. While poses are stale the vehicle keeps its last predicted pose; with ``stop`` the sensors
of the scene publish nothing.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ...autopilots.mavlink.vehicle_pose import PoseReader, PoseReaderState
from ...base.external_values import EXPECTED_POSE, read_pose
from ...base.geometry import Pose
from ...base.numerics.linear import rotate_back
from ...base.record import Record
from ...base.terminal import report
from ...bus import Remark
from ...errors import BadSetting
from ...messages import Odometry, PoseStamped, seconds
from ...messages import Pose as PoseMessage
from ...schema import element
from ...world import DeviceWorld
from ..device import Device, DeviceSpec, DeviceTopic, DeviceVehicle
from .pose_filter import FilterSettings, MeasuredPose, PoseFilter, PoseFilterState, format_report
from .prescribed_vehicle import PrescribedVehicle, move_vehicle

Axes = Literal["localized", "enu", "ned"]
"""The axes of poses: ``localized`` those of the scene file and of the model's base; ``enu`` those
of REP 103; ``ned`` north, east, down with a body forward, right, down."""
NED_FROM_ENU = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
"""The rotation from east, north, up to north, east, down; it is its own inverse."""
FLIP = np.diag([1.0, -1.0, -1.0])
"""The rotation between forward, left, up and forward, right, down."""
EXPECTED = f"{EXPECTED_POSE}; it is left out"


@dataclass(frozen=True, kw_only=True)
class FollowPoseSpec(DeviceSpec):
    """A ``<u:followPose>``: the vehicle follows poses that arrive while the scene runs."""

    topic: str = element(namespaced=True, default="")
    """The topic of the poses."""
    type: Literal["odometry", "pose"] = element(namespaced=True, default="odometry")
    """The type of the messages: nav_msgs/Odometry or geometry_msgs/PoseStamped."""
    mavlink_port: int | None = element(namespaced=True, default=None, minimum=1, maximum=65535)
    """The UDP port of MAVLink messages, instead of the topic."""
    axes: Axes = element(namespaced=True, default="localized")
    """The axes of the poses; MAVLink has ``ned``."""
    delay: float = element(namespaced=True, default=0.0, minimum=0.0, maximum=10.0)
    """The time between the measurement of a pose and its arrival, over which it is predicted
    [s]."""
    horizon: float = element(namespaced=True, default=0.3, minimum=0.0, maximum=10.0)
    """The longest time over which a pose is predicted [s]."""
    timeout: float = element(namespaced=True, default=0.5, exclusive_minimum=0.0)
    """The time without a pose after which the last one is stale [s]."""
    on_timeout: Literal["hold", "stop"] = element(namespaced=True, default="hold")
    """The sensors of the scene while poses are stale: ``hold`` continues at the last pose,
    ``stop`` publishes nothing."""
    max_speed: float = element(namespaced=True, default=10.0, exclusive_minimum=0.0)
    """The greatest speed of the vehicle; poses farther away are left out [m/s]."""

    @property
    def topics(self) -> tuple[DeviceTopic, ...]:
        """The topic of the poses."""
        if not self.topic:
            return ()
        message_type = Odometry if self.type == "odometry" else PoseStamped
        return (DeviceTopic(name=self.topic, is_subscribed=True, message_type=message_type),)

    def describe_source_error(self) -> str | None:
        """Return the error of a missing or ambiguous source of poses; None if there is one."""
        if bool(self.topic) is not (self.mavlink_port is not None):
            return None
        content = "a topic and a port" if self.topic else "neither a topic nor a port"
        return f"<u:followPose> has {content}; expected <u:topic> or <u:mavlinkPort>"

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> PoseFollower:
        """Subscribe to the topic, or open the port; raise BadSetting if there is neither."""
        if (error := self.describe_source_error()) is not None:
            raise BadSetting(f"{error}.")
        assert isinstance(vehicle, PrescribedVehicle)
        follower = PoseFollower(self, vehicle, world)
        if self.topic and self.type == "odometry":
            world.bus.subscribe(
                self.topic, Odometry, follower.receive_odometry, remark=_check_odometry
            )
        elif self.topic:
            world.bus.subscribe(self.topic, PoseStamped, follower.receive_pose, remark=_check_pose)
        return follower


@dataclass(slots=True)
class PoseFollowerState(Record):
    """The state of a vehicle that follows poses."""

    filter: PoseFilterState
    """The state of the filter of the poses."""
    has_begun: bool = False
    """True if the vehicle has been placed at a pose."""
    mavlink: PoseReaderState | None = None
    """The state of the reader of MAVLink messages; None without a port."""
    n_reported_bytes: int = 0
    """The number of bytes of no message when they were last reported."""


class PoseFollower(Device):
    """A vehicle that is placed at the predicted pose of a real vehicle at each step.

    Args:
        spec: the spec.
        vehicle: the vehicle.
        world: the view of the scene.
    """

    def __init__(
        self, spec: FollowPoseSpec, vehicle: PrescribedVehicle, world: DeviceWorld
    ) -> None:
        self.spec = spec
        """The spec."""
        self._vehicle, self._world = vehicle, world
        is_down = vehicle.world_from_base.rotation[2, 2] < 0.0
        self._world_from_axes, self._body_from_base = _find_axes(
            "ned" if spec.mavlink_port is not None else spec.axes,
            world.world_from_localized,
            is_down=is_down,
        )
        settings = FilterSettings(
            delay=spec.delay,
            horizon=spec.horizon,
            timeout=spec.timeout,
            max_speed=spec.max_speed,
        )
        self._filter = PoseFilter(settings)
        self.state: PoseFollowerState = PoseFollowerState(self._filter.state)
        self._receive: Callable[[], Sequence[bytes]] | None = None
        if spec.mavlink_port is not None:
            self._receive, self._reader = world.datagrams(spec.mavlink_port), PoseReader()
            self.state.mavlink = self._reader.state

    @property
    def is_stale(self) -> bool:
        """True if no pose has arrived for longer than the timeout."""
        return self._filter.is_stale(self._world.time)

    @property
    def report(self) -> list[str]:
        """The lines of the report about the received poses."""
        lines = format_report(self._vehicle.name, self.state.filter)
        if self.state.mavlink is not None:
            reader = self.state.mavlink.stream
            lines.append(
                f"{self._vehicle.name}: {reader.n_messages} MAVLink messages; "
                f"{reader.n_invalid_bytes} bytes of no message, or too many to read"
            )
        return lines

    def receive_odometry(self, message: Odometry) -> None:
        """Store the pose and the twist of a message; an invalid pose is counted."""
        twist = message.twist.twist
        v, w = twist.linear, twist.angular
        numbers = tuple(float(x) for x in (v.x, v.y, v.z, w.x, w.y, w.z))
        # many publishers leave the twist zero, which is no measurement
        has_twist = any(numbers) and all(map(math.isfinite, numbers))
        self._accept(message.pose.pose, seconds(message.header.stamp), numbers if has_twist else ())

    def receive_pose(self, message: PoseStamped) -> None:
        """Store the pose of a message; an invalid pose is counted."""
        self._accept(message.pose, seconds(message.header.stamp))

    def _accept(self, message: PoseMessage, stamp: float, twist: tuple[float, ...] = ()) -> None:
        pose = read_pose(message)
        if pose is None:
            self._filter.reject_invalid()
            return
        self._store(pose, stamp or None, twist)

    def _store(self, pose: Pose, stamp: float | None, twist: tuple[float, ...]) -> None:
        base_twist = None
        if twist:
            turn = self._body_from_base.rotation
            linear = rotate_back(turn, np.array(twist[:3]))
            angular = rotate_back(turn, np.array(twist[3:]))
            base_twist = (*linear.tolist(), *angular.tolist())
        world_from_base = self._world_from_axes @ pose @ self._body_from_base
        self._filter.accept(MeasuredPose(world_from_base, self._world.time, stamp, base_twist))

    def step(self, time: float) -> None:
        """Read the MAVLink messages that have arrived."""
        if self._receive is None:
            return
        for pose in self._reader.read(self._receive()):
            if pose is None:
                self._filter.reject_invalid()
            else:
                self._store(
                    Pose.from_quaternion(np.array(pose.position), np.array(pose.quaternion)),
                    pose.time,
                    pose.twist,
                )
        self._report_invalid_bytes()

    def _report_invalid_bytes(self) -> None:
        """Report the first bytes of no message, and whenever there are ten times as many."""
        assert self.state.mavlink is not None
        n_bytes = self.state.mavlink.stream.n_invalid_bytes
        if n_bytes > 10 * self.state.n_reported_bytes:
            self.state.n_reported_bytes = n_bytes
            port = self.spec.mavlink_port
            report(
                f"{self._vehicle.name}: {n_bytes} bytes at UDP port {port} are no MAVLink; they "
                "are skipped"
            )

    def animate(self, time: float) -> None:
        """Place the vehicle at its predicted pose at a time [s]."""
        pose = self._filter.predict(time)
        if pose is None:
            return
        filter_state = self.state.filter
        is_start = filter_state.has_relocated or not self.state.has_begun
        move_vehicle(self._vehicle, pose, is_start=is_start)
        filter_state.has_relocated, self.state.has_begun = False, True


def _find_axes(axes: Axes, world_from_localized: Pose, *, is_down: bool) -> tuple[Pose, Pose]:
    """Return the pose in W of the frame of poses, and that of the base in their body frame."""
    identity = Pose.identity()
    if axes == "localized":
        return world_from_localized, identity
    flip = Pose(np.zeros(3), FLIP)
    if axes == "enu":
        return identity, flip if is_down else identity
    return Pose(np.zeros(3), NED_FROM_ENU), identity if is_down else flip


def _check_odometry(message: Odometry) -> Remark | None:
    return None if read_pose(message.pose.pose) is not None else ("the pose is invalid", EXPECTED)


def _check_pose(message: PoseStamped) -> Remark | None:
    return None if read_pose(message.pose) is not None else ("the pose is invalid", EXPECTED)
