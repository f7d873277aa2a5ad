"""Vehicles whose thrusters cannot do everything: what can be held is, and no more is tried."""

from __future__ import annotations

from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.base.geometry import quaternion_from_rotation, rotation_from_rpy
from uwsim.checks import check_file, model_warnings
from uwsim.messages import Twist, TwistStamped, Vector3, header
from uwsim.model.balance import balance_of
from uwsim.physics.actuation.allocation import (
    HEAVE,
    PITCH,
    ROLL,
    SURGE,
    SWAY,
    YAW,
    allocate,
    thrusters_on_base,
)
from uwsim.scene.hydrodynamics.spec import ThrusterSpec
from uwsim.scene.hydrodynamics.vehicle_file import read_vehicle
from uwsim.scene.hydrodynamics.vehicle_sets import find_vehicle
from uwsim.scene.reader import read_scene
from uwsim.scene.urdf.reader import read_urdf
from uwsim.simulation import Simulation

DATA = Path(str(resources.files("uwsim"))) / "data"
ROBOT = """<robot name="torpedo">
  <link name="base_link">
    <collision> <origin rpy="0 1.5708 0"/>
      <geometry> <cylinder radius="0.1" length="1.6"/> </geometry> </collision>
  </link>
  <link name="tail"/>
  <joint name="to_tail" type="fixed">
    <origin xyz="-0.6 0 0" rpy="0 0 1.5707963"/> <parent link="base_link"/> <child link="tail"/>
  </joint>
</robot>"""
WATER = """<hydrodynamics name="torpedo">
  <source>a torpedo of the tests: z down, 0.2 kg buoyant, righted by 2 cm</source>
  <body link="base_link">
    <mass>50</mass> <inertia>0.25 10 10 0 0 0</inertia>
    <addedMass>3 50 50 0.02 8 8</addedMass>
    <linearDamping>3 20 20 0.3 10 10</linearDamping>
    <quadraticDamping>5 200 200 0.5 60 60</quadraticDamping>
    <volume>0.0502</volume>
    <centreOfBuoyancy> <x>0</x> <y>0</y> <z>-0.02</z> </centreOfBuoyancy>
    <shape>box</shape> <size>1.6 0.2 0.2</size>
  </body>
  {}
</hydrodynamics>"""
SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <simParams> <offsetr> <x>M_PI</x> <y>0</y> <z>-M_PI_2</z> </offsetr> </simParams>
  <vehicle> <name>torpedo</name> <file>torpedo.urdf</file>
    <position> <x>0</x> <y>0</y> <z>5.5</z> </position>
    <u:dynamics>torpedo</u:dynamics>
  </vehicle>
  <rosInterfaces>
    <ROSTwistToPAT> <topic>/twist</topic> <vehicleName>torpedo</vehicleName> </ROSTwistToPAT>
  </rosInterfaces>
