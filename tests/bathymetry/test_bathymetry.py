"""A chart in a scene: where it is on Earth, and that rays, contacts and placement use it."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.acoustics import MATERIALS
from uwsim.base.geodesy import Geodetic
from uwsim.base.geometry import Pose
from uwsim.bathymetry.bathymetry import BathymetrySpec
from uwsim.bathymetry.chart import Chart
from uwsim.bathymetry.chart_files import write_chart
from uwsim.bathymetry.coordinates import LOCAL_SYSTEM, Projection, orthographic, parse_system
from uwsim.bathymetry.height_grid import HeightGrid
from uwsim.errors import AssetError, SceneError, UwsimError
from uwsim.model.collision.terrain_shapes import terrain_shapes
from uwsim.scene.reader import read_scene

ORIGIN = Geodetic(latitude=math.radians(41.775), longitude=math.radians(3.033))
SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <simParams> {frame} </simParams> {origin}
  <vehicle> <name>rov</name> <file>data/vehicles/bluerov2_heavy.urdf</file>
    <position> <x>0</x> <y>0</y> <z>{z}</z> </position>
    <orientation> <r>0</r> <p>0</p> <y>0</y> </orientation>
    <u:dynamics>bluerov2_heavy</u:dynamics> </vehicle>
  <object> <name>{name}</name> <file>bay.asc</file>
    <position> <x>0</x> <y>0</y> <z>{shift}</z> </position>
    <orientation> <r>{roll}</r> <p>0</p> <y>0</y> </orientation>
    <u:bathymetry> {settings} </u:bathymetry> </object>
  <object> <name>box</name> <file>objects/blackbox_uib_trimesh.osg</file>
    <position> <x>3</x> <y>2</y> <z>0</z> </position>
    <orientation> <r>0</r> <p>0</p> <y>0</y> </orientation>
    <physics> <mass>15</mass> <collisionShapeType>box</collisionShapeType> </physics>
    {placement} </object>
</UWSimScene>"""
NED = "<offsetr> <x>M_PI</x> <y>0</y> <z>-M_PI_2</z> </offsetr>"


def wavy(x: float, y: float) -> float:
    return -10.0 + 0.2 * x + 0.5 * math.sin(0.8 * y)


def write_bay(folder: Path, system=LOCAL_SYSTEM) -> None:  # type: ignore[no-untyped-def]
    axis = np.arange(-12.0, 12.5, 0.5)
    heights = np.array([[wavy(x, y) for x in axis] for y in axis], np.float32)
    chart = Chart(x=-12.0, y=-12.0, step_x=0.5, step_y=0.5, heights=heights, system=system)
    write_chart(folder / "bay.asc", chart)


def write_scene(folder: Path, **values: object) -> Path:
    defaults = {
        "frame": "", "origin": "", "z": -3, "name": "terrain", "shift": 0, "roll": 0,
        "settings": "", "placement": "<u:onFloor/>",
    }  # fmt: skip
    file = folder / "scene.xml"
    file.write_text(SCENE.format(**defaults | values))
    return file


def test_rays_contacts_and_placement_use_the_same_surface(tmp_path: Path) -> None:
    write_bay(tmp_path)
    simulation = open_scene(read_scene(write_scene(tmp_path)), timestep=0.01)
    rays = simulation.world.rays
    hits = rays.cast(Pose(np.array([1.2, 2.3, 0.0]), np.eye(3)), np.array([[0.0, 0, -1]]), 50.0)
    assert -hits.distance[0] == pytest.approx(wavy(1.2, 2.3), abs=0.03)
    start = simulation.world.engine.poses.object(1).position
    assert start[2] - wavy(3.0, 2.0) == pytest.approx(0.1, abs=0.15)
    simulation.advance(4.0)
    end = simulation.world.engine.poses.object(1).position
    assert end[2] - wavy(end[0], end[1]) == pytest.approx(start[2] - wavy(3.0, 2.0), abs=0.1)
    simulation.close()


@pytest.mark.parametrize("frame", ["", NED], ids=["z up", "north east down"])
def test_a_chart_is_aligned_with_w_in_any_frame_of_the_file(frame: str, tmp_path: Path) -> None:
    write_bay(tmp_path)
    z, shift = (3, -1.5) if frame else (-3, 1.5)
    file = write_scene(tmp_path, frame=frame, z=z, shift=shift, placement="<u:solid>0</u:solid>")
    simulation = open_scene(read_scene(file), timestep=0.01)
    for x, y in ((4.1, -3.7), (-8.2, 6.4)):
        hits = simulation.world.rays.cast(
            Pose(np.array([x, y, 0.0]), np.eye(3)), np.array([[0.0, 0.0, -1.0]]), 50.0
        )
        assert -hits.distance[0] == pytest.approx(wavy(x, y) + 1.5, abs=0.03)
    simulation.close()


