"""Autonomous grasping of a black box: the parts, and the state machine that uses them."""

from __future__ import annotations

from .arm import Arm5e, Kinematics, Reach
from .box import BoxPose, BoxSpec
from .camera import Pinhole, View
from .detector import ColourDetector, Detector, Outline, outline_of
from .grasp import Grasp
from .station import Motion, Station, StationLaw
from .variants import GraspBlindClose, GraspNothing, GraspP, GraspTruth

__all__ = [
    "Arm5e",
    "BoxPose",
    "BoxSpec",
    "ColourDetector",
    "Detector",
    "Grasp",
    "GraspBlindClose",
    "GraspNothing",
    "GraspP",
    "GraspTruth",
    "Kinematics",
    "Motion",
    "Outline",
    "Pinhole",
    "Reach",
    "Station",
    "StationLaw",
    "View",
    "outline_of",
]
