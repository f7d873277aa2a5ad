"""Exact ray casting against the triangles and height grids of a scene, for range sensors."""

from .cover import Balls
from .height_rays import HeightRays
from .kernel import Hits
from .ray_scene import RayScene, Surface

__all__ = ["Balls", "HeightRays", "Hits", "RayScene", "Surface"]
