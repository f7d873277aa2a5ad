"""``valve``: an algorithm that finds a panel by camera, and turns the handle of one of its valves.

It has the sensors, the navigation, the station keeping and the phases of `grasp` up to the grip.
The camera sees the orange arrow on the panel, whose place among the valves is known; so are the
height of the panel over the seabed and the position in which the valve is closed. ``valve-rigid``
has the same eyes, and closes and turns for fixed times. ``valve-truth`` reads the true poses of
vehicle and panel instead: an upper bound, as ``grasp-truth``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import ClassVar

from ..grasp import BoxPose, ColourDetector, ConvexObject, ConvexPerception, Grasp, GraspTruth
from ..grasp.phases import Phase
from .arrow import panel_model
from .valve_phases import RIGID_PHASES, VALVE_PHASES

HANDLE = (0.28, -0.22, 0.32)
"""The centre of the handle's bar, in the frame of the panel [m]."""
CLOSING_ANGLE = math.pi / 2.0
"""The angle from the panel's x axis to the axis along which the jaw closes on the bar [rad]."""


def valve_model() -> ConvexObject:
    """Return the model of the panel: the arrow that is seen, and the handle that is grasped."""
    return panel_model((0.0, 0.0), HANDLE, CLOSING_ANGLE)


class Valve(Grasp):
    """Finds a panel by camera, keeps station over it, and turns the handle of a valve."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {**Grasp.PARAMETERS, "tolerance": 0.015}
    """The parameters of `Grasp`; those of lift and hold have no effect."""
    PHASES: ClassVar[Mapping[str, type[Phase]]] = VALVE_PHASES

    def model(self) -> ConvexObject:
        """Return the model of the panel."""
        return valve_model()

    def perception(self) -> ConvexPerception:
        """Return the perception of the panel, by the outline of its arrow."""
        return ConvexPerception(ColourDetector(), valve_model())


class ValveRigid(Valve):
    """The algorithm valve without feedback of the jaw's torque and of the angle of the turn."""

    PHASES: ClassVar[Mapping[str, type[Phase]]] = RIGID_PHASES


class ValveTruth(GraspTruth):
    """The algorithm valve with the true poses instead of camera and navigation: an upper bound."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **GraspTruth.PARAMETERS,
        "tolerance": 0.015,
        "target": "panel",
    }
    PHASES: ClassVar[Mapping[str, type[Phase]]] = VALVE_PHASES

    def model(self) -> ConvexObject:
        """Return the model of the panel."""
        return valve_model()

    def seabed_depth(self, target: BoxPose) -> float:
        """Return the depth of the seabed, on which the panel's frame is [m]."""
        return float(target.position[2])
