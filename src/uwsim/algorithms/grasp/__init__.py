"""Autonomous grasping of a black box (a flight recorder) by a vehicle with an arm.

The module `grasp` contains the algorithm and `phases` its state machine; the other modules are
parts of the algorithm. These frames are used:

* the *navigation frame*: axes north, east and down, origin at the water surface above the initial
  position of the vehicle (`uwsim.algorithms.navigation.ekf`)
* the *base*: the frame of the vehicle, with x forward, y to starboard and z down
* the frame of the *box*: origin at the centre, y along the long edges, z out of the top face
  (`box`)
* the *grip*: the point between the fingers of the jaw at which they close (`arm`)
* the *camera*: axes of OpenCV, x right, y down, z forward (`camera`)
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
from .variants import GraspBlindClose, GraspP, GraspTruth

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
