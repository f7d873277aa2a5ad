"""Charts in files: what is written is read again, and broken files give one line."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from uwsim.base.geodesy import Geodetic
from uwsim.bathymetry import esri_ascii, height_grid
from uwsim.bathymetry.chart import Chart
from uwsim.bathymetry.chart_files import READERS, read_chart, write_chart
from uwsim.bathymetry.coordinates import LOCAL_SYSTEM, orthographic, parse_system
from uwsim.errors import AssetError, UwsimError

CENTRE = Geodetic(latitude=math.radians(41.7712345678), longitude=math.radians(3.03))
SYSTEMS = [
    LOCAL_SYSTEM, parse_system("EPSG:4326"), orthographic(CENTRE), parse_system("EPSG:32631")
]  # fmt: skip
HEADER = "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 2\n"


def make_chart(system=LOCAL_SYSTEM) -> Chart:  # type: ignore[no-untyped-def]
    heights = np.random.default_rng(3).normal(-30.0, 5.0, (7, 9)).astype(np.float32)
    heights[2, 3] = np.nan
    return Chart(x=2.25, y=41.5, step_x=0.5, step_y=0.25, heights=heights, system=system)


@pytest.mark.parametrize("system", SYSTEMS, ids=[system.kind for system in SYSTEMS])
@pytest.mark.parametrize("suffix", [".asc", ".tif", ".nc", ".xyz"])
def test_a_chart_returns_from_a_file_to_the_bit(suffix: str, system, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    chart, file = make_chart(system), tmp_path / f"chart{suffix}"
    write_chart(file, chart)
    copy = read_chart(file)
    np.testing.assert_array_equal(copy.heights, chart.heights)
    assert (copy.x, copy.y, copy.step_x, copy.step_y) == pytest.approx((2.25, 41.5, 0.5, 0.25))
    assert copy.system.kind == system.kind
    assert copy.system.description == system.description
    if system.centre is not None:
        assert copy.system.centre.latitude == pytest.approx(system.centre.latitude, abs=1e-14)
        assert copy.system.centre.longitude == pytest.approx(system.centre.longitude, abs=1e-14)


def test_the_first_line_of_an_ascii_grid_is_the_northern_edge(tmp_path: Path) -> None:
    file = tmp_path / "a.asc"
    file.write_text(HEADER + "1 2 3\n4 5 -9999\n")
    chart = read_chart(file)
    assert (chart.x, chart.y) == (1.0, 1.0)  # the centre of the south-western cell
    assert chart.heights[1].tolist() == [1.0, 2.0, 3.0]
    assert chart.heights[0, :2].tolist() == [4.0, 5.0]
    assert chart.n_holes == 1


def test_netcdf_4_in_the_layout_of_gebco_is_read(tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py", reason="h5py of the extra `charts` is not installed")
    heights = np.arange(12, dtype=np.int16).reshape(3, 4) - 100
    with h5py.File(tmp_path / "gebco.nc", "w") as file:
        for name, values in (("lat", [41.0, 41.1, 41.2]), ("lon", [3.0, 3.1, 3.2, 3.3])):
            file[name] = np.array(values)
            file[name].make_scale(name)
        file["elevation"] = heights
        file["elevation"].attrs["units"] = "m"
        file["elevation"].dims[0].attach_scale(file["lat"])
        file["elevation"].dims[1].attach_scale(file["lon"])
    chart = read_chart(tmp_path / "gebco.nc")
    np.testing.assert_array_equal(chart.heights, heights)
    assert (chart.x, chart.y, chart.system.kind) == (3.0, 41.0, "geographic")


def test_depths_of_a_netcdf_file_become_heights_from_south_to_north(tmp_path: Path) -> None:
    from scipy.io import netcdf_file

    with netcdf_file(tmp_path / "d.nc", "w") as file:
        for name, values in (("lat", [42.0, 41.0]), ("lon", [3.0, 4.0])):
            file.createDimension(name, 2)
            file.createVariable(name, "f8", (name,))[:] = values
        depth = file.createVariable("depth", "i2", ("lat", "lon"))
        depth[:] = [[10, 20], [30, -99]]
        depth._FillValue = np.int16(-99)
    chart = read_chart(tmp_path / "d.nc")
    assert chart.heights[1].tolist() == [-10.0, -20.0]
    assert chart.heights[0, 0] == -30.0
    assert chart.n_holes == 1


BROKEN = {
    "asc": {
        "no header": ("1 2 3\n", "its header lacks ncols"),
        "few": (HEADER + "1.25 2.5 3.75\n4 5", "has 5 heights; expected 6 by its header"),
        "word": (HEADER + "1 2 3\n4 five 6\n", ":7: 'five'; expected a number"),
        "key": ("ncols 3\nnrow 2\n", ":2: 'nrow 2'; expected one of ncols"),
        "huge": (HEADER.replace("3", "3000000000") + "1\n", "expected 40000000 at most"),
        "empty": ("", "has no heights after its header"),
        "cell": (HEADER.replace("size 2", "size 0") + "1 2 3 4 5 6", "expected a number above 0"),
    },
    "xyz": {
        "scattered": ("0 0 1\n1.1 0.3 2\n0.2 2 3\n5 7.7 1\n", "are no regular grid"),
        "two": ("0 0\n1 1\n", "has 4 numbers; expected x, y and z"),
        "line": ("0 0 1\n1 0 1\n", "all points have the same y"),
    },
    "tif": {"text": ("not an image", "is no TIFF that can be read")},
    "nc": {"text": ("CDF nothing", "is not a NetCDF file"), "none": ("text", "is not a NetCDF")},
}


@pytest.mark.parametrize(
    ("suffix", "text", "message"),
    [(suffix, *case) for suffix, cases in BROKEN.items() for case in cases.values()],
    ids=[f"{suffix}-{name}" for suffix, cases in BROKEN.items() for name in cases],
)
def test_a_broken_file_gives_one_line(suffix: str, text: str, message: str, tmp_path: Path) -> None:
    file = tmp_path / f"broken.{suffix}"
    file.write_text(text)
    with pytest.raises(UwsimError) as error:
        read_chart(file)
    assert message in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("suffix", [".tif", ".nc"])
def test_a_truncated_file_gives_one_line(suffix: str, tmp_path: Path) -> None:
    file = tmp_path / f"a{suffix}"
    write_chart(file, make_chart())
    data = file.read_bytes()
    for n in range(0, len(data) - 1, 23):
        file.write_bytes(data[:n])
        with pytest.raises(AssetError) as error:
            read_chart(file)
        assert "\n" not in str(error.value)


def test_an_unknown_suffix_names_those_that_are_read(tmp_path: Path) -> None:
    with pytest.raises(AssetError, match=r"expected one of \.asc, \.tif"):
        read_chart(tmp_path / "chart.shp")
    assert set(READERS) >= {".asc", ".tif", ".nc", ".xyz"}


def test_the_size_is_checked_before_the_text_is_parsed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(height_grid, "MAX_CELLS", 5)
    monkeypatch.setattr(esri_ascii, "parse_numbers", None)
    file = tmp_path / "a.asc"
    file.write_text(HEADER + "1 2 3 4 5 6")
    with pytest.raises(UwsimError, match="expected 5 at most"):
        read_chart(file)
