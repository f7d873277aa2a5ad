"""An imported vehicle has the numbers of its SDF file, and moves as these numbers say."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import uwsim
from tests.importing.sdf_files import ROV, import_text, link, matrix, write_in_model
from uwsim.bus import Node
from uwsim.importing import Import
from uwsim.messages import Float64MultiArray, Odometry
from uwsim.scene.hydrodynamics.spec import VehicleHydrodynamics
from uwsim.scene.hydrodynamics.vehicle_file import read_vehicle
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec
from uwsim.scene.urdf.kinematics import link_poses
from uwsim.scene.urdf.reader import read_urdf
from uwsim.scene.urdf.robot import RobotSpec

ImportedFiles = tuple[Import, SceneSpec, RobotSpec, VehicleHydrodynamics]


def read_all(result: Import, name: str = "rov") -> ImportedFiles:
    folder = result.scene.parent
    robot = read_urdf(folder / f"{name}.urdf")
    links = [entry.name for entry in robot.links]
    return result, read_scene(result.scene), robot, read_vehicle(folder / f"{name}.xml", links)


@pytest.fixture(scope="module")
def rov(tmp_path_factory: pytest.TempPathFactory) -> ImportedFiles:
    return read_all(import_text(tmp_path_factory.mktemp("rov"), ROV))


def test_mass_and_inertia_are_those_of_the_file(rov: ImportedFiles) -> None:
    base = rov[2].link("base_link")
    assert base is not None
    assert base.mass == 20.0
    assert base.centre_of_mass == (0.01, 0.02, -0.03)
    assert base.inertia == (0.5, 0.6, 0.7, 0.01, -0.02, 0.03)


def test_volume_and_its_centre_are_those_of_the_collision_shapes(rov: ImportedFiles) -> None:
    body = rov[3].bodies[0]
    box, tube = 0.5 * 0.4 * 0.08, math.pi * 0.05**2 * 0.5
    assert body.volume == pytest.approx(box + tube, rel=1e-8)
    centre = np.array([0.1 * tube, 0.0, 0.1 * box]) / (box + tube)
    assert body.centre_of_buoyancy == pytest.approx(tuple(centre), abs=1e-8)


def test_derivatives_become_positive_coefficients(rov: ImportedFiles) -> None:
    body = rov[3].bodies[0]
    assert body.link == "base_link"
    assert body.added_mass == (8.0, 15.0, 16.0, 0.3, 0.4, 0.45)
    assert body.linear_damping == (5.0, 8.0, 9.0, 0.5, 0.6, 0.7)
    assert body.quadratic_damping == (50.0, 90.0, 110.0, 2.0, 3.0, 4.0)


def test_thruster_pushes_along_the_axis_of_its_joint(rov: ImportedFiles) -> None:
    thruster = rov[3].thrusters[0]
    base_from_link = link_poses(rov[2])[thruster.link]
    expected = matrix(-0.3, 0.1, 0.0, 0.0, math.radians(90), math.radians(30))
    direction = base_from_link.rotation @ np.array(thruster.direction)
    assert direction == pytest.approx(expected[:3, 2], abs=1e-8)
    position = base_from_link.transform(np.array(thruster.position))
    assert position == pytest.approx(expected[:3, 3], abs=1e-8)
    assert (thruster.forward, thruster.backward) == ((40.0,), (30.0,))
    assert thruster.radius == 0.04


def test_vehicle_begins_at_the_pose_of_the_model(rov: ImportedFiles) -> None:
    pose = rov[1].vehicles[0].localized_from_base
    assert pose.matrix == pytest.approx(matrix(1, 2, -3, 0, 0, 0.5), abs=1e-8)
    assert rov[1].ocean_state.currents[0].velocity == (0.1, 0.0, 0.0)  # type: ignore[attr-defined]


def test_sensors_look_in_the_directions_of_gazebo(rov: ImportedFiles) -> None:
    parts = {part.name: part for part in rov[1].vehicles[0].parts}  # type: ignore[attr-defined]
    assert sorted(parts) == ["eye", "imu", "log"]
    camera, dvl = parts["eye"], parts["log"]
    axes = matrix(0, 0, 0, *camera.orientation)[:3, :3]  # type: ignore[attr-defined]
    assert -axes[:, 2] == pytest.approx([1, 0, 0], abs=1e-8)  # ahead
    assert axes[:, 1] == pytest.approx([0, 0, 1], abs=1e-8)  # the top of the image
    fovy = 2 * math.degrees(math.atan(math.tan(0.6) * 480 / 640))
    assert camera.fovy == pytest.approx(fovy, abs=1e-5)  # type: ignore[attr-defined]
    beams = matrix(0, 0, 0, *dvl.orientation)[:3, 2]  # type: ignore[attr-defined]
    assert beams == pytest.approx([0, 0, -1], abs=1e-8)  # down, with z up
    assert dvl.beam_angle == 25.0  # type: ignore[attr-defined]
    assert parts["imu"].gyro.noise_density == pytest.approx(0.001)  # type: ignore[attr-defined]


def test_report_has_the_line_and_the_reason_of_what_is_missing(rov: ImportedFiles) -> None:
    rows = {row.element: row for row in rov[0].report.rows if row.status == "left out"}
    assert sorted(rows) == ["plugin unknown", "sensor nose (magnetometer)"]
    lines = ROV.splitlines()
    for name, word in (("plugin unknown", "libunknown"), ("sensor nose (magnetometer)", "nose")):
        assert word in lines[rows[name].line - 1]


STRAIGHT_ROV = write_in_model(
    """
    <link name="base_link">
      <inertial> <mass>20</mass> <inertia> <ixx>0.5</ixx> <iyy>0.6</iyy> <izz>0.7</izz> </inertia>
      </inertial>
      <collision name="hull"> <geometry> <box> <size>0.5 0.2 0.2</size> </box> </geometry>
      </collision> </link>
    <link name="prop"> <pose>-0.25 0 0 0 1.5707963267948966 0</pose>
      <inertial> <mass>0.1</mass> <inertia> <ixx>1e-4</ixx> <iyy>1e-4</iyy> <izz>1e-4</izz>
      </inertia> </inertial> </link>
    <joint name="prop_joint" type="revolute"> <parent>base_link</parent> <child>prop</child>
      <axis> <xyz>0 0 1</xyz> </axis> </joint>
    <plugin filename="gz-sim-hydrodynamics-system"> <link_name>base_link</link_name>
      <xDotU>-8</xDotU> <yDotV>-8</yDotV> <zDotW>-8</zDotW> <xU>-5</xU> <xUabsU>-50</xUabsU>
      <kP>-5</kP> <mQ>-50</mQ> <nR>-50</nR> <zW>-500</zW> </plugin>
    <plugin filename="gz-sim-thruster-system"> <joint_name>prop_joint</joint_name>
      <max_thrust_cmd>40</max_thrust_cmd> </plugin>
    """,
    name="rov",
)


def test_terminal_speed_of_the_scene_is_that_of_the_closed_form(tmp_path: Path) -> None:
    """Compare with the balance of the full thrust T and the drag: 50 u^2 + 5 u = T."""
    text = STRAIGHT_ROV.replace(
        '<link name="base_link">', '<pose>0 0 -9 0 0 0</pose> <link name="base_link">'
    )
    scene = import_text(tmp_path, text).scene
    simulation = uwsim.load(scene)
    messages: list[Odometry] = []

    class AheadCommands:
        def start(self, node: Node) -> None:
            publish = node.publisher("/rov/thrusters", Float64MultiArray)
            node.subscribe("/rov/odom", Odometry, messages.append)
            node.create_timer(0.1, lambda: publish(Float64MultiArray(data=[1.0])))

    simulation.attach(AheadCommands(), name="ahead", parameters={})
    while simulation.time < 6.0:
        simulation.advance()
    expected = (-5 + math.sqrt(5**2 + 4 * 50 * 40)) / (2 * 50)
    assert messages[-1].twist.twist.linear.x == pytest.approx(expected, rel=1e-3)


def test_equal_drag_in_three_directions_stays_that_of_each_axis(tmp_path: Path) -> None:
    text = ROV.replace("-90</yVabsV>", "-50</yVabsV>").replace("-110</zWW>", "-50</zWW>")
    body = read_all(import_text(tmp_path, text))[3].bodies[0]
    assert body.drag_law == "axes"
    assert np.array(body.quadratic_damping).reshape(6, 6).diagonal()[:3].tolist() == [50.0] * 3


def test_damping_that_would_propel_is_reported(tmp_path: Path) -> None:
    result = import_text(tmp_path, ROV.replace("<xU>-5</xU>", "<xU>5</xU>"))
    row = next(row for row in result.report.rows if row.element.startswith("plugin hydro"))
    assert row.status == "changed"
    assert "propulsion" in row.reason


def test_fluid_added_mass_keeps_its_energy_in_the_frame_of_the_link(tmp_path: Path) -> None:
    """Compare the kinetic energy of a motion in the frames of the inertia and of the link."""
    rows = {"xx": 5, "yy": 6, "zz": 7, "pp": 0.5, "qq": 0.6, "rr": 0.7, "xy": 0.4, "yr": 0.3}
    numbers = " ".join(f"<{name}>{value}</{name}>" for name, value in rows.items())
    inertial = (
        "<inertial> <pose>0.1 0.2 0.3 0.4 0.5 0.6</pose> <mass>3</mass> <inertia> <ixx>1</ixx> "
        f"</inertia> <fluid_added_mass> {numbers} </fluid_added_mass> </inertial>"
    )
    plugin = (
        '<plugin filename="gz-sim-hydrodynamics-system"> <link_name>a</link_name> '
        "<xU>-1</xU> </plugin>"
    )
    text = write_in_model(f'<link name="a"> {inertial} </link> {plugin}', name="rov")
    body = read_all(import_text(tmp_path, text))[3].bodies[0]
    added_mass = np.array(body.added_mass).reshape(6, 6)
    original = np.zeros((6, 6))
    for name, value in rows.items():
        i, j = ("xyzpqr".index(letter) for letter in name)
        original[i, j] = original[j, i] = value
    link_from_inertial = matrix(0.1, 0.2, 0.3, 0.4, 0.5, 0.6)
    rotation, position = link_from_inertial[:3, :3], link_from_inertial[:3, 3]
    velocity, rate = np.array([0.3, -0.2, 0.5]), np.array([0.2, 0.1, -0.4])
    at_inertial = np.concatenate(
        [rotation.T @ (velocity + np.cross(rate, position)), rotation.T @ rate]
    )
    at_link = np.concatenate([velocity, rate])
    assert at_link @ added_mass @ at_link == pytest.approx(at_inertial @ original @ at_inertial)


UUV = """
<plugin name="uuv_plugin" filename="libuuv_underwater_object_ros_plugin.so">
  <fluid_density>1028</fluid_density>
  <link name="rov/base_link"> <volume>0.02</volume>
    <center_of_buoyancy>0 0 0.05</center_of_buoyancy>
    <box> <width>0.4</width> <length>0.6</length> <height>0.3</height> </box>
    <hydrodynamic_model> <type>fossen</type>
      <added_mass> 5 0 0 0 -0.5 0  0 6 0 0.4 0 0  0 0 7 0 0 0
                   0 0.4 0 0.3 0 0  -0.5 0 0 0 0.4 0  0 0 0 0 0 0.5 </added_mass>
      <linear_damping>-1 -2 -3 -0.1 -0.2 -0.3</linear_damping>
      <quadratic_damping>-10 -20 -30 -1 -2 -3</quadratic_damping>
    </hydrodynamic_model>
  </link>
