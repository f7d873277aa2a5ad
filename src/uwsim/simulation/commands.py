"""Commands from topics to vehicles: the original's kinematics, or an autopilot.

=====================  ===========================  =============================================
interface              message                      effect
=====================  ===========================  =============================================
ROSPoseToPAT           geometry_msgs/Pose           the vehicle is put there (in L)
ROSTwistToPAT          geometry_msgs/TwistStamped   one step of the twist (in the base frame)
ROSOdomToPAT           nav_msgs/Odometry            a pose that is not all zero as ROSPoseToPAT,
                                                    else its twist as ROSTwistToPAT
ROSJointStateToArm     sensor_msgs/JointState       positions, else one step of the velocities
=====================  ===========================  =============================================

A velocity is not held: each message moves the vehicle by the time since the one before on its
interface (nothing for the first, or after more than 1 s). Joints are clamped to their limits. Time
is simulation time, where the original took the wall's. A vehicle that is simulated
(``u:dynamics``) hands a twist to its autopilot, which holds it until the next
(`uwsim.physics.autopilot`). Not modelled: that a joint command which would touch something is
refused.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from ..bus import Bus
from ..geometry import Array, Pose, rotation_from_quaternion, rotation_from_xyz
from ..messages import JointState, Odometry, Twist, TwistStamped
from ..messages import Pose as PoseMessage
from ..physics.state import State
from ..scene.ros_interfaces import (
    ROSJointStateToArmSpec,
    ROSOdomToPATSpec,
    ROSPoseToPATSpec,
    ROSTwistToPATSpec,
)
from ..scene.spec import SceneSpec
from ..scene.urdf import RobotSpec

LONGEST_GAP = 1.0
"""After a longer silence a velocity moves nothing [s]."""
Command = Callable[[], None]


class Commands:
    """What arrived for the vehicles of a scene; carried out at the start of the next step."""

    def __init__(
        self,
        scene: SceneSpec,
        robots: Sequence[RobotSpec],
        state: State,
        bus: Bus,
        timestep: float,
    ) -> None:
        self._scene, self._robots, self._state = scene, robots, state
        self._bus, self._timestep = bus, timestep
        self._waiting: list[Command] = []
        numbers = {vehicle.name: i for i, vehicle in reversed(list(enumerate(scene.vehicles)))}
        for interface in scene.ros_interfaces:
            if isinstance(
                interface,
                ROSPoseToPATSpec | ROSTwistToPATSpec | ROSOdomToPATSpec | ROSJointStateToArmSpec,
            ):
                vehicle = numbers.get(interface.vehicle_name)
                if vehicle is not None:
                    self._listen(interface, vehicle)

    def carry_out(self) -> None:
        """Move the vehicles as the messages of the last step say, in their order."""
        waiting, self._waiting = self._waiting, []
        for command in waiting:
            command()

    def _listen(
        self,
        interface: ROSPoseToPATSpec | ROSTwistToPATSpec | ROSOdomToPATSpec | ROSJointStateToArmSpec,
        vehicle: int,
    ) -> None:
        gap = _Gap(self._bus, self._timestep)

        def later(command: Command) -> None:
            self._waiting.append(command)

        if isinstance(interface, ROSPoseToPATSpec):
            self._bus.subscribe(
                interface.topic, PoseMessage, lambda m: later(lambda: self._place(vehicle, m))
            )
        elif isinstance(interface, ROSTwistToPATSpec):
            self._bus.subscribe(
                interface.topic,
                TwistStamped,
                lambda m: later(lambda: self._push(vehicle, m.twist, gap.take())),
            )
        elif isinstance(interface, ROSOdomToPATSpec):
            self._bus.subscribe(
                interface.topic,
                Odometry,
                lambda m: later(lambda: self._follow(vehicle, m, gap.take())),
            )
        else:
            self._bus.subscribe(
                interface.topic,
                JointState,
                lambda m: later(lambda: self._bend(vehicle, m, gap.take())),
            )

    def _place(self, vehicle: int, pose: PoseMessage) -> None:
        p, q = pose.position, pose.orientation
        wxyz = np.array([q.w, q.x, q.y, q.z])
        if not np.isfinite(wxyz).all() or not wxyz.any():
            wxyz = np.array([1.0, 0.0, 0.0, 0.0])
        localized_from_base = Pose(np.array([p.x, p.y, p.z]), rotation_from_quaternion(wxyz))
        self._state.place_vehicle(vehicle, self._scene.world_from_localized @ localized_from_base)

    def _push(self, vehicle: int, twist: Twist, time: float) -> None:
        v, w = twist.linear, twist.angular
        if self._state.is_simulated(vehicle):
            self._state.command(vehicle, np.array([v.x, v.y, v.z]), np.array([w.x, w.y, w.z]))
            return
        before_from_after = Pose(
            np.array([v.x, v.y, v.z]) * time,
            rotation_from_xyz(w.x * time, w.y * time, w.z * time),
        )
        self._state.place_vehicle(vehicle, self._state.vehicle_pose(vehicle) @ before_from_after)

    def _follow(self, vehicle: int, odometry: Odometry, time: float) -> None:
        pose = odometry.pose.pose
        p, q = pose.position, pose.orientation
        if any((p.x, p.y, p.z, q.x, q.y, q.z)):
            self._place(vehicle, pose)
        else:
            self._push(vehicle, odometry.twist.twist, time)

    def _bend(self, vehicle: int, message: JointState, time: float) -> None:
        joints = self._state.joints(vehicle)  # (n,) [rad or m]
        names = [joint.name for joint in self._robots[vehicle].movable]
        is_position = message.position.size > 0
        given: Array = message.position if is_position else message.velocity
        steps = np.zeros(len(joints))
        for i, value in enumerate(given.tolist()):
            if message.name and i < len(message.name):
                number = names.index(message.name[i]) if message.name[i] in names else None
            else:
                number = i if not message.name and i < len(joints) else None
            if number is None:
                continue
            if is_position:
                joints[number] = value
            else:
                steps[number] = value * time
        self._state.set_joints(vehicle, joints + steps)


class _Gap:
    """Time since the message before."""

    def __init__(self, bus: Bus, timestep: float) -> None:
        self._bus, self._timestep = bus, timestep
        self._last: int | None = None

    def take(self) -> float:
        """Return the time since the last call [s]; 0 for the first, or after a long silence."""
        now, last = self._bus.step, self._last
        self._last = now
        gap = 0.0 if last is None else (now - last) * self._timestep
        return gap if gap <= LONGEST_GAP else 0.0
