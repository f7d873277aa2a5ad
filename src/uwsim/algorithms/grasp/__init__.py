"""Autonomous grasping of a black box (a flight recorder) by a vehicle with an arm.

`grasp` is the algorithm, `phases` its state machine; the other modules are parts of it. Positions
are in the navigation frame of the vehicle: north, east, down, origin at the water surface
(`uwsim.algorithms.navigation.ekf`).
"""

from __future__ import annotations

from .arm import Arm5e, Kinematics, Reach
from .box import BoxPose, BoxSpec
from .box_pose import Sighting
from .camera import Pinhole, View
from .convex_object import ConvexObject, ConvexPerception
from .detector import ColourDetector, Detector, Outline, outline_of
from .grasp import Grasp
from .perception import GraspModel, ObjectPerception, Perception
from .station import Motion, Station, StationLaw
from .target import Target
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
    "Motion",
    "ObjectPerception",
    "Outline",
    "Perception",
    "Pinhole",
    "Reach",
    "Sighting",
    "Station",
    "StationLaw",
    "Target",
    "View",
    "outline_of",
]
