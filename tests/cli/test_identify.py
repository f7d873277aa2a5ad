"""``uwsim identify`` as it is typed."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.identification.vehicles import small_log
from uwsim.cli import main
from uwsim.identification.example import GUESS_NAME, LOG_NAME, ROBOT, write_example
from uwsim.logs import write_csv_log


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "small.csv").write_text(write_csv_log(small_log()))
    return tmp_path


def run_with_error(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    assert main(["identify", *words]) == 2
    return capsys.readouterr().err


@pytest.mark.usefixtures("folder")
def test_a_log_without_a_vehicle_is_an_error(capsys: pytest.CaptureFixture[str]) -> None:
    assert "Expected LOG... VEHICLE" in run_with_error(capsys, "small.csv")


@pytest.mark.usefixtures("folder")
def test_an_unknown_coefficient_is_an_error_with_the_nearest_name(
    capsys: pytest.CaptureFixture[str],
) -> None:
    error = run_with_error(capsys, "small.csv", "bluerov2_heavy", "--free", "aded_mass")
    assert "Did you mean 'added_mass'?" in error


@pytest.mark.usefixtures("folder")
def test_an_unknown_vehicle_is_an_error_with_the_known_ones(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert "bluerov2_heavy" in run_with_error(capsys, "small.csv", "bluerov2")


@pytest.mark.usefixtures("folder")
def test_invalid_options_and_missing_logs_are_reported_together(
    capsys: pytest.CaptureFixture[str],
) -> None:
    error = run_with_error(capsys, "none.csv", "bluerov2_heavy", "--noise", "sped=1")
    assert "none.csv" in error
    assert "sped=1" in error


@pytest.mark.usefixtures("folder")
def test_a_directory_with_other_files_is_kept(capsys: pytest.CaptureFixture[str]) -> None:
    Path("out").mkdir()
    Path("out/notes.txt").write_text("mine")
    run_with_error(capsys, "small.csv", "bluerov2_heavy", "-o", "out", "--overwrite")
    assert Path("out/notes.txt").read_text() == "mine"


@pytest.mark.slow
@pytest.mark.usefixtures("folder")
def test_the_example_is_identified_into_a_directory(capsys: pytest.CaptureFixture[str]) -> None:
    write_example(Path("swim"), duration=20.0)
    words = [f"swim/{LOG_NAME}", f"swim/{GUESS_NAME}", "--robot", ROBOT, "--starts", "1"]
    words += ["--free", "added_mass[surge],quadratic_damping[surge]", "--folds", "0", "-o", "fit"]
    assert main(["identify", *words]) == 0
    assert "added_mass[surge]" in capsys.readouterr().out
    names = {path.name for path in Path("fit").iterdir()}
    assert names == {"guess_identified.xml", "identification.json", "report.html", "plots"}
    document = json.loads(Path("fit/identification.json").read_text())
    assert [row["name"] for row in document["coefficients"]] == [
        "added_mass[surge]",
        "quadratic_damping[surge]",
    ]
