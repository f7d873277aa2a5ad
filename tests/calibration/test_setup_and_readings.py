"""Set-up files and tables of readings: what is read, and every error with its line."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from uwsim.calibration import BoardReading, LedReading, WaterReadings
from uwsim.calibration.measurements import OpenWaterReading, find_reference
from uwsim.calibration.readings_file import ReadingsError, read_readings, write_readings
from uwsim.calibration.setup import ChannelSpec, SetupError, read_setup

HEAD = "<calibration><camera><focalLength>1000</focalLength></camera>"
CHANNEL = "<channel><name>red</name><wavelength>630</wavelength></channel>"
LED = "<led><name>led</name></led>"
BOARD = "<board><name>board</name><square>0.15</square></board>"
PICTURE = "<picture><source>led</source><exposure><frames>*.npy</frames></exposure></picture>"


def read_text(text: str, folder: Path) -> None:
    path = folder / "setup.xml"
    path.write_text(text)
    (folder / "a.npy").write_bytes(b"")
    read_setup(path)


def test_a_small_set_up_is_valid(tmp_path: Path) -> None:
    read_text(f"{HEAD}{CHANNEL}{LED}<water><name>w</name>{PICTURE}</water></calibration>", tmp_path)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<set-up/>", "root element is <set-up>; expected <calibration>"),
        (f"{HEAD}</calibration>", "lacks <channel>"),
        (f"{HEAD}{CHANNEL}{CHANNEL}</calibration>", "channel 'red' is defined twice"),
        (f"{HEAD}{CHANNEL}{LED}</calibration>", "lacks <water>"),
        (f"{HEAD}{CHANNEL}<board><name>b</name></board></calibration>", "lacks <square>"),
        (
            f"{HEAD}{CHANNEL}<led><name>l</name><channels>rad</channels></led></calibration>",
            "no channel is called 'rad'. Did you mean 'red'?",
        ),
        (
            f"{HEAD}{CHANNEL}<led><name>lid</name></led><water><name>w</name>{PICTURE}</water>"
            "</calibration>",
            "no source is called 'led'. Did you mean 'lid'?",
        ),
        (
            f"{HEAD}{CHANNEL}{LED}<water><name>w</name><picture><source>open-water</source>"
            "<exposure><frames>*.npy</frames></exposure></picture></water></calibration>",
            "needs a <board> with its lamp",
        ),
        (
            f"{HEAD}{CHANNEL}{LED}<water><name>w</name><picture><source>led</source>"
            "<exposure><frames>x*.png</frames></exposure></picture></water></calibration>",
            "no file matches 'x*.png'",
        ),
        (
            f"{HEAD}{CHANNEL}{LED}{BOARD}<water><name>w</name><picture><source>board</source>"
            "<exposure><frames>*.npy</frames></exposure><corners><square>0.15</square>"
            "<pixels>1 2 3</pixels></corners></picture></water></calibration>",
            "<pixels> has 3 numbers; expected 8",
        ),
        (f"{HEAD}{CHANNEL}<lamp/></calibration>", "<lamp> is not an element of <calibration>"),
    ],
)
def test_each_mistake_of_a_set_up_is_named(text: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(SetupError) as error:
        read_text(text, tmp_path)
    assert message in str(error.value)
    assert "setup.xml:" in str(error.value)


def test_the_reference_is_pure_water_unless_its_numbers_are_given() -> None:
    pure = find_reference(ChannelSpec(name="red", wavelength=630.0))
    assert pure.absorption == 0.2916
    tap = find_reference(ChannelSpec(name="red", reference_absorption=0.3, wavelength=630.0))
    assert tap.absorption == 0.3
    assert tap.scattering == pure.scattering


WATERS = (
    WaterReadings(
        name="one, drop",
        dose=1.0,
        readings=(
            LedReading(
                channel="red", source="led", distance=1.0, signal=2.0, reference=3.0, noise=0.01,
                half_angle=math.radians(0.25),
            ),
            BoardReading(
                channel="red", source="board", distance=1.25, signal=0.5, side=0.15,
                lamp_distance=1.5, lamp_half_angle=math.radians(40.0), incidence=0.97,
            ),
        ),
        open_water=(
            OpenWaterReading(
                channel="red", ratio=0.02, lamp_position=(0.15, 0.0, 0.0),
                lamp_half_angle=math.radians(30.0),
            ),
        ),
    ),
)  # fmt: skip


def test_written_readings_are_read_again(tmp_path: Path) -> None:
    path = tmp_path / "readings.csv"
    path.write_text(write_readings(WATERS))
    [water] = read_readings(path, ["red"])
    assert (water.name, water.dose) == ("one, drop", 1.0)
    led, board = water.readings
    assert isinstance(led, LedReading)
    assert led.half_angle == pytest.approx(math.radians(0.25))
    assert (led.signal, led.reference, led.noise) == (2.0, 3.0, 0.01)
    assert isinstance(board, BoardReading)
    assert board.reference is None
    assert board.lamp_half_angle == pytest.approx(math.radians(40.0))
    assert (board.side, board.lamp_distance, board.incidence) == (0.15, 1.5, 0.97)
    assert water.open_water[0].ratio == 0.02


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("water,chanel\n", "csv:1: 'chanel' is not a column of readings. Did you mean 'channel'?"),
        ("water,channel,source,range_m,signal\n", "there is no row"),
        ("water;channel;source\n", "csv:1: the columns are separated by semicolons; expected comm"),
        (
            "water,channel,source,range_m,half_angle_deg,signal\nw,red,led,1,1,x\n",
            "csv:2: signal is 'x'; expected a number",
        ),
        (
            "water,channel,source,range_m,half_angle_deg,signal\nw,blue,led,1,1,2\n",
            "csv:2: no channel is called 'blue'",
        ),
        (
            "water,channel,source,range_m,half_angle_deg,signal\nw,red,led,1,,2\n",
            "csv:2: expected half_angle_deg of an LED",
        ),
        (
            "water,channel,source,range_m,half_angle_deg,signal\nw,red,led,0,1,2\nw,red,led,1,1,-2\n",
            "csv:3: signal is not a positive number",
        ),
    ],
)
def test_each_mistake_of_readings_is_named(text: str, message: str, tmp_path: Path) -> None:
    path = tmp_path / "readings.csv"
    path.write_text(text)
    with pytest.raises(ReadingsError) as error:
        read_readings(path, ["red"])
    assert message in str(error.value)


def test_a_water_that_the_set_up_lacks_is_reported_once_with_the_nearest_name(
    tmp_path: Path,
) -> None:
    path = tmp_path / "readings.csv"
    path.write_text(
        "water,channel,source,range_m,half_angle_deg,signal\n"
        "one drop,red,led,1,1,2\none drp,red,led,1,1,2\none drp,red,led,1,2,2\n"
    )
    with pytest.raises(ReadingsError) as error:
        read_readings(path, ["red"], ["one drop", "two drops"])
    (diagnostic,) = error.value.diagnostics
    assert diagnostic.line == 3
    assert diagnostic.message.startswith(
        "no water of the set-up is called 'one drp'. Did you mean 'one drop'?"
    )
    assert len(read_readings(path, ["red"])) == 2
