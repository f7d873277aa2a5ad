"""``uwsim bathymetry``: a floor is made, described and converted."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from uwsim.bathymetry.chart_files import read_chart
from uwsim.cli import main


def test_a_floor_is_made_drawn_described_and_converted(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file, copy = tmp_path / "bay.tif", tmp_path / "bay.asc"
    size = ["--size", "200x160", "--spacing", "1", "--depth", "12", "--lat", "41.5", "--lon", "3"]
    picture = ["--picture", str(tmp_path / "bay.png")]
    assert main(["bathymetry", *size, *picture, "--seed", "3", "-o", str(file)]) == 0
    text = capsys.readouterr().out
    assert "201 x 161, 1 m apart" in text
    assert "metres about 41.500000, 3.000000" in text
    assert (tmp_path / "bay.png").stat().st_size > 10_000
    assert main(["bathymetry", str(file), "-o", str(copy), "--json"]) == 0
    statistics = json.loads(capsys.readouterr().out)
    assert statistics["mean_height"] == pytest.approx(-12.0, abs=0.05)
    np.testing.assert_array_equal(read_chart(copy).heights, read_chart(file).heights)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--size", "12"], "--size is '12'; expected two lengths"),
        (["--lat", "3"], "One of --lat and --lon is missing"),
        (["-o", "bay.shp"], "expected a suffix of .asc, .tif"),
        (["nothing.asc"], "nothing.asc: cannot be read (No such file"),
    ],
)
def test_wrong_options_give_one_line(
    arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["bathymetry", *arguments]) == 2
    error = capsys.readouterr().err.strip()
    assert message in error
    assert "\n" not in error


def test_a_file_is_not_replaced_without_overwrite(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "bay.asc"
    arguments = ["bathymetry", "--size", "20x20", "-o", str(file)]
    assert main(arguments) == 0
    assert main(arguments) == 2
    assert "exists. Use --overwrite" in capsys.readouterr().err
    assert main([*arguments, "--overwrite"]) == 0
