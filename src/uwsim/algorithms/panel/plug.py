"""``plug``: an algorithm that finds a panel by camera, and inserts the plug in its jaw in a socket.

It has the sensors, the navigation, the station keeping and the phases of `grasp` up to the
alignment. While it inserts, it yields to the force on the wrist; ``plug-rigid`` does not, and
``plug-truth`` has the true poses of vehicle and panel: an upper bound, as ``grasp-truth``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from ..grasp import BoxPose, ColourDetector, ConvexObject, ConvexPerception, Grasp, GraspTruth
from ..grasp.arm import GRIP_OFFSET
from ..grasp.phases import Phase
from .arrow import panel_model
from .plug_phases import PLUG_PHASES, RIGID_PHASES

ARROW_MIDDLE = (-0.20, 0.12)
"""The middle of the arrow, in the frame of the panel [m]."""
MOUTH = (0.22, -0.12, 0.41)
"""The centre of the mouth of the socket, in the frame of the panel [m]."""
TIP = 0.25
"""The distance of the tip of the plug below the wrist [m]."""
DEPTH = 0.075
"""The depth to which the tip is brought below the mouth [m]."""


def socket_model() -> ConvexObject:
    """Return the model of the panel: its arrow, and the place of the grip after insertion."""
    x, y, z = MOUTH
    return panel_model(ARROW_MIDDLE, (x, y, z - DEPTH + TIP - GRIP_OFFSET), closing_angle=0.0)


class Plug(Grasp):
    """Finds a socket by camera, and inserts a plug, which yields to the force on the wrist."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {**Grasp.PARAMETERS, "tolerance": 0.01}
    """The parameters of `Grasp`; those of lift and hold have no effect."""
    PHASES: ClassVar[Mapping[str, type[Phase]]] = PLUG_PHASES

    def model(self) -> ConvexObject:
        """Return the model of the panel with the socket."""
        return socket_model()

    def perception(self) -> ConvexPerception:
        """Return the perception of the panel, by the outline of its arrow."""
        return ConvexPerception(ColourDetector(), socket_model())


class PlugRigid(Plug):
    """The algorithm plug without feedback of the force on the wrist."""

    PHASES: ClassVar[Mapping[str, type[Phase]]] = RIGID_PHASES


class PlugTruth(GraspTruth):
    """The algorithm plug with the true poses instead of camera and navigation: an upper bound."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **GraspTruth.PARAMETERS,
        "tolerance": 0.01,
        "target": "panel",
    }
    PHASES: ClassVar[Mapping[str, type[Phase]]] = PLUG_PHASES

    def model(self) -> ConvexObject:
        """Return the model of the panel with the socket."""
        return socket_model()

    def seabed_depth(self, target: BoxPose) -> float:
        """Return the depth of the seabed, on which the panel's frame is [m]."""
        return float(target.position[2])
