"""Commands of a vehicle with dynamics other than twists, and what it tells of itself."""

from dataclasses import replace

import numpy as np
import pytest

from tests.simulation.girona500 import (
    command,
    heading_deg,
    make,
    position,
    run,
    set_current,
    vector,
)
from uwsim.errors import BadMessage, UwsimError
from uwsim.messages import (
    Float64MultiArray,
    JointState,
    MultiArrayLayout,
    Odometry,
    Point,
    Pose,
    Quaternion,
    Wrench,
    WrenchStamped,
    header,
)
from uwsim.simulation import Simulation
from uwsim.topics.arm_to_ros_joint_state import ArmToROSJointStateSpec
from uwsim.topics.pat_to_ros_odom import PATToROSOdomSpec
from uwsim.topics.ros_joint_state_to_arm import ROSJointStateToArmSpec
from uwsim.topics.ros_pose_to_pat import ROSPoseToPATSpec
from uwsim.topics.ros_twist_to_pat import ROSTwistToPATSpec
from uwsim.topics.thruster_commands import ROSThrustersToPATSpec, ROSWrenchToPATSpec

NAME = "girona500"
INTERFACES = (
    ROSTwistToPATSpec(topic="/twist", vehicle_name=NAME),
    ROSPoseToPATSpec(topic="/pose", vehicle_name=NAME),
    ROSThrustersToPATSpec(topic="/thrusters", vehicle_name=NAME),
    ROSWrenchToPATSpec(topic="/wrench", vehicle_name=NAME),
    ROSJointStateToArmSpec(topic="/arm", vehicle_name=NAME),
    PATToROSOdomSpec(topic="/odometry", vehicle_name=NAME, rate=50),
    ArmToROSJointStateSpec(topic="/joints", vehicle_name=NAME, rate=50),
)


@pytest.fixture
def simulation() -> Simulation:
    return make(INTERFACES)


def thrust(simulation: Simulation, *values: float) -> None:
    simulation.bus.publisher("/thrusters", Float64MultiArray)(
        Float64MultiArray(layout=MultiArrayLayout(dim=[], data_offset=0), data=np.array(values))
    )


def push(simulation: Simulation, force: tuple, torque: tuple = (0.0, 0.0, 0.0)) -> None:
    wrench = Wrench(force=vector(*force), torque=vector(*torque))
    simulation.bus.publisher("/wrench", WrenchStamped)(
        WrenchStamped(header=header(0.0), wrench=wrench)
    )


def go_to(simulation: Simulation, x: float, y: float, z: float, yaw: float) -> None:
    q = Quaternion(x=0.0, y=0.0, z=float(np.sin(yaw / 2)), w=float(np.cos(yaw / 2)))
    simulation.bus.publisher("/pose", Pose)(Pose(position=Point(x=x, y=y, z=z), orientation=q))


def bend(simulation: Simulation, names: list[str], **given: list[float]) -> None:
    arrays = {kind: np.array(given.get(kind, [])) for kind in ("position", "velocity", "effort")}
    simulation.bus.publisher("/arm", JointState)(
        JointState(header=header(0.0), name=names, **arrays)
    )


def test_thrusters_are_driven_in_the_order_of_the_side_file(simulation: Simulation) -> None:
    thrust(simulation, 0.5, 0.5, 0.0, 0.0, 0.0)  # both surge thrusters; the bow points along y
    run(simulation, 8.0)
    before = position(simulation)
    run(simulation, 0.5)
    speed = (position(simulation) - before)[1] / 0.5
    # 70 N against 30 u + 230 u^2 give 0.49 m/s; the arm's drag and the pitch cost some of it
    assert 0.38 < speed < 0.49
    assert abs(heading_deg(simulation) - 90.0) < 2.0


@pytest.mark.parametrize(
    ("number", "axis", "sign"), [(4, 0, -1.0), (2, 2, 1.0)], ids=["sway", "bow heave"]
)
def test_each_thruster_pushes_its_own_way(
    simulation: Simulation, number: int, axis: int, sign: float
) -> None:
    commands = [0.0] * 5
    commands[number] = 0.5
    before = position(simulation)
    thrust(simulation, *commands)
    run(simulation, 1.5)
    moved = position(simulation) - before
    assert moved[axis] * sign > 0.02
    assert int(np.argmax(np.abs(moved))) == axis


def test_a_twist_takes_over_from_thruster_commands_where_the_vehicle_is(
    simulation: Simulation,
) -> None:
    thrust(simulation, 0.0, 0.0, 0.4, 0.4, 0.0)  # down
    run(simulation, 5.0)
    deep = position(simulation)[2]
    assert deep > 1.8
    command(simulation, 0.0, 0.0)
    run(simulation, 12.0)
    after = position(simulation)[2]
    assert after == pytest.approx(deep, abs=0.1)
    run(simulation, 3.0)
    assert position(simulation)[2] == pytest.approx(after, abs=0.01)


def test_a_wrong_number_of_thruster_commands_names_the_thrusters(simulation: Simulation) -> None:
    with pytest.raises(BadMessage, match=r"2 values; expected 5: surge_port, surge_starboard"):
        thrust(simulation, 1.0, 1.0)


def test_a_vehicle_that_is_not_simulated_takes_no_thruster_commands() -> None:
    with pytest.raises(UwsimError, match="no <u:dynamics>"):
        make(INTERFACES[2:3], change=lambda vehicle: replace(vehicle, dynamics=None))


def test_a_wrench_is_given_by_the_thrusters(simulation: Simulation) -> None:
    push(simulation, (70.0, 0.0, 0.0))
    run(simulation, 8.0)
    before = position(simulation)
    run(simulation, 0.5)
    speed = (position(simulation) - before)[1] / 0.5
    assert 0.38 < speed < 0.49


