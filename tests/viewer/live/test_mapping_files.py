"""Files and messages with which a pilot steers: what is none is one line, or counts as nothing."""

from __future__ import annotations

from pathlib import Path

import pytest

from uwsim.algorithms.pilot import AXES
from uwsim.errors import BadSetting
from uwsim.viewer.live.mapping import PilotMapping, read_mapping


@pytest.mark.parametrize(
    "text",
    [
        'axes = [["yaw"], ["heave"]]',
        "axes = [[], []]",
        "sticks = [1.0, 2.0]",
        "buttons = [true]",
        "buttons = [{a = 1}]",
        'keys = {w = ["+surge"]}',
        "keys = {w = 5}",
        "keys = {w = {a = 1}}",
        "axes = " + "[" * 5000,
        "axes = " + "[" * 5000 + "]" * 5000,
        "keys = {w = " + "[" * 5000 + "]" * 5000 + "}",
    ],
)
def test_a_mapping_with_nested_lists_is_one_line(text: str, tmp_path: Path) -> None:
    path = tmp_path / "pilot.toml"
    path.write_text(text)
    with pytest.raises(BadSetting, match="--pilot-mapping") as refused:
        read_mapping(path)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 1000


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (10**400, 1.0),
        (-(10**400), -1.0),
        (float("inf"), 1.0),
        (float("nan"), 0.0),
        (0.5, 0.5),
        (True, 0.0),
        ("1", 0.0),
        ([1.0], 0.0),
        (None, 0.0),
    ],
)
def test_a_stick_is_deflected_as_far_as_it_goes(value: object, expected: float) -> None:
    found = PilotMapping().values({"sticks": [value]})
    assert dict(zip(AXES, found, strict=True))["yaw"] == expected
