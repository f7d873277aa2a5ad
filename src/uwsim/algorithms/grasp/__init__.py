"""Autonomous grasping of a black box (a flight recorder) by a vehicle with an arm.

`grasp` is the algorithm, `phases` its state machine; the other modules are parts of it. Positions
are in the navigation frame of the vehicle: north, east, down, origin at the water surface
(`uwsim.algorithms.navigation.ekf`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ...base.deprecation import warn_old_name
from .arm import Arm5e, Kinematics, Reach
from .box import BoxPose, BoxSpec
from .box_pose import Sighting
from .camera import Pinhole, View
from .convex_object import ConvexObject, ConvexPerception
from .detector import ColourDetector, Detector, Outline, outline_of
from .grasp import Grasp
from .perception import GraspModel, ObjectPerception, Perception
from .station import StationController, StationLaw, TrackingState
from .target import TargetEstimate
from .variants import GraspBlindClose, GraspNothing, GraspP, GraspTruth

__all__ = [
    "Arm5e",
    "BoxPose",
    "BoxSpec",
    "ColourDetector",
    "ConvexObject",
    "ConvexPerception",
    "Detector",
    "Grasp",
    "GraspBlindClose",
    "GraspModel",
    "GraspNothing",
    "GraspP",
    "GraspTruth",
    "Kinematics",
    "ObjectPerception",
    "Outline",
    "Perception",
    "Pinhole",
    "Reach",
    "Sighting",
    "StationController",
    "StationLaw",
    "TargetEstimate",
    "TrackingState",
    "View",
    "outline_of",
]

_OLD_NAMES = {"Motion": TrackingState, "Station": StationController, "Target": TargetEstimate}
"""The classes by their deprecated names."""

if not TYPE_CHECKING:  # with a `__getattr__`, a type checker would accept every name

    def __getattr__(name: str) -> Any:
        """Return a class by its deprecated name."""
        if name not in _OLD_NAMES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        warn_old_name(name, _OLD_NAMES[name].__name__)
        return _OLD_NAMES[name]
