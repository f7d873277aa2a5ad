"""The measurement of a Doppler velocity log, from which its messages are written."""

from __future__ import annotations

import math
from dataclasses import dataclass

Vector = tuple[float, float, float]
"""A vector."""
UNKNOWN_VECTOR = (math.nan, math.nan, math.nan)
"""A vector that is not known."""


@dataclass(frozen=True, kw_only=True)
class DvlPing:
    """The measurement of a ping.

    The axes of the instrument are x forward, y to starboard, z down. A velocity that is not known
    is NaN.
    """

    time_us: int
    """The time of the ping [us since 1970]."""
    velocity: Vector = UNKNOWN_VECTOR
    """The velocity over the bottom, instrument axes [m/s]."""
    error_velocity: float = math.nan
    """The error velocity of the bottom track [m/s]."""
    earth_velocity: Vector = UNKNOWN_VECTOR
    """The velocity over the bottom, east, north, up [m/s]."""
    water_velocity: Vector = UNKNOWN_VECTOR
    """The velocity through the water, instrument axes [m/s]."""
    water_error_velocity: float = math.nan
    """The error velocity of the water track [m/s]."""
    water_earth_velocity: Vector = UNKNOWN_VECTOR
    """The velocity through the water, east, north, up [m/s]."""
    distance_made_good: Vector = (0.0, 0.0, 0.0)
    """The distance over the bottom since the start, east, north, up [m]."""
    water_distance_made_good: Vector = (0.0, 0.0, 0.0)
    """The distance through the water since the start, east, north, up [m]."""
    altitude: float = math.nan
    """The distance to the bottom [m]."""
    water_layer: float = math.nan
    """The distance to the tracked layer of water [m]."""
    age: float = 0.0
    """The time since the last valid velocity over the bottom [s]."""
    water_age: float = 0.0
    """The time since the last valid velocity through the water [s]."""
    vertical_ranges: tuple[float, ...] = (math.nan,) * 4
    """The distance along the instrument's axis that each beam measures [m]; NaN: no echo."""
    roll: float = 0.0
    """The roll angle of the vehicle [deg]."""
    pitch: float = 0.0
    """The pitch angle of the vehicle [deg]."""
    heading: float = 0.0
    """The heading of the vehicle [deg]."""
    depth: float = 0.0
    """The depth of the instrument [m]."""
    sound_speed: float = 1500.0
    """The speed of sound [m/s]."""
    salinity: float = 35.0
    """The salinity of the water [g/kg]."""
    temperature: float = 10.0
    """The temperature of the water [deg C]."""


def is_known(vector: Vector) -> bool:
    """Return whether all components of a velocity are known."""
    return all(map(math.isfinite, vector))


def to_ship_axes(vector: Vector) -> Vector:
    """Return a vector of instrument axes as starboard, forward, up, the axes of RDI's messages."""
    forward, starboard, down = vector
    return starboard, forward, -down
