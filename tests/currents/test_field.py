"""Fields from files: what is read is what is given, and what is wrong is said."""

from __future__ import annotations

import itertools
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from scipy.io import netcdf_file

from uwsim.base.rng import stream
from uwsim.currents import Current, Field, FieldSpec, SceneContext, read_grid
from uwsim.currents.field import read_csv
from uwsim.errors import AssetError

T = np.array([0.0, 10.0, 40.0])
X = np.array([-1.0, 0.0, 2.0])
Y = np.array([0.0, 5.0])
Z = np.array([1.0, 2.0, 3.0, 8.0])
LAW = np.array(  # of t, x, y, z and 1: linear in each
    [[0.01, 0.2, -0.1, 0.05, 0.3], [0.0, -0.3, 0.02, 0.0, 0.1], [0.002, 0.0, 0.0, -0.04, 0.0]]
)


def law(t: float, x: float, y: float, z: float) -> np.ndarray:
    return LAW @ np.array([t, x, y, z, 1.0])


def context() -> SceneContext:
    return SceneContext(stream=lambda name: stream(0, name))


def csv_file(folder: Path) -> Path:
    nodes = list(itertools.product(X, Y, Z, T))[::-1]
    rows = [",".join(map(repr, map(float, (*n, *law(n[3], *n[:3]))))) for n in nodes]
    path = folder / "field.csv"
    path.write_text("x,y,z,t,u,v,w\n" + "\n".join(rows) + "\n\n")
    return path


def nc_file(folder: Path, order: tuple[str, ...] = ("time", "z", "y", "x")) -> Path:
    path = folder / "field.nc"
    axes = {"time": T, "x": X, "y": Y, "z": Z}
    with netcdf_file(path, "w") as data:
        for name, values in axes.items():
            data.createDimension(name, len(values))
            data.createVariable(name, "d", (name,))[:] = values
        for i, name in enumerate("uvw"):
            values = np.empty([len(axes[axis]) for axis in order])
            for index in np.ndindex(values.shape):
                at = {axis: axes[axis][k] for axis, k in zip(order, index, strict=True)}
                values[index] = law(at["time"], at["x"], at["y"], at["z"])[i]
            data.createVariable(name, "d", order)[:] = values
    return path


def bound(path: Path, **other: object) -> Field:
    return FieldSpec(file=str(path), **other).bind(context())  # type: ignore[arg-type]


def inside() -> tuple[np.ndarray, np.ndarray]:
    """Return points and times within the grid."""
    rng = np.random.Generator(np.random.Philox(1))
    low, high = np.array([-1.0, 0.0, 1.0]), np.array([2.0, 5.0, 8.0])
    return rng.uniform(low, high, (50, 3)), rng.uniform(0.0, 40.0, 20)


@pytest.mark.parametrize("kind", ["csv", "nc", "nc in another order"])
def test_what_is_linear_is_exact_everywhere_in_the_grid(kind: str, tmp_path: Path) -> None:
    order = ("x", "time", "y", "z") if kind == "nc in another order" else ("time", "z", "y", "x")
    field = bound(csv_file(tmp_path) if kind == "csv" else nc_file(tmp_path, order))
    points, times = inside()
    for time in [*times, 0.0, 10.0, 40.0]:
        expected = np.array([law(time, *point) for point in points])
        assert field.velocity(points, time) == pytest.approx(expected, abs=1e-12)


def test_between_nodes_it_is_the_mean_of_the_corners() -> None:
    rng = np.random.Generator(np.random.Philox(2))
    axis = np.array([0.0, 1.0])
    velocities = rng.normal(size=(2, 2, 2, 2, 3))
    from uwsim.currents import Grid

    field = Field(Grid((axis, axis, axis, axis), velocities))
    middle = field.velocity(np.array([[0.5, 0.5, 0.5]]), 0.5)[0]
    assert middle == pytest.approx(velocities.reshape(-1, 3).mean(axis=0))


