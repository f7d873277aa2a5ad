"""``uwsim list``."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from lxml import etree

from uwsim.algorithms import ALGORITHMS
from uwsim.assets.bundled import bundled_files
from uwsim.benchmark.measures import MEASURES
from uwsim.checks.benchmark_tables import bundled_tables
from uwsim.checks.scene.not_simulated import unsimulated_elements
from uwsim.cli import main
from uwsim.cli.list import KINDS, find_limitation
from uwsim.cli.options.descriptions import first_line, head_comment, remove_title
from uwsim.model.robots import find_file
from uwsim.optics import WATERS
from uwsim.scene.hydrodynamics.vehicle_file import read_vehicle
from uwsim.scene.hydrodynamics.vehicle_sets import find_vehicle
from uwsim.scene.unsupported import UNSIMULATED_ELEMENTS
from uwsim.scene.urdf.reader import read_urdf

YOUR_OWN = Path(__file__).parents[2] / "docs" / "your-own-vehicle.md"


@pytest.mark.parametrize("kind", KINDS)
def test_everything_that_has_a_name_has_a_sentence_about_it(kind: str) -> None:
    entries = KINDS[kind](bundled_tables())
    assert entries
    assert [name for name, said in entries.items() if not said.endswith(".")] == []


def test_a_kind_lists_its_own_names_and_no_others(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["list", "algorithms"]) == 0
    listed = [line.split()[0] for line in capsys.readouterr().out.splitlines()]
    assert listed == sorted(ALGORITHMS)


def test_without_a_kind_everything_is_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["list"]) == 0
    printed = capsys.readouterr().out
    words = printed.split()
    assert {*KINDS, *MEASURES, *bundled_files("scenes"), *bundled_files("benchmarks")} <= set(words)


def test_a_misspelt_kind_is_reported_with_the_right_one(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["list", "sensor"]) == 2
    assert "Did you mean 'sensors'?" in capsys.readouterr().err


@pytest.fixture
def dvl_read_only(monkeypatch: pytest.MonkeyPatch) -> None:
    """Make the DVL an element that is read but not simulated."""
    for place in (("vehicle", "dvlSensor"), ("rosInterfaces", "DVLSensorToROS")):
        monkeypatch.setitem(UNSIMULATED_ELEMENTS, place, place[1])


@pytest.mark.usefixtures("dvl_read_only")
def test_what_is_read_and_not_simulated_is_marked(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["list", "sensors"]) == 0
    lines = {line.split()[0]: line for line in capsys.readouterr().out.splitlines()}
    assert "[read, not simulated yet]" in lines["dvlSensor"]
    assert "[" not in lines["virtualCamera"] + lines["imu"]
    assert main(["list", "interfaces"]) == 0
    lines = {line.split()[0]: line for line in capsys.readouterr().out.splitlines()}
    assert "[read, not simulated yet]" in lines["DVLSensorToROS"]
    assert "[" not in lines["u:ROSThrustersToPAT"] + lines["PATToROSOdom"]


@pytest.mark.parametrize("kind", ["sensors", "devices", "interfaces"])
def test_the_marks_are_those_that_check_gives_a_file(kind: str) -> None:
    for name in KINDS[kind](bundled_tables()):
        parent = "rosInterfaces" if kind == "interfaces" else "vehicle"
        scene = etree.fromstring(
            f"<UWSimScene xmlns:u='urn:uwsim:1'><{parent}><{name}/></{parent}></UWSimScene>"
        )
        assert bool([*unsimulated_elements(scene)]) == bool(find_limitation(kind, name)), name


def test_every_sensor_device_and_interface_is_simulated(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["list", "--json"]) == 0
    listed = json.loads(capsys.readouterr().out)
    for kind in ("sensors", "devices", "interfaces"):
        assert [each["name"] for each in listed[kind] if each["limit"]] == []


@pytest.mark.usefixtures("dvl_read_only")
def test_json_lists_the_same_for_programs(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["list", "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    assert list(said) == list(KINDS)
    assert [each["name"] for each in said["algorithms"]] == sorted(ALGORITHMS)
    limits = {each["name"]: each["limit"] for each in said["sensors"]}
    assert limits["virtualCamera"] == limits["imu"] == ""
    assert limits["dvlSensor"] == "read, not simulated yet"


def test_a_sentence_is_the_first_line_without_marks_of_code() -> None:
    assert first_line("``never``: always off.\n\nMore.") == "never: always off."
    assert first_line(None) == ""


def test_a_sentence_goes_without_the_title_that_its_name_is() -> None:
    assert remove_title("Distance: how far a body went.") == "How far a body went."
    assert remove_title("A fan of beams.") == "A fan of beams."


def test_the_sentence_of_a_file_is_the_first_of_its_comment(tmp_path: Path) -> None:
    file = tmp_path / "a.xml"
    file.write_text("<?xml version='1.0'?>\n<!-- A tank,\n  1.3 m deep. And a box. -->\n<a/>")
    assert head_comment(file) == "A tank, 1.3 m deep."
    file.write_text("<a/>")
    assert head_comment(file) == ""


def test_every_bundled_robot_is_listed_documented_found_by_that_name_and_has_its_sets(
    tmp_path: Path,
) -> None:
    package = Path(str(find_vehicle("rexrov"))).parents[2]
    listed = KINDS["vehicles"](bundled_tables())
    assert set(listed) == {path.name for path in package.glob("data/*/*.urdf")}
    rows = re.findall(r"^\| `(\w+\.urdf)` \|.*\| (.*?) \|$", YOUR_OWN.read_text(), re.M)
    assert {name for name, _ in rows} == set(listed)
    for name, sets in rows:
        robot = read_urdf(find_file(name, str(tmp_path / "scene.xml"), ()))
        for one in re.findall(r"`(\w+)`", sets):
            assert read_vehicle(find_vehicle(one), [link.name for link in robot.links]).bodies


def test_a_water_is_listed_with_its_coefficients_in_green_and_its_source(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["list", "waters"]) == 0
    lines = {line.split()[0]: line for line in capsys.readouterr().out.splitlines()}
    assert set(WATERS) <= set(lines)
    assert "coast; in green c 1.197 and b 1.099 1/m. Source:" in lines["jerlov-3C"]
