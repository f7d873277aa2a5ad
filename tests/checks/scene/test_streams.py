"""``uwsim check`` finds what is wrong with streams of bytes, with their lines."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.devices.streams.stream_scenes import SCENE, instrument
from uwsim.cli import main

ACTUATOR = "<u:actuatorStream> <name>t</name> <address>{}</address> </u:actuatorStream>"


def check(folder: Path, streams: str, capsys: pytest.CaptureFixture[str]) -> tuple[int, str]:
    path = folder / "scene.xml"
    path.write_text(SCENE.format(streams=streams, depth=1.5, x=2.0))
    status = main(["check", str(path)])
    captured = capsys.readouterr()
    return status, captured.out + captured.err


@pytest.mark.parametrize(
    ("streams", "problem"),
    [
        (instrument("PD4 GGA", "/dvl"), "needs several sensors"),
        (instrument("PD4", "/dvl", more="<address>udp:h:1</address>"), "Did you mean 'udpin'"),
        (ACTUATOR.format("serial:/dev/ttyUSB0"), "expected serial:PATH:BIT_RATE"),
    ],
)
def test_an_invalid_stream_is_an_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], streams: str, problem: str
) -> None:
    status, text = check(tmp_path, streams, capsys)
    assert status == 2
    assert problem in text
    assert "scene.xml:17: " in text


def test_a_topic_that_nothing_publishes_is_a_warning(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    status, text = check(tmp_path, instrument("PD4", "/dvll"), capsys)
    assert status == 0
    assert "scene.xml:17: warning: <u:instrumentStream>: nothing in the scene publishes" in text
    assert "Did you mean dvl?" in text


def test_a_valid_stream_has_no_remark(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    streams = instrument("PD4", "/dvl") + ACTUATOR.format("udpin:127.0.0.1:9201")
    status, text = check(tmp_path, streams, capsys)
    assert status == 0
    assert "Stream" not in text