def test_its_acceleration_is_its_slope_in_time(tmp_path: Path) -> None:
    field = bound(csv_file(tmp_path))
    points, _ = inside()
    assert field.acceleration(points, 20.0) == pytest.approx(np.tile(LAW[:, 0], (50, 1)), abs=1e-12)
    assert (field.acceleration(points, 41.0) == 0.0).all()
    numeric = Current.acceleration(field, points, 20.0)
    assert field.acceleration(points, 20.0) == pytest.approx(numeric, abs=1e-9)


def test_beyond_its_ends_it_is_as_at_its_edge(tmp_path: Path) -> None:
    field = bound(csv_file(tmp_path))
    far = field.velocity(np.array([[-9.0, 7.0, 2.0]]), 99.0)[0]
    assert far == pytest.approx(law(40.0, -1.0, 5.0, 2.0))
    assert field.velocity(np.array([[0.0, 0.0, 2.0]]), -5.0)[0] == pytest.approx(
        law(0.0, 0.0, 0.0, 2.0)
    )


def test_or_it_is_still_outside(tmp_path: Path) -> None:
    field = bound(csv_file(tmp_path), outside="still")
    v = field.velocity(np.array([[-1.01, 1.0, 2.0], [-1.0, 1.0, 2.0], [0.0, 1.0, 8.1]]), 0.0)
    assert [bool(row.any()) for row in v] == [False, True, False]


def test_the_simulation_may_begin_at_any_time_of_the_file(tmp_path: Path) -> None:
    path = csv_file(tmp_path)
    points, _ = inside()
    late = bound(path, start=12.0).velocity(points, 3.0)
    assert late == pytest.approx(bound(path).velocity(points, 15.0))


def test_coordinates_and_w_may_be_left_out(tmp_path: Path) -> None:
    path = tmp_path / "shear.csv"
    path.write_text("z, u, v\n0, 0.5, 0\n10, 0.1, 0.2\n")
    v = bound(path).velocity(np.array([[4.0, -4.0, 5.0], [0.0, 0.0, 0.0]]), 77.0)
    assert v == pytest.approx(np.array([[0.3, 0.1, 0.0], [0.5, 0.0, 0.0]]))


