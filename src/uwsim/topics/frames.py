"""Frames of a scene, as transforms of ROS's ``/tf``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..base.geometry import Pose

TF = "/tf"
"""The topic of all transforms."""


@dataclass(frozen=True, eq=False)
class Frame:
    """A named frame and where it is in another."""

    parent: str
    """Name of the other frame; empty: L, whatever the interface calls it."""
    child: str
    """Its name."""
    parent_from_child: Callable[[], Pose]
    """Returns where it is now."""
    is_fixed: bool = False
    """Whether it stays there."""
