"""Shapes that are touched, and the water's coefficients of loose objects."""

import numpy as np
import pytest

from uwsim.assets import load_model, primitive
from uwsim.assets.mesh import Mesh, Model
from uwsim.errors import UwsimError
from uwsim.model.collision.shapes import (
    MAX_PLATES,
    CollisionShape,
    bounding_box,
    convex_shapes,
    shapes_of,
)
from uwsim.physics.free_objects import (
    box_drag,
    ellipsoid_added_mass,
    loose_hydrodynamics,
    loose_link,
)
from uwsim.scene.object import PhysicsSpec

SAME = np.eye(4)


def mesh_of(vertices: list, triangles: list) -> Model:
    points = np.array(vertices, dtype=np.float32)
    mesh = Mesh(
        vertices=points,
        normals=np.zeros_like(points),
        uvs=np.zeros((len(points), 2), dtype=np.float32),
        triangles=np.array(triangles, dtype=np.uint32),
    )
    return Model(name="mesh", meshes=(mesh,), source="file")


def ring() -> Model:
    """A flat frame from 1 to 2 m about the origin, seen from above."""
    outer, inner = 2.0, 1.0
    turns = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    vertices = [(outer * x, outer * y, 0) for x, y in turns]
    vertices += [(inner * x, inner * y, 0) for x, y in turns]
    triangles = []
    for i in range(4):
        j = (i + 1) % 4
        triangles += [(i, j, 4 + j), (i, 4 + j, 4 + i)]
    vertices.append((0, 0, 1))  # a point above, so that it has a height
    return mesh_of(vertices, triangles)


def test_a_box_is_made_of_the_scaled_and_moved_mesh() -> None:
    placed = np.diag([2.0, 1.0, 1.0, 1.0])
    placed[:3, 3] = (0.0, 0.0, 5.0)
    (box,) = shapes_of(primitive("box", (1.0, 2.0, 3.0)), placed, "box", is_fixed=False)
    assert box.size == pytest.approx((1.0, 1.0, 1.5))
    assert box.body_from_shape.position == pytest.approx([0.0, 0.0, 5.0])


WEDGE = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
OUTWARDS = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


def test_a_convex_mesh_is_its_hull_and_a_box_stays_a_box() -> None:
    shapes = convex_shapes(mesh_of(WEDGE, OUTWARDS), np.diag([2.0, 1.0, 1.0, 1.0]))
    assert shapes is not None
    assert [shape.kind for shape in shapes] == ["hull"]
    assert shapes[0].corners == pytest.approx(np.array(WEDGE) * (2.0, 1.0, 1.0))
    boxes = convex_shapes(primitive("box", (1.0, 2.0, 3.0)), SAME)
    assert boxes is not None
    assert [(shape.kind, shape.size) for shape in boxes] == [("box", (0.5, 1.0, 1.5))]


def test_a_mesh_with_a_hollow_has_no_convex_shapes() -> None:
    hollow = [*WEDGE, (0.2, 0.2, 0.2)]
    triangles = [*OUTWARDS[:3], (1, 2, 4), (2, 3, 4), (3, 1, 4)]
    assert convex_shapes(mesh_of(hollow, triangles), SAME) is None


def test_a_cylinder_lies_along_the_longest_edge() -> None:
    model = primitive("box", (3.0, 1.0, 1.0))
    (rod,) = shapes_of(model, SAME, "compound cylinder", is_fixed=False)
    assert rod.size == pytest.approx((0.5, 1.5))
    assert np.abs(rod.body_from_shape.rotation[:, 2]) == pytest.approx([1.0, 0.0, 0.0])
    assert np.linalg.det(rod.body_from_shape.rotation) == pytest.approx(1.0)


def test_a_flat_rectangle_becomes_one_slab_behind_its_face() -> None:
    corners = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0), (0, 0, 4)]
    (slab,) = shapes_of(mesh_of(corners, [(0, 1, 2), (0, 2, 3)]), SAME, "trimesh", is_fixed=True)
    assert slab.kind == "box"
    assert sorted(slab.size) == pytest.approx([0.05, 0.5, 1.0])
    assert slab.body_from_shape.position == pytest.approx([1.0, 0.5, -0.05])


def test_a_ring_is_not_closed() -> None:
    plates = shapes_of(ring(), SAME, "trimesh", is_fixed=True)
    assert len(plates) == 4
    assert not any(holds(plate, (x, y, -0.05)) for plate in plates for x in INNER for y in INNER)
    assert all(any(holds(plate, (x, 1.5, -0.05)) for plate in plates) for x in INNER)


INNER = (-0.9, 0.0, 0.9)  # within the ring's hole [m]


def test_a_flat_patch_that_is_no_rectangle_becomes_a_prism_behind_its_face() -> None:
    corners = [(0, 0, 0), (3, 0, 0), (2, 1, 0), (0, 1, 0), (0, 0, 4)]
    (prism,) = shapes_of(mesh_of(corners, [(0, 1, 2), (0, 2, 3)]), SAME, "trimesh", is_fixed=True)
    assert prism.corners is not None
    assert prism.corners.shape == (8, 3)
    assert sorted(set(prism.corners[:, 2].round(6).tolist())) == [-0.1, 0.0]


