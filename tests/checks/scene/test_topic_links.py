"""``uwsim check`` finds routes of ``<u:topicLink>`` that lead nowhere, with their lines."""

from __future__ import annotations

from pathlib import Path

import pytest

from uwsim.assets.bundled import bundled_files
from uwsim.cli import main

ROUTE = "<from>/bluerov2/imu</from> <to>/operator/imu</to>"


@pytest.mark.parametrize(
    ("route", "status", "message"),
    [
        (ROUTE, 0, ""),
        (ROUTE.replace("operator", "bluerov2"), 2, "both '/bluerov2/imu'; expected two topics"),
        (ROUTE.replace("2/imu", "2/imy"), 0, "warning: <u:topicLink> 'operator': nothing in the"),
        (ROUTE.replace("2/imu", "2/imy"), 0, "Did you mean bluerov2/imu?"),
    ],
)
def test_a_route_that_leads_nowhere_is_reported(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], route: str, status: int, message: str
) -> None:
    text = bundled_files("scenes")["teleoperation-scene"].read_text()
    assert text.count(ROUTE) == 1
    path = tmp_path / "scene.xml"
    path.write_text(text.replace(ROUTE, route))
    line = text[: text.index(ROUTE)].count("\n") + 1
    assert main(["check", str(path)]) == status
    captured = capsys.readouterr()
    output = captured.out + captured.err
    assert ("topicLink" in output) == bool(message)
    assert message in output
    assert not message or f"scene.xml:{line}: " in output
