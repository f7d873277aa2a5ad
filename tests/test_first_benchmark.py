"""docs/first-benchmark.md does what it says: its files are written, its commands run."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.support.documented import is_printed, read_commands, write_files
from uwsim.cli import main
from uwsim.scene.reader import read_scene

OTHER_LEVEL = re.compile(r" +0\.[12] .* ok")
"""Rows of the sweep that are not played: each level is alone, and the first is enough."""
PAGE = (Path(__file__).parent.parent / "docs" / "first-benchmark.md").read_text()


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    names = write_files(PAGE, tmp_path)
    assert names == ["scout.urdf", "scout.xml", "wreck.xml", "hover.py", "hover.xml"]
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_scene_of_the_page_can_be_read(folder: Path) -> None:
    scene = read_scene(folder / "wreck.xml")
    assert [vehicle.dynamics for vehicle in scene.vehicles] == ["scout"]


@pytest.mark.slow
def test_every_command_of_the_page_prints_what_the_page_shows(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for command in read_commands(PAGE):
        is_sweep = command.words[1] == "bench" and "--level" not in command.words
        level = ("--level", "current=0") if is_sweep else ()
        assert main([*command.words[1:], *level]) == 0, command.words
        printed = "".join(capsys.readouterr())
        expected = [line for line in command.output if not (is_sweep and OTHER_LEVEL.match(line))]
        missing = [line for line in expected if not is_printed(line, printed, tolerance=0.05)]
        assert missing == [], printed
    assert (folder / "hover.result" / "report.html").exists()
