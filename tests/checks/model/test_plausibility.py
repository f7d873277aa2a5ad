"""What seems not to be meant is asked about, with its line, until the file says that it is."""

from __future__ import annotations

import json
import os
import re
from importlib import resources
from pathlib import Path
from typing import get_args

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.checks import check_file, model_warnings, scene_warnings
from uwsim.checks.model.vehicles import describe_size
from uwsim.cli.app import main
from uwsim.errors import Diagnostic
from uwsim.model.collision.hull import Hull, LinkBox
from uwsim.scene.accepted_warnings import PLAUSIBILITY_WARNINGS, VehicleWarning
from uwsim.scene.reader import read_scene
from uwsim.scene.urdf.robot import LinkSpec, RobotSpec

ORIGINALS = os.environ.get("UWSIM_ORIGINALS")
DATA = Path(str(resources.files("uwsim"))) / "data"
ROBOT = """<robot name="rov">
  <link name="base_link">
    <inertial> <mass value="19.9"/>
      <inertia ixx="0.5" iyy="0.6" izz="0.7" ixy="0" ixz="0" iyz="0"/> </inertial>
    <collision> <geometry> <box size="0.5 0.4 0.3"/> </geometry> </collision>
  </link>
  <link name="jaw"> <collision> <geometry> <box size="0.1 0.1 0.1"/> </geometry> </collision>
  </link>
  <joint name="grip" type="revolute"> <origin xyz="0.3 0 0"/> <axis xyz="0 0 1"/>
    <parent link="base_link"/> <child link="jaw"/> <limit lower="-1" upper="1"/> </joint>
</robot>"""
BODY = """<volume>0.0201</volume>
    <linearDamping>5 8 8 0.5 0.5 0.5</linearDamping>
    <centreOfBuoyancy> <x>0</x> <y>0</y> <z>-0.06</z> </centreOfBuoyancy>"""
THRUSTER = """<thruster name="{}" link="base_link">
    <position> {} </position> <direction> {} </direction> <forward>0 40</forward>
  </thruster>"""
