"""Docks: the dimensions of the scene, outward normals, and the sides that a vehicle meets."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.assets import load_model
from uwsim.assets.dock_shape import DockShape, keep_inner_sides, shape_dock
from uwsim.assets.mesh import Model

SHAPE = DockShape(funnel_length=0.9, length=1.2, entrance=(1.0, 0.8), throat=(0.3, 0.2))


def load_dock(name: str) -> Model:
    return shape_dock(load_model(f"objects/{name}"), np.eye(4), SHAPE)


@pytest.mark.parametrize("name", ["dock_round", "dock_square"])
def test_a_dock_has_the_inner_dimensions_of_the_scene(name: str) -> None:
    model = keep_inner_sides(load_dock(name))
    points = np.concatenate([mesh.vertices[mesh.triangles].reshape(-1, 3) for mesh in model.meshes])
    assert points[:, 0].min() == pytest.approx(-0.9)
    assert points[:, 0].max() == pytest.approx(1.2)
    for x, width, height in [(-0.9, 1.0, 0.8), (0.0, 0.3, 0.2), (1.2, 0.3, 0.2)]:
        ring = points[np.abs(points[:, 0] - x) < 1e-6]
        sizes = np.hypot(ring[:, 1] / (0.5 * width), ring[:, 2] / (0.5 * height))
        edge = ring[(sizes > 0.5) & (sizes < sizes[sizes > 0.5].min() + 0.01)]
        assert np.abs(edge[:, 1]).max() == pytest.approx(0.5 * width, rel=0.01)
        assert np.abs(edge[:, 2]).max() == pytest.approx(0.5 * height, rel=0.01)


@pytest.mark.parametrize("name", ["dock_round", "dock_square"])
def test_normals_are_those_of_the_faces(name: str) -> None:
    # within 15 degrees, the angle between two of the 24 sides, which are shaded as round
    for mesh in load_dock(name).meshes:
        corners = mesh.vertices[mesh.triangles].astype(float)
        faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        faces /= np.sqrt(np.sum(faces**2, axis=1))[:, None]
        for k in range(3):
            cosines = np.sum(faces * mesh.normals[mesh.triangles[:, k]], axis=1)
            assert cosines.min() > np.cos(np.radians(15.0))


def test_the_contact_surface_leaves_out_the_outside() -> None:
    model = load_dock("dock_square")
    contact_model = keep_inner_sides(model)
    funnel, chamber = (len(mesh.triangles) for mesh in contact_model.meshes)
    assert (funnel, chamber) == (
        16,
        20,
    )  # four sides and a rim of four pieces each; a plate of four
    assert sum(len(mesh.triangles) for mesh in model.meshes) == 80
