"""PD4 of Teledyne RDI: the velocities of a DVL in 47 bytes, little-endian.

======  =======  ==========================================================================
byte    type     field
======  =======  ==========================================================================
1       uint8    0x7d
2       uint8    0: PD4
3       uint16   number of bytes without the checksum: 45
5       uint8    bits 7, 6: axes (10 ship, 11 Earth); bit 5: tilts used; bit 4: three-beam
                 solutions; bits 2 to 0: frequency (010 300 kHz, 011 600 kHz, 100 1200 kHz)
6       int16*4  velocity over the bottom: x, y, z, error [mm/s]; -32768: bad
14      uint16*4 vertical distance to the bottom of each beam [cm]; 0: bad
22      uint8    status of the bottom track; per beam low correlation, low echo amplitude
23      int16*4  velocity through the layer of water: x, y, z, error [mm/s]; -32768: bad
31      uint16*2 start and end of the layer [dm]
35      uint8    status of the layer
36      uint8*4  time of the ping: hour, minute, second, hundredth
40      uint16   result of the built-in test; 0: passed
42      uint16   speed of sound [m/s]
44      int16    temperature [0.01 deg C]
46      uint16   sum of the bytes before, modulo 65536
======  =======  ==========================================================================

Source: Teledyne RD Instruments, ExplorerDVL Operation Manual and WorkHorse Commands and Output Data
Format, "PD4 output data format". Axes x, y, z are starboard, forward, up, or east, north, up.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from ...errors import BadMessage
from .checksums import sum_checksum
from .dvl import DvlPing, Vector, is_known, to_ship_axes
from .utc import to_datetime

LAYOUT = struct.Struct("<BBHB4h4HB4hHHB4BHHh")
LENGTH = LAYOUT.size + 2
"""The number of bytes of a message."""
IDENTIFICATION = b"\x7d\x00"
"""The first bytes of a message."""
BAD_VELOCITY = -32768
"""The value of a velocity that is not known."""
CONFIGURATION = {"ship": 0b10110011, "earth": 0b11110011}
"""The configuration byte: axes, tilts used, three-beam solutions, 600 kHz."""
BAD_BEAM = 0b11
"""The status of a beam without an echo: low correlation, low echo amplitude."""


def _millimetres(vector: Vector, error_velocity: float) -> list[int]:
    """Return x, y, z and the error velocity [mm/s], within the range of 16 bits."""
    if not is_known(vector):
        return [BAD_VELOCITY] * 4
    error = error_velocity if math.isfinite(error_velocity) else BAD_VELOCITY / 1000.0
    return [_clamp(1000.0 * value, -32768, 32767) for value in (*vector, error)]


def _clamp(value: float, lower: int, upper: int) -> int:
    """Return the nearest integer in a range; 0 if the value is not a number."""
    if not math.isfinite(value):
        return 0
    return min(max(round(value), lower), upper)


def write_pd4(ping: DvlPing, axes: Literal["ship", "earth"] = "ship") -> bytes:
    """Return the message of a ping, with velocities in ship or Earth axes."""
    if axes == "ship":
        bottom, water = to_ship_axes(ping.velocity), to_ship_axes(ping.water_velocity)
    else:
        bottom, water = ping.earth_velocity, ping.water_earth_velocity
    ranges = [_clamp(100.0 * r, 0, 65535) for r in ping.vertical_ranges]
    status = sum(BAD_BEAM << 2 * i for i, value in enumerate(ranges) if not value)
    layer = _clamp(10.0 * ping.water_layer, 0, 9999)
    moment = to_datetime(ping.time_us)
    body = LAYOUT.pack(
        *IDENTIFICATION,
        LAYOUT.size,
        CONFIGURATION[axes],
        *_millimetres(bottom, ping.error_velocity),
        *ranges,
        status,
        *_millimetres(water, ping.water_error_velocity),
        layer,
        layer,
        0 if is_known(water) else 0b1111,
        *(moment.hour, moment.minute, moment.second, moment.microsecond // 10000),
        0,
        _clamp(ping.sound_speed, 0, 65535),
        _clamp(100.0 * ping.temperature, -32768, 32767),
    )
    return body + struct.pack("<H", sum_checksum(body))


@dataclass(frozen=True, kw_only=True)
class Pd4:
    """The fields of a PD4 message."""

    axes: str
    """The axes of the velocities: ``beam``, ``instrument``, ``ship`` or ``earth``."""
    velocity: Vector
    """The velocity over the bottom [m/s]; NaN: bad."""
    error_velocity: float
    """The error velocity of the bottom track [m/s]; NaN: bad."""
    ranges: tuple[float, ...]
    """The vertical distance of each beam [m]; NaN: no echo."""
    water_velocity: Vector
    """The velocity through the layer of water [m/s]; NaN: bad."""
    time_of_day: float
    """The time of the ping since midnight [s]."""
    sound_speed: float
    """The speed of sound [m/s]."""
    temperature: float
    """The temperature of the water [deg C]."""


def read_pd4(data: bytes) -> Pd4:
    """Return the fields of a message; raise BadMessage."""
    if len(data) != LENGTH or data[:2] != IDENTIFICATION:
        raise BadMessage(f"{data[:4]!r} with {len(data)} bytes is no PD4; expected {LENGTH} bytes.")
    expected = sum_checksum(data[:-2])
    if struct.unpack("<H", data[-2:])[0] != expected:
        raise BadMessage(f"PD4 has a wrong checksum; expected {expected:#06x}.")
    numbers = LAYOUT.unpack(data[:-2])
    hour, minute, second, hundredth = numbers[19:23]
    return Pd4(
        axes=("beam", "instrument", "ship", "earth")[numbers[3] >> 6],
        velocity=_vector(numbers[4:7]),
        error_velocity=_speed(numbers[7]),
        ranges=tuple(value / 100.0 if value else math.nan for value in numbers[8:12]),
        water_velocity=_vector(numbers[13:16]),
        time_of_day=hour * 3600 + minute * 60 + second + hundredth / 100.0,
        sound_speed=float(numbers[24]),
        temperature=numbers[25] / 100.0,
    )


def _speed(value: int) -> float:
    return math.nan if value == BAD_VELOCITY else value / 1000.0


def _vector(values: Sequence[int]) -> Vector:
    x, y, z = map(_speed, values)
    return x, y, z
