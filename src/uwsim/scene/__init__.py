"""Scenes: what a scene or robot file says, and nothing that runs."""

from .reader import check_scene, read_scene
from .spec import ObjectSpec, SceneSpec
from .vehicle import VehicleSpec

__all__ = ["ObjectSpec", "SceneSpec", "VehicleSpec", "check_scene", "read_scene"]
