"""Specs of scenes and robots, and their readers."""

from .object import ObjectSpec
from .reader import read_scene
from .spec import SceneSpec
from .vehicle import VehicleSpec

__all__ = ["ObjectSpec", "SceneSpec", "VehicleSpec", "read_scene"]
