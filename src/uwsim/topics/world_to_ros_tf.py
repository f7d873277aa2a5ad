"""The frames of a scene on /tf."""

from __future__ import annotations

from dataclasses import dataclass

from ..schema import element
from .interface import InterfaceSpec


@dataclass(frozen=True, kw_only=True)
class WorldToROSTFSpec(InterfaceSpec):
    """Publishes the frames of vehicles, sensors and objects."""

    root_name: str
    """Name of the frame of the file."""
    enable_objects: bool = False
    """Whether objects are published too."""
    rate: int = element(default=10, minimum=1)
    """How often [Hz]."""
