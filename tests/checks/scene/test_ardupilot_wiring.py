"""A channel of an unknown lamp, and a seventh rangefinder, are errors with their lines."""

from __future__ import annotations

from pathlib import Path

import pytest

import uwsim
from uwsim.assets.bundled import bundled_files


def messages_of(text: str, folder: Path) -> list[str]:
    path = folder / "scene.xml"
    path.write_text(text)
    return [str(d) for d in uwsim.check(path) if d.severity == "error"]


def test_an_unknown_lamp_is_an_error_with_the_nearest_name(tmp_path: Path) -> None:
    text = bundled_files("scenes")["bluerov2-scene"].read_text()
    assert messages_of(text, tmp_path) == []
    changed = text.replace("<lamp>lights_port</lamp>", "<lamp>light_port</lamp>")
    (message,) = messages_of(changed, tmp_path)
    line = 1 + changed[: changed.index("<lamp>light_port")].count("\n")
    assert message.endswith(
        f"scene.xml:{line}: No lamp is called 'light_port'. Did you mean lights_port?"
    )


def test_seven_rangefinders_are_too_many(tmp_path: Path) -> None:
    text = bundled_files("scenes")["bluerov2-scene"].read_text()
    one = "<rangefinder>/bluerov2/altitude</rangefinder>"
    (message,) = messages_of(text.replace(one, one * 7), tmp_path)
    assert "7 <rangefinder>: ArduPilot reads 6." in message


SCENE = bundled_files("scenes")["bluerov2-scene"].read_text()
FIRST = "<channel> <number>1</number> <thruster>bow_starboard</thruster> <reversed>1</reversed>"


@pytest.mark.parametrize(
    ("channel", "expected_messages"),
    [
        (
            "<channel> <number>1</number> <thruster>bow_starboard</thruster>"
            " <lamp>lights_port</lamp>",
            ["<channel> 1 has <thruster> and <lamp>; expected one of"],
        ),
        ("<channel> <number>1</number>", ["<channel> 1 has none of them; expected one of"]),
        (
            "<channel> <number>1</number> <thruster>bow_starbord</thruster>",
            ["No thruster is called 'bow_starbord'. Did you mean bow_starboard?"],
        ),
        ("<channel> <number>1</number> <joint>jaw</joint>", ["No joint is called 'jaw'."]),
        (
            "<channel> <number>1</number> <thruster>bow_starboard</thruster>"
            " <curve>1900 -1 1100 1</curve>",
            ["The pulse widths 1900 1100 of a curve"],
        ),
        (
            "<channel> <number>1</number> <thruster>bow_starbord</thruster> <lamp>lamp</lamp>",
            ["<channel> 1 has <thruster> and <lamp>", "'bow_starbord'", "'lamp'"],
        ),
    ],
)
def test_all_errors_of_a_channel_are_found(
    tmp_path: Path, channel: str, expected_messages: list[str]
) -> None:
    changed = SCENE.replace(FIRST, channel)
    messages = messages_of(changed, tmp_path)
    line = 1 + changed[: changed.index(channel)].count("\n")
    assert len(messages) == len(expected_messages)
    for message, expected in zip(messages, expected_messages, strict=True):
        assert f"scene.xml:{line}: " in message
        assert expected in message


def test_a_thruster_behind_two_channels_is_an_error(tmp_path: Path) -> None:
    changed = SCENE.replace("<thruster>bow_port</thruster>", "<thruster>bow_starboard</thruster>")
    (message,) = messages_of(changed, tmp_path)
    assert "<channel> 2: channel 1 (line " in message
    assert "drives the thruster 'bow_starboard', too" in message


def test_two_connections_to_ardupilot_in_one_vehicle_are_an_error(tmp_path: Path) -> None:
    second = "</u:ardupilot> <u:ardupilot> <instance>1</instance> </u:ardupilot>"
    (message,) = messages_of(SCENE.replace("</u:ardupilot>", second), tmp_path)
    assert "<u:ardupilot>: 'bluerov2' has another <u:ardupilot> (line " in message
