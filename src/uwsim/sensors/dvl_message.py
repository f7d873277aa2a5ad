"""The message of a DVL: velocities in three frames, and distances made good, as RDI's PD6.

A velocity that is not known is NaN and its status ``V``; a good one has ``A``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..acoustics import SeaWater
from ..base.geometry import Array, Pose
from ..base.numerics.linear import product, turned
from ..base.record import Record
from ..messages import DVL, Header

GOOD, BAD = "A", "V"
"""Status of a velocity in PD6."""


@dataclass(slots=True)
class TrackState(Record):
    """What is known of the velocity over one thing."""

    instrument: Array
    """The velocity in the axes of the sensor, (3,) [m/s]."""
    world: Array
    """The velocity in W, (3,) [m/s]."""
    error: float
    """The error velocity [m/s]."""
    made_good: Array
    """East, north and up since the beginning, over the time with a velocity, (3,) [m]."""
    time: float | None
    """When the last ping was [s]."""
    last: float
    """When there was a velocity last [s]."""

    @staticmethod
    def unknown() -> TrackState:
        """Return that of a sensor that has not pinged."""
        unknown = np.full(3, math.nan)
        return TrackState(unknown, unknown.copy(), math.nan, np.zeros(3), None, 0.0)


class Track:
    """A velocity, and how far it has led."""

    def __init__(self) -> None:
        self.state = TrackState.unknown()
        """What is known."""

    def take(
        self, time: float, pose: Pose, found: tuple[Array, float] | None, noise: Array
    ) -> None:
        """Take the velocity of a ping at ``time`` [s]: in the sensor's axes, with its error."""
        state = self.state
        lasted = 0.0 if state.time is None else time - state.time
        state.time = time
        if found is None:
            state.instrument, state.world = np.full(3, math.nan), np.full(3, math.nan)
            state.error = math.nan
            return
        state.instrument, state.error = found[0] + noise, found[1]
        state.world = turned(pose.rotation, state.instrument)
        state.made_good = state.made_good + state.world * lasted
        state.last = time

    def age(self) -> float:
        """Since the last velocity [s]."""
        return 0.0 if self.state.time is None else self.state.time - self.state.last

    @property
    def status(self) -> str:
        """``A`` or ``V``."""
        return BAD if math.isnan(float(self.state.instrument[0])) else GOOD


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
        state = track.state
        ship = product(ship_from_world, state.world)
        values = {
            **dict(zip(("i_x_axis", "i_y_axis", "i_z_axis"), state.instrument, strict=True)),
            **dict(zip(("s_longitudinal", "s_transverse", "s_normal"), ship, strict=True)),
            **dict(zip(("e_east", "e_north", "e_upwards"), state.world, strict=True)),
            **dict(zip(("d_east", "d_north", "d_upwards"), state.made_good, strict=True)),
            **{"i_error": state.error, "d_range": height, "d_time": track.age()},
        }
        for name, value in values.items():
            setattr(message, letter + name, float(value))
        for axes in "ise":
            setattr(message, f"{letter}{axes}_status", track.status)
    return message
