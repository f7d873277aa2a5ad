"""Poses, joints and contacts on topics, at a rate.

=====================  =======================  =================================================
interface              message                  what is in it
=====================  =======================  =================================================
PATToROSOdom           nav_msgs/Odometry        the base in L; of a simulated vehicle also its
                                                twist over ground, base axes
ArmToROSJointState     sensor_msgs/JointState   the joint vector; of a simulated vehicle also the
                                                joints' velocities and efforts
contactSensorToROS     std_msgs/Bool            whether a vehicle or object touches another
=====================  =======================  =================================================

As in the original the frames have no name, the covariances are zero, the twist of a vehicle that
is not simulated is zero, its velocities are missing and its efforts are zero.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

import numpy as np

from ..bus import Bus
from ..errors import UwsimError
from ..geometry import quaternion_from_rotation
from ..messages import (
    Bool,
    JointState,
    Odometry,
    Point,
    Pose,
    PoseWithCovariance,
    Quaternion,
    Twist,
    TwistWithCovariance,
    Vector3,
    header,
)
from ..physics.state import State
from ..scene.ros_interfaces import ArmToROSJointStateSpec, ContactSensorToROSSpec, PATToROSOdomSpec
from ..scene.spec import SceneSpec
from ..scene.urdf import RobotSpec
from .bodies import touchable
from .touch import Touch


class OdometryPublisher:
    """One ``<PATToROSOdom>`` at work."""

    def __init__(
        self, spec: PATToROSOdomSpec, scene: SceneSpec, vehicle: int, state: State, bus: Bus
    ) -> None:
        self._vehicle, self._state = vehicle, state
        self._localized_from_world = scene.world_from_localized.inverse()
        self._publish = bus.publisher(spec.topic, Odometry)

    def publish(self, time: float) -> None:
        """Publish the state at ``time`` [s]."""
        pose = self._localized_from_world @ self._state.vehicle_pose(self._vehicle)
        w, x, y, z = quaternion_from_rotation(pose.rotation).tolist()
        px, py, pz = pose.position.tolist()
        is_simulated = self._state.is_simulated(self._vehicle)
        twist = self._state.vehicle_velocity(self._vehicle) if is_simulated else np.zeros(6)
        vx, vy, vz, wx, wy, wz = twist.tolist()
        self._publish(
            Odometry(
                header=header(time),
                child_frame_id="",
                pose=PoseWithCovariance(
                    pose=Pose(
                        position=Point(x=px, y=py, z=pz),
                        orientation=Quaternion(x=x, y=y, z=z, w=w),
                    ),
                    covariance=np.zeros(36),
                ),
                twist=TwistWithCovariance(
                    twist=Twist(
                        linear=Vector3(x=vx, y=vy, z=vz), angular=Vector3(x=wx, y=wy, z=wz)
                    ),
                    covariance=np.zeros(36),
                ),
            )
        )


class JointPublisher:
    """One ``<ArmToROSJointState>`` at work."""

    def __init__(
        self,
        spec: ArmToROSJointStateSpec,
        robot: RobotSpec,
        vehicle: int,
        state: State,
        bus: Bus,
    ) -> None:
        self._vehicle, self._state = vehicle, state
        self._names = [joint.name for joint in robot.movable]
        self._publish = bus.publisher(spec.topic, JointState)

    def publish(self, time: float) -> None:
        """Publish the state at ``time`` [s]."""
        velocity, effort = np.zeros(0), np.zeros(len(self._names))
        if self._state.is_simulated(self._vehicle):
            servos = self._state.servos(self._vehicle)
            velocity, effort = servos.velocities, servos.efforts
        self._publish(
            JointState(
                header=header(time),
                name=list(self._names),
                position=self._state.joints(self._vehicle),
                velocity=velocity,
                effort=effort,
            )
        )


class ContactPublisher:
    """One ``<contactSensorToROS>`` at work."""

    def __init__(self, spec: ContactSensorToROSSpec, touch: Touch, bus: Bus) -> None:
        self._name, self._topic, self._touch, self._bus = spec.name, spec.topic, touch, bus
        self._publish = bus.publisher(spec.topic, Bool)

    def publish(self, time: float) -> None:
        """Publish whether it touches anything, if somebody reads it; the message has no time."""
        if self._bus.has_readers(self._topic):
            self._publish(Bool(data=bool(self._touch.contacts(self._name))))


def state_publishers(
    scene: SceneSpec,
    robots: Mapping[int, RobotSpec],
    state: State,
    touch: Touch,
    bus: Bus,
    clock: Callable[[], float],
) -> list[tuple[int, Callable[[], None]]]:
    """What publishes poses and joints: rate [Hz] and what to call, in the scene's order."""
    numbers = {vehicle.name: i for i, vehicle in reversed(list(enumerate(scene.vehicles)))}
    found: list[tuple[int, Callable[[], None]]] = []
    for interface in scene.ros_interfaces:
        if isinstance(interface, ContactSensorToROSSpec) and _can_touch(interface, scene, robots):
            contact = ContactPublisher(interface, touch, bus)
            found.append((interface.rate, partial(_at, clock, contact.publish)))
        if not isinstance(interface, PATToROSOdomSpec | ArmToROSJointStateSpec):
            continue
        vehicle = numbers.get(interface.vehicle_name)
        if vehicle is None:  # left out, as in the original; `uwsim check` says so
            continue
        if isinstance(interface, PATToROSOdomSpec):
            publish = OdometryPublisher(interface, scene, vehicle, state, bus).publish
        else:
            publish = JointPublisher(interface, robots[vehicle], vehicle, state, bus).publish
        found.append((interface.rate, partial(_at, clock, publish)))
    return found


def _at(clock: Callable[[], float], publish: Callable[[float], None]) -> None:
    publish(clock())


def _can_touch(
    interface: ContactSensorToROSSpec, scene: SceneSpec, robots: Mapping[int, RobotSpec]
) -> bool:
    """Without a shape the sensor says nothing, as the original's without physics."""
    try:
        kind, index = touchable(interface.name, scene)
    except UwsimError:
        return False
    return kind == "object" or any(link.solids for link in robots[index].links)