</UWSimScene>"""
THRUSTER = """<thruster name="{}" link="{}">
  <position> <x>{}</x> <y>{}</y> <z>{}</z> </position>
  <direction> <x>{}</x> <y>{}</y> <z>{}</z> </direction>
  <forward>0 40</forward> <timeConstant>0.1</timeConstant> </thruster>"""
STERN = THRUSTER.format("stern", "base_link", -0.8, 0, 0, 1, 0, 0)
TAIL = THRUSTER.format("tail_down", "base_link", -0.6, 0, 0, 0, 0, 1)
RUDDER = THRUSTER.format("tail_side", "base_link", -0.6, 0, 0, 0, 1, 0)
BOW = THRUSTER.format("bow_down", "base_link", 0.6, 0, 0, 0, 0, 1)
MIDDLE = THRUSTER.format("down", "base_link", 0.03, 0, 0, 0, 0, 1)


def torpedo(folder: Path, *thrusters: str) -> Simulation:
    (folder / "torpedo.urdf").write_text(ROBOT)
    (folder / "torpedo.xml").write_text(WATER.format("\n".join(thrusters)))
    (folder / "scene.xml").write_text(SCENE)
    return open_scene(read_scene(folder / "scene.xml"))


def drive(simulation: Simulation, surge: float, seconds: float) -> np.ndarray:
    """Depth and lean of each second, (n, 2) [m, deg]."""
    zero = Vector3(x=0.0, y=0.0, z=0.0)
    twist = Twist(linear=Vector3(x=surge, y=0.0, z=0.0), angular=zero)
    simulation.advance(0.0)
    simulation.bus.publisher("/twist", TwistStamped)(TwistStamped(header=header(0.0), twist=twist))
    seen = []
    localized_from_world = simulation.world.model.scene.world_from_localized.inverse()
    for step in range(round(seconds / simulation.timestep)):
        simulation.advance()
        if step % 500 == 0:
            pose = localized_from_world @ simulation.world.bodies.find("torpedo").world_from_body
            lean = np.degrees(np.arcsin(-pose.rotation[2, 0]))
            seen.append((pose.position[2], lean))
    return np.array(seen)


@pytest.mark.parametrize("vertical", [TAIL, BOW], ids=["tail", "bow"])
def test_a_torpedo_that_holds_its_depth_is_not_driven_to_the_surface(
    vertical: str, tmp_path: Path
) -> None:
    seen = drive(torpedo(tmp_path, STERN, vertical, RUDDER), 0.8, 40.0)
    assert np.abs(seen[:, 1]).max() < 20.0
    assert np.abs(seen[20:, 0] - 5.5).max() < 0.7  # by pitching, for it has no heave of its own


@pytest.mark.parametrize("surge", [0.0, 0.8])
def test_a_torpedo_with_a_stern_thruster_alone_lets_go_what_it_cannot_hold(
    surge: float, tmp_path: Path
) -> None:
    low = THRUSTER.format("stern", "base_link", -0.8, 0, 0.05, 1, 0, 0)
    simulation = torpedo(tmp_path, low)
    seen = drive(simulation, surge, 30.0)
    assert np.abs(seen[:, 1]).max() < 40.0
    assert np.abs(seen[:, 0] - 5.5).max() < (1.8 if surge == 0.0 else 2.5)
    if surge == 0.0:  # nothing is tried: the thruster stands still, the hull drifts up upright
        assert simulation.world.engine._data.ctrl == pytest.approx([0.0], abs=0.05)


def test_what_was_let_go_does_not_wind_up(tmp_path: Path) -> None:
    simulation = torpedo(tmp_path, STERN)
    drive(simulation, 0.5, 30.0)
    autopilot = simulation.world.engine.actuation[0].autopilot
    assert autopilot._state["integral"][0, 1:] == pytest.approx(np.zeros(5), abs=0.0)


def test_a_small_lever_of_the_heave_thruster_is_borne_by_the_hull(tmp_path: Path) -> None:
    seen = drive(torpedo(tmp_path, STERN, MIDDLE), 0.4, 30.0)
    assert np.abs(seen[:, 0] - 5.5).max() < 0.1
    assert np.abs(seen[:, 1]).max() < 5.0


def test_thrusters_on_links_of_their_own_push_where_they_are(tmp_path: Path) -> None:
    on_links = [
        THRUSTER.format("stern", "base_link", -0.8, 0, 0, 1, 0, 0),
        THRUSTER.format("tail_down", "tail", 0, 0, 0, 0, 0, 1),
        THRUSTER.format("tail_side", "tail", 0, 0, 0, 1, 0, 0),  # the tail's x is the base's y
    ]
    there, here = tmp_path / "links", tmp_path / "base"
    there.mkdir()
    here.mkdir()
    on_link = drive(torpedo(there, *on_links), 0.6, 15.0)
    on_base = drive(torpedo(here, STERN, TAIL, RUDDER), 0.6, 15.0)
    assert on_link == pytest.approx(on_base, abs=1e-5)


def thruster(*numbers: float) -> ThrusterSpec:
    return ThrusterSpec(
        name="t", link="base_link", position=numbers[:3], direction=numbers[3:], forward=(0.0, 40.0)
    )


ORIGIN = np.zeros(3)
AHEAD = thruster(-0.8, 0, 0, 1, 0, 0)


@pytest.mark.parametrize(
    ("thrusters", "stiffness", "axes"),
    [
        ([], 10.0, ()),
        ([AHEAD], 10.0, (SURGE,)),
        ([thruster(-0.8, 0.1, 0, 1, 0, 0)], 10.0, (SURGE,)),
        ([thruster(-1, -0.1, 0, 1, 0, 0), thruster(-1, 0.1, 0, 1, 0, 0)], 10.0, (SURGE, YAW)),
        ([AHEAD, thruster(-0.6, 0, 0, 0, 1, 0)], 10.0, (SURGE, YAW)),
        ([AHEAD, thruster(-0.6, 0, 0, 0, 0, 1)], 10.0, (SURGE, PITCH)),
        ([AHEAD, thruster(-0.6, 0, 0, 0, 0, 1)], 1e4, (SURGE, HEAVE)),
        ([AHEAD, thruster(0.03, 0, 0, 0, 0, 1)], 10.0, (SURGE, HEAVE)),
        ([AHEAD, thruster(0.03, 0, 0, 0, 0, 1)], -1.0, (SURGE, PITCH)),
        ([AHEAD, thruster(0.6, 0, 0, 0, 0, 1), thruster(-0.6, 0, 0, 0, 0, 1)], 10.0,
         (SURGE, HEAVE, PITCH)),
        ([thruster(0, 0.3, 0, 0, 0, 1), thruster(0, -0.3, 0, 0, 0, 1)], 10.0, (HEAVE, ROLL)),
        ([thruster(0, 0, 0.5, 0, 1, 0)], 10.0, (SWAY,)),
    ],
)  # fmt: skip
def test_the_axes_that_thrusters_drive(
    thrusters: list[ThrusterSpec], stiffness: float, axes: tuple[int, ...]
) -> None:
    found = allocate(thrusters, ORIGIN, stiffness)
    assert found.axes == axes
    # what is driven is driven alone, and as said
    assert found.driven_wrenches @ found.inverse_allocation_matrix == pytest.approx(
        np.eye(len(axes)), abs=1e-9
    )


@pytest.mark.parametrize("name", ["g500_physical", "uwsim_compat", "bluerov2_heavy", "rexrov"])
def test_bundled_vehicles_drive_all_that_keeps_a_place(name: str) -> None:
    robot = read_urdf(
        DATA / "scenes" / "g500ARM5.urdf"
        if name in ("g500_physical", "uwsim_compat")
        else DATA / "vehicles" / f"{name}.urdf"
    )
    vehicle = read_vehicle(find_vehicle(name))
    body = vehicle.body(robot.root)
    assert body is not None
    up = np.array([0.0, 0.0, 1.0 if name == "rexrov" else -1.0])
    balance = balance_of(robot, vehicle)
    found = allocate(vehicle.thrusters, np.array(body.reference), balance.stiffness(up))
    assert {SURGE, SWAY, HEAVE, PITCH, YAW} <= set(found.axes)
    for axis in (SURGE, SWAY, HEAVE):
        assert found.force_limits(axis) == found.thruster_limits(axis)
    assert 0.98 < balance.displaced_mass / balance.mass < 1.03
    assert thrusters_on_base(robot, vehicle.thrusters) == vehicle.thrusters


def test_a_force_that_leans_the_hull_is_asked_for_as_far_as_it_rights_itself() -> None:
    found = allocate([thruster(-0.8, 0, 0.1, 1, 0, 0)], ORIGIN, 10.0)
    assert found.thruster_limits(SURGE) == pytest.approx((-40.0, 40.0))
    assert found.force_limits(SURGE)[1] == pytest.approx(10.0 * np.sin(np.radians(20.0)) / 0.1)


def test_weight_and_righting_of_a_vehicle_with_an_arm_are_those_of_the_engine() -> None:
    import mujoco

    scene = read_scene(DATA / "scenes" / "currents-scene.xml").nominal_scene
    simulation = open_scene(scene)
    model, data = simulation.world.engine._model, simulation.world.engine._data
    vehicle = read_vehicle(find_vehicle("g500_physical"))
    balance = balance_of(simulation.world.model.robots[0], vehicle, scene.vehicles[0].joint_values)
    mujoco.mj_forward(model, data)
    base = simulation.world.engine.poses.base(0)
    rotation = data.xmat[base].reshape(3, 3).copy()
    world = data.xpos[base] + rotation @ balance.centre_of_mass
    # the engine gives 10 g to each link without a mass
    assert world == pytest.approx(data.subtree_com[base], abs=1e-3)
    assert balance.mass == pytest.approx(model.body_subtreemass[base], rel=1e-3)
    moments = []
    for lean in (0.0, np.radians(1.0)):
        turned = rotation @ rotation_from_rpy(lean, 0.0, 0.0)
        data.qpos[3:7] = quaternion_from_rotation(turned)
        mujoco.mj_forward(model, data)
        force = data.qfrc_passive - data.qfrc_bias
        moments.append(force[3] - (np.cross(balance.centre_of_mass, force[:3]))[0])
    stiffness = -(moments[1] - moments[0]) / np.radians(1.0)
    assert stiffness == pytest.approx(balance.stiffness(rotation[2]), rel=0.02)


def said_of(folder: Path, *thrusters: str) -> list[str]:
    simulation = torpedo(folder, *thrusters)
    checked = [
        diagnostic
        for diagnostic in check_file(folder / "scene.xml")
        if "drive" in diagnostic.message
    ]
    assert checked == model_warnings(simulation.world.model)
    assert all((diagnostic.severity, diagnostic.line) == ("warning", 5) for diagnostic in checked)
    return [diagnostic.message for diagnostic in checked]


def test_what_thrusters_cannot_give_is_reported_at_the_start_and_by_check(tmp_path: Path) -> None:
    (said,) = said_of(tmp_path, STERN)
    assert said.startswith(
        "the vehicle 'torpedo': its thrusters (1) drive surge (-40 to 40 N); expected surge, sway, "
        "heave and yaw. Not held: sway, depth (heave), heading (yaw)"
    )
    (said,) = said_of(tmp_path, STERN, TAIL, RUDDER)
    assert "surge (-40 to 40 N), pitch (-24 to 24 N m), yaw (-24 to 24 N m)" in said
    assert "sway is driven only together with yaw; heave is driven only together with pitch" in said
    assert "depth is held by pitching while it moves ahead" in said
    assert said.endswith("If intended: <u:accept>thrust</u:accept>")
    scene = (tmp_path / "scene.xml").read_text()
    (tmp_path / "scene.xml").write_text(
        scene.replace("</u:dynamics>", "</u:dynamics> <u:accept>thrust</u:accept>")
    )
    assert [f for f in check_file(tmp_path / "scene.xml") if "drive" in f.message] == []
    assert model_warnings(open_scene(read_scene(tmp_path / "scene.xml")).world.model) == []


def test_nothing_is_reported_of_the_bundled_scene() -> None:
    assert (
        model_warnings(
            open_scene(read_scene(DATA / "scenes" / "currents-scene.xml").nominal_scene).world.model
        )
        == []
    )
