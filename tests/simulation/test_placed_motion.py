"""Velocities that sensors of a kinematic vehicle measure: those of its motion, at any rate."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from tests.simulation.girona500 import TWIST, make, set_current
from uwsim.devices.sway import SwaySpec
from uwsim.messages import (
    Imu,
    JointState,
    Odometry,
    Point,
    Pose,
    PoseWithCovariance,
    Quaternion,
    Twist,
    TwistStamped,
    TwistWithCovariance,
    Vector3,
    header,
)
from uwsim.sensors.dvl_sensor import DvlSensorSpec
from uwsim.sensors.imu import ImuSpec
from uwsim.simulation import Simulation
from uwsim.topics.ros_joint_state_to_arm import ROSJointStateToArmSpec
from uwsim.topics.ros_odom_to_pat import ROSOdomToPATSpec
from uwsim.topics.ros_pose_to_pat import ROSPoseToPATSpec

NAME = "girona500"
IMU = ImuSpec(name="imu", relative_to="base_link")
INTERFACES = (
    TWIST,
    ROSPoseToPATSpec(topic="/pose", vehicle_name=NAME),
    ROSOdomToPATSpec(topic="/odometry", vehicle_name=NAME),
    ROSJointStateToArmSpec(topic="/arm", vehicle_name=NAME),
)
SPEED, TURN = 0.5, 0.2  # [m/s], [rad/s]


def kinematic(*parts: Any) -> Simulation:
    return make(
        INTERFACES, change=lambda vehicle: replace(vehicle, parts=parts, dynamics=None)
    )  # fmt: skip


def twist_of(speed: float, turn: float) -> Twist:
    return Twist(linear=Vector3(speed, 0.0, 0.0), angular=Vector3(0.0, 0.0, turn))


def by_twist(simulation: Simulation, time: float) -> None:
    simulation.publish("/twist", TwistStamped(header=header(0.0), twist=twist_of(SPEED, TURN)))


def by_odometry(simulation: Simulation, time: float) -> None:
    pose = Pose(position=Point(0, 0, 0), orientation=Quaternion(0, 0, 0, 0))
    simulation.publish(
        "/odometry",
        Odometry(
            header=header(0.0),
            child_frame_id="",
            pose=PoseWithCovariance(pose=pose, covariance=np.zeros(36)),
            twist=TwistWithCovariance(twist=twist_of(SPEED, TURN), covariance=np.zeros(36)),
        ),
    )


def by_pose(simulation: Simulation, time: float) -> None:
    """A circle at the same speed and turn."""
    angle, radius = TURN * time, SPEED / TURN
    simulation.publish(
        "/pose",
        Pose(
            position=Point(radius * np.sin(angle), radius * (1.0 - np.cos(angle)), 0.0),
            orientation=Quaternion(0.0, 0.0, np.sin(angle / 2), np.cos(angle / 2)),
        ),
    )


def measured(
    simulation: Simulation,
    say: Callable[[Simulation, float], None],
    periods: list[int],
    rate: int,
    seconds: float = 2.5,
) -> tuple[np.ndarray, np.ndarray]:
    """Angular velocities and accelerations (less gravity) after the first second, (n, 3) each.

    The commands come after `periods` of steps, in turn; the imu samples at `rate` [Hz].
    """
    unit = simulation.world.sensors.sensor("imu", ("imu",))
    found, due, k = [], 0, 0
    for step in range(round(seconds / simulation.timestep)):
        if step == due:
            say(simulation, simulation.time)
            due, k = due + periods[k % len(periods)], k + 1
        simulation.advance()
        if step % round(1.0 / (rate * simulation.timestep)) == 0 and simulation.time > 1.0:
            message: Imu = unit.sample(simulation.time)
            w, a = message.angular_velocity, message.linear_acceleration
            found.append(([w.x, w.y, w.z], [a.x, a.y, a.z]))
    turns, forces = np.array(found).transpose(1, 0, 2)
    return turns, forces


@pytest.mark.parametrize("say", [by_twist, by_odometry, by_pose])
@pytest.mark.parametrize("rate", [50, 100, 7])
@pytest.mark.parametrize("periods", [[50], [13], [47, 53, 55]], ids=["10 Hz", "38 Hz", "uneven"])
def test_an_imu_measures_the_commanded_motion_at_every_sample(
    say: Callable[[Simulation, float], None], rate: int, periods: list[int]
) -> None:
    turns, forces = measured(kinematic(IMU), say, periods, rate)
    assert np.abs(turns[:, 2]) == pytest.approx(TURN, rel=2e-3)
    assert np.abs(turns[:, :2]).max() < 1e-9
    level = np.hypot(forces[:, 0], forces[:, 1])
    assert level == pytest.approx(SPEED * TURN, abs=0.02)  # of the circle


def test_an_imu_off_the_centre_feels_the_turn() -> None:
    lever = replace(IMU, position=(0.4, 0.0, 0.0))
    _, forces = measured(kinematic(lever), by_twist, [50], 50)
    assert np.abs(forces[-1, 0]) == pytest.approx(0.4 * TURN**2, abs=5e-3)


def test_a_current_and_commands_add_up() -> None:
    """The water moves it at every step, the commands move it ten times a second."""
    simulation = kinematic(IMU, DvlSensorSpec(name="dvl", relative_to="base_link"))
    set_current(simulation, (0.0, 0.3, 0.0))
    turns, forces = measured(simulation, by_twist, [50], 50)
    assert np.abs(turns[:, 2]) == pytest.approx(TURN, rel=1e-3)
    assert np.hypot(forces[:, 0], forces[:, 1]).max() < 0.5
    before = simulation.world.vehicles.find(NAME).world_from_base
    simulation.advance(0.1)
    by_twist(simulation, 0.0)
    simulation.advance()
    apart = simulation.world.vehicles.find(NAME).world_from_base.position - before.position
    motion = simulation.world.vehicles.find(NAME).moving_mount(IMU).motion()
    assert motion.velocity == pytest.approx(apart / 0.1, abs=0.02)


def test_a_vehicle_whose_commands_stop_stands_still_after_half_a_period_more() -> None:
    simulation = kinematic(IMU)
    unit = simulation.world.sensors.sensor("imu", ("imu",))
    for _ in range(20):
        by_twist(simulation, 0.0)
        simulation.advance(0.1)
    simulation.advance(0.02)
    assert abs(unit.sample(simulation.time).angular_velocity.z) == pytest.approx(TURN)
    simulation.advance(0.06)
    rest = unit.sample(simulation.time)
    assert rest.angular_velocity.z == 0.0
    level = np.hypot(rest.linear_acceleration.x, rest.linear_acceleration.y)
    assert level == pytest.approx(SPEED / 0.1, rel=1e-3)  # it slows down over a period
    simulation.advance(0.2)
    still = unit.sample(simulation.time).linear_acceleration
    assert np.hypot(still.x, still.y) == pytest.approx(0.0, abs=1e-9)


def test_speed_and_turn_of_a_swaying_vehicle_are_the_derivatives_of_its_sway() -> None:
    sway = SwaySpec(axis="x", amplitude=0.2, period=2.0)
    simulation = kinematic(IMU, sway)
    body = simulation.world.vehicles.find(NAME).moving_mount(IMU)
    simulation.advance(1.1)
    pace, time = np.pi, simulation.time
    for _ in range(5):
        simulation.advance()
        time = simulation.time
        axis = simulation.world.model.scene.world_from_localized.rotation[:, 0]
        motion = body.motion()
        assert axis @ motion.velocity == pytest.approx(
            0.2 * pace * np.cos(pace * (time - 0.001)), abs=1e-5
        )
        assert axis @ motion.acceleration == pytest.approx(
            -0.2 * pace**2 * np.sin(pace * (time - 0.002)), abs=1e-4
        )


def test_a_sensor_on_an_arm_moves_with_the_joints_too() -> None:
    link, joint = "part2", 1
    wrist = replace(IMU, relative_to=link, position=(0.1, 0.2, 0.0))
    simulation = kinematic(wrist)
    mount = simulation.world.vehicles.find(NAME).moving_mount(wrist)
    names = list(simulation.world.vehicles.find(NAME).joint_names)
    speeds = np.zeros(len(names))
    speeds[joint] = 0.3
    start = mount.world_from_body
    for k in range(10):
        simulation.publish(
            "/arm",
            JointState(
                header=header(0.0), name=names, position=np.zeros(0), velocity=speeds,
                effort=np.zeros(0),
            ),
        )  # fmt: skip
        by_twist(simulation, 0.0)
        start = mount.world_from_body if k == 9 else start
        simulation.advance(0.1)
    moved = mount.world_from_body.position - start.position
    found = mount.motion()
    assert np.linalg.norm(moved) > 0.03
    assert found.velocity == pytest.approx(moved / 0.1, abs=0.02)


def test_a_vehicle_that_is_put_back_is_at_rest() -> None:
    simulation = kinematic(IMU)
    for _ in range(8):
        by_twist(simulation, 0.0)
        simulation.advance(0.1)
    simulation.world.vehicles.find(NAME).reset_pose(None)
    motion = simulation.world.vehicles.find(NAME).moving_mount(IMU).motion()
    assert not motion.velocity.any()
    assert not motion.acceleration.any()


def test_a_saved_simulation_goes_on_with_the_same_motion() -> None:
    simulation = kinematic(IMU)
    body = simulation.world.vehicles.find(NAME).moving_mount(IMU)
    ends = []
    for _ in range(8):
        by_twist(simulation, 0.0)
        simulation.advance(0.1)
    saved = simulation.save()
    for _ in range(2):
        simulation.restore(saved)
        by_twist(simulation, 0.0)
        simulation.advance(0.15)
        ends.append(body.motion().acceleration.tobytes() + body.motion().velocity.tobytes())
    assert ends[0] == ends[1]
