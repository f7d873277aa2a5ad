"""A vehicle with dynamics that follows a recording: its sensors measure the recorded motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.simulation.girona500 import make
from uwsim.errors import UwsimError
from uwsim.messages import (
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
from uwsim.sensors.dvl_sensor import DvlSensorSpec
from uwsim.sensors.imu import ImuSpec
from uwsim.simulation import Simulation
from uwsim.simulation.ghosts import follow_recorded
from uwsim.topics.arm_to_ros_joint_state import ArmToROSJointStateSpec
from uwsim.topics.pat_to_ros_odom import PATToROSOdomSpec

NAME = "girona500"
IMU = ImuSpec(name="imu", relative_to="base_link")
DVL = DvlSensorSpec(name="dvl", relative_to="base_link")
INTERFACES = (
    PATToROSOdomSpec(topic="/odom", vehicle_name=NAME),
    ArmToROSJointStateSpec(topic="/joints", vehicle_name=NAME),
)
SPEED, TURN, RATE = 0.5, 0.2, 10  # [m/s], [rad/s], [Hz]
FAR = np.array([30.0, -20.0, 3.0])  # where the recording begins, m from where the scene puts it
SLEW = 0.3  # [rad/s]


def following(*, dynamics: bool = True) -> Simulation:
    simulation = make(
        INTERFACES,
        change=lambda vehicle: replace(
            vehicle, parts=(IMU, DVL), dynamics=vehicle.dynamics if dynamics else None
        ),
    )
    recorded = {"/odom": "/recorded/odom", "/joints": "/recorded/joints"}
    assert follow_recorded(simulation, recorded) == (NAME,)
    return simulation


def play(simulation: Simulation, seconds: float, *, joints: bool = False, first: int = 0) -> None:
    """A circle of radius SPEED / TURN by odometry without a twist, as there often is."""
    still = TwistWithCovariance(
        twist=Twist(linear=Vector3(0, 0, 0), angular=Vector3(0, 0, 0)), covariance=np.zeros(36)
    )
    for k in range(first, first + round(seconds * RATE)):
        time = k / RATE
        angle, radius = TURN * time, SPEED / TURN
        x, y, z = FAR + radius * np.array([np.sin(angle), 1.0 - np.cos(angle), 0.0])
        pose = Pose(
            position=Point(x, y, z),
            orientation=Quaternion(0.0, 0.0, np.sin(angle / 2), np.cos(angle / 2)),
        )
        odometry = Odometry(
            header=header(time),
            child_frame_id="",
            pose=PoseWithCovariance(pose=pose, covariance=np.zeros(36)),
            twist=still,
        )
        simulation.bus.publisher("/recorded/odom", Odometry)(odometry)
        if joints:
            at = JointState(
                header(time), ["Slew"], np.array([SLEW * time]), np.zeros(0), np.zeros(0)
            )
            simulation.bus.publisher("/recorded/joints", JointState)(at)
        simulation.advance(1.0 / RATE)


@pytest.mark.parametrize("dynamics", [True, False], ids=["simulated", "kinematic"])
def test_velocity_sensors_measure_the_recorded_motion(dynamics: bool) -> None:
    simulation = following(dynamics=dynamics)
    play(simulation, 2.0)
    world, time = simulation.world, simulation.time
    turn = world.sensors.sensor("imu", ("imu",)).sample(time)
    assert abs(turn.angular_velocity.z) == pytest.approx(TURN, rel=1e-6)
    force = turn.linear_acceleration
    assert np.hypot(force.x, force.y) == pytest.approx(SPEED * TURN, abs=0.01)
    motion = world.vehicles.find(NAME).moving_mount(DVL).motion()
    assert np.linalg.norm(motion.velocity) == pytest.approx(SPEED, rel=1e-3)


def test_its_odometry_has_the_recorded_twist() -> None:
    simulation = following()
    simulation.latest_message("/odom")
    play(simulation, 1.0)
    heard = simulation.latest_message("/odom")
    assert heard is not None
    linear, angular = heard.twist.twist.linear, heard.twist.twist.angular
    assert linear.x == pytest.approx(SPEED, rel=1e-3)
    assert [linear.z, angular.x, angular.y] == pytest.approx([0.0] * 3, abs=1e-6)
    assert angular.z == pytest.approx(TURN, rel=1e-6)
    assert simulation.velocity(NAME)[0] == pytest.approx(linear.x, rel=1e-6)


def test_where_a_recording_begins_is_no_motion() -> None:
    """It is put there: 36 m in no time would be a jump in every velocity."""
    simulation = following()
    play(simulation, 0.1)
    assert simulation.pose(NAME).position == pytest.approx(FAR)
    assert simulation.velocity(NAME) == pytest.approx(np.zeros(6), abs=1e-12)
    play(simulation, 0.1, first=1)
    assert simulation.velocity(NAME)[0] == pytest.approx(SPEED, rel=1e-3)


def test_joints_move_what_is_mounted_on_them() -> None:
    simulation = following()
    link = "part1"
    mount = simulation.world.vehicles.find(NAME).moving_mount(replace(IMU, relative_to=link))
    play(simulation, 1.0, joints=True)
    base = simulation.world.vehicles.find(NAME).moving_mount(IMU).motion()
    apart = mount.motion().angular_velocity - base.angular_velocity
    assert np.linalg.norm(apart) == pytest.approx(SLEW, rel=1e-3)


def test_a_joint_that_is_recorded_as_no_number_stays() -> None:
    simulation = following()
    before = simulation.world.vehicles.find(NAME).joints
    heard = JointState(
        header(0.0),
        ["Slew", "Elbow"],
        np.array([np.nan, before[2] - 0.1]),
        np.zeros(0),
        np.zeros(0),
    )
    simulation.bus.publisher("/recorded/joints", JointState)(heard)
    simulation.advance()
    expected = before - [0.0, 0.0, 0.1, 0.0, 0.0]
    assert simulation.world.vehicles.find(NAME).joints == pytest.approx(expected, abs=1e-4)


def test_a_vehicle_that_follows_nothing_keeps_its_own_velocity() -> None:
    simulation = make(INTERFACES, change=lambda vehicle: replace(vehicle, parts=(IMU,)))
    simulation.advance(0.1)
    assert simulation.velocity(NAME).shape == (6,)
    kinematic = following(dynamics=False)
    with pytest.raises(UwsimError, match="kinematic"):
        kinematic.velocity(NAME)
