"""Frames of a scene, as transforms of ROS's ``/tf``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..geometry import Pose
from ..messages import Quaternion, Transform, TransformStamped, Vector3, header

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


def transform(parent: str, child: str, parent_from_child: Pose, time: float) -> TransformStamped:
    """Build a transform at ``time`` [s]; names without a leading slash, as tf2 requires."""
    w, x, y, z = parent_from_child.quaternion.tolist()
    px, py, pz = parent_from_child.position.tolist()
    return TransformStamped(
        header=header(time, parent.strip().lstrip("/")),
        child_frame_id=child.strip().lstrip("/"),
        transform=Transform(
            translation=Vector3(x=px, y=py, z=pz), rotation=Quaternion(x=x, y=y, z=z, w=w)
        ),
    )
