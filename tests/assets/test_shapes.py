import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scripts.models import shapes
from scripts.models.shapes import Shape, mesh

CLOSED: dict[str, tuple[Shape, float]] = {
    "box": (shapes.box((0, 0, 0), (1, 2, 3)), 6.0),
    "cylinder": (shapes.cylinder((0, 0, 0), (0, 2, 0), 0.5, n=64), math.pi * 0.25 * 2),
    "cone": (shapes.cylinder((0, 0, 0), (1, 1, 0), 0.5, n=64, top=0.0),
             math.pi * 0.25 * math.sqrt(2) / 3),
    "sphere": (shapes.sphere(1.0, n=64), 4 / 3 * math.pi),
    "capsule": (shapes.capsule(0.5, 0.0, 3.0, n=64), math.pi * 0.25 * 2 + 4 / 3 * math.pi * 0.125),
    "torus": (shapes.torus(1.0, 0.25, n=96, m=48), 2 * math.pi**2 * 0.0625),
    "ring": (shapes.ring(1.0, 0.5, 0.0, 1.0, n=64), math.pi * 0.75),
    "tube": (shapes.tube([(0, 0, 0), (0, 0, 1), (1, 0, 2)], 0.1, n=48),
             math.pi * 0.01 * (1 + math.sqrt(2))),
    "extrusion": (shapes.extrusion(shapes.rounded_rectangle(2, 1, 0.1, 8), 0.0, 1.0),
                  2 - 0.04 + math.pi / 100),
    "rounded box": (shapes.rounded_box((0, 0, 0), (1, 1, 1), radius=0.05, n=4), 1.0),
}  # fmt: skip


@pytest.mark.parametrize("name", CLOSED)
def test_closed_shapes_are_wound_outward_and_hold_the_volume_they_should(name: str) -> None:
    shape, volume = CLOSED[name]
    assert shape.volume == pytest.approx(volume, rel=0.02)


@pytest.mark.parametrize("name", CLOSED)
def test_normals_are_unit_and_on_the_side_of_the_face(name: str) -> None:
    made = mesh(CLOSED[name][0])
    assert np.allclose(np.linalg.norm(made.normals, axis=1), 1.0, atol=1e-5)
    a, b, c = (made.vertices[made.triangles[:, k]] for k in range(3))
    face = np.cross(b - a, c - a)
    face /= np.linalg.norm(face, axis=1, keepdims=True)
    across = np.einsum("ij,ikj->ik", face, made.normals[made.triangles])
    assert across.min() > 0.5


@pytest.mark.parametrize("name", CLOSED)
def test_every_edge_of_a_closed_shape_has_two_sides(name: str) -> None:
    points = np.round(CLOSED[name][0].corners.reshape(-1, 3), 6) + 0.0
    _, number = np.unique(points, axis=0, return_inverse=True)
    faces = number.reshape(-1, 3)
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    there = {tuple(edge) for edge in edges.tolist()}
    assert all((b, a) in there for a, b in there)


def test_a_box_has_flat_faces_and_a_sphere_is_smooth() -> None:
    assert len(mesh(shapes.box((0, 0, 0), (1, 1, 1))).vertices) == 24
    ball = mesh(shapes.sphere(1.0, n=32))
    assert np.allclose(ball.normals, ball.vertices, atol=0.02)


def test_mirroring_keeps_the_outside_out() -> None:
    shape = CLOSED["cylinder"][0]
    assert shape.scale(1, 1, -1).volume == pytest.approx(shape.volume)
    assert shape.flip().volume == pytest.approx(-shape.volume)


@given(st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda v: np.linalg.norm(v) > 1e-3))
def test_facing_is_a_rotation_that_takes_z_there(direction: tuple[float, float, float]) -> None:
    rotation = shapes.rotation_to(np.array(direction))
    assert np.allclose(rotation @ rotation.T, np.eye(3), atol=1e-9)
    assert np.linalg.det(rotation) == pytest.approx(1.0)
    assert np.allclose(rotation[:, 2], np.array(direction) / np.linalg.norm(direction))


def test_a_quad_shows_its_texture_upright() -> None:
    shape = shapes.quad((0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0), cuts=(4, 2))
    assert len(shape.corners) == 16
    assert np.allclose(shape.uvs, shape.corners[:, :, :2] / [2, 1])


def test_meshes_hold_the_types_the_renderer_takes() -> None:
    made = mesh(shapes.box((0, 0, 0), (1, 1, 1)))
    assert [a.dtype for a in (made.vertices, made.normals, made.uvs)] == [np.float32] * 3
    assert made.triangles.dtype == np.uint32
