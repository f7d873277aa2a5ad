"""Standard manoeuvres: algorithms that steer a vehicle with fins or thrusters by a program."""

from __future__ import annotations

from .manoeuvre_node import ManoeuvreNode
from .nodes import (
    CrashStopNode,
    PullOutNode,
    ReverseSpiralNode,
    SpiralNode,
    TurningCircleNode,
    ZigZagNode,
)
from .programs import Hold

__all__ = [
    "CrashStopNode",
    "Hold",
    "ManoeuvreNode",
    "PullOutNode",
    "ReverseSpiralNode",
    "SpiralNode",
    "TurningCircleNode",
    "ZigZagNode",
]
