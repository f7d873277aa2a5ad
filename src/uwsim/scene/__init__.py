"""Scene and robot files: their specs, the readers, and the checks of what they contain."""

from .object import ObjectSpec
from .reader import read_scene
from .spec import SceneSpec
from .vehicle import VehicleSpec

__all__ = ["ObjectSpec", "SceneSpec", "VehicleSpec", "read_scene"]
