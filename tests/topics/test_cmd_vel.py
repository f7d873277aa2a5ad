"""``cmd_vel`` of common teleoperation programs, and the multibeam as a cloud of points."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from lxml import etree

from scripts.reference.relax_ng import scene_grammar
from tests.support.opened import open_scene
from uwsim.base.geometry import Pose
from uwsim.checks import check_file
from uwsim.messages import LaserScan, PointCloud2, Twist, Vector3, points
from uwsim.scene.reader import read_scene

UP, DOWN = "<r>0</r>", "<r>M_PI</r>"  # of the base's z axis, as roll
SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle>
    <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <position> <x>0</x> <y>0</y> <z>-5</z> </position>
    <orientation> {roll} <p>0</p> <y>0.5</y> </orientation>
    <multibeamSensor>
      <name>beams</name> <relativeTo>base_link</relativeTo>
      <position> <x>0.4</x> <y>0</y> <z>0</z> </position>
      <orientation> <r>0.1</r> <p>{pitch}</p> <y>0</y> </orientation>
      <initAngle>-40</initAngle> <finalAngle>40</finalAngle> <angleIncr>4</angleIncr>
      <range>4.2</range>
    </multibeamSensor>
    {dynamics}
  </vehicle>
  <object>
    <name>floor</name> <file>objects/box</file> <position> <x>0</x> <y>0</y> <z>-9</z> </position>
    <scaleFactor> <x>8</x> <y>8</y> <z>1</z> </scaleFactor>
  </object>
  <rosInterfaces>
    <u:ROSCmdVelToPAT> <{u}topic>/cmd_vel</{u}topic> <{u}vehicleName>rov</{u}vehicleName>
    </u:ROSCmdVelToPAT>
    <multibeamSensorToLaserScan> <name>beams</name> <topic>/scan</topic>
    </multibeamSensorToLaserScan>
    <u:multibeamToPointCloud2> <name>beams</name> <topic>/points</topic>
    </u:multibeamToPointCloud2>
  </rosInterfaces>
</UWSimScene>
"""


def write(folder: Path, *, roll: str = UP, dynamics: str = "", u: str = "") -> Path:
    path = folder / "scene.xml"
    pitch = "0" if roll == UP else "M_PI"
    path.write_text(SCENE.format(roll=roll, dynamics=dynamics, u=u, pitch=pitch))
    return path


def moved(path: Path, twist: Twist, time: float = 1.0) -> tuple[Pose, Pose]:
    """Where the vehicle was and is, after commands at 20 Hz."""
    with open_scene(read_scene(path), is_blind=True) as simulation:
        publish = simulation.bus.publisher("/cmd_vel", Twist)
        before = simulation.pose("rov", "W")
        for _ in range(round(20 * time)):
            publish(twist)
            simulation.advance(0.05)
        return before, simulation.pose("rov", "W")


MOVES = [
    (Twist(linear=Vector3(0.4, 0.0, 0.0)), "forward"),
    (Twist(linear=Vector3(0.0, 0.4, 0.0)), "left"),
    (Twist(linear=Vector3(0.0, 0.0, 0.4)), "up"),
    (Twist(angular=Vector3(0.0, 0.0, 0.3)), "turn left"),
]
DYNAMICS = "<u:dynamics>bluerov2_heavy</u:dynamics>"


@pytest.mark.parametrize(
    ("roll", "dynamics"),
    [(UP, ""), (DOWN, ""), (UP, DYNAMICS)],  # bluerov2_heavy floats upright
    ids=["z up", "z down", "simulated"],
)
@pytest.mark.parametrize(("twist", "way"), MOVES, ids=[way for _, way in MOVES])
def test_a_twist_is_forward_left_and_up_whatever_the_axes_of_the_vehicle(
    tmp_path: Path, twist: Twist, way: str, roll: str, dynamics: str
) -> None:
    before, after = moved(write(tmp_path, roll=roll, dynamics=dynamics), twist)
    ahead = before.rotation[:, 0]
    left = np.cross([0.0, 0.0, 1.0], ahead)
    way_moved = after.position - before.position
    if way == "turn left":
        assert 0.1 < float(np.dot(np.cross(ahead, after.rotation[:, 0]), [0.0, 0.0, 1.0])) < 0.4
        return
    direction = {"forward": ahead, "left": left, "up": np.array([0.0, 0.0, 1.0])}[way]
    assert 0.15 < float(np.dot(way_moved, direction)) < 0.5
    assert np.linalg.norm(way_moved - direction * np.dot(way_moved, direction)) < 0.1


@pytest.mark.parametrize("u", ["", "u:"])
def test_children_of_an_interface_of_ours_may_have_the_prefix_or_not(
    tmp_path: Path, u: str
) -> None:
    path = write(tmp_path, u="")
    thrusters = "<u:ROSThrustersToPAT> <{u}topic>/t</{u}topic> <{u}vehicleName>rov</{u}vehicleName>"
    extra = thrusters.format(u=u) + "</u:ROSThrustersToPAT></rosInterfaces>"
    text = path.read_text().replace("</rosInterfaces>", extra)
    path.write_text(text.replace("</vehicle>", f"{DYNAMICS}</vehicle>"))
    assert [each.message for each in check_file(path) if "ROSThrusters" in each.message] == []
    assert read_scene(path).ros_interfaces[-1].topic == "/t"  # type: ignore[attr-defined]
    grammar = etree.RelaxNG(etree.fromstring(scene_grammar().encode()))
    grammar.assertValid(etree.fromstring(path.read_text().encode()))


def test_the_cloud_has_the_points_of_the_scan_that_hit(tmp_path: Path) -> None:
    with open_scene(read_scene(write(tmp_path)), is_blind=True) as simulation:
        scans = simulation.bus.inbox("/scan", LaserScan)
        clouds = simulation.bus.inbox("/points", PointCloud2)
        simulation.advance(0.3)
        scan, cloud = scans.last_message, clouds.last_message
        assert scan is not None
        assert cloud is not None
        assert cloud.header == scan.header
        found = points(cloud)
        is_hit = scan.ranges < np.float32(scan.range_max)
        assert 5 < is_hit.sum() < len(scan.ranges)  # some beams miss
        assert np.linalg.norm(found, axis=1) == pytest.approx(scan.ranges[is_hit], rel=1e-6)
        frame = simulation.world.sensors.sensor("beams", ("multibeamSensor",))
        assert frame is not None
        bearings = np.arctan2(found[:, 1], found[:, 0])
        angles = scan.angle_min + scan.angle_increment * np.arange(len(scan.ranges))
        assert bearings == pytest.approx(angles[is_hit], abs=1e-6)
