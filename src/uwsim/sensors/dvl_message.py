"""The message of a DVL: velocities in three frames, and distances made good, as RDI's PD6.

A velocity that is not known is NaN and its status ``V``; a good one has ``A``.
"""

from __future__ import annotations

import math
from typing import ClassVar

import numpy as np

from ..acoustics import SeaWater
from ..base.geometry import Array, Pose
from ..base.numerics.linear import product, turned
from ..messages import DVL, Header

GOOD, BAD = "A", "V"
"""Status of a velocity in PD6."""


class Track:
    """A velocity, and how far it has led."""

    STATE: ClassVar[tuple[str, ...]] = (
        "instrument",
        "world",
        "error",
        "made_good",
        "_time",
        "last",
    )
    """Attributes of its state, for snapshots."""

    def __init__(self) -> None:
        self.instrument, self.world = np.full(3, math.nan), np.full(3, math.nan)
        """In the axes of the sensor, and in W, (3,) [m/s]."""
        self.error = math.nan
        """Error velocity [m/s]."""
        self.made_good = np.zeros(3)
        """East, north and up since the beginning, over the time with a velocity, (3,) [m]."""
        self._time: float | None = None
        self.last = 0.0
        """When there was a velocity last [s]."""

    def take(
        self, time: float, pose: Pose, found: tuple[Array, float] | None, noise: Array
    ) -> None:
        """Take the velocity of a ping at ``time`` [s]: in the sensor's axes, with its error."""
        lasted = 0.0 if self._time is None else time - self._time
        self._time = time
        if found is None:
            self.instrument, self.world = np.full(3, math.nan), np.full(3, math.nan)
            self.error = math.nan
            return
        self.instrument, self.error = found[0] + noise, found[1]
        self.world = turned(pose.rotation, self.instrument)
        self.made_good = self.made_good + self.world * lasted
        self.last = time

    def age(self) -> float:
        """Since the last velocity [s]."""
        return 0.0 if self._time is None else self._time - self.last

    @property
    def status(self) -> str:
        """``A`` or ``V``."""
        return BAD if math.isnan(float(self.instrument[0])) else GOOD


def dvl_message(
    header: Header,
    tracks: tuple[Track, Track],
    *,
    heights: tuple[float, float],
    ship_from_world: Array,
    water: SeaWater,
    depth: float,
    beams: tuple[Array, Array],
) -> DVL:
    """Return the message.

    Args:
        header: its header.
        tracks: of the bottom and of the water.
        heights: over the bottom, and to the layer of water [m].
        ship_from_world: axes of the vehicle's base, (3, 3).
        water: where the sensor is.
        depth: of the sensor [m].
        beams: ranges [m] and velocities [m/s] along the beams on the bottom, (4,) each.
    """
    message = DVL(
        header=header,
        header_dvl=header.frame_id,
        salinity=water.salinity,
        temperature=water.temperature,
        depth=depth,
        sound_speed=water.sound_speed(depth),
        raw_data=" ".join(repr(number) for each in beams for number in each.tolist()),
    )
    for letter, track, height in zip("bw", tracks, heights, strict=True):
        ship = product(ship_from_world, track.world)
        values = {
            **dict(zip(("i_x_axis", "i_y_axis", "i_z_axis"), track.instrument, strict=True)),
            **dict(zip(("s_longitudinal", "s_transverse", "s_normal"), ship, strict=True)),
            **dict(zip(("e_east", "e_north", "e_upwards"), track.world, strict=True)),
            **dict(zip(("d_east", "d_north", "d_upwards"), track.made_good, strict=True)),
            **{"i_error": track.error, "d_range": height, "d_time": track.age()},
        }
        for name, value in values.items():
            setattr(message, letter + name, float(value))
        for axes in "ise":
            setattr(message, f"{letter}{axes}_status", track.status)
    return message
