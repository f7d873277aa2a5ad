"""Commands from topics to vehicles: the original's kinematics, or an autopilot.

=====================  ===========================  =============================================
interface              message                      effect
=====================  ===========================  =============================================
ROSPoseToPAT           geometry_msgs/Pose           the vehicle is put there (in L)
ROSTwistToPAT          geometry_msgs/TwistStamped   one step of the twist (in the base frame)
ROSOdomToPAT           nav_msgs/Odometry            a pose that is not all zero as ROSPoseToPAT,
                                                    else its twist as ROSTwistToPAT
ROSJointStateToArm     sensor_msgs/JointState       positions, else one step of the velocities
u:ROSThrustersToPAT    std_msgs/Float64MultiArray   commands of the thrusters, simulated only
u:ROSWrenchToPAT       geometry_msgs/WrenchStamped  force and torque, simulated only
=====================  ===========================  =============================================

A velocity is not held: each message moves the vehicle by the time since the velocity before it on
its interface (nothing for the first, or after more than 1 s). Poses and positions in between do
not count, as in the original: they take no time from a velocity. Joints are clamped to their
limits. Time is simulation time, where the original took the wall's.

A vehicle that is simulated (``u:dynamics``) is never put anywhere by a message: its autopilot
(`uwsim.physics.autopilot`) takes a pose for the place to go to and stay at, and holds a twist, a
wrench or thruster commands until the next of any of them. Its joints' servos
(`uwsim.physics.servos`) take positions, else velocities, else efforts, held likewise. What is not
finite is passed over, what is beyond 1e6 taken as that; a wrong number of thruster commands is the
sender's fault, told to it when it publishes them. Not modelled: that a joint command of a vehicle
that is not simulated is refused when it would touch something.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from ..bus import Bus
from ..errors import BadMessage
from ..geometry import Array, Pose, rotation_from_quaternion, rotation_from_xyz
from ..messages import (
    Float64MultiArray,
    JointState,
    Odometry,
    Twist,
    TwistStamped,
    WrenchStamped,
)
from ..messages import Pose as PoseMessage
from ..physics.autopilot import LARGEST
from ..physics.state import State
from ..scene.ros_interfaces import (
    ROSJointStateToArmSpec,
    ROSOdomToPATSpec,
    ROSPoseToPATSpec,
    ROSThrustersToPATSpec,
    ROSTwistToPATSpec,
    ROSWrenchToPATSpec,
)
from ..scene.spec import SceneSpec
from ..scene.urdf import RobotSpec

LONGEST_GAP = 1.0
"""After a longer silence a velocity moves nothing [s]."""
Command = Callable[[], None]
CommandSpec = (
    ROSPoseToPATSpec
    | ROSTwistToPATSpec
    | ROSOdomToPATSpec
    | ROSJointStateToArmSpec
    | ROSThrustersToPATSpec
    | ROSWrenchToPATSpec
)


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
            if isinstance(interface, CommandSpec):
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
        interface: CommandSpec,
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
                lambda m: later(lambda: self._push(vehicle, m.twist, gap)),
            )
        elif isinstance(interface, ROSOdomToPATSpec):
            self._bus.subscribe(
                interface.topic,
                Odometry,
                lambda m: later(lambda: self._follow(vehicle, m, gap)),
            )
        elif isinstance(interface, ROSThrustersToPATSpec):
            self._bus.subscribe(
                interface.topic,
                Float64MultiArray,
                lambda m: later(lambda: self._thrust(vehicle, m)),
                check=lambda m: self._check_thrust(vehicle, m),
            )
        elif isinstance(interface, ROSWrenchToPATSpec):
            self._bus.subscribe(
                interface.topic, WrenchStamped, lambda m: later(lambda: self._force(vehicle, m))
            )
        else:
            self._bus.subscribe(
                interface.topic,
                JointState,
                lambda m: later(lambda: self._bend(vehicle, m, gap)),
            )

    def _place(self, vehicle: int, pose: PoseMessage) -> None:
        p, q = pose.position, pose.orientation
        wxyz = np.array([q.w, q.x, q.y, q.z])
        largest = float(np.abs(wxyz).max())
        if not 0.0 < largest < np.inf:
            wxyz, largest = np.array([1.0, 0.0, 0.0, 0.0]), 1.0
        position = np.array([p.x, p.y, p.z])
        if not np.isfinite(position).all():
            return
        localized_from_base = Pose(
            np.clip(position, -LARGEST, LARGEST), rotation_from_quaternion(wxyz / largest)
        )
        world_from_base = self._scene.world_from_localized @ localized_from_base
        if self._state.is_simulated(vehicle):
            self._state.pilot(vehicle).go_to(world_from_base)
        else:
            self._state.place_vehicle(vehicle, world_from_base)

    def _check_thrust(self, vehicle: int, message: Float64MultiArray) -> None:
        names = self._state.thrusters(vehicle)
        if message.data.shape != (len(names),):
            raise BadMessage(
                f"A message for the thrusters of {self._scene.vehicles[vehicle].name!r} has "
                f"{message.data.size} values; expected {len(names)}: {', '.join(names)}."
            )

    def _thrust(self, vehicle: int, message: Float64MultiArray) -> None:
        commands: Array = np.array(message.data, dtype=np.float64)  # (n,) [1]
        if np.isfinite(commands).all():
            self._state.pilot(vehicle).set_thrusters(commands)

    def _force(self, vehicle: int, message: WrenchStamped) -> None:
        f, t = message.wrench.force, message.wrench.torque
        force, torque = np.array([f.x, f.y, f.z]), np.array([t.x, t.y, t.z])
        if np.isfinite(force).all() and np.isfinite(torque).all():
            self._state.pilot(vehicle).push(force, torque)

    def _push(self, vehicle: int, twist: Twist, gap: _Gap) -> None:
        time = gap.take()
        v, w = twist.linear, twist.angular
        numbers = np.array([v.x, v.y, v.z, w.x, w.y, w.z])
        if not np.isfinite(numbers).all():
            return
        numbers = np.clip(numbers, -LARGEST, LARGEST)
        if self._state.is_simulated(vehicle):
            self._state.pilot(vehicle).command(numbers[:3].tolist(), numbers[3:].tolist())
            return
        step = numbers * time  # (6,) [m, rad]
        before_from_after = Pose(step[:3], rotation_from_xyz(*step[3:].tolist()))
        self._state.place_vehicle(vehicle, self._state.vehicle_pose(vehicle) @ before_from_after)

    def _follow(self, vehicle: int, odometry: Odometry, gap: _Gap) -> None:
        pose = odometry.pose.pose
        p, q = pose.position, pose.orientation
        if any((p.x, p.y, p.z, q.x, q.y, q.z)):
            self._place(vehicle, pose)
        else:
            self._push(vehicle, odometry.twist.twist, gap)

    def _bend(self, vehicle: int, message: JointState, gap: _Gap) -> None:
        if self._state.is_simulated(vehicle):
            servos = self._state.servos(vehicle)
            if message.position.size:
                servos.aim(self._numbered(vehicle, message, message.position))
            elif message.velocity.size:
                servos.drive(self._numbered(vehicle, message, message.velocity))
            else:
                servos.push(self._numbered(vehicle, message, message.effort))
            return
        joints = self._state.joints(vehicle)  # (n,) [rad or m]
        if message.position.size:
            for number, value in self._numbered(vehicle, message, message.position).items():
                joints[number] = value
        elif message.velocity.size:
            time = gap.take()
            for number, value in self._numbered(vehicle, message, message.velocity).items():
                joints[number] += value * time
        self._state.set_joints(vehicle, joints)

    def _numbered(self, vehicle: int, message: JointState, given: Array) -> dict[int, float]:
        """Values by the number of their joint; by name, or without names in order."""
        names = [joint.name for joint in self._robots[vehicle].movable]
        places = message.name or names
        return {
            names.index(name): value
            for name, value in zip(places, given.tolist(), strict=False)
            if name in names and np.isfinite(value)
        }


class _Gap:
    """Time since the velocity before."""

    def __init__(self, bus: Bus, timestep: float) -> None:
        self._bus, self._timestep = bus, timestep
        self._last: int | None = None

    def take(self) -> float:
        """Return the time since the last call [s]; 0 for the first, or after a long silence."""
        now, last = self._bus.step, self._last
        self._last = now
        gap = 0.0 if last is None else (now - last) * self._timestep
        return gap if gap <= LONGEST_GAP else 0.0
