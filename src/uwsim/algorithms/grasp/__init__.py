"""Autonomous grasping of a black box: the parts, and the state machine that uses them."""

from __future__ import annotations

from .grasp import Grasp
from .variants import GraspBlindClose, GraspNothing, GraspP, GraspTruth

__all__ = ["Grasp", "GraspBlindClose", "GraspNothing", "GraspP", "GraspTruth"]
