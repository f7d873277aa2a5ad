r"""Four beams in Janus configuration, and velocities from measurements along them.

The beams are inclined from the z axis of the sensor by the angle :math:`\theta`, towards the
azimuths 45, 135, 225 and 315 degrees from x to y. A beam of the direction d measures
:math:`b = d \cdot v`. Three or four beams give the least-squares velocity. With a deviation s
along each of four beams those of x and y are :math:`s / (\sqrt 2 \sin\theta)`, and that of z is
:math:`s / (2 \cos\theta)`. The redundancy of four beams is the error velocity,
:math:`(b_1 - b_2 + b_3 - b_4) / (2 \sqrt 2 \sin\theta)`, with the deviation of x and y.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

MIN_BEAMS = 3
"""The least number of beams that determine a velocity."""
AZIMUTHS = np.array([45.0, 135.0, 225.0, 315.0])
"""The azimuths of the beams, from x to y [deg]."""
SIGNS = np.array([1.0, -1.0, 1.0, -1.0])
"""The signs of the beams in the error velocity."""

Flags = npt.NDArray[np.bool_]


class Janus:
    """The geometry of four beams inclined by an angle [rad]."""

    def __init__(self, angle: float) -> None:
        sine, cosine = math.sin(angle), math.cos(angle)
        turns = [math.radians(azimuth) for azimuth in AZIMUTHS.tolist()]
        self.directions = np.array(
            [[sine * math.cos(turn), sine * math.sin(turn), cosine] for turn in turns]
        )
        """The directions of the beams, sensor frame, (4, 3)."""
        self.cosine = cosine
        """The distance along the z axis per distance along a beam [1]."""
        self.error_share = 1.0 / (2.0 * math.sqrt(2.0) * sine)
        """The error velocity per difference between the beams, signs as in `SIGNS` [1]."""
