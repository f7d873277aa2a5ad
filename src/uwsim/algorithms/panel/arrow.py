"""The orange arrow on a panel: the part that the camera sees, and from which places are known."""

from __future__ import annotations

import numpy as np

from ..grasp import ConvexObject

CORNERS = ((-0.15, -0.10), (0.06, -0.10), (0.15, 0.0), (0.06, 0.10), (-0.15, 0.10))
"""The corners of the arrow from its middle, in the axes of the panel [m]."""
HEIGHT = 0.253
"""The height of the arrow over the seabed [m]."""


def panel_model(
    middle: tuple[float, float], grip_point: tuple[float, float, float], closing_angle: float
) -> ConvexObject:
    """Return the model of a panel that is found by its arrow.

    Args:
        middle: the middle of the arrow, in the frame of the panel [m].
        grip_point: the point to which the grip of the jaw is brought, in that frame [m].
        closing_angle: the angle from the panel's x axis to the axis along which the jaw closes
            [rad].
    """
    return ConvexObject(
        points=np.array([(middle[0] + x, middle[1] + y, HEIGHT) for x, y in CORNERS]),
        grip_point=np.array(grip_point),
        closing_angle=closing_angle,
        clearance=HEIGHT,
    )
