"""`uwsim check` of communication devices."""

from __future__ import annotations

from pathlib import Path

import pytest

from uwsim.checks import check_file

DEVICE = """
<CustomCommsDevice> <dccommsId>{name}</dccommsId> <txChannelId>{channel}</txChannelId>
  <rxChannelId>{channel}</rxChannelId> <relativeTo>part0</relativeTo> <mac>{mac}</mac> {mesh}
  <macProtocol> <name>{protocol}</name> </macProtocol> <bitrate>1000</bitrate>
  <rateErrorModel> <errorUnit>{unit}</errorUnit> <errorRateExpr>{formula}</errorRateExpr>
  </rateErrorModel>
  <txPacketBuilder> <className>VariableLengthPacketBuilder</className> </txPacketBuilder>
  <rxPacketBuilder> <className>VariableLengthPacketBuilder</className> </rxPacketBuilder>
</CustomCommsDevice>"""
GOOD = {
    "name": "rf",
    "channel": 1,
    "mac": 1,
    "protocol": "",
    "unit": "bit",
    "formula": "0.01*m",
    "mesh": "",
}


def reported(folder: Path, *devices: dict[str, object]) -> list[tuple[str, str]]:
    scene = folder / "scene.xml"
    inside = "".join(DEVICE.format(**{**GOOD, **device}) for device in devices)
    joints = 5 * "<joint>0</joint>"
    scene.write_text(
        "<UWSimScene> <CustomCommsChannel> <id>1</id> </CustomCommsChannel>"
        "<vehicle> <name>v</name> <file>data/scenes/g500ARM5.urdf</file>"
        f"<jointValues>{joints}</jointValues>{inside}</vehicle> </UWSimScene>"
    )
    return [(each.severity, str(each)) for each in check_file(scene)]


def test_devices_that_fit_together_are_simulated_without_a_word(tmp_path: Path) -> None:
    assert reported(tmp_path, {}, {"name": "other", "mac": 2}) == []


@pytest.mark.parametrize(
    ("changed", "severity", "said"),
    [
        ({"formula": "0.01*x"}, "error", "no variable is called 'x'"),
        ({"formula": "0.01*("}, "error", "ends too early"),
        ({"unit": "word"}, "error", "word"),
        (
            {"channel": 4},
            "warning",
            "no <CustomCommsChannel> has the id 4; one with the defaults is used",
        ),
        ({"protocol": "FAMA"}, "warning", "read as ALOHA; known: ALOHA, slottedALOHA, CSMA"),
        ({"mac": -1}, "error", "-1"),
        ({"mesh": "<mesh> <path>nowhere.osg</path> </mesh>"}, "error", "'nowhere.osg'"),
    ],
)
def test_what_does_not_fit_is_named(
    tmp_path: Path, changed: dict[str, object], severity: str, said: str
) -> None:
    [(kind, text)] = reported(tmp_path, changed)
    assert kind == severity
    assert said in text
    assert "scene.xml:" in text


def test_names_and_addresses_that_two_devices_share_are_named(tmp_path: Path) -> None:
    texts = [text for _, text in reported(tmp_path, {}, {})]
    assert any("two devices are called 'rf'" in text for text in texts)
    assert any("both receive packets that are sent to it" in text for text in texts)


def test_two_channels_of_one_id(tmp_path: Path) -> None:
    scene = tmp_path / "scene.xml"
    twice = "<CustomCommsChannel> <id>1</id> </CustomCommsChannel>\n" * 2
    other = "<AcousticCommsChannel> <id>1</id> </AcousticCommsChannel>"
    scene.write_text(f"<UWSimScene> {twice} {other} </UWSimScene>")
    (message,) = check_file(scene)
    assert str(message).endswith(":2: warning: several channels have the id 1; the first is used")
