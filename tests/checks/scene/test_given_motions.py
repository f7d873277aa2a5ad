"""Vehicles with a given motion: what ``uwsim check`` says about their tables and sources."""

from __future__ import annotations

from pathlib import Path

import pytest

import uwsim
from uwsim.assets.bundled import scene_file
from uwsim.devices.motion.scripted_motion import TITLES


def check(folder: Path, elements: str) -> list[str]:
    """Return the errors and warnings about motions of a vehicle with more elements."""
    text = scene_file("bluerov2-scene", ()).read_text()
    path = folder / "scene.xml"
    path.write_text(text.replace("<u:dynamics>", f"{elements}\n<u:dynamics>", 1))
    line = (
        path.read_text()
        .splitlines()
        .index(next(line for line in path.read_text().splitlines() if elements in line))
    )
    return [
        item.message
        for item in uwsim.check(path)
        if item.line == line + 1 or "motion" in item.message
    ]


@pytest.mark.parametrize(
    ("elements", "error"),
    [
        ("<u:followPose> <u:delay>0.1</u:delay> </u:followPose>", "neither a topic nor a port"),
        (
            "<u:followPose> <u:topic>/a</u:topic> <u:mavlinkPort>9000</u:mavlinkPort> "
            "</u:followPose>",
            "has a topic and a port",
        ),
        ("<u:scriptedMotion> <u:file>no.csv</u:file> </u:scriptedMotion>", "'no.csv' is in none"),
        ("<u:scriptedMotion> <u:file>bad.csv</u:file> </u:scriptedMotion>", "bad.csv:2: has 2"),
    ],
)
def test_a_motion_without_a_valid_source_is_an_error_with_its_line(
    tmp_path: Path, elements: str, error: str
) -> None:
    (tmp_path / "bad.csv").write_text(f"{TITLES}\n1,2\n")
    messages = check(tmp_path, elements)
    assert len(messages) == 1
    assert error in messages[0]


def test_of_two_motions_and_a_sway_the_last_motion_applies(tmp_path: Path) -> None:
    elements = (
        "<u:followPose> <u:topic>/a</u:topic> </u:followPose> "
        "<u:followPose> <u:topic>/b</u:topic> </u:followPose> "
        "<u:sway> <u:axis>x</u:axis> <u:amplitude>1</u:amplitude> <u:period>5</u:period> </u:sway>"
    )
    messages = check(tmp_path, elements)
    assert any("has 2 given motions; the last one applies" in message for message in messages)
    assert any("<u:sway> has no lasting effect" in message for message in messages)


def test_a_single_motion_with_a_source_is_accepted(tmp_path: Path) -> None:
    (tmp_path / "good.csv").write_text(f"{TITLES}\n0,0,0,1,1,0,0,0\n")
    element = "<u:scriptedMotion> <u:file>good.csv</u:file> </u:scriptedMotion>"
    assert check(tmp_path, element) == []
