"""``<u:onFloor>``: what stands on the ground, whatever the ground is like."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.girona500 import SCENE, run
from tests.support.opened import open_scene
from uwsim.assets import load_model
from uwsim.base.geometry import Pose
from uwsim.checks import check_file
from uwsim.errors import SceneError
from uwsim.scene.object import ObjectSpec, PhysicsSpec
from uwsim.scene.on_floor import OnFloorSpec
from uwsim.scene.reader import read_scene
from uwsim.scene.sim_params import SimParamsSpec
from uwsim.scene.spec import SceneSpec
from uwsim.scene.vehicle import VehicleSpec
from uwsim.simulation import Simulation

DOWN = SimParamsSpec(offsetr=(np.pi, 0.0, -np.pi / 2.0))
UP = SimParamsSpec()
ON_FLOOR = OnFloorSpec()
BOX = "objects/blackbox_uib_trimesh.osg"
EDGES = np.array([0.13, 0.433, 0.15])  # of it [m]


def obj(folder: Path, name: str, points: np.ndarray, faces: np.ndarray) -> str:
    lines = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in points]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    (folder / name).write_text("\n".join(lines))
    return str(folder / name)


def grid(folder: Path, height, n: int = 40, reach: float = 8.0, hole: float = 0.0) -> str:  # type: ignore[no-untyped-def]
    """A sea floor z = height(x, y), z up, with a round hole in its middle."""
    x, y = np.meshgrid(np.linspace(-reach, reach, n + 1), np.linspace(-reach, reach, n + 1))
    points = np.column_stack([x.ravel(), y.ravel(), height(x.ravel(), y.ravel())])
    i = np.arange((n + 1) * n).reshape(n, n + 1)[:, :-1].ravel()
    faces = np.concatenate(
        [np.column_stack([i, i + 1, i + n + 2]), np.column_stack([i, i + n + 2, i + n + 1])]
    )
    middle = points[faces].mean(axis=1)[:, :2]
    return obj(folder, "ground.obj", points, faces[np.linalg.norm(middle, axis=1) >= hole])


def ground(file: str, **changes: object) -> ObjectSpec:
    return ObjectSpec(name="terrain", file=file, **changes)  # type: ignore[arg-type]


def thing(x: float, y: float, z: float = 0.0, **changes: object) -> ObjectSpec:
    given = {"on_floor": ON_FLOOR, **changes}
    return ObjectSpec(name="thing", file=BOX, position=(x, y, z), **given)  # type: ignore[arg-type]


def opened(*objects: ObjectSpec, frame: SimParamsSpec = UP, rov: bool = False) -> Simulation:
    vehicles = ()
    if rov:
        vehicles = (replace(read_scene(SCENE).vehicles[0], parts=(), name="rov"),)
    return open_scene(SceneSpec(sim_params=frame, objects=objects, vehicles=vehicles))


def corners(simulation: Simulation) -> np.ndarray:
    """Corners of the thing in W, (8, 3) [m]."""
    body = simulation.world.bodies.find("thing")
    assert body.box is not None
    return body.world_from_body.transform(body.box.corners())


def lowest(simulation: Simulation) -> float:
    return float(corners(simulation)[:, 2].min())


def flat(depth: float):  # type: ignore[no-untyped-def]
    return lambda x, y: np.full_like(x, -depth)


@pytest.mark.parametrize(("frame", "sign"), [(UP, 1.0), (DOWN, -1.0)])
def test_a_box_stands_on_a_flat_floor_whichever_way_the_files_z_points(
    frame: SimParamsSpec, sign: float, tmp_path: Path
) -> None:
    file = grid(tmp_path, flat(4.0))
    turned = (0.0, 0.0, 0.0) if sign > 0 else (np.pi, 0.0, 0.0)
    simulation = opened(ground(file, orientation=turned), thing(1.3, -0.7), frame=frame)
    assert lowest(simulation) == pytest.approx(-4.0, abs=1e-6)
    place = (
        simulation.world.model.scene.world_from_localized.inverse()
        @ simulation.world.bodies.find("thing").world_from_body
    )
    assert (place.position - place.rotation @ [0, 0, 0])[:2] == pytest.approx([1.3, -0.7], abs=1e-9)


def test_a_clearance_lifts_and_a_negative_one_sinks_in(tmp_path: Path) -> None:
    file = grid(tmp_path, flat(4.0))
    for clearance in (0.3, -0.05):
        stands = thing(0.0, 0.0, on_floor=OnFloorSpec(clearance=clearance))
        assert lowest(opened(ground(file), stands)) == pytest.approx(-4.0 + clearance, abs=1e-6)


def dunes(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return -4.0 + 0.5 * np.sin(1.7 * x) * np.cos(1.3 * y)


@pytest.mark.parametrize("place", [(0.3, 0.2), (1.1, -2.05), (-3.3, 2.7), (5.0, 5.0)])
@pytest.mark.parametrize("large", [1.0, 12.0])
def test_on_relief_a_box_touches_and_does_not_reach_in(
    place: tuple[float, float], large: float, tmp_path: Path
) -> None:
    file = grid(tmp_path, dunes)
    stands = thing(*place, orientation=(0.1, 0.2, 0.7), scale_factor=(large, large, large))
    simulation = opened(ground(file), stands)
    assert clearance_by_sampling(simulation, file) == pytest.approx(0.0, abs=2e-3 * large)


def clearance_by_sampling(simulation: Simulation, file: str) -> float:
    """Least height of points of the thing's surface over the ground, by brute force [m]."""
    import trimesh
    from matplotlib.tri import LinearTriInterpolator, Triangulation

    part = simulation.world.bodies.find("thing")
    scale = simulation.world.model.scene.objects[1].scale_factor[0]
    points = np.concatenate([mesh.vertices for mesh in load_model(BOX).meshes]) * scale
    hull = trimesh.convex.convex_hull(points)
    surface, _ = trimesh.sample.sample_surface_even(hull, 4000, seed=1)
    points = part.world_from_body.transform(np.concatenate([surface, hull.vertices]))
    below = trimesh.load(file, process=False)
    plane = Triangulation(below.vertices[:, 0], below.vertices[:, 1], below.faces)
    height = LinearTriInterpolator(plane, below.vertices[:, 2])(points[:, 0], points[:, 1])
    return float((points[:, 2] - height).min())


