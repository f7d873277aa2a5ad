"""Tangents of meshes, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from tests.rendering.models import ball, plate
from uwsim.assets.mesh import Mesh
from uwsim.assets.tangents import add_tangents


def mesh_of(points: list[list[float]], uvs: list[list[float]], triangles: list[list[int]]) -> Mesh:
    return Mesh(
        vertices=np.array(points, np.float32),
        normals=np.tile(np.array([0, 0, 1], np.float32), (len(points), 1)),
        uvs=np.array(uvs, np.float32),
        triangles=np.array(triangles, np.uint32),
    )


def test_the_tangent_of_a_plate_is_its_u_axis() -> None:
    mesh = add_tangents(plate(2.0, 3.0).meshes[0])
    assert mesh.tangents is not None
    np.testing.assert_allclose(mesh.tangents, np.tile([1.0, 0.0, 0.0, 1.0], (4, 1)), atol=1e-6)


@pytest.mark.parametrize("angle", [0.3, 2.0, -1.1])
def test_a_turned_texture_turns_the_tangent(angle: float) -> None:
    plain = plate(2.0, 3.0).meshes[0]
    cos, sin = np.cos(angle), np.sin(angle)
    u = cos * plain.vertices[:, 0] + sin * plain.vertices[:, 1]
    v = cos * plain.vertices[:, 1] - sin * plain.vertices[:, 0]
    points, triangles = plain.vertices.tolist(), plain.triangles.tolist()
    mesh = add_tangents(mesh_of(points, np.stack([5.0 * u, v], 1).tolist(), triangles))
    assert mesh.tangents is not None
    np.testing.assert_allclose(mesh.tangents, np.tile([cos, sin, 0.0, 1.0], (4, 1)), atol=1e-6)


def test_a_mirrored_texture_has_its_own_vertices_at_the_seam() -> None:
    # u grows to x = 0 and falls from there on
    points = [[-1, 0, 0], [0, 0, 0], [0, 1, 0], [1, 0, 0]]
    uvs = [[0, 0], [1, 0], [1, 1], [0, 0]]
    mesh = add_tangents(mesh_of(points, uvs, [[0, 1, 2], [1, 3, 2]]))
    assert mesh.tangents is not None
    assert len(mesh.vertices) == 6
    for triangle, expected in zip(mesh.triangles, ([1, 0, 0, 1], [-1, 0, 0, -1]), strict=True):
        np.testing.assert_allclose(mesh.tangents[triangle], np.tile(expected, (3, 1)), atol=1e-6)
        np.testing.assert_array_equal(mesh.vertices[triangle].shape, (3, 3))
    np.testing.assert_array_equal(
        mesh.vertices[mesh.triangles], np.array(points, np.float32)[[[0, 1, 2], [1, 3, 2]]]
    )


def test_the_tangents_of_a_sphere_point_along_its_parallels() -> None:
    sphere = ball(1.0).meshes[0]
    x, y, z = sphere.vertices.astype(np.float64).T
    columns = np.arange(len(x)) % 49
    uvs = np.stack([columns / 48.0, 0.5 + 0.5 * z], 1).astype(np.float32)
    mesh = Mesh(
        vertices=sphere.vertices, normals=sphere.normals, uvs=uvs, triangles=sphere.triangles
    )
    mesh = add_tangents(mesh)
    assert mesh.tangents is not None
    x, y, z = mesh.vertices.astype(np.float64).T
    is_inside = (np.abs(z) < 0.95) & (np.abs(y) > 1e-6)  # not at the poles and the seam
    expected = np.stack([-y, x, 0.0 * x], 1) / np.maximum(np.hypot(x, y), 1e-9)[:, None]
    np.testing.assert_allclose(mesh.tangents[is_inside, :3], expected[is_inside], atol=0.01)
    np.testing.assert_allclose((mesh.tangents[:, :3] * mesh.normals).sum(axis=1), 0.0, atol=1e-6)


def test_a_texture_without_an_area_gives_unit_tangents() -> None:
    mesh = add_tangents(mesh_of([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 0]] * 3, [[0, 1, 2]]))
    assert mesh.tangents is not None
    np.testing.assert_allclose(np.linalg.norm(mesh.tangents[:, :3], axis=1), 1.0, atol=1e-6)
    np.testing.assert_allclose((mesh.tangents[:, :3] * mesh.normals).sum(axis=1), 0.0, atol=1e-6)
