"""``uwsim manoeuvres``: the report of a vehicle, and its errors."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from uwsim.cli.app import main


@pytest.mark.slow
def test_the_report_of_the_bluerov2_has_all_files(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["manoeuvres", "bluerov2-scene", "-o", "one"]) == 0
    text = capsys.readouterr().out
    assert "Criteria of IMO MSC.137(76)" in text
    assert "time to 90° [s]" in text
    files = sorted(path.relative_to("one") for path in Path("one").rglob("*") if path.is_file())
    assert len(files) == 2 + 12 + 7
    document = json.loads(Path("one/manoeuvres.json").read_text())
    starboard, port = document["turning_circles"]
    assert starboard["advance"] == pytest.approx(port["advance"], rel=1e-6)
    assert document["criteria"][0]["is_met"] is True
    assert "http" not in Path("one/report.html").read_text().replace("http-equiv", "")
    assert main(["manoeuvres", "bluerov2-scene", "-o", "one"]) == 2
    assert "--overwrite" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["visibility-scene"], "no vehicle with <u:dynamics>"),
        (["remus-scene", "--vehicle", "remos"], "remus"),
        (["none.xml"], "none.xml"),
        (["remus-scene", "--length", "0"], "--length"),
    ],
)
def test_invalid_input_is_reported(
    arguments: list[str], text: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["manoeuvres", *arguments]) == 2
    assert text in capsys.readouterr().err
