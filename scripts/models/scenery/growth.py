"""Sponges, anemones and clumps of mussels on structures: small bodies with one image."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from uwsim.base import rng
from uwsim.base.geometry import rotation_from_rpy

from ..baked import Skin, bake
from ..cached import cache_image
from ..fields import Points, Values, noise3
from ..parts import Part
from ..shapes import rotation_to
from ..textures import smoothstep

KINDS = ("sponge", "mussels", "anemone")
COLOURS = {
    "sponge": (0.30, 0.20, 0.12),
    "mussels": (0.085, 0.085, 0.095),
    "anemone": (0.33, 0.30, 0.26),
}
"""The colour of each kind between its bumps."""
TOPS = {"sponge": (0.41, 0.31, 0.19), "mussels": (0.20, 0.19, 0.18), "anemone": (0.48, 0.44, 0.39)}
"""The colour of each kind on its bumps."""
MAX_STRETCH = 1.2
"""The greatest height of a clump, in widths."""


def scatter_growth(
    name: str, points: np.ndarray, normals: np.ndarray, *, size: tuple[float, float]
) -> list[Part]:
    """Return clumps on a surface, one part for each kind.

    Args:
        name: the name of the random stream.
        points: the places of the clumps, (n, 3) [m].
        normals: the outward normals there, (n, 3).
        size: the least and the greatest size of a clump [m].
    """
    stream = rng.stream(0, f"assets/{name}/growth")
    kinds = stream.integers(0, len(KINDS), len(points))
    parts = []
    for index, kind in enumerate(KINDS):
        indices = np.flatnonzero(kinds == index)
        poses = [(points[k], normals[k]) for k in indices]
        if poses:
            parts.append(_copy_clump(_clump(kind), poses, size, stream))
    return parts


def _copy_clump(
    clump: Part,
    poses: Sequence[tuple[np.ndarray, np.ndarray]],
    size: tuple[float, float],
    stream: np.random.Generator,
) -> Part:
    mesh = clump.mesh
    vertices, normals = [], []
    for point, normal in poses:
        share = float(stream.random())
        scale = size[0] + (size[1] - size[0]) * share * share
        stretch = float(stream.uniform(0.45, MAX_STRETCH))
        spin = rotation_from_rpy(0.0, 0.0, float(stream.uniform(0.0, 6.28)))
        rotation = np.einsum("ij,jk->ik", rotation_to(normal), spin)
        shape = np.array([1.0, 1.0, stretch])
        clump_vertices = np.einsum("ij,kj->ik", mesh.vertices * shape * scale, rotation)
        vertices.append(clump_vertices + point + normal * (0.1 * scale))
        clump_normals = np.einsum("ij,kj->ik", mesh.normals / shape, rotation)
        normals.append(
            clump_normals / np.sqrt((clump_normals * clump_normals).sum(axis=1, keepdims=True))
        )
    n = len(mesh.vertices)
    return replace(
        clump,
        mesh=replace(
            mesh,
            vertices=np.concatenate(vertices).astype(np.float32),
            normals=np.concatenate(normals).astype(np.float32),
            uvs=np.tile(mesh.uvs, (len(poses), 1)),
            triangles=np.concatenate(
                [mesh.triangles + np.uint32(k * n) for k in range(len(poses))]
            ),
        ),
    )


@cache_image
def _clump(kind: str) -> Part:
    """Return a clump of about 1 m, to be scaled."""
    return bake(f"growth/{kind}", partial(_radius, kind), partial(_paint, kind), n=3, side=72)


def _radius(kind: str, direction: Points) -> Values:
    lobes = noise3(f"growth/{kind}/lobes", direction, 0.8, octaves=2)
    return np.asarray(0.5 * (1.0 + 0.22 * lobes), dtype=np.float32)


def _paint(kind: str, points: Points, direction: Points) -> Skin:
    bumps = noise3(f"growth/{kind}/bumps", points, 0.16, octaves=3, gain=0.7)
    share = smoothstep(-0.2, 1.0, bumps + 0.7 * direction[..., 2])
    low, high = (np.array(table[kind], dtype=np.float32) for table in (COLOURS, TOPS))
    colour = 1.3 * (low + (high - low) * share[..., None])
    colour = colour * (1.0 + 0.22 * bumps)[..., None]
    roughness = np.full(bumps.shape, 0.5 if kind == "mussels" else 0.85, dtype=np.float32)
    return Skin(colour, 0.03 * bumps, roughness)
