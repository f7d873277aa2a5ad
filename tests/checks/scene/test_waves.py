"""Flat seas, waves that would break, and vehicles that are long for them are warned of."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from tests.support.short_trial import make_plan
from uwsim.bus import Node
from uwsim.checks import check_file
from uwsim.checks.scene.waves import breaking_height

SCENE = """<UWSimScene xmlns:u='urn:uwsim:1'>
<oceanState> <depth>{depth}</depth> <u:waves>
{waves}
</u:waves> </oceanState>{vehicle}</UWSimScene>"""
REGULAR = "<u:regularWave> <u:height>{}</u:height> <u:period>{}</u:period> </u:regularWave>"
SEA = """<u:jonswap> <u:significantHeight>{}</u:significantHeight>
<u:peakPeriod>{}</u:peakPeriod> </u:jonswap>"""
VEHICLE = """
<vehicle> <name>rov</name> <file>bluerov2_heavy.urdf</file>
<position> <x>0</x> <y>0</y> <z>{z}</z> </position>
<orientation> <r>M_PI</r> <p>0</p> <y>0</y> </orientation>
{accept}<u:dynamics>bluerov2_heavy</u:dynamics> </vehicle>"""


class Idle:
    """Does nothing at all."""

    def start(self, node: Node) -> None:
        pass


def warnings(folder: Path, waves: str, *, depth: float = 100.0, vehicle: str = "") -> list[str]:
    path = folder / "scene.xml"
    path.write_text(SCENE.format(waves=waves, depth=depth, vehicle=vehicle))
    return [f"{each.line} {each.severity} {each.message}" for each in check_file(path)]


def test_the_highest_wave_in_deep_water_is_a_seventh_of_its_length() -> None:
    assert breaking_height(4.0, 1000.0) == pytest.approx(0.142 * 9.81 * 16.0 / (2 * math.pi))
    # in shallow water 0.142 * 2 pi = 0.89 of the depth
    assert breaking_height(20.0, 0.5) == pytest.approx(0.89 * 0.5, rel=0.01)


@pytest.mark.parametrize(
    ("waves", "depth", "text"),
    [
        (REGULAR.format(1.2, 2.0), 100.0, "waves of 2 s break: their height is 1.2 m; expected at"),
        (REGULAR.format(1.0, 8.0), 1.0, "expected at most 0.874 m in water 1 m deep"),
        (SEA.format(2.0, 4.0), 100.0, "their significant height is 2 m; expected at most 1.67 m"),
        (SEA.format(17.0, 16.0), 1000.0, "expected at most 16 m"),  # 1/25 of 400 m
    ],
)
def test_a_wave_that_would_break_is_warned_of(
    waves: str, depth: float, text: str, tmp_path: Path
) -> None:
    (warning,) = warnings(tmp_path, waves, depth=depth)
    assert warning.startswith("3 warning")
    assert text in warning


@pytest.mark.parametrize(
    "waves",
    [
        REGULAR.format(0.8, 2.0),
        SEA.format(1.6, 4.0),
        SEA.format(0.0, 1.0),
        "<u:piersonMoskowitz> <u:windSpeed>30</u:windSpeed> </u:piersonMoskowitz>",
        "<u:uwsimOcean/>",
    ],
)
def test_waves_that_do_not_break_are_not(waves: str, tmp_path: Path) -> None:
    assert warnings(tmp_path, waves, depth=1000.0) == []


def test_an_element_without_waves_is_warned_of(tmp_path: Path) -> None:
    (warning,) = warnings(tmp_path, "")
    assert warning == (
        "2 warning <u:waves> is empty: the sea is flat; expected one or more of <u:jonswap>, "
        "<u:piersonMoskowitz>, <u:regularWave>, <u:uwsimOcean>"
    )


@pytest.mark.parametrize(
    "setting",
    [
        "<windSpeed>0</windSpeed>",
        "<windx>0</windx> <windy>0</windy>",
        "<waveScale>0</waveScale>",
    ],
)
def test_an_ocean_without_wind_is_warned_of(setting: str, tmp_path: Path) -> None:
    path = tmp_path / "scene.xml"
    scene = SCENE.format(waves="<u:uwsimOcean/>", depth=30, vehicle="")
    path.write_text(scene.replace("<depth>", f"{setting} <depth>"))
    (warning,) = check_file(path)
    assert warning.line == 3
    assert warning.message.startswith("<u:uwsimOcean> is flat: its waves are 0 m high with <wind")


def test_a_number_of_uwsim_s_ocean_counts_where_its_waves_are(tmp_path: Path) -> None:
    ocean = "<windx>0.1</windx> <windSpeed>9</windSpeed> <choppyFactor>2</choppyFactor>"
    unread = "not simulated yet: waves (line 2)"
    for waves, texts in (
        ("<u:uwsimOcean/>", ("<choppyFactor>",)),
        (REGULAR.format(0.1, 5), ("<windx>", "<windSpeed>", "<choppyFactor>")),
    ):
        for text in ("<windx>", "<windSpeed>", "<choppyFactor>"):
            value = next(part for part in ocean.split(" ") if part.startswith(text))
            path = tmp_path / "scene.xml"
            scene = SCENE.format(waves=waves, depth=30, vehicle="")
            path.write_text(scene.replace("<depth>", f"{value} <depth>"))
            messages = [each.message for each in check_file(path)]
            assert any(unread in message for message in messages) == (text in texts)


def test_a_depth_without_waves_is_not_called_waves(tmp_path: Path) -> None:
    path = tmp_path / "scene.xml"
    path.write_text("<UWSimScene>\n<oceanState> <depth>30</depth> </oceanState>\n</UWSimScene>")
    assert [each.message for each in check_file(path)] == [
        "read, not simulated without <u:waves>: depth (line 2)"
    ]


def test_a_vehicle_that_is_long_for_the_waves_is_warned_of(tmp_path: Path) -> None:
    """A BlueROV2 of 0.575 m in waves of 1 s, which are 1.56 m long."""
    short, long = SEA.format(0.05, 1.0), SEA.format(0.05, 2.0)
    (warning,) = warnings(tmp_path, short, vehicle=VEHICLE.format(z=-0.3, accept=""))
    assert warning.startswith("9 warning the vehicle 'rov'"), warning
    assert "waves are 1.56 m; it would diffract them, which is not modelled" in warning
    assert "<u:accept>waves</u:accept>" in warning
    accept = "<u:accept>waves</u:accept>"
    assert warnings(tmp_path, short, vehicle=VEHICLE.format(z=-0.3, accept=accept)) == []
    assert warnings(tmp_path, short, vehicle=VEHICLE.format(z=-5, accept="")) == []
    assert warnings(tmp_path, long, vehicle=VEHICLE.format(z=-0.3, accept="")) == []


def test_a_level_at_which_the_waves_would_break_is_warned_of(tmp_path: Path) -> None:
    scene = tmp_path / "scene.xml"
    scene.write_text(SCENE.format(waves=SEA.format(0.3, 2.0), depth=100, vehicle=""))
    updater = """<u:seaStateUpdater> <initialValue>0</initialValue>
<finalValue>{}</finalValue> <step>0.1</step> <interval>1</interval> </u:seaStateUpdater>"""
    found = {}
    for height in (0.4, 0.9):
        make_plan(tmp_path, Idle, updater.format(height))
        file = tmp_path / "benchmark.xml"
        found[height] = [
            each.message for each in check_file(file, scene=scene) if "break" in each.message
        ]
    assert found[0.4] == []
    assert found[0.9] == [
        "at waveHeight 0.9 m, waves of 2 s break: their significant height is 0.9 m; expected at "
        "most 0.416 m in water 100 m deep"
    ]