PORT = "<x>-0.2</x> <y>-0.15</y> <z>0</z>"
STARBOARD = "<x>-0.2</x> <y>0.15</y> <z>0</z>"
MIDDLE = "<x>0</x> <y>0</y> <z>0</z>"
X, Y, Z = (f"<x>{x}</x> <y>{y}</y> <z>{z}</z>" for x, y, z in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
WATER = f"""<hydrodynamics name="rov">
  <body link="base_link"> {BODY} </body>
  <body link="jaw"> <mass>0.1</mass> </body>
  {THRUSTER.format("port", PORT, X)} {THRUSTER.format("starboard", STARBOARD, X)}
  {THRUSTER.format("side", MIDDLE, Y)} {THRUSTER.format("down", MIDDLE, Z)}
</hydrodynamics>"""
SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <simParams> <offsetr> <x>M_PI</x> <y>0</y> <z>-M_PI_2</z> </offsetr> </simParams>
  <vehicle>
    <name>rov</name> <file>rov.urdf</file>
    <position> <x>0</x> <y>0</y> <z>3</z> </position>
    <u:dynamics>rov</u:dynamics>
  </vehicle>
  <object> <name>terrain</name> <file>floor.obj</file>
    <position> <x>0</x> <y>0</y> <z>5</z> </position> </object>
  <object> <name>box</name> <file>cube.obj</file>
    <position> <x>2</x> <y>0</y> <z>4.7</z> </position>
    <physics> <mass>1</mass> </physics> </object>
</UWSimScene>"""
FLOOR = """v -20 -20 0
v 20 -20 0
v 20 20 0
v -20 20 0
f 1 4 3
f 1 3 2
"""
CUBE = (
    "".join(f"v {x} {y} {z}\n" for x in (-0.2, 0.2) for y in (-0.2, 0.2) for z in (-0.2, 0.2))
    + "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"
)


def written(folder: Path, *, robot: str = ROBOT, water: str = WATER, scene: str = SCENE) -> Path:
    for name, text in (
        ("rov.urdf", robot), ("rov.xml", water), ("floor.obj", FLOOR), ("cube.obj", CUBE),
        ("scene.xml", scene),
    ):  # fmt: skip
        (folder / name).write_text(text)
    return folder / "scene.xml"


def asked(path: Path) -> list[Diagnostic]:
    """What `check` asks about; the same as the simulation knows."""
    found = [diagnostic for diagnostic in check_file(path) if "<u:accept>" in diagnostic.message]
    assert scene_warnings(read_scene(path), ()) == found
    return found


def test_nothing_is_asked_about_a_sound_vehicle(tmp_path: Path) -> None:
    assert check_file(written(tmp_path)) == []


WRONG = {
    "sinks": (
        "buoyancy",
        "water",
        "0.0201",
        "0.015",
        "20 kg and displaces 15 kg of water: it sinks with 49.1 N",
    ),
    "rises": (
        "buoyancy",
        "water",
        "0.0201",
        "0.03",
        "displaces 30 kg of water: it rises with 98.1 N",
    ),
    "no volume": (
        "buoyancy",
        "water",
        "<volume>0.0201</volume>",
        "",
        "displaces 0 kg of water: it sinks",
    ),
    "no room": (
        "buoyancy",
        "robot",
        'size="0.5 0.4 0.3"',
        'size="0.15 0.2 0.1"',
        "it displaces 0.0201 m3 and the boxes around its links have 0.004 m3",
    ),
    "capsizes": (
        "balance",
        "water",
        "<z>-0.06</z>",
        "<z>0.06</z>",
        "its centre of buoyancy is 0.06 m below its centre of mass at the start",
    ),
    "upside down": (
        "balance",
        "scene",
        "</position>\n    <u:dyn",
        "</position> <orientation> <r>M_PI</r> <p>0</p> <y>0</y> </orientation>\n    <u:dyn",
        "If it begins upside down",
    ),
    "millimetres": (
        "size",
        "robot",
        'size="0.5 0.4 0.3"',
        'size="500 400 300"',
        "it is 500 m long, its link 'base_link' 500 m; expected 0.05 to 50 m",
    ),
    "a thruster in cm": (
        "places",
        "water",
        "<x>-0.2</x> <y>0.15</y>",
        "<x>-20</x> <y>15</y>",
        "far from its hull, which is 0.6 m long, is its thruster 'starboard' 24.7 m",
    ),
    "buoyancy in mm": (
        "places",
        "water",
        "<z>-0.06</z>",
        "<z>-60</z>",
        "is its centre of buoyancy 59.8 m",
    ),
    "kN for N": (
        "strength",
        "water",
        "0 40",
        "0 40000",
        "its thruster 'port' gives 4e+04 N for 20 kg",
    ),
    "no inertia": (
        "inertia",
        "robot",
        'ixx="0.5" iyy="0.6" izz="0.7"',
        'ixx="0" iyy="0" izz="0"',
        "link 'base_link' has 19.9 kg and the inertia 0 0 0 (it is simulated with 0.0001); a box "
        "of its size, 0.5 0.4 0.3 m, has 0.68 kg m2 at most",
    ),
    "negative inertia": ("inertia", "robot", 'ixx="0.5"', 'ixx="-0.5"', "the inertia -0.5 0.6 0.7"),
    "inertia in kg mm2": (
        "inertia",
        "robot",
        'ixx="0.5" iyy="0.6" izz="0.7"',
        'ixx="500" iyy="600" izz="700"',
        "0.5 0.4 0.3 m, has 0.68 kg m2 at most",
    ),
    "drag without mass": (
        "drag",
        "water",
        '<body link="jaw"> <mass>0.1</mass> </body>',
        '<body link="jaw"> <linearDamping>1 1 1 0 0 0</linearDamping> </body>',
        "its link 'jaw' has drag and no mass",
    ),
    "drag that stops": (
        "drag",
        "water",
        "5 8 8 0.5",
        "5e4 8 8 0.5",
        "which stops it in a step",
    ),
    "friction of a placeholder": (
        "friction",
        "robot",
        '<limit lower="-1" upper="1"/>',
        '<limit lower="-1" upper="1" effort="10"/> <dynamics friction="1e7"/>',
        "the dry friction of its joint 'grip' (1e+07 of 10) is more than its effort",
    ),
    "in the air": (
        "start",
        "scene",
        "<z>3</z>",
        "<z>-3</z>",
        "it begins 2.85 m above the water and falls; expected a position in it (up is -z in",
    ),
    "under the floor": (
        "start",
        "scene",
        "<z>3</z>",
        "<z>8</z>",
        "it begins under the surface of 'terrain', its middle 3 m deep",
    ),
    "in the floor": (
        "start",
        "scene",
        "<z>3</z>",
        "<z>4.95</z>",
        "it begins 0.1 m deep in 'terrain'",
    ),
    "thrust": (
        "thrust",
        "water",
        THRUSTER.format("down", MIDDLE, Z),
        "",
        "Not held: depth (heave)",
    ),
}
"""Mistake: the warning, the file, what stands there, what is written instead, what is said."""


@pytest.mark.parametrize("mistake", WRONG)
def test_a_mistake_is_warned_of_until_it_is_accepted(mistake: str, tmp_path: Path) -> None:
    warning, kind, right, wrong, said = WRONG[mistake]
    texts = {"robot": ROBOT, "water": WATER, "scene": SCENE}
    assert right in texts[kind]
    texts[kind] = texts[kind].replace(right, wrong)
    found = asked(written(tmp_path, **texts))
    about = [
        diagnostic
        for diagnostic in found
        if diagnostic.message.endswith(f"<u:accept>{warning}</u:accept>")
    ]
    assert len(about) == 1
    assert about[0].message.startswith("the vehicle 'rov': ")
    assert said in about[0].message
    assert about[0].severity == "warning"
    lines = texts["scene"].splitlines()
    place = {"size": "<file>", "start": "<position>"}.get(warning, "<u:dynamics>")
    assert about[0].line is not None
    assert place in lines[about[0].line - 1]
    others = {re.search(r"accept>(\w+)<", diagnostic.message)[1] for diagnostic in found}  # type: ignore[index]
    texts["scene"] = texts["scene"].replace(
        "</u:dynamics>",
        "</u:dynamics>" + "".join(f" <u:accept>{other}</u:accept>" for other in others),
    )
    assert asked(written(tmp_path, **texts)) == []


def test_a_vehicle_smaller_than_a_hand_is_asked_about() -> None:
    robot = RobotSpec(name="r", root="hull", links=(LinkSpec(name="hull"),), joints=())
    hull = Hull({"hull": LinkBox(np.zeros(3), np.full(3, 0.002), 8e-9)})
    assert describe_size(hull, robot).startswith(
        "it is 0.002 m long, its link 'hull' 0.002 m; expected"
    )


def test_a_light_link_without_inertia_is_not_asked_about(tmp_path: Path) -> None:
    water = WATER.replace('<body link="jaw"> </body>', '<body link="jaw"> <mass>0.1</mass> </body>')
    assert asked(written(tmp_path, water=water)) == []


def test_info_shows_what_is_asked(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = written(tmp_path, water=WATER.replace("0.0201", "0.03"))
    assert main(["info", str(path), "--json"]) == 0
    (warning,) = json.loads(capsys.readouterr().out)["warnings"]
    assert "it rises with 98.1 N" in warning


def test_where_a_camera_looks_is_reported_of_the_vehicle_on_the_floor(tmp_path: Path) -> None:
    camera = """<u:dynamics>rov</u:dynamics> <u:onFloor/>
    <virtualCamera> <name>eye</name> <relativeTo>base_link</relativeTo>
      <u:lookAt> <x>0</x> <y>0</y> <z>4</z> </u:lookAt> </virtualCamera>"""
    scene = SCENE.replace("<u:dynamics>rov</u:dynamics>", camera)
    (diagnostic,) = check_file(written(tmp_path, scene=scene))
    assert diagnostic.message.startswith("'eye' looks up; ")


def test_a_loose_object_that_begins_in_the_floor_is_asked_about(tmp_path: Path) -> None:
    scene = SCENE.replace("<z>4.7</z>", "<z>4.9</z>")
    (diagnostic,) = asked(written(tmp_path, scene=scene))
    assert "the object 'box': it begins 0.1 m deep in 'terrain'" in diagnostic.message
    assert diagnostic.line == 11
    accepted = scene.replace("</physics>", "</physics> <u:accept>start</u:accept>")
    assert asked(written(tmp_path, scene=accepted)) == []
    on_floor = scene.replace("</physics>", "</physics> <u:onFloor/>")
    assert asked(written(tmp_path, scene=on_floor)) == []


def test_a_kinematic_vehicle_is_asked_about_its_size_and_the_floor_only(tmp_path: Path) -> None:
    scene = SCENE.replace("    <u:dynamics>rov</u:dynamics>\n", "").replace("<z>3</z>", "<z>8</z>")
    robot = ROBOT.replace('size="0.5 0.4 0.3"', 'size="1500 400 300"')
    said = [diagnostic.message for diagnostic in asked(written(tmp_path, robot=robot, scene=scene))]
    assert ["it is 1500 m long" in said[0], "under the surface of 'terrain'" in said[1]] == [
        True
    ] * 2
    assert len(said) == 2


def test_render_says_it_before_it_draws(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    turned = "</position> <orientation> <r>0</r> <p>0</p> <y>90</y> </orientation>"
    scene = SCENE.replace("</position>", turned, 1)
    path = written(tmp_path, water=WATER.replace("0.0201", "0.03"), scene=scene)
    assert main(["render", str(path), "-o", str(tmp_path / "a.png"), "--size", "8x8"]) == 0
    said = capsys.readouterr().err
    assert f"{path}:6: warning: the vehicle 'rov': it has 20 kg" in said
    assert "<orientation> is 0 0 90 in radians, more than a turn" in said


@pytest.mark.parametrize("name", sorted(path.stem for path in (DATA / "scenes").glob("*.xml")))
def test_nothing_is_asked_about_a_bundled_scene(name: str) -> None:
    assert scene_warnings(read_scene(DATA / "scenes" / f"{name}.xml"), ()) == []


@pytest.mark.skipif(ORIGINALS is None, reason="UWSIM_ORIGINALS is not set")
def test_nothing_is_asked_about_the_originals_scenes() -> None:
    scenes = sorted(Path(ORIGINALS or "").rglob("scenes/*.xml"))
    assert scenes
    assert [scene_warnings(read_scene(path), ()) for path in scenes] == [[]] * len(scenes)


@pytest.mark.parametrize(
    ("robot", "dynamics", "roll"),
    [
        ("data/scenes/g500ARM5.urdf", "g500_physical", 0),
        ("data/scenes/g500ARM5.urdf", "uwsim_compat", 0),
        ("bluerov2_heavy.urdf", "bluerov2_heavy", 0),
        ("rexrov.urdf", "rexrov", "M_PI"),
    ],
)
def test_nothing_is_asked_about_a_bundled_vehicle(
    robot: str, dynamics: str, roll: object, tmp_path: Path
) -> None:
    place = f"</position> <orientation> <r>{roll}</r> <p>0</p> <y>0</y> </orientation>"
    scene = SCENE.replace("rov.urdf", robot).replace(">rov</u:dyn", f">{dynamics}</u:dyn")
    scene = scene.replace("</position>", place, 1).replace("<z>3</z>", "<z>2.5</z>")
    assert asked(written(tmp_path, scene=scene)) == []


def test_every_doubt_has_a_name_and_a_sentence() -> None:
    assert tuple(PLAUSIBILITY_WARNINGS) == get_args(VehicleWarning)


def test_the_model_of_a_sound_scene_has_no_warnings(tmp_path: Path) -> None:
    simulation = open_scene(read_scene(written(tmp_path)), is_blind=True)
    assert model_warnings(simulation.world.model) == []


DVL = "<dvlSensor> <name>log</name> <relativeTo>base_link</relativeTo> {} </dvlSensor>"
ASIDE = "<orientation> <r>M_PI_2</r> <p>0</p> <y>0</y> </orientation>"
BLIND = {
    "up": ("<u:lookAt>up</u:lookAt>", "It looks up; its x axis points aft, and its beams"),
    "too high": ("<u:maxAltitude>1</u:maxAltitude>", "at 2 to 2 m; expected 3 hits or more"),
    "too low": ("<u:minAltitude>2.5</u:minAltitude>", "expected 3 hits or more at 2.5 to 81 m"),
    "sideways": (ASIDE, "It looks port"),
}


@pytest.mark.parametrize("name", BLIND)
def test_a_dvl_that_finds_no_bottom_at_the_start_is_reported(tmp_path: Path, name: str) -> None:
    part, text = BLIND[name]
    scene = SCENE.replace("    <u:dynamics>", f"    {DVL.format(part)} <u:dynamics>", 1)
    (found,) = asked(written(tmp_path, scene=scene))
    assert found.message.startswith("'log': it has no bottom track at the start. ")
    assert text in found.message
    accepted = scene.replace("</u:dynamics>", "</u:dynamics> <u:accept>bottom</u:accept>")
    assert asked(written(tmp_path, scene=accepted)) == []


@pytest.mark.parametrize("part", ["", "<u:lookAt>down</u:lookAt>"])
def test_a_dvl_above_the_bottom_is_not_reported(tmp_path: Path, part: str) -> None:
    scene = SCENE.replace("    <u:dynamics>", f"    {DVL.format(part)} <u:dynamics>", 1)
    assert asked(written(tmp_path, scene=scene)) == []
