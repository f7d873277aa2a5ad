"""Triangles joined to convex faces: what they cover stays the same, and there are few."""

import itertools

import numpy as np
import pytest

from uwsim.assets import load_model, primitive
from uwsim.base.geometry import rotation_from_rpy
from uwsim.model.collision.convex_faces import convex_faces

LEVEL = 0.3  # height of the flat meshes below [m]


def quads(*corners: tuple[tuple[float, float], ...]) -> np.ndarray:
    """Triangles of flat quadrilaterals seen from above."""
    triangles = []
    for a, b, c, d in corners:
        triangles += [(a, b, c), (a, c, d)]
    flat = np.array(triangles, dtype=float)
    return np.concatenate([flat, np.full((*flat.shape[:2], 1), LEVEL)], axis=2)


def grid(xs: list[float], ys: list[float], *, without: tuple[tuple[int, int], ...] = ()):
    cells = []
    for (i, (x0, x1)), (j, (y0, y1)) in itertools.product(
        enumerate(itertools.pairwise(xs)), enumerate(itertools.pairwise(ys))
    ):
        if (i, j) not in without:
            cells.append(((x0, y0), (x1, y0), (x1, y1), (x0, y1)))
    return quads(*cells)


def area(face: np.ndarray) -> float:
    return float(np.linalg.norm(np.cross(face[1:-1] - face[0], face[2:] - face[0]).sum(axis=0)) / 2)


def normal(face: np.ndarray) -> np.ndarray:
    found = np.cross(face[1:-1] - face[0], face[2:] - face[0]).sum(axis=0)
    return found / np.linalg.norm(found)


def covers(faces: list[np.ndarray], point: tuple[float, float]) -> int:
    """How many of some level faces lie over a point."""
    n = 0
    for face in faces:
        after = np.roll(face, -1, axis=0)
        edges, ways = (after - face)[:, :2], np.array(point) - face[:, :2]
        n += bool(np.all(edges[:, 0] * ways[:, 1] - edges[:, 1] * ways[:, 0] > -1e-9))
    return n


def test_a_grid_is_one_rectangle_of_four_corners() -> None:
    (face,) = convex_faces(grid([0, 1, 1.7, 4], [0, 0.5, 2]))
    assert len(face) == 4
    assert area(face) == pytest.approx(8.0)
    assert normal(face) == pytest.approx([0, 0, 1])
    assert face[:, 2] == pytest.approx(LEVEL)


def test_a_frame_is_four_pieces_and_its_hole_stays_open() -> None:
    faces = convex_faces(grid([0, 1, 2, 3], [0, 1, 2, 3], without=((1, 1),)))
    assert len(faces) == 4
    rng = np.random.Generator(np.random.Philox(1))
    for x, y in rng.uniform(0.0, 3.0, (500, 2)):
        inside_hole = 1 < x < 2 and 1 < y < 2
        assert covers(faces, (x, y)) == (0 if inside_hole else 1)


def test_parts_that_are_cut_differently_are_joined_all_the_same() -> None:
    left, right = grid([0, 2], [0, 1, 2, 3]), grid([2, 5], [0, 3])
    assert len(convex_faces(np.concatenate([left, right]))) == 1


def test_two_levels_and_two_sides_stay_apart() -> None:
    low = grid([0, 1, 2], [0, 1, 2])
    high = low + np.array([0.0, 0.0, 0.5])
    back = low[:, ::-1]
    assert len(convex_faces(np.concatenate([low, high, back]))) == 3


def test_a_gentle_bend_is_not_flattened() -> None:
    """A row of strips, each one degree steeper: no two lie in one plane."""
    x, z, strips = 0.0, 0.0, []
    for i in range(20):
        nx, nz = x + np.cos(np.radians(i)), z + np.sin(np.radians(i))
        a, b, c, d = (x, 0, z), (nx, 0, nz), (nx, 3, nz), (x, 3, z)
        strips += [(a, b, c), (a, c, d)]
        x, z = nx, nz
    faces = convex_faces(np.array(strips))
    assert len(faces) == 20
    assert sum(map(area, faces)) == pytest.approx(60.0)


def test_faces_that_lie_on_one_another_are_left_as_they_are() -> None:
    twice = np.concatenate([grid([0, 1, 2], [0, 1]), grid([0, 1, 2], [0, 1])])
    assert len(convex_faces(twice)) == len(twice)


def test_slivers_are_dropped() -> None:
    sliver = np.array([[(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 0, 0), (0, 0, 0), (1, 1, 0)]])
    assert convex_faces(sliver.astype(float)) == []


def test_faces_do_not_depend_on_where_the_mesh_stands() -> None:
    mesh = grid([0, 1, 2, 3, 4], [0, 1, 2, 3], without=((1, 1), (3, 2), (0, 0)))
    before = sorted(area(face) for face in convex_faces(mesh))
    turn = rotation_from_rpy(0.3, -1.1, 2.0)
    after = sorted(area(face) for face in convex_faces(mesh @ turn.T + [5.0, -3.0, 1.0]))
    assert after == pytest.approx(before)
    assert sum(before) == pytest.approx(9.0)


def test_a_random_checker_keeps_its_area_and_covers_each_point_once() -> None:
    rng = np.random.Generator(np.random.Philox(7))
    gone = tuple((i, j) for i in range(8) for j in range(8) if rng.random() < 0.3)
    lines = np.arange(9.0).tolist()
    mesh = grid(lines, lines, without=gone)
    faces = convex_faces(mesh)
    assert len(faces) < len(mesh) / 2
    assert sum(map(area, faces)) == pytest.approx(sum(map(area, mesh)))
    for x, y in rng.uniform(0.0, 8.0, (1000, 2)):
        assert covers(faces, (x, y)) == (0 if (int(x), int(y)) in gone else 1)


def test_a_cylinder_has_one_face_for_each_side_and_end() -> None:
    model = primitive("cylinder", (0.5, 2.0))
    triangles = model.meshes[0].vertices.astype(float)[model.meshes[0].triangles]
    faces = convex_faces(triangles)
    ends = [face for face in faces if abs(normal(face)[2]) > 0.999]
    assert len(ends) == 2
    assert len(faces) == len(ends[0]) + 2
    assert sum(map(area, faces)) == pytest.approx(sum(map(area, triangles)))


def test_the_tank_is_a_few_plates_with_the_tanks_area() -> None:
    tank = load_model("terrain/CIRS/cirs_trident.osg", named_by=None, data_path=())
    triangles = np.concatenate(
        [mesh.vertices.astype(float)[mesh.triangles] for mesh in tank.meshes]
    )
    faces = convex_faces(triangles)
    assert len(triangles) > 1000
    assert len(faces) < 70
    assert sum(map(area, faces)) == pytest.approx(sum(map(area, triangles)), rel=1e-5)
