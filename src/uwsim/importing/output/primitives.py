"""Meshes of simple shapes, as OBJ files with the colour of their material."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Pose
from ..mesh_files import MeshFiles
from ..sdf.spec import Colour, Shape, Visual

GREY: Colour = (0.6, 0.6, 0.6, 1.0)
"""The colour of a shape without a material."""
SEGMENTS = 32
"""The number of segments of a circle."""
MAX_PLANE = 2000.0
"""The greatest side of a plane that is drawn [m]."""


@dataclass(frozen=True, eq=False)
class Part:
    """Triangles of one colour."""

    vertices: Array
    """The vertices, (n, 3) [m]."""
    triangles: npt.NDArray[np.int64]
    """The indices of vertices, (m, 3), counter-clockwise from outside."""
    colour: Colour
    """The colour and the opacity [0..1]."""


def write_shape(visual: Visual, meshes: MeshFiles, stem: str) -> str:
    """Write the mesh of a simple shape, and return its name in the folder of the scene."""
    return write_parts([shape_part(visual.shape, visual.colour)], meshes, stem)


def shape_part(shape: Shape, colour: Colour | None, pose: Pose | None = None) -> Part:
    """Return the triangles of a simple shape at a pose."""
    import trimesh

    x, y, z = shape.size
    mesh: Any
    if shape.kind == "plane":
        vertices, triangles = _plane(shape)
    else:
        if shape.kind == "box":
            mesh = trimesh.creation.box((1.0, 1.0, 1.0))
        elif shape.kind == "cylinder":
            mesh = trimesh.creation.cylinder(radius=0.5, height=1.0, sections=SEGMENTS)
        elif shape.kind == "cone":
            mesh = trimesh.creation.cone(radius=0.5, height=1.0, sections=SEGMENTS)
            mesh.apply_translation((0.0, 0.0, -0.5))
        elif shape.kind == "capsule":
            count = [SEGMENTS, SEGMENTS]
            mesh = trimesh.creation.capsule(height=z - x, radius=0.5 * x, count=count)
            mesh.apply_translation(-mesh.bounds.mean(axis=0))
        else:
            mesh = trimesh.creation.uv_sphere(radius=0.5, count=[SEGMENTS, SEGMENTS])
        size = np.ones(3) if shape.kind == "capsule" else np.array([x, y, z])
        vertices, triangles = np.asarray(mesh.vertices) * size, np.asarray(mesh.faces)
    if pose is not None:
        vertices = pose.transform(vertices)
    return Part(vertices, triangles, colour or GREY)


def _plane(shape: Shape) -> tuple[Array, npt.NDArray[np.int64]]:
    """Return a rectangle across the normal, (4, 3) and (2, 3)."""
    width, depth = (0.5 * min(side, MAX_PLANE) for side in shape.size[:2])
    normal = np.array(shape.normal) / max(float(np.sqrt(np.sum(np.square(shape.normal)))), 1e-9)
    tangent = np.array([1.0, 0.0, 0.0]) if abs(normal[0]) < 0.9 else np.array([0.0, 1.0, 0.0])
    u = tangent - normal * float(np.sum(tangent * normal))
    u = u / float(np.sqrt(np.sum(u * u)))
    v = np.cross(normal, u)
    corners = np.array([-u * width - v * depth, u * width - v * depth,
                        u * width + v * depth, -u * width + v * depth])  # fmt: skip
    return corners, np.array([[0, 1, 2], [0, 2, 3]])


def write_parts(parts: Sequence[Part], meshes: MeshFiles, stem: str) -> str:
    """Write an OBJ file with its materials, and return its name in the folder of the scene."""
    name = meshes.reserve(stem, ".obj")
    path = meshes.folder / name
    materials, lines = [], [f"mtllib {path.stem}.mtl"]
    n_vertices = 1
    for index, part in enumerate(parts):
        red, green, blue, opacity = part.colour
        materials.append(f"newmtl m{index}\nKd {red:.6g} {green:.6g} {blue:.6g}\nd {opacity:.6g}\n")
        lines.append(f"usemtl m{index}")
        lines += [f"v {x:.7g} {y:.7g} {z:.7g}" for x, y, z in part.vertices.tolist()]
        lines += [
            f"f {a + n_vertices} {b + n_vertices} {c + n_vertices}"
            for a, b, c in part.triangles.tolist()
        ]
        n_vertices += len(part.vertices)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    path.with_suffix(".mtl").write_text("".join(materials), encoding="utf-8")
    return name
