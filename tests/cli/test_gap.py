"""``uwsim gap``: its files, its output, and all its errors at once."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import uwsim
from tests.reality_gap.fossen import Rov, write_log
from uwsim.cli.app import main

SCENE = Path(__file__).parents[1] / "reality_gap" / "scene.xml"


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