def test_aligned_to_a_slope_a_box_lies_flat_on_it(tmp_path: Path) -> None:
    steepness = 0.4
    file = grid(tmp_path, lambda x, y: -4.0 + np.tan(steepness) * x)
    stands = thing(1.0, 2.0, orientation=(0.0, 0.0, 0.5), on_floor=OnFloorSpec(align_to_slope=True))
    simulation = opened(ground(file), stands)
    over = corners(simulation)[:, 2] - (-4.0 + np.tan(steepness) * corners(simulation)[:, 0])
    assert np.sort(over)[:4] == pytest.approx(np.zeros(4), abs=1e-6)
    rotation = simulation.world.bodies.find("thing").world_from_body.rotation
    heading = np.arctan2(rotation[1, 0], rotation[0, 0])
    assert heading == pytest.approx(0.5, abs=0.1)


def test_a_ball_touches_with_its_lowest_point(tmp_path: Path) -> None:
    file = grid(tmp_path, flat(4.0))
    ball = thing(0.0, 0.0, physics=PhysicsSpec(collision_shape_type="sphere"))
    simulation = opened(ground(file), ball)
    middle = corners(simulation).mean(axis=0)
    assert middle[2] == pytest.approx(-4.0 + 0.5 * EDGES.max(), abs=1e-3)


