"""Sand buries objects; a dredge tool uncovers them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.small_robots import scene_of, shape, write_robot
from tests.support.opened import open_scene
from uwsim.assets.procedural.sand_texture import TILE, make_sand_texture
from uwsim.base.geometry import Pose
from uwsim.devices.dredge_tool import DredgeTool, DredgeToolSpec
from uwsim.scene.object import ObjectSpec
from uwsim.scene.spec import SceneSpec
from uwsim.scene.vehicle import VehicleSpec
from uwsim.sensors.dvl_sensor import Dvl, DvlSensorSpec
from uwsim.sensors.virtual_camera import VirtualCameraSpec
from uwsim.simulation import Simulation
from uwsim.simulation.scenery.sand import TEXTURED_COLOUR, Heap

EYE = VirtualCameraSpec(name="eye", relative_to="base_link", position=(0.0, 0.0, 2.0))
TOOL = DredgeToolSpec(name="dredge", target="base_link")
DOWN = np.array([[0.0, 0.0, -1.0]])


def heap() -> Heap:
    """A box of 0.2 m by 0.4 m, 0.2 m high, half buried."""
    return Heap("box", np.array([0.0, 0.0, 1.0]), np.array([0.2, 0.4, 1.2]), 0.5)


def test_a_heap_is_level_over_its_object_and_falls_as_a_parabola_beside_it() -> None:
    sand = heap()
    assert sand.height(0.1, 0.2) == sand.height(0.19, 0.39) == pytest.approx(1.1)
    for away in (0.1, 0.2, 0.29):  # the skirt is 0.3 m long
        wanted = 1.0 + 0.1 * (1.0 - (away / 0.3) ** 2)
        assert sand.height(-away, 0.2) == pytest.approx(wanted, abs=1e-6)
        assert sand.height(0.1, 0.4 + away) == pytest.approx(wanted, abs=1e-6)
    assert sand.height(-0.31, 0.2) == pytest.approx(1.0)


def test_digging_takes_a_centimetre_of_each_column_within_a_decimetre() -> None:
    """On a level top a disc of 0.1 m in columns of 1 cm: about 314."""
    sand = heap()
    n = sand.dig(np.array([0.1, 0.2, 1.1]))
    assert n == pytest.approx(314, abs=8)
    assert sand.height(0.1, 0.2) == sand.height(0.15, 0.25) == pytest.approx(1.09)
    assert sand.height(0.1, 0.35) == pytest.approx(1.1)
    assert sand.dig(np.array([0.1, 0.2, 1.3])) == 0
    assert sand.version == 1


def test_sand_with_a_texture_ends_where_its_height_is_zero() -> None:
    plain_mesh = heap().mesh()
    texture = make_sand_texture()
    lower, upper = np.array([0.0, 0.0, 1.0]), np.array([0.2, 0.4, 1.2])
    sand = Heap("box", lower, upper, 0.5, texture)
    mesh = sand.mesh()
    assert mesh.texture is texture
    np.testing.assert_array_equal(mesh.vertices, plain_mesh.vertices)  # as pages expect them
    # a rectangle of 0.8 by 1 m whose corners are rounded by 0.3 m
    area = 0.8 * 1.0 - (4.0 - np.pi) * 0.3**2
    assert len(mesh.triangles) * 0.01**2 / 2 == pytest.approx(area, rel=0.02)
    assert np.ptp(mesh.uvs, axis=0) == pytest.approx([0.8 / TILE, 1.0 / TILE], abs=0.01)
    mean_colour = np.array(mesh.colour) * texture.pixels.mean() / 255.0
    assert mean_colour == pytest.approx(TEXTURED_COLOUR, rel=0.03)
    sand.dig(np.array([0.1, 0.2, 1.1]))
    assert len(sand.mesh().triangles) == len(mesh.triangles)


def test_opposite_sides_of_the_texture_of_sand_fit_together() -> None:
    pixels = make_sand_texture().pixels[..., 0].astype(float)
    assert pixels.std() > 10.0
    seam = np.abs(pixels[0] - pixels[-1]).mean()
    assert seam < 1.3 * np.abs(np.diff(pixels, axis=0)).mean()


def test_no_sand_is_taken_below_the_bottom() -> None:
    sand = heap()
    for _ in range(20):
        sand.dig(np.array([0.1, 0.2, 1.03]))
    assert sand.height(0.1, 0.2) == pytest.approx(1.0)
    assert sand.dig(np.array([0.1, 0.2, 1.0])) < 314


def scene(folder: Path, buried: float) -> SceneSpec:
    """A vehicle 1 m above a buried box, with a camera 2 m above it that looks down."""
    robot = write_robot(folder, f'<link name="base_link">{shape(size=(0.01, 0.01, 0.01))}</link>')
    vehicle = VehicleSpec(name="rov", file=str(robot), position=(0.5, 0.0, 1.0), parts=(EYE, TOOL))
    box = ObjectSpec(name="box", file="objects/blackbox_uib_trimesh.osg", buried=buried)
    return scene_of(vehicle, objects=(box,))


def below(simulation: Simulation) -> float:
    """Distance from 1 m above the box down to what is there."""
    at = Pose(np.array([0.0, 0.0, 1.0]), np.eye(3))
    return float(simulation.world.rays.cast(at, DOWN, 10.0).distance[0])


def test_a_tool_uncovers_an_object_for_rays_and_cameras(tmp_path: Path) -> None:
    with open_scene(scene(tmp_path, 1.0)) as buried, open_scene(scene(tmp_path, 0.0)) as bare:
        buried.advance(0.02)
        top = 1.0 - below(bare)
        assert below(buried) == pytest.approx(1.0 - top, abs=1e-6)  # sand up to its top
        before = buried.image("eye")
        place = Pose(np.array([0.0, 0.0, top]), np.eye(3))
        buried.world.vehicles.find("rov").place(place)
        buried.advance(0.1)
        assert buried.world.scenery.heaps[0].height(0.0, 0.0) < top - 0.02
        tool = next(d for d in buried.world.devices if isinstance(d, DredgeTool))
        assert tool.state.n_lowered > 1000
        after = buried.image("eye")
        assert before.ids is not None
        assert after.ids is not None
        box, sand = 2, 3
        assert buried.world.scenery.part_names[sand] == "sand/box"
        assert (before.ids == sand).any()
        assert (after.ids == box).sum() > (before.ids == box).sum() + 20


def test_sand_is_saved(tmp_path: Path) -> None:
    spec = scene(tmp_path, 0.8)
    spec = replace(spec, vehicles=(replace(spec.vehicles[0], position=(0.0, 0.0, 0.05)),))
    with open_scene(spec, is_blind=True) as first, open_scene(spec, is_blind=True) as second:
        first.advance(0.1)
        second.restore(first.save())
        one, other = (s.world.scenery.heaps[0].height(0.0, 0.0) for s in (first, second))
        assert one == other
        assert below(first) == below(second)


def test_a_dvl_over_a_buried_object_hears_the_sand(tmp_path: Path) -> None:
    looks_down = (np.pi, 0.0, 0.0)
    dvl = DvlSensorSpec(
        name="dvl", relative_to="base_link", orientation=looks_down, beam_angle=1.0
    )  # fmt: skip
    spec = scene(tmp_path, 1.0)
    rov = replace(spec.vehicles[0], position=(0.0, 0.0, 1.0), parts=(dvl,))
    with open_scene(replace(spec, vehicles=(rov,)), is_blind=True) as simulation:
        sensor = simulation.world.sensors.sensor("dvl", ("dvlSensor",))
        assert isinstance(sensor, Dvl)
        ranges = np.array(sensor.sample(0.0).raw_data.split()[:4], dtype=float)
        assert ranges == pytest.approx(below(simulation) / np.cos(np.radians(1.0)), abs=1e-3)
