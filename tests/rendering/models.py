"""Small models for the tests of the renderer."""

from __future__ import annotations

import numpy as np

from uwsim.assets.mesh import Mesh, Model, Texture

Colour = tuple[float, float, float]


def plate(
    width: float,
    height: float,
    colour: Colour = (1.0, 1.0, 1.0),
    *,
    texture: Texture | None = None,
    two_sided: bool = False,
) -> Model:
    """A rectangle in the x-y plane about the origin, facing +z."""
    x, y = width / 2.0, height / 2.0
    mesh = Mesh(
        vertices=np.array([[-x, -y, 0], [x, -y, 0], [x, y, 0], [-x, y, 0]], np.float32),
        normals=np.tile(np.array([0, 0, 1], np.float32), (4, 1)),
        uvs=np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32),
        triangles=np.array([[0, 1, 2], [0, 2, 3]], np.uint32),
        colour=colour,
        texture=texture,
        two_sided=two_sided,
    )
    return Model(name="plate", meshes=(mesh,), source="stand-in")


def block(size: tuple[float, float, float], colour: Colour = (1.0, 1.0, 1.0)) -> Model:
    """A box about the origin, faces outward."""
    half = np.array(size) / 2.0
    vertices, normals, triangles = [], [], []
    for axis in range(3):
        for sign in (-1.0, 1.0):
            normal = np.zeros(3)
            normal[axis] = sign
            aside = np.roll(np.abs(normal), 1)
            up = np.cross(normal, aside)
            first = len(vertices)
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                vertices.append((normal + a * aside + b * up) * half)
                normals.append(normal)
            triangles += [[first, first + 1, first + 2], [first, first + 2, first + 3]]
    mesh = Mesh(
        vertices=np.array(vertices, np.float32),
        normals=np.array(normals, np.float32),
        uvs=np.zeros((len(vertices), 2), np.float32),
        triangles=np.array(triangles, np.uint32),
        colour=colour,
    )
    return Model(name="block", meshes=(mesh,), source="stand-in")


def ball(radius: float, colour: Colour = (1.0, 1.0, 1.0)) -> Model:
    """A sphere of 24 x 48 faces about the origin, with smooth normals."""
    rows, columns = 24, 48
    polar = np.linspace(0.0, np.pi, rows + 1)[:, None]
    turn = np.linspace(0.0, 2.0 * np.pi, columns + 1)[None, :]
    normals = np.stack(
        [np.sin(polar) * np.cos(turn), np.sin(polar) * np.sin(turn), np.cos(polar) + 0.0 * turn], 2
    ).reshape(-1, 3)
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    below = corner + columns + 1
    triangles = np.concatenate(
        [np.stack([corner, below, corner + 1], 1), np.stack([corner + 1, below, below + 1], 1)]
    )
    mesh = Mesh(
        vertices=(radius * normals).astype(np.float32),
        normals=normals.astype(np.float32),
        uvs=np.zeros((len(normals), 2), np.float32),
        triangles=triangles.astype(np.uint32),
        colour=colour,
    )
    return Model(name="ball", meshes=(mesh,), source="stand-in")


def placed(x: float = 0.0, y: float = 0.0, z: float = 0.0) -> np.ndarray:
    """A matrix that only moves."""
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix
