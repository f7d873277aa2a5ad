"""Users' own meshes: GLB, OBJ, STL, PLY and DAE read by trimesh."""

from __future__ import annotations

from pathlib import Path

from ..errors import AssetError
from .mesh import Model

READABLE = (".glb", ".gltf", ".obj", ".stl", ".ply", ".dae")
"""Formats that are read without help from outside."""


def read_model(path: Path, *, name: str, max_triangles: int | None = None) -> Model:
    """The model in a file."""
    raise AssetError(f"{path}: reading files comes in a moment")
