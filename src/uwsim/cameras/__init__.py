"""Cameras apart from scenes and renderers: lens and port, shutter, electrons and digital numbers.

Light comes in as an image of floats, and goes out as the numbers that a camera stores. `Lens` bends
the rays of a pinhole, `Shutter` chooses the times of the rows, `CameraResponse` counts electrons.
"""

from .lens import Lens
from .port import DomePort, FlatPort
from .response import CameraResponse
from .shutter import Shutter

__all__ = ["CameraResponse", "DomePort", "FlatPort", "Lens", "Shutter"]
