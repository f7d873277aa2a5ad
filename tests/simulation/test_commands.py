from dataclasses import replace
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.base.geometry import Pose, rotation_from_xyz
from uwsim.messages import (
    JointState,
    Odometry,
    Point,
    PoseWithCovariance,
    Quaternion,
    Twist,
    TwistStamped,
    TwistWithCovariance,
    Vector3,
    header,
)
from uwsim.messages import Pose as PoseMessage
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation
from uwsim.topics.ros_joint_state_to_arm import ROSJointStateToArmSpec
from uwsim.topics.ros_odom_to_pat import ROSOdomToPATSpec
from uwsim.topics.ros_pose_to_pat import ROSPoseToPATSpec
from uwsim.topics.ros_twist_to_pat import ROSTwistToPATSpec

SCENE = Path(str(resources.files("uwsim"))) / "data" / "scenes" / "visibility-scene.xml"


@pytest.fixture
def simulation() -> Simulation:
    scene = read_scene(SCENE)
    interfaces = (
        ROSPoseToPATSpec(topic="/pose", vehicle_name="girona500"),
        ROSTwistToPATSpec(topic="/twist", vehicle_name="girona500"),
        ROSJointStateToArmSpec(topic="/arm", vehicle_name="girona500"),
        ROSOdomToPATSpec(topic="/odometry", vehicle_name="girona500"),
    )
    simulation = open_scene(replace(scene, objects=(), ros_interfaces=interfaces))
    simulation.advance(0.0)
    return simulation


def pose_in_l(simulation: Simulation) -> Pose:
    return simulation.world.model.scene.world_from_localized.inverse() @ (
        simulation.world.bodies.find("girona500").world_from_body
    )


def twist(x: float, yaw: float) -> TwistStamped:
    return TwistStamped(
        header=header(0.0),
        twist=Twist(linear=Vector3(x=x, y=0.0, z=0.0), angular=Vector3(x=0.0, y=0.0, z=yaw)),
    )


def test_a_pose_is_taken_as_it_is_in_the_frame_of_the_file(simulation: Simulation) -> None:
    simulation.bus.publisher("/pose", PoseMessage)(
        PoseMessage(
            position=Point(x=1.0, y=2.0, z=3.0),
            orientation=Quaternion(x=0.0, y=0.0, z=np.sqrt(0.5), w=np.sqrt(0.5)),
        )
    )
    for _ in range(2):
        simulation.advance()
    pose = pose_in_l(simulation)
    assert pose.position == pytest.approx([1.0, 2.0, 3.0])
    assert pose.rotation == pytest.approx(rotation_from_xyz(0.0, 0.0, np.pi / 2), abs=1e-12)


def test_a_twist_moves_by_the_time_since_the_one_before_and_is_not_held(
    simulation: Simulation,
) -> None:
    start = pose_in_l(simulation).position
    publish = simulation.bus.publisher("/twist", TwistStamped)
    for step in range(200):
        if step in (0, 50, 100):
            publish(twist(0.5, 0.0))
        simulation.advance()
    assert pose_in_l(simulation).position - start == pytest.approx([0.1, 0.0, 0.0])


def test_after_more_than_a_second_of_silence_a_twist_moves_nothing(simulation: Simulation) -> None:
    start = pose_in_l(simulation).position
    publish = simulation.bus.publisher("/twist", TwistStamped)
    publish(twist(0.5, 0.0))
    for _ in range(600):
        simulation.advance()
    publish(twist(0.5, 0.0))
    simulation.advance()
    simulation.advance()
    assert pose_in_l(simulation).position == pytest.approx(start)


def odometry(*, y: float = 0.0, speed: float = 0.0) -> Odometry:
    """A pose 0, ``y``, 2 m if there is a ``y``, else a twist of ``speed`` along x."""
    pose = PoseMessage(
        position=Point(x=0.0, y=y, z=2.0 if y else 0.0),
        orientation=Quaternion(x=0.0, y=0.0, z=0.0, w=1.0),
    )
    return Odometry(
        header=header(0.0),
        child_frame_id="",
        pose=PoseWithCovariance(pose=pose, covariance=np.zeros(36)),
        twist=TwistWithCovariance(twist=twist(speed, 0.0).twist, covariance=np.zeros(36)),
    )


