"""Surfaces that tests of fixed meshes are made of."""

from __future__ import annotations

import numpy as np
import trimesh
from scipy.spatial import Delaunay

from uwsim.assets.mesh import Mesh, Model
from uwsim.base.geometry import Array


def dunes(x: Array, y: Array) -> Array:
    """Heights of rough ground [m]."""
    return 0.5 * np.sin(0.9 * x) * np.cos(0.7 * y) + 0.05 * np.sin(5.0 * x + 3.0 * y)


def grid(columns: int, rows: int, *, width: float = 8.0, height: float = 5.0) -> Array:
    """A regular grid of dunes, counter-clockwise from above, (n, 3, 3) [m]."""
    x, y = np.meshgrid(np.linspace(0.0, width, columns), np.linspace(-2.0, height - 2.0, rows))
    points = np.stack([x, y, dunes(x, y)], axis=2)
    a, b, c, d = points[:-1, :-1], points[:-1, 1:], points[1:, 1:], points[1:, :-1]
    both = np.stack([np.stack([a, b, c], axis=2), np.stack([a, c, d], axis=2)], axis=2)
    return both.reshape(-1, 3, 3)


def irregular(n: int, seed: int = 0) -> Array:
    """Dunes over 8 x 5 m with n corners anywhere, (m, 3, 3) [m]."""
    random = np.random.default_rng(seed)
    side = np.linspace(0.0, 1.0, round(np.sqrt(n)))
    edges = [np.column_stack(pair) for pair in ((side, 0 * side), (0 * side, side))]
    places = np.concatenate(
        [*edges, *(1.0 - edge for edge in edges), random.uniform(0.02, 0.98, (n, 2))]
    )
    places = np.unique(places, axis=0) * [8.0, 5.0] - [0.0, 2.0]
    points = np.column_stack([places, dunes(places[:, 0], places[:, 1])])
    faces = points[Delaunay(places).simplices]
    turned = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])[:, 2] < 0.0
    faces[turned] = faces[turned, ::-1]
    return faces


def rock(seed: int = 0, *, subdivisions: int = 4) -> Array:
    """A closed ball with bumps and hollows, about 2 m across, (n, 3, 3) [m]."""
    random = np.random.default_rng(seed)
    ball = trimesh.creation.icosphere(subdivisions=subdivisions)
    radii = np.ones(len(ball.vertices))
    for _ in range(8):
        radii += 0.08 * np.sin(2.0 * (ball.vertices * random.normal(size=3)).sum(axis=1))
    return np.asarray((ball.vertices * radii[:, None])[ball.faces])


def model_of(*parts: Array) -> Model:
    """A model with a mesh for each part."""
    meshes = []
    for part in parts:
        points = part.reshape(-1, 3).astype(np.float32)
        meshes.append(
            Mesh(
                vertices=points,
                normals=np.zeros_like(points),
                uvs=np.zeros((len(points), 2), np.float32),
                triangles=np.arange(len(points), dtype=np.uint32).reshape(-1, 3),
            )
        )
    return Model(name="mesh", meshes=tuple(meshes), source="file")