</plugin>
<plugin name="thruster" filename="libuuv_thruster_ros_plugin.so">
  <linkName>rov/prop</linkName> <jointName>rov/prop_joint</jointName>
  <clampMin>-50</clampMin> <clampMax>100</clampMax>
  <dynamics> <type>FirstOrder</type> <timeConstant>0.05</timeConstant> </dynamics>
  <conversion> <type>Basic</type> <rotorConstant>0.004</rotorConstant> </conversion>
</plugin>
"""


def test_plug_ins_of_uuv_simulator_are_read(tmp_path: Path) -> None:
    joint = (
        '<joint name="prop_joint" type="continuous"> <parent>base_link</parent> '
        "<child>prop</child> <axis> <xyz>1 0 0</xyz> </axis> </joint>"
    )
    text = write_in_model(
        link("base_link") + link("prop", "-1 0 0 0 0 0") + joint + UUV, name="rov"
    )
    vehicle = read_all(import_text(tmp_path, text))[3]
    body = vehicle.body("base_link")
    assert body is not None
    assert (vehicle.density, body.volume) == (1028.0, 0.02)
    assert body.centre_of_buoyancy == (0.0, 0.0, 0.05)
    assert body.size == (0.6, 0.4, 0.3)
    added_mass = np.array(body.added_mass).reshape(6, 6)
    assert added_mass.diagonal().tolist() == [5.0, 6.0, 7.0, 0.3, 0.4, 0.5]
    assert added_mass[0, 4] == 0.5  # the axis of pitch points the other way
    assert added_mass[1, 3] == -0.4  # as does that of sway
    assert body.linear_damping == (1.0, 2.0, 3.0, 0.1, 0.2, 0.3)
    thruster = vehicle.thrusters[0]
    assert thruster.forward == (0.0, 0.004 * 100**2)
    assert thruster.backward == (0.0, 0.004 * 50**2)
    assert thruster.time_constant == 0.05


def test_fin_has_the_coefficients_of_the_lift_drag_plug_in(tmp_path: Path) -> None:
    plugin = """<plugin filename="gz-sim-lift-drag-system"> <link_name>fin</link_name>
      <cla>4.13</cla> <cda>0.2</cda> <alpha_stall>0.17</alpha_stall> <cla_stall>-1.1</cla_stall>
      <cda_stall>0.03</cda_stall> <area>0.0244</area> <upward>0 1 0</upward>
      <forward>-1 0 0</forward> </plugin>"""
    joint = (
        '<joint name="j" type="revolute"> <parent>hull</parent> <child>fin</child> <axis>'
        "<xyz>0 0 1</xyz> <limit> <lower>-0.26</lower> <upper>0.26</upper> </limit> </axis>"
        "</joint>"
    )
    text = write_in_model(link("hull") + link("fin", "-1 0 0 0 0 0") + joint + plugin, name="rov")
    fin = read_all(import_text(tmp_path, text))[3].fins[0]
    assert (fin.area, fin.chord, fin.limits) == (0.0244, (-1.0, 0.0, 0.0), (0.0, 0.0))
    assert abs(fin.axis[2]) == 1.0
    angles, lifts, drags = np.array(fin.coefficients).reshape(-1, 3).T
    for angle in (0.05, 0.17, 0.4, 0.7, 1.2):
        excess = max(angle - 0.17, 0.0)
        lift = max(4.13 * min(angle, 0.17) - 1.1 * excess, 0.0)
        drag = 0.2 * min(angle, 0.17) + 0.03 * excess
        assert np.interp(angle, angles, lifts) == pytest.approx(lift, abs=1e-6)
        assert np.interp(angle, angles, drags) == pytest.approx(drag, abs=1e-6)
