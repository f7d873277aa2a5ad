"""``--xacro NAME:=VALUE`` sets an argument of the scene and of its robots."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import uwsim
from uwsim.cli import main
from uwsim.errors import SceneError
from uwsim.runs.planning.make_plan import make_plan
from uwsim.runs.planning.plan_request import PlanRequest

NAMESPACES = 'xmlns:xacro="http://ros.org/wiki/xacro" xmlns:u="urn:uwsim:1"'
SCENE = f"""<UWSimScene {NAMESPACES}>
  <xacro:arg name="depth" default="3"/>
  <vehicle> <name>rov</name> <file>rov.urdf.xacro</file>
    <position> <x>0</x> <y>0</y> <z>${{-$(arg depth)}}</z> </position>
    <orientation> <r>0</r> <p>0</p> <y>0</y> </orientation> </vehicle>
</UWSimScene>"""
ROBOT = f"""<robot name="rov" {NAMESPACES}>
  <xacro:arg name="payload" default="none"/>
  <link name="hull"/>
  <xacro:unless value="${{'$(arg payload)' == 'none'}}">
    <link name="$(arg payload)"/>
    <joint name="j" type="fixed"> <parent link="hull"/> <child link="$(arg payload)"/> </joint>
  </xacro:unless>
</robot>"""


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    (tmp_path / "rov.urdf.xacro").write_text(ROBOT)
    (tmp_path / "scene.xml").write_text(SCENE)
    return tmp_path / "scene.xml"


def call(capsys: pytest.CaptureFixture[str], *words: str | Path) -> tuple[int, str, str]:
    status = main([str(word) for word in words])
    out, err = capsys.readouterr()
    return status, out, err


def test_info_shows_the_scene_with_the_arguments(
    scene: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["info", scene, "--xacro", "depth:=7.5", "--xacro", "payload:=gripper", "--json"]
    status, out, _ = call(capsys, *words)
    (vehicle,) = json.loads(out)["vehicles"]
    assert status == 0
    assert vehicle["links"] == ["hull", "gripper"]
    assert vehicle["position"][2] == pytest.approx(-7.5)


@pytest.mark.parametrize("file", ["scene.xml", "rov.urdf.xacro"])
def test_check_reads_a_file_with_the_arguments(
    file: str, scene: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["check", scene.parent / file, "--xacro", "payload:=hull"]
    status, out, _ = call(capsys, *words)
    assert (status, "two links are called 'hull'" in out) == (2, True)
    assert call(capsys, *words[:2])[0] == 0


def test_an_argument_that_no_file_has_is_reported(
    scene: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    _, out, _ = call(capsys, "check", scene, "--xacro", "dpeth:=7")
    assert "no <xacro:arg> is called 'dpeth'" in out
    assert "Did you mean 'depth'? Arguments: depth, payload" in out
    _, out, _ = call(capsys, "check", scene, "--xacro", "payload:=x")
    assert "no <xacro:arg>" not in out


def test_an_argument_that_is_used_and_not_declared_has_a_value_from_outside(
    scene: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    robot = scene.parent / "rov.urdf.xacro"
    robot.write_text(f'<robot name="rov" {NAMESPACES}><link name="$(arg space)/hull"/></robot>')
    status, out, _ = call(capsys, "check", scene)
    assert (status, "--xacro NAME:=VALUE sets it" in out) == (2, True)
    status, out, _ = call(capsys, "check", scene, "--xacro", "space:=a")
    assert (status, "<xacro:arg>" in out) == (0, False)


@pytest.mark.parametrize("word", ["depth=7", ":=7", "depth"])
def test_what_is_no_argument_is_refused(
    word: str, scene: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    status, _, err = call(capsys, "check", scene, "--xacro", word)
    assert status == 2
    assert f"--xacro {word!r}: expected NAME:=VALUE." in err


def test_python_and_set_take_them_as_settings(scene: Path) -> None:
    with uwsim.load(scene, settings={"xacro.depth": 2.5, "xacro.payload": "lamp"}) as simulation:
        assert simulation.world.bodies.find("rov/lamp").name == "rov/lamp"
        assert simulation.world.bodies.find("rov").world_from_body.position[2] == pytest.approx(
            -2.5
        )
    with pytest.raises(SceneError):
        uwsim.load(scene, settings={"xacro.depth": "deep"})
    found = [each.message for each in uwsim.check(scene, arguments={"payload": "hull"})]
    assert "two links are called 'hull'" in found


def test_a_plan_keeps_them_with_the_settings_of_its_result(scene: Path) -> None:
    settings = ["xacro.depth=9", "vehicle[rov].position.x=4"]
    request = PlanRequest(
        benchmark="visibility", scene=str(scene), algorithm="frozen", settings=settings
    )
    plan = make_plan(request)
    assert plan.scene.vehicles[0].position == (4.0, 0.0, -9.0)
    assert ("xacro.depth", "9") in plan.settings
