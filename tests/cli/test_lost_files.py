"""Files that a scene names and that are nowhere: check, render and bench say and do the same."""

from __future__ import annotations

from pathlib import Path

import pytest

from uwsim.assets import loaders
from uwsim.assets.bundled import bundled_files
from uwsim.cli import main

DOCTYPE = '<!DOCTYPE UWSimScene SYSTEM "UWSimScene.dtd">'
SCENE = """<?xml version="1.0"?>{doctype}
<UWSimScene><vehicle><name>g500</name><file>{robot}</file>
<position><x>0</x><y>0</y><z>2</z></position>
<virtualCamera><name>eye</name><relativeTo>base_link</relativeTo></virtualCamera></vehicle>
{objects}
</UWSimScene>"""
LOST_BUT_OURS = "/home/nobody/.uwsim/data/robot/GIRONA500/g500ARM5.urdf"
LOST = "package://my_robot/urdf/my_robot.urdf"


def scene(folder: Path, robot: str, *, doctype: str = DOCTYPE, objects: str = "") -> Path:
    file = folder / "scene.xml"
    file.write_text(SCENE.format(robot=robot, doctype=doctype, objects=objects))
    return file


def call(*words: str | Path, capfd: pytest.CaptureFixture[str]) -> tuple[int, str, str]:
    status = main([str(word) for word in words])
    out, err = capfd.readouterr()
    return status, out, err


@pytest.mark.parametrize("doctype", [DOCTYPE, ""])
def test_a_bundled_robot_replaces_a_lost_file_of_its_name_and_that_is_reported(
    doctype: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    file = scene(tmp_path, LOST_BUT_OURS, doctype=doctype)
    status, out, _ = call("check", file, capfd=capfd)
    assert status == 0
    assert "is not found; the bundled g500ARM5.urdf is used" in out
    status, _, err = call("render", file, "--camera", "eye", "-o", tmp_path / "a.png", capfd=capfd)
    assert status == 0
    assert err.count("uwsim: warning: ") == 1
    assert "is not found; the bundled g500ARM5.urdf is used" in err


@pytest.mark.slow
def test_bench_says_once_that_a_bundled_robot_stands_for_a_lost_one(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    whole = bundled_files("scenes")["visibility-scene"].read_text()
    file = tmp_path / "scene.xml"
    file.write_text(whole.replace("data/scenes/g500ARM5.urdf", LOST_BUT_OURS))
    words = ["bench", "visibility", "--scene", file, "--level", "fog=0"]
    both = ["--algorithm", "frozen", "--algorithm", "esm"]
    status, _, err = call(*words, *both, "--out", tmp_path / "r", capfd=capfd)
    assert status == 0
    assert err.count("uwsim: warning: ") == 1
    assert "is not found; the bundled g500ARM5.urdf is used" in err


@pytest.mark.parametrize("doctype", [DOCTYPE, ""])
@pytest.mark.parametrize("command", ["check", "render", "bench"])
def test_a_robot_that_is_nowhere_and_not_ours_is_an_error_everywhere(
    command: str, doctype: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    file = scene(tmp_path, LOST, doctype=doctype)
    calls = {
        "check": ["check", file],
        "render": ["render", file, "--camera", "eye", "-o", tmp_path / "a.png"],
        "bench": ["bench", "visibility", "--scene", file, "--out", tmp_path / "r"],
    }
    status, out, err = call(*calls[command], capfd=capfd)
    assert status == 2
    assert "my_robot.urdf" in out + err


def test_a_mesh_of_a_type_that_cannot_be_read_here_is_an_error_in_check_too(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(loaders, "has_osgconv", lambda: False)
    (tmp_path / "reef.osg").write_text("Geode {}")
    thing = (
        "<object><name>reef</name><file>reef.osg</file><position><x>0</x><y>0</y><z>0</z>"
        "</position><orientation><r>0</r><p>0</p><y>0</y></orientation></object>"
    )
    file = scene(tmp_path, LOST_BUT_OURS, objects=thing)
    status, out, _ = call("check", file, capfd=capfd)
    assert status == 2
    assert "sudo apt-get install openscenegraph" in out


def test_a_lost_collision_shape_is_reported(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    thing = (
        "<object><name>box</name><file>objects/blackbox.osg</file><position><x>0</x><y>0</y>"
        "<z>0</z></position><orientation><r>0</r><p>0</p><y>0</y></orientation><physics>"
        "<collisionShape>gone.obj</collisionShape></physics></object>"
    )
    file = scene(tmp_path, LOST_BUT_OURS, doctype="", objects=thing)
    status, out, _ = call("check", file, capfd=capfd)
    assert status == 2
    assert "model 'gone.obj' is not found" in out


def test_a_stand_in_is_not_blamed_for_a_mass_that_the_lost_robot_may_have(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    force = (
        "<ForceSensor><name>f</name><target>part4_jaw2</target><offsetp><x>0</x><y>0</y><z>0</z>"
        "</offsetp><offsetr><x>0</x><y>0</y><z>0</z></offsetr></ForceSensor></vehicle>"
    )
    for robot, is_blamed in ((LOST_BUT_OURS, False), ("data/scenes/g500ARM5.urdf", True)):
        file = scene(tmp_path, robot)
        text = file.read_text().replace("</vehicle>", force)
        physics = "<UWSimScene><simParams><enablePhysics>1</enablePhysics></simParams>"
        file.write_text(text.replace("<UWSimScene>", physics))
        status, out, _ = call("check", file, capfd=capfd)
        assert status == 0, out
        assert ("its link 'part4_jaw2' has no mass" in out) is is_blamed
