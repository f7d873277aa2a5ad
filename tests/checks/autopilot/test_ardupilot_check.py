"""The check of scenes for ArduPilot: the bundled vehicle passes, each mistake is found."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from uwsim.assets.bundled import bundled_files
from uwsim.autopilots.ardupilot.frames import find_frame
from uwsim.checks import ArduPilotCheck, check_file
from uwsim.cli import main
from uwsim.errors import Diagnostic

SCENE = bundled_files("scenes")["bluerov2-scene"].read_text()
HYDRODYNAMICS = bundled_files("vehicles")["bluerov2_heavy"].read_text()
NAMES = re.findall(r'<thruster name="(\w+)"', HYDRODYNAMICS)


def check(
    folder: Path, scene: str, hydrodynamics: str = HYDRODYNAMICS, frame: str | None = "2"
) -> list[Diagnostic]:
    """Return the diagnostics that only the check for ArduPilot has."""
    (folder / "rov.xml").write_text(hydrodynamics.replace('name="bluerov2_heavy"', 'name="rov"'))
    path = folder / "scene.xml"
    path.write_text(scene.replace(">bluerov2_heavy<", ">rov<"))
    plain = set(check_file(path))
    request = ArduPilotCheck(None if frame is None else find_frame(frame))
    return [entry for entry in check_file(path, ardupilot=request) if entry not in plain]


def errors(diagnostics: list[Diagnostic]) -> list[str]:
    return [entry.message for entry in diagnostics if entry.severity == "error"]


@pytest.mark.parametrize("frame", ["2", "vectored_6dof", None])
def test_the_bundled_vehicle_passes(tmp_path: Path, frame: str | None) -> None:
    assert errors(check(tmp_path, SCENE, frame=frame)) == []


def change_thruster(name: str, element: str, change: str) -> str:
    """Return the hydrodynamics with the sign of one coordinate of a thruster changed."""
    pattern = rf'(<thruster name="{name}".*?<{element}>.*?<{change}>)(-?)([\d.]+)'
    return re.sub(
        pattern, lambda m: m[1] + ("" if m[2] else "-") + m[3], HYDRODYNAMICS, count=1, flags=re.S
    )


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("axis", ["x", "y"])
def test_a_mirrored_thruster_of_the_file_is_found(tmp_path: Path, name: str, axis: str) -> None:
    (message,) = errors(check(tmp_path, SCENE, change_thruster(name, "position", axis)))
    assert f"thruster {name!r} (channel {NAMES.index(name) + 1}) is mirrored" in message
    assert "FRAME_CONFIG 2 (vectored_6dof)" in message
    assert f"its {axis} position has the wrong sign" in message


def test_a_changed_channel_is_found(tmp_path: Path) -> None:
    scene = SCENE.replace(
        "<thruster>bow_port</thruster> <reversed>1</reversed>", "<thruster>bow_port</thruster>"
    )
    assert scene != SCENE
    (message,) = errors(check(tmp_path, scene))
    assert "channel 2, thruster 'bow_port', is reversed" in message
    assert "MOT_2_DIRECTION -1" in message


def test_the_line_of_the_element_is_stated(tmp_path: Path) -> None:
    scene = SCENE.replace("<number>5</number>", "<number>60</number>", 1)
    scene = scene.replace("<number>60</number>", "<number>15</number>")
    found = [entry for entry in check(tmp_path, scene) if entry.severity == "error"]
    line = scene[: scene.index("<u:ardupilot>")].count("\n") + 1
    assert {entry.line for entry in found} == {line}
    assert any("nothing is at motor 5" in entry.message for entry in found)


@pytest.mark.parametrize(("axes", "is_wrong"), [("start", False), ("frd", False), ("flu", True)])
def test_wrong_axes_of_the_base_are_found(tmp_path: Path, axes: str, is_wrong: bool) -> None:
    scene = SCENE.replace("<u:ardupilot>", f"<u:ardupilot> <axes>{axes}</axes>")
    messages = errors(check(tmp_path, scene))
    assert any("accel_body at rest is (0, 0, +9.81)" in text for text in messages) == is_wrong
    assert any("set <axes> frd" in text for text in messages) == is_wrong


def test_missing_navigation_and_topics_are_warnings(tmp_path: Path) -> None:
    scene = SCENE.replace(
        "<rangefinder>/bluerov2/altitude</rangefinder>",
        "<rangefinder>/bluerov2/altitud</rangefinder>",
    )
    scene = re.sub(r"<u:mavlink>.*?</u:mavlink>", "", scene, flags=re.S)
    text = "\n".join(map(str, check(tmp_path, scene)))
    assert "nothing in <rosInterfaces> publishes '/bluerov2/altitud'" in text
    assert "Did you mean bluerov2/altitude" in text
    assert "no <u:mavlink> with <dvl> or <odometry>" in text
    element = "<u:mavlink> <dvl>/bluerov2/dvl</dvl> </u:mavlink> <u:ardupilot>"
    text = "\n".join(map(str, check(tmp_path, scene.replace("<u:ardupilot>", element))))
    assert "no <u:mavlink>" not in text


def test_a_home_below_the_surface_is_a_warning(tmp_path: Path) -> None:
    home = "<home> <x>0</x> <y>0</y> <z>2</z> </home>"
    scene = re.sub(r"<u:mavlink>.*?</u:mavlink>", "", SCENE, flags=re.S)
    scene = scene.replace("<u:ardupilot>", f"<u:ardupilot> {home}")
    assert "home is 2.00 m below the surface" in "\n".join(map(str, check(tmp_path, scene)))


def test_a_start_under_water_is_a_warning(tmp_path: Path) -> None:
    text = "\n".join(map(str, check(tmp_path, SCENE)))
    assert "'bluerov2' starts 1.50 m deep" in text
    higher = SCENE.replace("<z>1.5</z> </position>", "<z>0.3</z> </position>", 1)
    assert higher != SCENE
    assert "starts" not in "\n".join(map(str, check(tmp_path, higher)))


def test_a_heavy_vehicle_is_a_warning(tmp_path: Path) -> None:
    heavy = HYDRODYNAMICS.replace("<mass>13.5</mass>", "<mass>20</mass>")
    text = "\n".join(map(str, check(tmp_path, SCENE, heavy)))
    assert "'bluerov2' sinks with 64.7 N" in text
    assert "of its vertical thrust" in text


def test_a_scene_without_thrusters_has_nothing_to_steer(tmp_path: Path) -> None:
    path = tmp_path / "scene.xml"
    path.write_text("<UWSimScene> </UWSimScene>")
    found = check_file(path, ardupilot=ArduPilotCheck())
    messages = errors(found)
    assert messages == [] or "nothing to steer" in messages[-1]


def test_the_command_has_exit_status_2_for_a_mirrored_thruster(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "rov.xml").write_text(
        change_thruster("bow_port", "position", "x").replace("bluerov2_heavy", "rov")
    )
    scene = tmp_path / "scene.xml"
    scene.write_text(SCENE.replace("<u:dynamics>bluerov2_heavy<", "<u:dynamics>rov<"))
    assert main(["check", str(scene), "--frame", "vectored_6dof"]) == 2
    assert "thruster 'bow_port' (channel 2) is mirrored" in capsys.readouterr().out
    assert main(["check", str(scene)]) == 0
    assert main(["check", "bluerov2-scene", "--ardupilot"]) == 0
    assert main(["check", "bluerov2-scene", "--frame", "vectored_7dof"]) == 2
    assert "Did you mean 'vectored_6dof'" in capsys.readouterr().err
