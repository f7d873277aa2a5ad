"""Exact rays against the triangles of a scene: where each hits first, at what angle, on what."""

from .kernel import Hits
from .ray_scene import RayScene, Surface

__all__ = ["Hits", "RayScene", "Surface"]
