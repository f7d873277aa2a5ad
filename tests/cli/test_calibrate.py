"""``uwsim calibrate`` as it is typed."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest
from PIL import Image

from uwsim.calibration import LedReading
from uwsim.calibration.example import write_example as example
from uwsim.calibration.readings_file import read_readings
from uwsim.cli import main
from uwsim.optics import read_water

LED_ROWS = "\n".join(
    f"dyed,red,led,1,{angle},{signal},1"
    for angle, signal in ((0.25, 0.5), (1, 0.6), (2, 0.65), (10, 0.8))
)
READINGS = f"water,channel,source,range_m,half_angle_deg,signal,reference\n{LED_ROWS}\n"
SETUP = (
    "<calibration><camera><focalLength>1000</focalLength></camera>"
    "<channel><name>red</name><wavelength>630</wavelength></channel>"
    "<led><name>led</name></led></calibration>"
)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "setup.xml").write_text(SETUP)
    (tmp_path / "readings.csv").write_text(READINGS)
    return tmp_path


def run_on_readings(*arguments: str) -> int:
    return main(["calibrate", "setup.xml", "--readings", "readings.csv", *arguments])


@pytest.fixture
def without_plots(monkeypatch: pytest.MonkeyPatch) -> None:
    """Draw nothing: drawing is most of the time of the command."""
    monkeypatch.setattr("uwsim.calibration.report.write.draw_plots", lambda *arguments: [])


@pytest.mark.slow
@pytest.mark.usefixtures("folder")
def test_readings_are_calibrated_into_a_directory(capsys: pytest.CaptureFixture[str]) -> None:
    assert run_on_readings("-o", "out") == 0
    output = capsys.readouterr().out
    assert "beam attenuation c" in output
    assert "quality gates: 3 of 3 passed" in output
    assert "written: out/water.json" in output
    names = {path.relative_to("out").as_posix() for path in Path("out").rglob("*.*")}
    plots = {f"plots/dyed-{name}.{kind}" for name in ("fit", "contrast") for kind in ("png", "pdf")}
    assert names == {"water.json", "readings.csv", "calibration.json", "report.html", *plots}
    water = read_water("out/water.json")
    document = json.loads(Path("out/calibration.json").read_text())
    [channel] = document["waters"][0]["channels"]
    assert water.medium.scattering[0] == pytest.approx(channel["scattering"], rel=1e-4)
    assert "chi²" in Path("out/report.html").read_text()
    assert [path for path in Path().iterdir() if path.name.endswith(".part")] == []


@pytest.mark.filterwarnings("error")
def test_a_focal_length_without_a_pixel_of_open_water_is_reported(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    Image.new("L", (32, 24), 100).save(folder / "open.png")
    picture = (
        "<picture><source>open-water</source><exposure><time>1</time>"
        "<frames>open.png</frames></exposure></picture>"
    )
    water = f"<water><name>dyed</name>{picture}</water></calibration>"
    board = (
        "<board><name>board</name><distance>1</distance><lampPosition><x>0.1</x><y>0</y><z>0</z>"
        "</lampPosition><lampHalfAngle>0.5</lampHalfAngle><square>0.04</square></board>"
    )
    setup = SETUP.replace(">1000<", ">10<").replace("</calibration>", board + water)
    (folder / "setup.xml").write_text(setup)
    assert main(["calibrate", "setup.xml"]) == 2
    assert "has no pixel; <focalLength> is 10 pixels" in capsys.readouterr().err


@pytest.mark.slow
def test_a_board_at_three_ranges_needs_no_reference(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    header = "water,channel,source,range_m,square_m,lamp_range_m,signal"
    rows = [
        f"sea,red,board,{distance},{side},{distance},{math.exp(-loss * distance) / distance**2}"
        for distance in (0.5, 1.0, 1.5)
        for side, loss in ((0.15, 0.6), (0.04, 0.8), (0.01, 0.95))
    ]
    (folder / "readings.csv").write_text("\n".join([header, *rows, ""]))
    assert run_on_readings("-o", "out") == 0
    assert "beam attenuation c" in capsys.readouterr().out
    document = json.loads(Path("out/calibration.json").read_text())
    assert set(document["waters"][0]["channels"][0]["gains"]) == {"board"}


@pytest.mark.usefixtures("folder", "without_plots")
def test_written_readings_give_the_same_bytes_again(capsys: pytest.CaptureFixture[str]) -> None:
    assert run_on_readings("-o", "out") == 0
    arguments = ["calibrate", "setup.xml", "--readings", "out/readings.csv", "-o", "again"]
    assert main(arguments) == 0
    for name in ("calibration.json", "water.json", "readings.csv", "report.html"):
        assert Path("again", name).read_bytes() == Path("out", name).read_bytes(), name
    capsys.readouterr()
    assert main([*arguments, "--overwrite", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["uwsim_calibration"] == 1


@pytest.mark.usefixtures("without_plots")
@pytest.mark.parametrize("words", [(), ("--json",)])
def test_a_failed_quality_gate_is_one_line_and_exit_status_3(
    folder: Path, capsys: pytest.CaptureFixture[str], words: tuple[str, ...]
) -> None:
    # the exposure time of the last disc is stated as half of what it was
    (folder / "readings.csv").write_text(READINGS.replace("10,0.8", "10,1.6"))
    assert run_on_readings("-o", "out", *words) == 3
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "of 3 quality gates are failed (fit" in error
    assert "do not use this water. Compare the exposure times" in error
    assert Path("out/water.json").is_file()


@pytest.mark.usefixtures("without_plots")
def test_an_error_is_one_line_and_leaves_the_directory_as_it_was(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert run_on_readings("-o", "out") == 0
    report = Path("out/report.html").read_bytes()
    capsys.readouterr()
    for arguments, message in (
        (["calibrate"], "Missing SETUP; uwsim calibrate --example DIR writes one"),
        (["calibrate", "none.xml"], "none.xml"),
        (["calibrate", "setup.xml"], "lacks <water>"),
        (["calibrate", "setup.xml", "--readings", "none.csv"], "none.csv: cannot be read"),
        (["calibrate", "setup.xml", "--readings", "readings.csv", "-o", "out"], "not empty"),
        (["calibrate", "setup.xml", "--example", "x"], "omit SETUP"),
        (["calibrate", "--example", "out"], "not an empty directory"),
    ):
        assert main(arguments) == 2
        error = capsys.readouterr().err
        assert error.count("\n") == 1
        assert message in error

    def fail(*arguments: object) -> None:
        raise OSError(28, "No space left on device", "plots")

    monkeypatch.setattr("uwsim.calibration.report.write.draw_plots", fail)
    assert run_on_readings("-o", "out", "--overwrite") != 0
    assert Path("out/report.html").read_bytes() == report
    assert sorted(path.name for path in folder.iterdir()) == ["out", "readings.csv", "setup.xml"]


@pytest.mark.slow
def test_the_example_is_written_and_calibrated(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The example's waters are in their intervals."""
    monkeypatch.chdir(tmp_path)
    assert main(["calibrate", "--example", "tank"]) == 0
    assert "next: uwsim calibrate tank/setup.xml" in capsys.readouterr().out
    assert main(["calibrate", "tank/setup.xml", "-o", "out"]) == 0
    assert "not used" not in capsys.readouterr().out
    document = json.loads(Path("out/calibration.json").read_text())
    for water, truth in zip(document["waters"], example.WATERS, strict=True):
        assert water["name"] == truth.name
        assert read_water(f"out/{truth.folder}.water.json").medium.n_channels == 3
        for channel in water["channels"]:
            medium = truth.make_medium(channel["name"])
            deviations = channel["standard_deviations"]
            for name, value in (
                ("beam_attenuation", medium.beam_attenuation[0]),
                ("scattering", medium.scattering[0]),
            ):
                assert abs(channel[name] - value) < 3.0 * deviations[name], (water, name)
            backscatter = channel["scattering_at_170_degrees"]
            assert backscatter["ratio_to_phase_function"] == pytest.approx(1.0, abs=0.1)
    waters = read_readings(Path("out/readings.csv"), ["red", "green", "blue"])
    assert sum(isinstance(reading, LedReading) for reading in waters[0].readings) == 18
