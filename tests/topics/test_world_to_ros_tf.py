"""The frames of a scene on /tf: one tree, and where everything is in it."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np

from tests.simulation.small_robots import joint, scene_of, shape, write_robot
from tests.support.opened import open_scene
from uwsim.base.geometry import Pose
from uwsim.messages import JointState, TFMessage, TransformStamped, seconds
from uwsim.scene.object import ObjectSpec
from uwsim.scene.sim_params import SimParamsSpec
from uwsim.scene.spec import SceneSpec
from uwsim.scene.vehicle import VehicleSpec
from uwsim.sensors.pressure_sensor import PressureSensorSpec
from uwsim.sensors.sonar.multibeam_sensor import MultibeamSensorSpec
from uwsim.sensors.virtual_camera import VirtualCameraSpec
from uwsim.simulation import Simulation
from uwsim.topics.ros_joint_state_to_arm import ROSJointStateToArmSpec
from uwsim.topics.world_to_ros_tf import WorldToROSTFSpec

NED = SimParamsSpec(offsetr=(math.pi, 0.0, -math.pi / 2))


def scene_in(folder: Path, *, with_objects: bool = False) -> SceneSpec:
    links = "".join(
        f'<link name="{name}">{shape()}</link>' for name in ("base_link", "arm", "mast")
    )
    joints = joint("elbow", "base_link arm", kind="revolute", xyz="1 0 0", axis="0 1 0").replace(
        "<axis", '<limit lower="-3" upper="3" effort="1" velocity="1"/><axis'
    ) + joint("step", "base_link mast", xyz="0 0 -0.5")
    robot = write_robot(folder, links + joints)
    vehicle = VehicleSpec(
        name="rov",
        file=str(robot),
        position=(10.0, 20.0, 3.0),
        orientation=(0.0, 0.0, math.pi / 2),
        parts=(
            VirtualCameraSpec(name="bow", relative_to="arm", position=(0.0, 0.0, 0.1)),
            PressureSensorSpec(name="depth", relative_to="base_link"),
            MultibeamSensorSpec(
                name="fan", relative_to="base_link", init_angle=-60.0, final_angle=60.0,
                angle_incr=1.0, range=10.0,
            ),
        ),
    )  # fmt: skip
    interfaces = (
        WorldToROSTFSpec(root_name="/world", enable_objects=with_objects, rate=10),
        ROSJointStateToArmSpec(topic="/joints", vehicle_name="rov"),
    )
    box = ObjectSpec(name="box", file="objects/blackbox.obj", position=(1.0, 2.0, 4.0))
    things = (replace(box, file=str(_cube(folder))),) if with_objects else ()
    return scene_of(vehicle, ros_interfaces=interfaces, sim_params=NED, objects=things)


def _cube(folder: Path) -> Path:
    file = folder / "cube.obj"
    file.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n")
    return file


def frames(simulation: Simulation) -> dict[str, TransformStamped]:
    simulation.latest_message("/tf")
    simulation.advance(0.1)
    message = simulation.latest_message("/tf")
    assert isinstance(message, TFMessage)
    return {each.child_frame_id: each for each in message.transforms}


def pose(found: TransformStamped) -> Pose:
    t, q = found.transform.translation, found.transform.rotation
    return Pose.from_quaternion(np.array([t.x, t.y, t.z]), np.array([q.w, q.x, q.y, q.z]))


def test_every_frame_hangs_on_one_tree(tmp_path: Path) -> None:
    with open_scene(scene_in(tmp_path, with_objects=True), is_blind=True) as simulation:
        found = frames(simulation)
    assert {child: each.header.frame_id for child, each in found.items()} == {
        "rov": "world",
        "rov/base_link": "rov",
        "rov/arm": "rov/base_link",
        "rov/mast": "rov/base_link",
        "bow": "rov/arm",
        "depth": "rov/base_link",
        "fan": "rov/base_link",
        "box": "world",
    }
    assert {seconds(each.header.stamp) for each in found.values()} == {0.1}


def test_vehicles_and_objects_are_where_the_file_puts_them_in_l(tmp_path: Path) -> None:
    with open_scene(scene_in(tmp_path, with_objects=True), is_blind=True) as simulation:
        found = frames(simulation)
    assert np.allclose(pose(found["rov"]).position, [10.0, 20.0, 3.0])
    assert np.allclose(pose(found["rov"]).rotation[:, 0], [0.0, 1.0, 0.0])
    assert np.allclose(pose(found["box"]).position, [1.0, 2.0, 4.0])
    assert np.allclose(pose(found["rov/mast"]).position, [0.0, 0.0, -0.5])


def test_a_joint_turns_its_link_and_what_is_mounted_on_it_stays(tmp_path: Path) -> None:
    with open_scene(scene_in(tmp_path), is_blind=True) as simulation:
        before = frames(simulation)
        command = JointState(name=["elbow"], position=np.array([0.5]))
        simulation.publish("/joints", command)
        after = frames(simulation)
    turned = pose(before["rov/arm"]).inverse() @ pose(after["rov/arm"])
    assert np.allclose(turned.rotation[:, 0], [math.cos(0.5), 0.0, -math.sin(0.5)])
    assert np.allclose(pose(after["bow"]).matrix, pose(before["bow"]).matrix)
    assert np.allclose(pose(after["bow"]).position, [0.0, 0.0, 0.1])


def test_cameras_look_along_z_and_scans_begin_along_x(tmp_path: Path) -> None:
    with open_scene(scene_in(tmp_path), is_blind=True) as simulation:
        found = frames(simulation)
    ahead = np.array([0.0, 0.0, -1.0])  # of both in their own axes
    assert np.allclose(pose(found["bow"]).rotation[:, 2], ahead)
    assert np.allclose(pose(found["bow"]).rotation[:, 0], [1.0, 0.0, 0.0])
    assert np.allclose(pose(found["fan"]).rotation[:, 0], ahead)
    assert np.allclose(pose(found["fan"]).rotation[:, 1], [0.0, 1.0, 0.0])