def test_the_tank_is_open_in_its_middle_and_has_a_floor() -> None:
    tank = load_model("terrain/CIRS/cirs_trident.osg", named_by=None, data_path=())
    plates = shapes_of(tank, SAME, "trimesh", is_fixed=True)
    assert len(plates) < MAX_PLATES
    inside = [plate for plate in plates if holds(plate, (0.0, 0.0, -2.0))]
    below = [plate for plate in plates if holds(plate, (0.0, 0.0, -4.87))]
    assert inside == []
    assert len(below) >= 1


def holds(shape: CollisionShape, point: tuple[float, float, float]) -> bool:
    local = shape.body_from_shape.inverse().transform(np.array([point]))[0]
    if shape.corners is None:
        return bool(np.all(np.abs(local) <= shape.size))
    low, high = shape.corners.min(axis=0), shape.corners.max(axis=0)
    return bool(np.all((local >= low) & (local <= high)))


def test_a_mesh_with_too_many_faces_says_what_to_do(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("uwsim.model.collision.shapes.MAX_PLATES", 100)
    rng = np.random.Generator(np.random.Philox(1))
    points = rng.uniform(size=(3 * 100 + 3, 3))
    soup = mesh_of(points.tolist(), np.arange(len(points)).reshape(-1, 3).tolist())
    with pytest.raises(UwsimError, match="<collisionShape>"):
        shapes_of(soup, SAME, "trimesh", is_fixed=True)


@pytest.mark.parametrize(
    ("ratio", "along", "across", "turning"),
    [(1.0, 0.5, 0.5, 0.0), (2.0, 0.209, 0.702, 0.240), (4.99, 0.059, 0.895, 0.701)],
)
def test_added_mass_is_lambs(ratio: float, along: float, across: float, turning: float) -> None:
    half = np.array([ratio, 1.0, 1.0])
    volume = 4.0 / 3.0 * np.pi * ratio
    added = ellipsoid_added_mass(half)
    inertia = volume / 5.0 * (ratio**2 + 1.0)
    assert added[:3] / volume == pytest.approx([along, across, across], abs=3e-3)
    assert added[3:] / inertia == pytest.approx([0.0, turning, turning], abs=3e-3)


def test_drag_of_a_turning_box_is_that_of_its_strips() -> None:
    x, y, z = 0.3, 0.2, 0.5
    r = (np.arange(20_000) + 0.5) / 20_000
    about_x = 0.5 * 1.05 * 2.0 * x * np.mean(r**3) * ((z / 2) ** 4 + (y / 2) ** 4)
    assert box_drag(np.array([x, y, z]))[3] == pytest.approx(about_x, rel=1e-4)


def test_inertia_is_that_of_a_solid_box_unless_the_file_says_another() -> None:
    shapes = shapes_of(primitive("box", (1.0, 2.0, 3.0)), SAME, "box", is_fixed=False)
    link = loose_link("box", PhysicsSpec(mass=12.0), shapes)
    assert link.inertia == pytest.approx((13.0, 10.0, 5.0, 0.0, 0.0, 0.0))
    link = loose_link("box", PhysicsSpec(mass=12.0, inertia=(1.0, 2.0, 2.5)), shapes)
    assert link.inertia[:3] == (1.0, 2.0, 2.5)


def test_buoyancy_is_the_boxs_unless_the_file_says_another() -> None:
    shapes = shapes_of(primitive("box", (1.0, 2.0, 3.0)), SAME, "box", is_fixed=False)
    assert loose_hydrodynamics("a", PhysicsSpec(), shapes, 1000.0).volume == pytest.approx(6.0)
    given = PhysicsSpec(volume=0.5, linear_damping=0.2)
    water = loose_hydrodynamics("a", given, shapes, 1000.0)
    assert water.volume == 0.5
    assert water.linear_damping[:3] == pytest.approx((0.2, 0.2, 0.2))


def test_a_ball_has_its_own_volume_and_added_mass() -> None:
    shapes = shapes_of(primitive("sphere", (0.5,)), SAME, "sphere", is_fixed=False)
    water = loose_hydrodynamics("a", PhysicsSpec(), shapes, 1000.0)
    assert water.volume == pytest.approx(np.pi / 6.0, rel=1e-3)
    assert water.added_mass[:3] == pytest.approx([500.0 * water.volume] * 3, rel=1e-3)


def test_bounds_hold_every_shape() -> None:
    model = primitive("box", (3.0, 1.0, 1.0))
    for kind in ("box", "compound box", "compound cylinder", "trimesh"):
        box = bounding_box(shapes_of(model, SAME, kind, is_fixed=False))
        assert box.size == pytest.approx((1.5, 0.5, 0.5)), kind
