"""Echo amplitudes as marine_acoustic_msgs/ProjectedSonarImage."""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array
from ...messages import PingInfo, ProjectedSonarImage, SonarImageData, Vector3, header
from .kernel import Singles
from .spec import SonarSpec

FLOAT32 = 8
"""``SonarImageData.DTYPE_FLOAT32``."""


def sonar_image(
    amplitude: Singles,
    spec: SonarSpec,
    *,
    directions: Array,
    ranges: Array,
    sound_speed: float,
    time: float,
) -> ProjectedSonarImage:
    """Build the message of a ping.

    Args:
        amplitude: the amplitude in each bin and beam, (bins, n) [Pa].
        spec: the spec of the sonar.
        directions: the directions of the beams in the sonar's frame, unit vectors (n, 3).
        ranges: the middles of the range bins, (bins,) [m].
        sound_speed: the speed of sound at the sonar [m/s].
        time: the time of the ping [s].
    """
    n = len(directions)
    forward, starboard, up = (directions * [1.0, -1.0, 1.0]).T.tolist()
    return ProjectedSonarImage(
        header=header(time, spec.name),
        ping_info=PingInfo(
            frequency=spec.frequency,
            sound_speed=sound_speed,
            tx_beamwidths=np.full(n, math.radians(spec.vertical_aperture), dtype=np.float32),
            rx_beamwidths=np.full(n, math.radians(spec.beam_width), dtype=np.float32),
        ),
        # in the frame of the message: z ahead, x up, y to starboard
        beam_directions=list(map(Vector3, up, starboard, forward)),
        ranges=ranges.astype(np.float32),
        image=SonarImageData(
            is_bigendian=False,
            dtype=FLOAT32,
            beam_count=n,
            data=amplitude.astype("<f4", copy=False).reshape(-1).view(np.uint8),
        ),
    )


def level_directions(azimuths: Array) -> Array:
    """Return unit vectors in the x-y plane at azimuths (n,) [rad], positive to port, (n, 3)."""
    return np.stack([np.cos(azimuths), np.sin(azimuths), np.zeros(len(azimuths))], axis=1)


def amplitudes(message: ProjectedSonarImage) -> Singles:
    """Return the amplitudes in a message that `sonar_image` built, (bins, beams) [Pa]."""
    shape = len(message.ranges), message.image.beam_count
    return np.asarray(message.image.data, dtype=np.uint8).view("<f4").reshape(shape)