@pytest.mark.slow
def test_what_is_loose_stays_where_it_was_set(tmp_path: Path) -> None:
    file = grid(tmp_path, dunes)
    stands = thing(
        0.95, 0.1, physics=PhysicsSpec(mass=30.0), on_floor=OnFloorSpec(align_to_slope=True)
    )
    simulation = opened(ground(file), stands, frame=UP, rov=True)
    simulation.advance(0.0)
    before = simulation.world.bodies.find("thing").world_from_body.position
    run(simulation, 3.0)
    after = simulation.world.bodies.find("thing").world_from_body.position
    assert after == pytest.approx(before, abs=0.02)


def box_mesh(low: tuple[float, ...], high: tuple[float, ...]) -> tuple[np.ndarray, np.ndarray]:
    import trimesh

    box = trimesh.creation.box(bounds=[low, high])
    return np.asarray(box.vertices), np.asarray(box.faces)


def joined(folder: Path, *parts: tuple[np.ndarray, np.ndarray]) -> str:
    points, faces, n = [], [], 0
    for vertices, triangles in parts:
        points.append(vertices)
        faces.append(triangles + n)
        n += len(vertices)
    return obj(folder, "ground.obj", np.concatenate(points), np.concatenate(faces))


def test_under_an_overhang_the_height_says_which_floor_is_meant(tmp_path: Path) -> None:
    floor = box_mesh((-8, -8, -11), (8, 8, -10))
    arch = box_mesh((-2, -2, -7), (2, 2, -6))
    file = joined(tmp_path, floor, arch)
    assert lowest(opened(ground(file), thing(0.0, 0.0, -8.0))) == pytest.approx(-10.0, abs=1e-6)
    assert lowest(opened(ground(file), thing(0.0, 0.0, -1.0))) == pytest.approx(-6.0, abs=1e-6)
    # within the rock of the arch: on it
    assert lowest(opened(ground(file), thing(0.0, 0.0, -6.5))) == pytest.approx(-6.0, abs=1e-6)


def test_on_a_beach_above_the_water_it_stands_on_the_beach(tmp_path: Path) -> None:
    file = grid(tmp_path, lambda x, y: 0.5 * x)
    high = lowest(opened(ground(file), thing(6.0, 0.0, 0.0)))
    assert high == pytest.approx(0.5 * (6.0 + 0.5 * EDGES[0]), abs=1e-6)


@pytest.mark.slow
def test_over_a_hole_in_the_ground_nothing_can_stand(tmp_path: Path) -> None:
    file = grid(tmp_path, flat(4.0), hole=3.0)
    with pytest.raises(SceneError, match="no ground under the object 'thing' at x 0, y 0"):
        opened(ground(file), thing(0.0, 0.0))
    # a hole narrower than it is long does not matter
    narrow = grid(tmp_path, flat(4.0), n=160, hole=0.15)
    assert lowest(opened(ground(narrow), thing(0.0, 0.0))) == pytest.approx(-4.0, abs=1e-6)


def test_a_thing_as_thin_as_paper_lies_on_the_ground(tmp_path: Path) -> None:
    file = grid(tmp_path, flat(4.0))
    sheet = obj(
        tmp_path, "sheet.obj",
        np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]), np.array([[0, 1, 2], [0, 2, 3]]),
    )  # fmt: skip
    simulation = opened(ground(file), replace(thing(0.0, 0.0), file=sheet))
    assert simulation.world.bodies.find("thing").world_from_body.position[2] == pytest.approx(
        -4.0, abs=1e-3
    )


def test_on_scaled_terrain_it_stands_where_the_terrain_is_seen(tmp_path: Path) -> None:
    file = grid(tmp_path, dunes)
    scaled = ground(file, scale_factor=(1.0, 1.0, 2.0), position=(0.5, 0.0, 1.0))
    simulation = opened(scaled, thing(0.5 + 0.924, 0.0))
    assert lowest(simulation) == pytest.approx(1.0 + 2.0 * -3.5, abs=0.05)


