"""A vehicle's scaleFactor: L_T_B = T R S moves, and is not forgotten by, everything below it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.small_robots import begin, joint, scene_of, shape, write_robot
from uwsim.base.geometry import Pose, rotation_from_rpy, rotation_from_xyz
from uwsim.devices.lamp import LampSpec
from uwsim.errors import SceneError
from uwsim.scene.object import ObjectSpec, PhysicsSpec
from uwsim.scene.sim_params import SimParamsSpec
from uwsim.scene.spec import SceneSpec
from uwsim.scene.urdf.kinematics import link_poses
from uwsim.scene.vehicle import VehicleSpec
from uwsim.sensors.virtual_camera import VirtualCameraSpec

ARM = (
    f'<link name="base">{shape(size=(1.0, 0.4, 0.4))}</link>'
    f'<link name="upper">{shape(size=(0.5, 0.1, 0.1), xyz="0.25 0 0", rpy="0 0 0.3")}</link>'
    f'<link name="rail">{shape(size=(0.1, 0.1, 0.1))}</link><link name="tool"/>'
    + joint("1", "base upper", kind="continuous", xyz="0.5 0.1 0", rpy="0.2 0 0.4")
    + joint("2", "upper rail", kind="prismatic", xyz="0.5 0 0", rpy="0 0.3 0", axis="2 0 1")
    + joint("3", "rail tool", kind="fixed", xyz="0.1 0.05 0", rpy="0 0 1")
)
CAMERA = VirtualCameraSpec(
    name="eye", relative_to="rail", position=(0.1, 0.2, 0.3), orientation=(0.1, 0.2, 0.3), std=0.0
)
VALUES = (0.7, 0.4)
EVEN, UNEVEN = (2.0, 2.0, 2.0), (2.0, 0.5, 1.5)


def arm(folder: Path, scale: tuple[float, float, float], **given: object) -> SceneSpec:
    vehicle = VehicleSpec(
        name="arm",
        file=str(write_robot(folder, ARM)),
        joint_values=VALUES,
        position=(1.0, 2.0, -3.0),
        orientation=(0.3, -0.2, 0.5),
        scale_factor=scale,
        parts=(CAMERA, LampSpec(name="lamp", relative_to="rail", position=(0.1, 0.2, 0.3))),
    )
    return scene_of(vehicle, **given)


def placed(scale: tuple[float, float, float], base_from_point: np.ndarray) -> np.ndarray:
    """``T R S p``, written out."""
    turn = rotation_from_xyz(0.3, -0.2, 0.5)
    return np.array([1.0, 2.0, -3.0]) + turn @ (np.array(scale) * base_from_point)


@pytest.mark.parametrize("scale", [EVEN, UNEVEN])
@pytest.mark.parametrize("values", [VALUES, (-1.1, 1.2)])
def test_links_cameras_and_routes_stand_where_the_scale_puts_them(
    scale: tuple[float, float, float], values: tuple[float, float], tmp_path: Path
) -> None:
    simulation = begin(arm(tmp_path, scale), is_blind=True)
    simulation.world.stage_view.set_joints("arm", dict(enumerate(values)))
    robot = simulation.world.model.robots[0]
    poses = link_poses(robot, values)
    for link, pose in poses.items():
        found = simulation.world.bodies.find(f"arm/{link}").world_from_body
        assert found.position == pytest.approx(placed(scale, pose.position)), link
        turn = rotation_from_xyz(0.3, -0.2, 0.5) @ pose.rotation
        assert found.rotation == pytest.approx(turn, abs=1e-9), link  # a frame has no shear
    eye = poses["rail"].transform(np.array([CAMERA.position]))[0]
    camera = simulation.world.sensors.camera("eye").world_from_camera
    assert camera.position == pytest.approx(placed(scale, eye))
    turn = rotation_from_xyz(0.3, -0.2, 0.5) @ poses["rail"].rotation
    assert camera.rotation == pytest.approx(turn @ rotation_from_rpy(*CAMERA.orientation))
    visual = poses["upper"].transform(np.array([[0.25, 0.0, 0.0]]))[0]
    found = simulation.world.bodies.find("upper@visual").world_from_body
    assert found.position == pytest.approx(placed(scale, visual))
    assert simulation.world.vehicles.find("arm").joints == pytest.approx(values)


@pytest.mark.parametrize("scale", [EVEN, UNEVEN])
def test_meshes_are_stretched_along_the_axes_of_the_base(
    scale: tuple[float, float, float], tmp_path: Path
) -> None:
    simulation = begin(arm(tmp_path, scale), is_blind=True)
    poses = link_poses(simulation.world.model.robots[0], VALUES)
    part = next(p for p in simulation.world.scenery.parts if p.link == "upper")
    corner = np.array([0.25, 0.05, -0.05])  # of the box in its own frame
    link_from_mesh = Pose.from_rpy((0.25, 0.0, 0.0), (0.0, 0.0, 0.3))
    base_from_corner = (poses["upper"] @ link_from_mesh).transform(corner[None])[0]
    world_from_mesh = simulation.world.scenery.world_from_mesh(part)
    assert (world_from_mesh @ [*corner, 1.0])[:3] == pytest.approx(placed(scale, base_from_corner))


@pytest.mark.parametrize("scale", [EVEN, UNEVEN])
def test_a_lamp_hangs_where_the_scale_puts_it(
    scale: tuple[float, float, float], tmp_path: Path
) -> None:
    simulation = begin(arm(tmp_path, scale), is_blind=True)
    (lamp,) = simulation.world.scenery.mounted_lamps
    base_from_rail = link_poses(simulation.world.model.robots[0], VALUES)["rail"]
    place = base_from_rail.transform(np.array([[0.1, 0.2, 0.3]]))[0]
    assert lamp.world_from_lamp.position == pytest.approx(placed(scale, place))


def test_a_camera_sees_the_larger_robot_where_it_is(tmp_path: Path) -> None:
    """Two bars 1 m ahead, the second of a robot half as large and scaled by two: same image."""
    images = []
    for size, scale in ((0.2, 1.0), (0.1, 2.0)):
        bar = shape(size=(size, size / 2, size / 4), xyz=f"{size} 0 0", colour="1 0 0 1")
        file = write_robot(tmp_path, f'<link name="base">{bar}</link>', f"{scale:g}.urdf")
        vehicle = VehicleSpec(
            name="r", file=str(file), position=(1.0, 0.0, -1.0), scale_factor=(scale,) * 3
        )
        simulation = begin(scene_of(vehicle))
        pose = Pose.from_rpy((0.0, 0.0, -1.0), (np.pi / 2, 0.0, -np.pi / 2))
        lens = CAMERA.intrinsics()
        images.append(simulation.world.scenery.render_clean(pose, lens))
        simulation.close()
    assert images[0].ids is not None
    assert images[0].ids.any()
    assert np.array_equal(images[0].ids, images[1].ids)


WALL = ObjectSpec(name="wall", file="objects/blackbox", physics=PhysicsSpec(mass=0.0))


@pytest.mark.parametrize(("scale", "touches"), [(1.0, False), (2.0, True)])
@pytest.mark.parametrize("falls", [False, True])
def test_contacts_know_how_large_a_vehicle_is(
    scale: float, touches: bool, falls: bool, tmp_path: Path
) -> None:
    """The arm's tip, 1 m ahead of its base, 2 m with the scale; a box 1.9 m ahead."""
    tip = joint("t", "base tip", xyz="0.95 0 0")
    solid = shape("collision", (0.1, 0.1, 0.1))
    file = write_robot(tmp_path, f'<link name="base"/><link name="tip">{solid}</link>{tip}')
    vehicle = VehicleSpec(name="arm", file=str(file), scale_factor=(scale, scale, scale))
    falling = replace(WALL, name="stone", position=(50.0, 0.0, 0.0), physics=PhysicsSpec())
    wall = replace(WALL, position=(1.98, 0.0, 0.0))
    scene = scene_of(
        vehicle,
        objects=(wall, falling) if falls else (wall,),
        sim_params=SimParamsSpec(enable_physics=falls),
    )
    simulation = begin(scene, is_blind=True)
    for _ in range(3):
        simulation.advance()
    assert bool(simulation.world.contacts.find("arm")) is touches


def test_a_vehicle_with_dynamics_and_a_scale_is_refused_with_the_way_out(tmp_path: Path) -> None:
    vehicle = VehicleSpec(
        name="g", file="data/scenes/g500ARM5.urdf", dynamics="g500_physical", scale_factor=EVEN
    )
    with pytest.raises(SceneError, match=r"'g' has <u:dynamics>.*<scaleFactor>.*URDF"):
        begin(scene_of(vehicle), is_blind=True)
