"""Two elements at one port, or one terminal, are an error with the lines of both."""

from __future__ import annotations

from pathlib import Path

import pytest

import uwsim
from tests.devices.streams.stream_scenes import SCENE

FIRST_LINE = 17
"""The line of the first stream in the scene."""


def actuator(address: str) -> str:
    return f"<u:actuatorStream> <name>a</name> <address>{address}</address> </u:actuatorStream>"


def instrument(address: str) -> str:
    return (
        "<u:instrumentStream> <name>b</name> <topic>/imu</topic> <format>HDT</format>"
        f"<address>{address}</address> </u:instrumentStream>"
    )


def mavlink(address: str, name: str = "link") -> str:
    return f"<u:mavlink> <name>{name}</name> <address>{address}</address> </u:mavlink>"


PX4 = "<u:px4> <name>{}</name> </u:px4>"


def errors_of(folder: Path, first: str, second: str) -> list[str]:
    path = folder / "scene.xml"
    path.write_text(SCENE.format(streams=f"{first}\n{second}", depth=1.5, x=2.0))
    return [str(d) for d in uwsim.check(path) if d.severity == "error"]


@pytest.mark.parametrize(
    ("first", "second", "place"),
    [
        (actuator("udpin:127.0.0.1:9201"), mavlink("udpin:127.0.0.1:9201"), "UDP port 9201"),
        (actuator("udpin:0.0.0.0:9201"), mavlink("udpin:127.0.0.1:9201"), "UDP port 9201"),
        (actuator("tcpin:localhost:4560"), PX4.format("px4"), "TCP port 4560"),
        (PX4.format("px4"), PX4.format("second"), "TCP port 4560"),
        ("<fdm>9002</fdm>", "<u:ardupilot/>", "UDP port 9002"),
        ("<u:ardupilot/>", actuator("udpin:127.0.0.1:9002"), "UDP port 9002"),
        (actuator("pty:/tmp/line"), instrument("pty:/tmp/line"), "the terminal /tmp/line"),
    ],
)
def test_a_port_of_two_elements_is_an_error(
    tmp_path: Path, first: str, second: str, place: str
) -> None:
    (message,) = errors_of(tmp_path, first, second)
    assert f"scene.xml:{FIRST_LINE + 1}: " in message
    assert f"{place} is that of" in message
    assert f"(line {FIRST_LINE}), too; expected a port of its own" in message


@pytest.mark.parametrize(
    ("first", "second"),
    [
        (actuator("udpin:127.0.0.1:9201"), instrument("tcpin:127.0.0.1:9201")),
        (actuator("udpin:127.0.0.1:9201"), instrument("udpout:127.0.0.1:9201")),
        (actuator("udpin:127.0.0.1:9201"), mavlink("udpin:127.0.0.2:9201")),
        (actuator("pty"), instrument("pty")),
        ("<u:ardupilot/>", PX4.format("px4")),
    ],
)
def test_different_ports_are_no_error(tmp_path: Path, first: str, second: str) -> None:
    assert errors_of(tmp_path, first, second) == []


def test_two_vehicles_with_one_instance_of_ardupilot_are_an_error(tmp_path: Path) -> None:
    path = tmp_path / "scene.xml"
    text = SCENE.format(streams="<u:ardupilot/>", depth=1.5, x=2.0)
    vehicle = text[text.index("<vehicle>") : text.index("</vehicle>") + len("</vehicle>")]
    path.write_text(text.replace(vehicle, vehicle + vehicle.replace("<name>rov<", "<name>b<")))
    (message,) = [str(d) for d in uwsim.check(path) if d.severity == "error"]
    assert "<u:ardupilot> of 'b': UDP port 9002 is that of <u:ardupilot> of 'rov'" in message


def test_a_link_of_mavlink_needs_an_address_and_a_name_of_its_own(tmp_path: Path) -> None:
    first, second = mavlink("tcpp:127.0.0.1:5762"), mavlink("tcp:127.0.0.1:5772")
    address_error, name_error = errors_of(tmp_path, first, second)
    assert "<u:mavlink>: <address>: 'tcpp:127.0.0.1:5762' is not an address" in address_error
    assert "Did you mean 'tcp'?" in address_error
    assert f"'link' is the name of another <u:mavlink> (line {FIRST_LINE})" in name_error


@pytest.mark.parametrize(
    ("motors", "problem"),
    [
        ("<motor>bow_starbord</motor>", "no thruster is called 'bow_starbord'. Did you mean bow"),
        ("<motor>bow_port</motor>" * 17, "<u:px4> has 17 <motor>; expected at most 16"),
    ],
)
def test_an_invalid_output_of_px4_is_an_error(tmp_path: Path, motors: str, problem: str) -> None:
    (message,) = errors_of(tmp_path, f"<u:px4> {motors} </u:px4>", "")
    assert problem in message