def test_ground_that_is_only_looked_at_carries_and_so_does_other_solid_scenery(
    tmp_path: Path,
) -> None:
    file = grid(tmp_path, flat(4.0))
    assert lowest(opened(ground(file, is_solid=False), thing(0.0, 0.0))) == pytest.approx(-4.0)
    wreck = ObjectSpec(name="wreck", file=file, is_solid=True)
    assert lowest(opened(wreck, thing(0.0, 0.0))) == pytest.approx(-4.0)
    with pytest.raises(SceneError, match="no ground under the object"):
        opened(replace(wreck, is_solid=None), thing(0.0, 0.0))


@pytest.mark.parametrize("align", [False, True])
def test_a_vehicle_begins_with_its_lowest_link_on_the_floor(align: bool, tmp_path: Path) -> None:
    file = grid(tmp_path, flat(6.0))
    scene = read_scene(SCENE).nominal_scene
    vehicle = replace(
        scene.vehicles[0],
        parts=(),
        position=(2.0, 1.0, 0.0),
        on_floor=OnFloorSpec(align_to_slope=align, clearance=-0.003),
    )
    terrain = ground(file, orientation=(np.pi, 0.0, 0.0))
    simulation = open_scene(
        replace(scene, vehicles=(vehicle,), objects=(terrain,)), data_path=(tmp_path,)
    )
    simulation.advance(0.0)
    start: Pose = simulation.world.bodies.find("girona500").world_from_body
    simulation.advance()
    touched = simulation.world.contacts.find("girona500")
    run(simulation, 0.05)
    end: Pose = simulation.world.bodies.find("girona500").world_from_body
    assert {contact.other for contact in touched} == {"terrain"}
    assert np.linalg.norm(end.position - start.position) < 0.005
    localized = simulation.world.model.scene.world_from_localized.inverse() @ start
    assert localized.position[:2] == pytest.approx([2.0, 1.0], abs=1e-9)


TWO_LINKS = """<robot name="tall">
  <link name="base"> <visual> <geometry> <box size="1 1 1"/> </geometry> </visual> </link>
  <link name="foot"> <visual> <geometry> <box size="0.2 0.2 0.2"/> </geometry> </visual> </link>
  <joint name="leg" type="fixed"> <origin xyz="0 0 -2"/>
    <parent link="base"/> <child link="foot"/> </joint>
</robot>"""


def test_a_scaled_vehicle_stands_on_its_scaled_foot(tmp_path: Path) -> None:
    (tmp_path / "tall.urdf").write_text(TWO_LINKS)
    vehicle = VehicleSpec(
        name="tall",
        file=str(tmp_path / "tall.urdf"),
        scale_factor=(1.0, 1.0, 1.5),
        on_floor=ON_FLOOR,
    )
    scene = SceneSpec(objects=(ground(grid(tmp_path, flat(6.0))),), vehicles=(vehicle,))
    height = open_scene(scene).world.bodies.find("tall").world_from_body.position[2]
    assert height == pytest.approx(-6.0 + 1.5 * 2.1, abs=1e-6)


FILE = """<UWSimScene xmlns:u="urn:uwsim:1">
<object> <name>terrain</name> <file>terrain/islands/islands.osg</file>
<position> <x>0</x> <y>0</y> <z>-15</z> </position> </object>
<object> <name>pot</name> <file>objects/amphora.osg</file>
<position> <x>{x}</x> <y>0</y> <z>0</z> </position>
<u:onFloor/>
</object> </UWSimScene>"""


def test_check_says_with_its_line_where_there_is_no_ground(tmp_path: Path) -> None:
    path = tmp_path / "scene.xml"
    path.write_text(FILE.format(x=3))
    assert [diagnostic for diagnostic in check_file(path) if diagnostic.severity == "error"] == []
    assert open_scene(read_scene(path)).world.bodies.find("pot").world_from_body.position[2] > -7.2
    path.write_text(FILE.format(x=300))
    (diagnostic,) = [
        diagnostic for diagnostic in check_file(path) if diagnostic.severity == "error"
    ]
    assert (diagnostic.line, "at x 300, y 0" in diagnostic.message) == (6, True)
    with pytest.raises(SceneError) as caught:
        open_scene(read_scene(path))
    assert caught.value.diagnostics == (diagnostic,)