def test_the_engine_has_the_surface_of_the_grid() -> None:
    heights = np.random.default_rng(0).normal(0.0, 1.0, (8, 13)).astype(np.float32)
    grid = HeightGrid(west=-1.0, south=2.0, spacing=0.5, heights=heights)
    shapes = terrain_shapes(grid, Pose.identity())
    assert len(shapes) == 2 * 3  # 7 x 12 cells in tiles of 5 x 5
    for shape in shapes:
        assert shape.heights is not None
        low = shape.body_from_shape.position - np.array([*shape.size[:2], 0.0])
        rows, columns = (
            grid.window(low + 1e-6, low + 2.0 * np.array([*shape.size[:2], 0]) - 1e-6) or ()
        )
        expected = heights[rows, columns]
        np.testing.assert_allclose(shape.heights + low[2], expected, atol=1e-6)


def test_latitude_and_longitude_become_metres_about_the_origin_of_the_scene() -> None:
    random = np.random.default_rng(1)
    x, y = random.uniform(-5e4, 5e4, (2, 100))
    projection = Projection(parse_system("EPSG:4326"), ORIGIN, "chart")
    longitude, latitude = projection.from_local(x, y)
    for k in range(5):
        place = Geodetic(latitude=math.radians(latitude[k]), longitude=math.radians(longitude[k]))
        north, east, _ = ORIGIN.north_east_down(place)  # an independent way
        assert (east, north) == pytest.approx((x[k], y[k]), abs=1e-6)
    np.testing.assert_allclose(projection.to_local(longitude, latitude), (x, y), atol=1e-6)


def test_pyproj_has_the_same_orthographic_projection_and_converts_utm() -> None:
    pyproj = pytest.importorskip("pyproj", reason="pyproj of the extra `charts` is not installed")
    text = orthographic(ORIGIN).definition
    x, y = np.array([1000.0, -20_000.0]), np.array([-3000.0, 30_000.0])
    longitude, latitude = Projection(parse_system("EPSG:4326"), ORIGIN, "").from_local(x, y)
    transformer = pyproj.Transformer.from_crs("EPSG:4326", text, always_xy=True)
    np.testing.assert_allclose(transformer.transform(longitude, latitude), (x, y), atol=1e-4)
    utm = Projection(parse_system("EPSG:32631"), ORIGIN, "")
    np.testing.assert_allclose(utm.to_local(*utm.from_local(x, y)), (x, y), atol=1e-4)
    easting, northing = utm.from_local(np.zeros(1), np.zeros(1))
    assert easting[0] == pytest.approx(502_742.3, abs=1.0)  # 0.033 degrees east of 3 degrees
    assert 4_620_000 < northing[0] < 4_640_000


def test_a_geographic_chart_is_resampled_to_the_heights_of_its_function(tmp_path: Path) -> None:
    longitude, latitude = 3.03 + 1e-5 * np.arange(700), 41.773 + 1e-5 * np.arange(500)
    heights = -40.0 + 1e4 * (longitude[None] - 3.033) + 2e4 * (latitude[:, None] - 41.775)
    chart = Chart(
        x=3.03, y=41.773, step_x=1e-5, step_y=1e-5, heights=heights.astype(np.float32),
        system=parse_system("EPSG:4326"),
    )  # fmt: skip
    write_chart(tmp_path / "bay.nc", chart)
    spec = BathymetrySpec(crop=(-100.0, -100.0, 100.0, 100.0), spacing=2.0)
    grid = spec.read(tmp_path / "bay.nc", name="bay.nc", origin=ORIGIN)
    assert grid.shape == (101, 101)
    place = ORIGIN.position_at(np.array([60.0, -30.0, 0.0]))
    expected = -40.0 + 1e4 * (math.degrees(place.longitude) - 3.033)
    expected += 2e4 * (math.degrees(place.latitude) - 41.775)
    assert grid.height_at(-30.0, 60.0) == pytest.approx(expected, abs=1e-3)
    again = spec.read(tmp_path / "bay.nc", name="bay.nc", origin=ORIGIN)
    assert again is grid  # from memory


def test_holes_are_refused_or_filled_with_the_nearest_height(tmp_path: Path) -> None:
    heights = np.array([[1, 2, 3], [4, np.nan, 6], [7, 8, 9]], np.float32)
    write_chart(tmp_path / "a.asc", Chart(x=0, y=0, step_x=1, step_y=1, heights=heights))
    with pytest.raises(AssetError, match=r"1 of 9 nodes have no height, the first at x 1, y 1"):
        BathymetrySpec().read(tmp_path / "a.asc", name="a.asc", origin=None)
    filled = BathymetrySpec(holes="fill").read(tmp_path / "a.asc", name="a.asc", origin=None)
    assert filled.heights[1, 1] in (2.0, 4.0, 6.0, 8.0)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"settings": "<u:crop>0 0 1</u:crop>"}, "has 3 numbers; expected west, south, east"),
        ({"settings": "<u:crop>5 0 1 2</u:crop>"}, "is empty; expected west below east"),
        ({"roll": 0.1}, "<orientation> does not apply to a <u:bathymetry>"),
    ],
)
def test_settings_that_do_not_fit_are_errors_of_the_scene(
    values: dict[str, object], message: str, tmp_path: Path
) -> None:
    with pytest.raises(SceneError, match=message):
        read_scene(write_scene(tmp_path, **values))


