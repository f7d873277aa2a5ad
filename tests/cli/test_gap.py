"""``uwsim gap``: its files, its output, and all its errors at once."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import uwsim
from tests.reality_gap.fossen import Rov, write_log
from uwsim.cli.app import main

SCENE = Path(__file__).parents[1] / "reality_gap" / "scene.xml"


FLOOR = """<object> <name>terrain</name> <file>terrain/seafloor/terrain_noship.osg</file>
  <position> <x>0</x> <y>0</y> <z>0</z> </position>
  <orientation> <r>M_PI</r> <p>0</p> <y>0</y> </orientation> </object>"""
"""A sea floor at a depth of 15 m; the vehicle of the log is 20 m deep."""


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_log(tmp_path_factory.mktemp("log") / "dive.csv", Rov(), duration=12.0)


def test_the_command_writes_and_prints_what_python_returns(
    log: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    words = ["gap", str(log), str(SCENE), "-o", str(out), "--windows", "4", "--horizons", "1,2"]
    assert main([*words, "--json"]) == 0
    printed = capsys.readouterr().out
    assert printed == (out / "gap.json").read_text()
    document = json.loads(printed)
    assert document["verdict"].startswith("The simulation follows the log")
    assert (out / "report.html").read_text().count("<img") == 4
    gap = uwsim.gap(log, SCENE, windows=4, horizons=(1, 2))
    assert gap.verdict == document["verdict"]
    assert gap.horizons[1].distance.value == pytest.approx(
        document["horizons"][1]["distance"]["value"], rel=1e-5
    )


def test_a_log_with_another_origin_needs_open_water(
    log: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = tmp_path / "tank.xml"
    text = SCENE.read_text().replace("<z>20</z>", "<z>5</z>")  # above the floor
    scene.write_text(text.replace("</UWSimScene>", f"{FLOOR}</UWSimScene>"))
    words = ["gap", str(log), str(scene), "-o", str(tmp_path / "out"), "--windows", "3"]
    words += ["--horizons", "1", "--no-attribution"]
    assert main(words) != 0
    assert "--open-water" in capsys.readouterr().err
    assert main([*words, "--open-water"]) == 0
    gap = uwsim.gap(log, scene, windows=3, horizons=(1,), attribution=False, open_water=True)
    assert gap.verdict == json.loads((tmp_path / "out" / "gap.json").read_text())["verdict"]


def test_all_errors_are_reported_at_once(
    log: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "notes.txt").write_text("mine")
    words = ["gap", str(log) + "x", "no-such-scene", "-o", str(tmp_path), "--horizons", "5,1"]
    assert main(words) == 2
    text = capsys.readouterr().err
    for part in ("horizons=5,1", "no-such-scene", "does not exist", str(tmp_path)):
        assert part in text


def test_a_template_is_written_once(
    log: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "dive.toml"
    words = ["gap", str(log), "--write-mapping", str(path)]
    assert main(words) == 0
    assert "thrusters.bow_port" in path.read_text()
    assert main(words) == 2
    assert "exists" in capsys.readouterr().err