def test_netcdf_may_be_packed_and_steady(tmp_path: Path) -> None:
    path = tmp_path / "packed.nc"
    with netcdf_file(path, "w") as data:
        data.createDimension("x", 2)
        data.createVariable("x", "d", ("x",))[:] = [0.0, 4.0]
        for name, values in (("u", [0, 100]), ("v", [50, 50])):
            variable = data.createVariable(name, "h", ("x",))
            variable[:] = values
            variable.scale_factor = 0.01
    v = bound(path).velocity(np.array([[1.0, 0.0, 0.0]]), 0.0)[0]
    assert v == pytest.approx([0.25, 0.5, 0.0])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "has nothing; expected u and v"),
        ("x,u\n0,1\n", "has x, u; expected u and v"),
        ("x,u,v,speed\n0,1,1,1\n", "has x, u, v, speed; expected"),
        ("x,u,v\n", "has no line of numbers"),
        ("x,u,v\n0,1,fast\n", r"field\.csv:2: 'fast'; expected a number"),
        ("x,u,v\n0,1,nan\n", r"field\.csv:2: 'nan'; expected a number"),
        ("x,u,v\n0,1,1\n1,1\n", r"field\.csv:3: 2 values; expected 3: x, u, v"),
        ("x,y,u,v\n0,0,1,1\n1,0,1,1\n1,1,1,1\n", "node t 0, x 0, y 1, z 0 is missing"),
        ("x,u,v\n0,1,1\n0,1,1\n", "node t 0, x 0, y 0, z 0 occurs twice"),
    ],
)
def test_what_is_wrong_with_a_table_is_reported(text: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "field.csv"
    path.write_text(text)
    with pytest.raises(AssetError, match=said):
        read_grid(path)


def write_nc(path: Path, **variables: tuple[tuple[str, ...], list[float]]) -> Path:
    with netcdf_file(path, "w") as data:
        for name, (dimensions, values) in variables.items():
            for dimension in dimensions:
                if dimension not in data.dimensions:
                    data.createDimension(dimension, 2)
            shape = (2,) * len(dimensions)
            data.createVariable(name, "d", dimensions)[:] = np.reshape(values, shape)
    return path


def test_what_is_wrong_with_a_netcdf_file_is_reported(tmp_path: Path) -> None:
    path = tmp_path / "a.nc"
    x = (("x",), [0.0, 1.0])
    with pytest.raises(AssetError, match="has x, u; expected u and v"):
        read_grid(write_nc(path, x=x, u=x))
    with pytest.raises(AssetError, match=r"u is over \(lon\); expected coordinates of t, x, y, z"):
        read_grid(write_nc(path, x=x, u=(("lon",), [0.0, 1.0]), v=x))
    with pytest.raises(AssetError, match="the values of x neither increase nor"):
        read_grid(write_nc(path, x=(("x",), [1.0, 1.0]), u=x, v=x))
    with pytest.raises(AssetError, match="1 of 2 values of v are missing"):
        read_grid(write_nc(path, x=x, u=x, v=(("x",), [0.0, np.nan])))
    with pytest.raises(AssetError, match=r"x is over \(y\); expected a coordinate over itself"):
        read_grid(write_nc(path, x=(("y",), [0.0, 1.0]), u=x, v=x))
    path.write_bytes(b"\x89HDF\r\n\x1a\n")
    with pytest.raises(AssetError, match="is NetCDF-4; expected classic NetCDF"):
        read_grid(path)
    for rubbish in (b"", b"CDF\x01", b"CDF\x01" + b"\xff" * 40, b"not at all"):
        path.write_bytes(rubbish)
        with pytest.raises(AssetError, match="is not a NetCDF file that can be read"):
            read_grid(path)


def test_netcdf_is_read_in_its_units_and_along_axes_that_fall(tmp_path: Path) -> None:
    si, other = tmp_path / "si", tmp_path / "other"
    si.mkdir()
    other.mkdir()
    nc_file(si)
    units = {"time": ("hours since 2000-01-01 00:00", 3600.0), "x": ("km", 1000.0)}
    units |= {"y": ("metres", 1.0), "u": ("cm s-1", 0.01), "v": ("km/h", 1 / 3.6), "w": ("m/s", 1)}
    with netcdf_file(nc_file(other), "a", mmap=False) as data:
        for name, (said, factor) in units.items():
            variable = data.variables[name]
            variable[:] = variable[:] / factor + (7.0 if name == "time" else 0.0)
            variable.units = said
        for name, axis in (("z", 1), ("x", 3)):
            data.variables[name][:] = data.variables[name][::-1].copy()
            for component in "uvw":
                variable = data.variables[component]
                variable[:] = np.flip(variable[:], axis).copy()
    expected, found = read_grid(si / "field.nc"), read_grid(other / "field.nc")
    for one, same in zip(found.axes, expected.axes, strict=True):
        assert one == pytest.approx(same, abs=1e-9)
    assert found.velocities == pytest.approx(expected.velocities, abs=1e-12)


@pytest.mark.parametrize(
    ("name", "said", "expected"),
    [
        ("x", "degrees_east", "x is in 'degrees_east'; expected m, km or cm"),
        ("time", "months since 2000-01-01", "t is in 'months since 2000-01-01'; expected s, min,"),
        ("u", "knots", "u is in 'knots'; expected m/s, cm/s or km/h"),
        ("v", "m", "v is in 'm'; expected m/s"),
        ("z", 1, "z is in '1'; expected m, km or cm"),
    ],
)
def test_a_unit_that_is_not_known_is_refused(
    name: str, said: str | int, expected: str, tmp_path: Path
) -> None:
    path = nc_file(tmp_path)
    with netcdf_file(path, "a", mmap=False) as data:
        data.variables[name].units = said
    with pytest.raises(AssetError, match=expected):
        read_grid(path)


def test_another_kind_of_file_and_one_that_is_not_there_are_errors(tmp_path: Path) -> None:
    with pytest.raises(AssetError, match=r"a field is a \.csv or a \.nc file, not '\.mat'"):
        read_grid(tmp_path / "field.mat")
    with pytest.raises(AssetError, match="No such file"):
        read_grid(tmp_path / "field.csv")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "x,u,v\n0,0,0\n1,1e300,0\n",
            r"field\.csv:3: u is 1e\+300; expected a number from -100 to",
        ),
        (
            "x,u,v\n0,0,-101\n1,0,0\n",
            r"field\.csv:2: v is -101; expected a number from -100 to 100",
        ),
        ("x,u,v\n0,0,inf\n1,0,0\n", r"field\.csv:2: 'inf'; expected a number"),
        ("x,u,v\n0,0,1_0\n1,0,0\n", r"field\.csv:2: '1_0'; expected a number"),
        ("x,u,v\n1e30,0,0\n1,0,0\n", r"field\.csv:2: x is 1e\+30; expected a number from -1e\+09"),
        ("x,u,v\n" + "0" * 200_000 + ",0,0\n", r"field\.csv: is not a table that can be read"),
        (
            "x,y,z,t,u,v\n" + "".join(f"{i},{i},{i},{i},0,0\n" for i in range(70_000)),
            "has 70000 nodes; expected a full grid of 70000 x 70000 x 70000 x 70000 nodes",
        ),
    ],
)
def test_a_table_that_no_water_moves_by_is_refused(text: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "field.csv"
    path.write_text(text)
    with pytest.raises(AssetError, match=said):
        read_grid(path)


def test_a_table_of_a_spreadsheet_may_begin_with_a_mark_of_its_encoding(tmp_path: Path) -> None:
    path = tmp_path / "field.csv"
    path.write_text("x,u,v\n0,1,2\n", encoding="utf-8-sig")
    assert read_grid(path).velocities.tolist() == [[[[[1.0, 2.0, 0.0]]]]]


@pytest.mark.parametrize("value", [1e300, -100.5])
def test_a_netcdf_file_with_water_faster_than_any_names_the_node(
    value: float, tmp_path: Path
) -> None:
    path = nc_file(tmp_path)
    with netcdf_file(path, "a", mmap=False) as data:
        data.variables["v"][1, 2, 0, 1] = value
    with pytest.raises(
        AssetError, match=rf"v is {value:g} at t 10, z 3, y 0, x 0; expected".replace("+", r"\+")
    ):
        read_grid(path)


def test_whatever_stands_in_a_netcdf_file_there_is_one_line(tmp_path: Path) -> None:
    whole = nc_file(tmp_path).read_bytes()
    random = stream(0, "fuzz")
    path = tmp_path / "broken.nc"
    for i in range(300):
        broken = bytearray(whole[: int(random.integers(4, len(whole)))] if i % 3 == 0 else whole)
        for _ in range(int(random.integers(1, 5))):
            broken[int(random.integers(4, min(len(broken), 600)))] = int(random.integers(0, 256))
        path.write_bytes(broken)
        said = str(path)
        try:
            read_grid(path)
        except AssetError as error:
            said = str(error)
        assert said.startswith(str(path))
        assert "\n" not in said


@pytest.mark.slow
@pytest.mark.parametrize("names", ["x,y,u,v", "x,y,z,t,u,v,w"])
def test_a_table_takes_little_more_memory_than_it_is_long(tmp_path: Path, names: str) -> None:
    n, n_names = 40_000, names.count(",") + 1
    rest = ",0" * (n_names - 3)
    lines = [f"{k % 200},{k // 200}{rest},0.25" for k in range(n)]
    path = tmp_path / "field.csv"
    path.write_text("\n".join([names, *lines]) + "\n")
    data = path.read_bytes()
    tracemalloc.start()
    try:
        grid = read_csv(path, data)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert grid.velocities.size == 3 * n
    numbers = 8 * n * n_names
    assert peak < 3 * len(data) + 3 * numbers + 8 * n * 10
