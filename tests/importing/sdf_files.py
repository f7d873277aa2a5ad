"""SDF files for the tests of the import, written by hand for these tests."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from uwsim.importing import Import, ImportRequest, import_file

BOX_LINK = """
<link name="{name}"> <pose>{pose}</pose>
  <inertial> <mass>2</mass>
    <inertia> <ixx>0.1</ixx> <iyy>0.2</iyy> <izz>0.25</izz> </inertia> </inertial>
  <collision name="hull"> <geometry> <box> <size>0.1 0.2 0.1</size> </box> </geometry> </collision>
</link>
"""

ROV = """<?xml version="1.0"?>
<sdf version="1.9">
  <model name="rov">
    <pose>1 2 -3 0 0 0.5</pose>
    <link name="base_link">
      <inertial>
        <pose>0.01 0.02 -0.03 0 0 0</pose>
        <mass>20</mass>
        <inertia> <ixx>0.5</ixx> <iyy>0.6</iyy> <izz>0.7</izz>
          <ixy>0.01</ixy> <ixz>-0.02</ixz> <iyz>0.03</iyz> </inertia>
      </inertial>
      <collision name="top"> <pose>0 0 0.1 0 0 0</pose>
        <geometry> <box> <size>0.5 0.4 0.08</size> </box> </geometry> </collision>
      <collision name="tube"> <pose>0.1 0 0 0 0 0</pose>
        <geometry> <cylinder> <radius>0.05</radius> <length>0.5</length> </cylinder> </geometry>
      </collision>
      <visual name="hull"> <geometry> <box> <size>0.5 0.4 0.3</size> </box> </geometry>
        <material> <diffuse>1 0.5 0 1</diffuse> </material> </visual>
      <sensor name="imu" type="imu"> <update_rate>100</update_rate>
        <imu> <angular_velocity> <x> <noise type="gaussian"> <stddev>0.01</stddev>
          </noise> </x> </angular_velocity> </imu> </sensor>
      <sensor name="eye" type="camera"> <pose>0.25 0 0 0 0 0</pose>
        <camera> <horizontal_fov>1.2</horizontal_fov>
          <image> <width>640</width> <height>480</height> </image> </camera> </sensor>
      <sensor name="log" type="custom" gz:type="dvl"> <pose>0 0 -0.15 0 0 0</pose>
        <gz:dvl> <arrangement degrees="true">
          <beam> <rotation>45</rotation> <tilt>25</tilt> </beam>
          <beam> <rotation>135</rotation> <tilt>25</tilt> </beam>
          <beam> <rotation>-45</rotation> <tilt>25</tilt> </beam>
          <beam> <rotation>-135</rotation> <tilt>25</tilt> </beam> </arrangement>
          <maximum_range>80</maximum_range> </gz:dvl> </sensor>
      <sensor name="nose" type="magnetometer"/>
    </link>
    <link name="prop">
      <pose degrees="true">-0.3 0.1 0 0 90 30</pose>
      <inertial> <mass>0.1</mass>
        <inertia> <ixx>0.001</ixx> <iyy>0.001</iyy> <izz>0.001</izz> </inertia> </inertial>
    </link>
    <joint name="prop_joint" type="revolute">
      <parent>base_link</parent> <child>prop</child> <axis> <xyz>0 0 1</xyz> </axis>
    </joint>
    <plugin filename="gz-sim-hydrodynamics-system" name="gz::sim::systems::Hydrodynamics">
      <link_name>base_link</link_name>
      <xDotU>-8</xDotU> <yDotV>-15</yDotV> <zDotW>-16</zDotW>
      <kDotP>-0.3</kDotP> <mDotQ>-0.4</mDotQ> <nDotR>-0.45</nDotR>
      <xU>-5</xU> <yV>-8</yV> <zW>-9</zW> <kP>-0.5</kP> <mQ>-0.6</mQ> <nR>-0.7</nR>
      <xUabsU>-50</xUabsU> <yVabsV>-90</yVabsV> <zWW>-110</zWW>
      <kPabsP>-2</kPabsP> <mQabsQ>-3</mQabsQ> <nRabsR>-4</nRabsR>
      <default_current>0.1 0 0</default_current>
    </plugin>
    <plugin filename="gz-sim-thruster-system" name="gz::sim::systems::Thruster">
      <joint_name>prop_joint</joint_name> <propeller_diameter>0.08</propeller_diameter>
      <max_thrust_cmd>40</max_thrust_cmd> <min_thrust_cmd>-30</min_thrust_cmd>
    </plugin>
    <plugin filename="libunknown.so" name="unknown"/>
  </model>
</sdf>
"""


def import_text(folder: Path, text: str, *, folders: tuple[Path, ...] = ()) -> Import:
    """Import an SDF file with a text, into ``folder/scene``."""
    path = folder / "world.sdf"
    path.write_text(text, encoding="utf-8")
    return import_file(ImportRequest(file=path, out=folder / "scene", folders=folders))


def write_in_model(
    content: str, *, name: str = "m", version: str = "1.9", attributes: str = ""
) -> str:
    """Return an SDF file with a model."""
    return f'<sdf version="{version}"> <model name="{name}" {attributes}> {content} </model> </sdf>'


def write_in_world(content: str) -> str:
    """Return an SDF file with a world."""
    return f'<sdf version="1.9"> <world name="w"> {content} </world> </sdf>'


def link(name: str, pose: str = "0 0 0 0 0 0") -> str:
    """Return a link that is a box of 2 kg and 2 litres."""
    return BOX_LINK.format(name=name, pose=pose)


def matrix(x: float, y: float, z: float, roll: float, pitch: float, yaw: float) -> np.ndarray:
    """Return the homogeneous matrix of a pose of SDF, Rz Ry Rx, computed from its definition."""
    c, s = np.cos, np.sin
    rx = np.array([[1, 0, 0], [0, c(roll), -s(roll)], [0, s(roll), c(roll)]])
    ry = np.array([[c(pitch), 0, s(pitch)], [0, 1, 0], [-s(pitch), 0, c(pitch)]])
    rz = np.array([[c(yaw), -s(yaw), 0], [s(yaw), c(yaw), 0], [0, 0, 1]])
    result = np.eye(4)
    result[:3, :3], result[:3, 3] = rz @ ry @ rx, (x, y, z)
    return result
