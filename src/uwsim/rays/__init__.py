"""Exact ray casting against the triangles of a scene."""

from .kernel import Hits
from .ray_scene import RayScene, Surface

__all__ = ["Hits", "RayScene", "Surface"]
