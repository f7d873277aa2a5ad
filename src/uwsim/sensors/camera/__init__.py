"""The parts of a camera in a scene file: its response, and its lens with a port."""

from .lens import LensSpec
from .response import ResponseSpec

__all__ = ["LensSpec", "ResponseSpec"]
