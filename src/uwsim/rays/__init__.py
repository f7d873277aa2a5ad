"""Exact ray casting against the triangles of a scene, for sonars and other range sensors."""

from .cover import Balls
from .kernel import Hits
from .ray_scene import RayScene, Surface

__all__ = ["Balls", "Hits", "RayScene", "Surface"]