def test_a_pose_between_two_velocities_of_odometry_does_not_take_the_time_of_the_second(
    simulation: Simulation,
) -> None:
    publish = simulation.bus.publisher("/odometry", Odometry)
    publish(odometry(speed=0.5))
    for _ in range(50):
        simulation.advance()
    publish(odometry(y=1.0))
    publish(odometry(speed=0.5))  # 0.1 s after the velocity before
    simulation.advance()
    simulation.advance()
    assert pose_in_l(simulation).position == pytest.approx([0.05, 1.0, 2.0])


def test_positions_of_joints_do_not_take_the_time_of_their_velocities(
    simulation: Simulation,
) -> None:
    nothing = np.array([])
    publish = simulation.bus.publisher("/arm", JointState)

    def slew(position: np.ndarray, velocity: np.ndarray) -> JointState:
        return JointState(
            header=header(0.0), name=["Slew"], position=position, velocity=velocity, effort=nothing
        )

    publish(slew(nothing, np.array([-0.5])))
    for _ in range(50):
        simulation.advance()
    publish(slew(np.array([0.2]), nothing))
    publish(slew(nothing, np.array([-0.5])))
    simulation.advance()
    simulation.advance()
    assert simulation.world.vehicles.find("girona500").joints[0] == pytest.approx(0.2 - 0.5 * 0.1)


def test_joints_are_found_by_name_and_clamped(simulation: Simulation) -> None:
    simulation.bus.publisher("/arm", JointState)(
        JointState(
            header=header(0.0),
            name=["Elbow", "Slew", "Nobody"],
            position=np.array([9.0, -0.3, 1.0]),
            velocity=np.array([]),
            effort=np.array([]),
        )
    )
    before = simulation.world.vehicles.find("girona500").joints
    simulation.advance()
    simulation.advance()
    after = simulation.world.vehicles.find("girona500").joints
    assert after[2] == pytest.approx(2.15294)
    assert after[0] == pytest.approx(-0.3)
    assert after[[1, 3, 4]] == pytest.approx(before[[1, 3, 4]])


def test_names_of_joints_may_change_from_message_to_message(simulation: Simulation) -> None:
    publish = simulation.bus.publisher("/arm", JointState)
    nothing = np.array([])
    for name, position in (
        (["Slew", "Elbow"], [0.1, 0.5]),
        (["Elbow", "Slew"], [0.6, 0.2]),
        (["Slew", "Slew", "Elbow"], [0.25, np.nan, np.nan]),
        (["Slew", "Elbow", "Slew"], [0.1, 0.7, 0.3]),
        ([], [0.4]),
    ):
        publish(
            JointState(
                header=header(0.0),
                name=name,
                position=np.array(position),
                velocity=nothing,
                effort=nothing,
            )
        )
        simulation.advance()
        simulation.advance()
        joints = simulation.world.vehicles.find("girona500").joints
        last = dict(zip(name or ["Slew"], position, strict=True))
        if np.isnan(position).any():  # the values that are none are passed over
            last = {"Slew": 0.25, "Elbow": 0.6}
        assert joints[0] == pytest.approx(last["Slew"])
        assert joints[2] == pytest.approx(last.get("Elbow", joints[2]))


def test_numbers_that_lead_nowhere_leave_a_vehicle_where_a_renderer_finds_it(
    simulation: Simulation,
) -> None:
    before = pose_in_l(simulation)
    say_twist = simulation.bus.publisher("/twist", TwistStamped)
    say_pose = simulation.bus.publisher("/pose", PoseMessage)
    still = Quaternion(x=0.0, y=0.0, z=0.0, w=1e-300)
    for number in (np.nan, np.inf, -np.inf):
        say_twist(twist(number, 0.0))
        say_twist(twist(0.0, number))
        say_pose(PoseMessage(position=Point(x=number, y=0.0, z=0.0), orientation=still))
        simulation.advance()
    assert pose_in_l(simulation).position == pytest.approx(before.position)
    for _ in range(3):
        say_twist(twist(1e308, 1e308))
        simulation.advance()
    say_pose(PoseMessage(position=Point(x=1e308, y=0.0, z=0.0), orientation=still))
    simulation.advance()
    simulation.advance()
    after = pose_in_l(simulation)
    assert after.position == pytest.approx([1e6, 0.0, 0.0], abs=1e-6)
    assert after.rotation == pytest.approx(np.eye(3), abs=1e-9)
