"""The frames of a scene, as transforms on ROS's ``/tf``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..base.geometry import Pose

TF = "/tf"
"""The topic of transforms."""


@dataclass(frozen=True, eq=False)
class Frame:
    """A named frame and its pose in another frame."""

    parent: str
    """The name of the other frame; empty for L, the frame of the scene, which each interface names
    itself (``rootName``)."""
    child: str
    """The name of the frame."""
    parent_from_child: Callable[[], Pose]
    """A function that returns the present pose of the frame in the other frame."""
    is_fixed: bool = False
    """True if the pose is constant."""