def test_a_chart_on_earth_needs_a_scene_on_earth_and_limits_within_it(tmp_path: Path) -> None:
    write_bay(tmp_path, orthographic(ORIGIN))
    file = tmp_path / "bay.asc"
    with pytest.raises(AssetError, match=r"<nedOrigin> <lat>41.775000</lat>"):
        BathymetrySpec().read(file, name="bay.asc", origin=None)
    spec = BathymetrySpec(crop=(-99.0, 0.0, 5.0, 5.0))
    with pytest.raises(AssetError, match="covers x -12 to 12 m and y -12 to 12 m"):
        spec.read(file, name="bay.asc", origin=ORIGIN)
    exact = BathymetrySpec(crop=(-2.0, -3.0, 2.0, 3.0)).read(file, name="bay.asc", origin=ORIGIN)
    assert exact.shape == (13, 9)
    assert exact.heights[0, 0] == np.float32(wavy(-2.0, -3.0))


SLOPE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle> <name>rov</name> <file>data/vehicles/bluerov2_heavy.urdf</file>
    <position> <x>0</x> <y>0</y> <z>-3</z> </position>
    <orientation> <r>0</r> <p>0</p> <y>0</y> </orientation>
    <u:dynamics>bluerov2_heavy</u:dynamics> </vehicle>
  <object> <name>floor</name> <file>bay.asc</file>
    <position> <x>0</x> <y>0</y> <z>0</z> </position>
    <orientation> <r>0</r> <p>0</p> <y>0</y> </orientation>
    <u:bathymetry> <u:sediment> <u:file>map.asc</u:file> <u:materials>{materials}</u:materials>
    </u:sediment> </u:bathymetry> </object>
  {boxes}
</UWSimScene>"""
BOX = """<object> <name>{name}</name> <file>objects/blackbox_uib_trimesh.osg</file>
    <position> <x>{x}</x> <y>0</y> <z>0</z> </position>
    <orientation> <r>0</r> <p>0</p> <y>0</y> </orientation>
    <physics> <mass>15</mass> <collisionShapeType>box</collisionShapeType>
      <u:volume>0.002</u:volume> </physics>
    <u:onFloor> <u:alignToSlope>1</u:alignToSlope> </u:onFloor> </object>"""


def write_slope(folder: Path, materials: str = "silt rock") -> Path:
    """Write a floor that falls by 0.4 towards the north: silt in the west, rock in the east."""
    axis = np.arange(-10.0, 10.5, 1.0)
    heights = np.tile(-10.0 - 0.4 * axis[:, None], (1, len(axis))).astype(np.float32)
    codes = np.tile(np.where(axis < 0.0, 0.0, 1.0), (len(axis), 1)).astype(np.float32)
    for name, values in (("bay", heights), ("map", codes)):
        chart = Chart(x=-10.0, y=-10.0, step_x=1.0, step_y=1.0, heights=values)
        write_chart(folder / f"{name}.asc", chart)
    boxes = "".join(BOX.format(name=f"box{x}", x=x) for x in (-3, 3))
    file = folder / "slope.xml"
    file.write_text(SLOPE.format(materials=materials, boxes=boxes))
    return file


def test_a_map_of_sediments_sets_echoes_and_friction(tmp_path: Path) -> None:
    """On a slope of 0.4, steel slides on silt (0.2) and rests on rock (0.7)."""
    simulation = open_scene(read_scene(write_slope(tmp_path)), timestep=0.005)
    rays = simulation.world.rays
    down = np.array([[0.0, 0.0, -1.0]])
    for x, name in ((-3.3, "silt"), (4.6, "rock")):
        hits = rays.cast(Pose(np.array([x, 5.0, 0.0]), np.eye(3)), down, 50.0)
        assert rays.materials[hits.surface[0]] == MATERIALS[name]
        part = simulation.world.scenery.part_names[rays.part_ids[hits.surface[0]]]
        assert part == "floor"
    poses = simulation.world.engine.poses
    starts = [poses.object(index).position[1] for index in (1, 2)]
    simulation.advance(2.0)
    on_silt, on_rock = (
        poses.object(index).position[1] - start for index, start in zip((1, 2), starts, strict=True)
    )
    assert on_silt > 0.5
    assert abs(on_rock) < 0.05
    simulation.close()


def test_a_wrong_material_or_code_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="has 'sillt'; expected names of clay, silt"):
        read_scene(write_slope(tmp_path, "sillt rock"))
    scene = read_scene(write_slope(tmp_path, "silt"))
    with pytest.raises(UwsimError, match=r"x 0.5, y -9.5 m of the scene is 1; expected"):
        open_scene(scene)
