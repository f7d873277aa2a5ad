r"""Four beams in Janus configuration: their directions, and the error velocity.

The beams are inclined from the z axis of the sensor by the angle :math:`\theta`, towards the
azimuths 45, 135, 225 and 315 degrees from x to y. A beam with the direction d measures
:math:`b = d \cdot v` of the sensor's velocity v. Three or four beams give the least-squares
estimate of v. If the noise along each of four beams has the standard deviation s, the noise of the
components x and y has :math:`s / (\sqrt 2 \sin\theta)`, and that of z :math:`s / (2 \cos\theta)`.
The redundancy of four beams gives the error velocity,
:math:`(b_1 - b_2 + b_3 - b_4) / (2 \sqrt 2 \sin\theta)`, whose noise is equal to that of x and y.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

MIN_BEAMS = 3
"""The minimum number of beams that determine a velocity."""
AZIMUTHS = np.array([45.0, 135.0, 225.0, 315.0])
"""The azimuths of the beams, from x to y [deg]."""
SIGNS = np.array([1.0, -1.0, 1.0, -1.0])
"""The signs of the beams in the error velocity."""

Flags = npt.NDArray[np.bool_]
"""A truth value for each beam."""


class Janus:
    """The geometry of four beams.

    Args:
        angle: the angle from the z axis of the sensor to each beam [rad].
    """

    def __init__(self, angle: float) -> None:
        sine, cosine = math.sin(angle), math.cos(angle)
        azimuths = [math.radians(degrees) for degrees in AZIMUTHS.tolist()]
        self.directions = np.array(
            [[sine * math.cos(azimuth), sine * math.sin(azimuth), cosine] for azimuth in azimuths]
        )
        """The directions of the beams, unit vectors in the sensor's frame, (4, 3)."""
        self.cosine = cosine
        """The cosine of the angle: the distance along the z axis per distance along a beam [1]."""
        self.error_scale = 1.0 / (2.0 * math.sqrt(2.0) * sine)
        """The factor from the sum of beam velocities, signed by `SIGNS`, to the error velocity."""