def test_a_torque_turns_the_vehicle(simulation: Simulation) -> None:
    push(simulation, (0.0, 0.0, 0.0), (0.0, 0.0, 10.0))
    run(simulation, 2.0)
    assert heading_deg(simulation) > 95.0


def test_a_pose_is_gone_to_and_held_in_a_current(simulation: Simulation) -> None:
    set_current(simulation, (0.1, 0.05, 0.0))
    go_to(simulation, 2.5, 2.0, 2.0, np.pi / 4)
    run(simulation, 0.1)
    assert position(simulation) == pytest.approx([3.0, 1.5, 1.515], abs=0.02)  # no jump
    run(simulation, 40.0)
    assert position(simulation) == pytest.approx([2.5, 2.0, 2.0], abs=0.03)
    assert heading_deg(simulation) == pytest.approx(45.0, abs=2.0)


def test_a_joint_position_is_reached_by_its_servo_and_not_at_once(simulation: Simulation) -> None:
    before = simulation.world.vehicles.find(NAME).joints
    bend(simulation, ["Slew"], position=[-0.5])
    run(simulation, 0.01)
    assert abs(simulation.world.vehicles.find(NAME).joints[0] - before[0]) < 0.2
    run(simulation, 3.0)
    after = simulation.world.vehicles.find(NAME).joints
    assert after[0] == pytest.approx(-0.5, abs=0.03)
    assert after[1:] == pytest.approx(before[1:], abs=0.1)  # the servos give


def test_a_joint_velocity_is_held_and_ends_at_the_limit(simulation: Simulation) -> None:
    run(simulation, 1.0)
    bend(simulation, ["Slew"], velocity=[-0.2])
    run(simulation, 3.0)
    assert simulation.world.vehicles.find(NAME).joints[0] == pytest.approx(-0.6, abs=0.05)
    run(simulation, 7.0)
    assert simulation.world.vehicles.find(NAME).joints[0] == pytest.approx(-np.pi / 2, abs=0.05)


def test_an_effort_lets_the_joint_go_as_far_as_its_stop(simulation: Simulation) -> None:
    run(simulation, 1.0)
    bend(simulation, ["Slew"], effort=[-3.0])
    run(simulation, 8.0)
    assert simulation.world.vehicles.find(NAME).joints[0] == pytest.approx(-np.pi / 2, abs=0.05)
    bend(simulation, ["Slew"], position=[0.0])
    run(simulation, 3.0)
    assert simulation.world.vehicles.find(NAME).joints[0] == pytest.approx(0.0, abs=0.03)


def test_the_odometry_publishes_pose_and_twist_over_ground(simulation: Simulation) -> None:
    inbox = simulation.bus.inbox("/odometry", Odometry)
    set_current(simulation, (0.0, 0.1, 0.0))
    command(simulation, 0.2, 0.0)
    run(simulation, 10.0)
    messages = inbox.take()
    assert len(messages) == 500
    last = messages[-1]
    place = last.pose.pose.position
    assert [place.x, place.y, place.z] == pytest.approx(position(simulation), abs=1e-9)
    assert last.twist.twist.linear.x == pytest.approx(0.3, abs=0.01)


def test_the_joints_are_published_with_velocities_and_efforts(simulation: Simulation) -> None:
    inbox = simulation.bus.inbox("/joints", JointState)
    bend(simulation, ["Slew"], velocity=[-0.2])
    run(simulation, 3.0)
    last = inbox.take()[-1]
    assert last.name[:3] == ["Slew", "Shoulder", "Elbow"]
    assert last.position == pytest.approx(simulation.world.vehicles.find(NAME).joints)
    assert last.velocity[0] == pytest.approx(-0.2, abs=0.02)
    assert last.effort.shape == (5,)


def test_what_is_not_finite_is_passed_over(simulation: Simulation) -> None:
    for message in range(3):
        value = (np.nan, np.inf, -np.inf)[message]
        thrust(simulation, value, 0.0, 0.0, 0.0, 0.0)
        push(simulation, (value, 0.0, 0.0))
        go_to(simulation, value, 0.0, 0.0, 0.0)
        command(simulation, value, 0.0)
        bend(simulation, ["Slew"], position=[value])
    run(simulation, 2.0)
    assert position(simulation) == pytest.approx([3.0, 1.5, 1.515], abs=0.02)


@pytest.mark.parametrize("kind", ["thrusters", "wrench"])
def test_thrusts_and_wrenches_act_on_the_next_step(kind: str, simulation: Simulation) -> None:
    """Between two ticks of the autopilot, which are 20 ms apart."""
    run(simulation, 0.024)
    controls = simulation.world.engine._data.ctrl
    before = controls.copy()
    if kind == "thrusters":
        thrust(simulation, 0.5, 0.5, 0.0, 0.0, 0.0)
    else:
        push(simulation, (30.0, 0.0, 0.0))
    simulation.advance()  # delivers
    simulation.advance()
    assert np.abs(controls - before).max() > 0.05


def test_a_command_beyond_its_limit_counts_as_the_limit_in_the_track_too() -> None:
    ends = []
    for most in (1.0, 1500.0, 1e9):
        with make(INTERFACES) as simulation:
            thrust(simulation, most, -most, 0.25, -most, most)
            run(simulation, 0.04)
            shares = simulation.world.engine.actuation[0].commands().tolist()
            ends.append((shares, position(simulation).tobytes()))
    assert ends[0] == ends[1] == ends[2]
    assert ends[0][0] == [1.0, -1.0, 0.25, -1.0, 1.0]
