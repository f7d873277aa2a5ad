"""The serial protocol of Water Linked's DVLs: velocity reports ``wrz``, transducers ``wru``.

.. code-block:: text

    wrz,vx,vy,vz,valid,altitude,fom,covariance,time of validity,time of transmission,time,status*xx
    wru,id,velocity,distance,rssi,nsd*xx

Velocities [m/s] are in the axes of the instrument, x forward, y to starboard, z down; ``valid`` is
y or n; the altitude is -1 without bottom lock; the covariance has 9 numbers [m2/s2]; times are in
microseconds since 1970, the time since the last report in milliseconds. The checksum is a CRC-8.

Source: Water Linked, "DVL protocol", version 2.3, serial protocol. The signal and noise levels of
``wru`` are not modelled, so a stream of the simulation does not send it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from ...errors import BadMessage
from .checksums import crc8
from .dvl import Vector, is_known
from .sentence import MAX_LENGTH, parse_number


def frame_report(body: str) -> bytes:
    """Return a report with its checksum and its end of line."""
    data = body.encode("ascii")
    return b"%s*%02x\r\n" % (data, crc8(data))


def read_report(data: bytes, name: str) -> list[str]:
    """Return the fields of a report after its name; raise BadMessage."""
    line = data.strip(b"\r\n")
    body, star, checksum = line.rpartition(b"*")
    if len(data) > MAX_LENGTH or not star or not body.startswith(name.encode() + b","):
        raise BadMessage(f"{line[:40]!r} is no report {name}; expected {name},FIELDS*CHECKSUM.")
    expected = b"%02x" % crc8(body)
    if checksum.lower() != expected:
        raise BadMessage(f"{line[:40]!r} has a wrong checksum; expected *{expected.decode()}.")
    return body.decode("ascii", "replace").split(",")[1:]


@dataclass(frozen=True, kw_only=True)
class VelocityReport:
    """A velocity report."""

    velocity: Vector
    """The velocity over the bottom, instrument axes [m/s]; NaN: no bottom lock."""
    altitude: float
    """The distance to the bottom [m]; NaN: no bottom lock."""
    figure_of_merit: float
    """The accuracy of the velocity [m/s]."""
    time_us: int
    """The time of validity [us since 1970]."""
    sent_us: int
    """The time of transmission [us since 1970]."""
    interval_ms: float
    """The time since the last report [ms]."""
    covariance: tuple[float, ...] = (0.0,) * 9
    """The covariance of the velocity, by rows [m2/s2]."""

    @property
    def is_valid(self) -> bool:
        """True if there is bottom lock."""
        return is_known(self.velocity) and math.isfinite(self.altitude)

    def to_bytes(self) -> bytes:
        """Return the report ``wrz``."""
        velocity = self.velocity if self.is_valid else (0.0, 0.0, 0.0)
        altitude = self.altitude if self.is_valid else -1.0
        fields = (
            *(f"{round(value, 3) + 0.0:.3f}" for value in velocity),
            "y" if self.is_valid else "n",
            f"{altitude:.2f}",
            f"{self.figure_of_merit:.3f}",
            ";".join(f"{value:.6g}" for value in self.covariance),
            str(self.time_us),
            str(self.sent_us),
            f"{self.interval_ms:.2f}",
            "0",
        )
        return frame_report(",".join(("wrz", *fields)))


def read_velocity_report(data: bytes) -> VelocityReport:
    """Return the report of a line ``wrz``; raise BadMessage."""
    fields = read_report(data, "wrz")
    if len(fields) != 11:
        raise BadMessage(f"wrz has {len(fields)} fields; expected 11.")
    covariance = tuple(parse_number(text, "wrz") for text in fields[6].split(";")[:10])
    if len(covariance) != 9:
        raise BadMessage(f"wrz has a covariance of {len(covariance)} numbers; expected 9.")
    x, y, z, altitude = (parse_number(fields[i], "wrz") for i in (0, 1, 2, 4))
    is_valid = fields[3] == "y"
    return VelocityReport(
        velocity=(x, y, z) if is_valid else (math.nan, math.nan, math.nan),
        altitude=altitude if is_valid else math.nan,
        figure_of_merit=parse_number(fields[5], "wrz"),
        covariance=covariance,
        time_us=int(parse_number(fields[7], "wrz")),
        sent_us=int(parse_number(fields[8], "wrz")),
        interval_ms=parse_number(fields[9], "wrz"),
    )


@dataclass(frozen=True, kw_only=True)
class TransducerReport:
    """A transducer report."""

    transducer: int
    """The number of the transducer."""
    velocity: float
    """The velocity along its beam [m/s]."""
    distance: float
    """The distance along its beam [m]."""
    signal_level: float
    """The strength of the signal [dBm]."""
    noise_level: float
    """The level of the background noise [dBm]."""

    def to_bytes(self) -> bytes:
        """Return the report ``wru``."""
        return frame_report(
            f"wru,{self.transducer},{self.velocity:.3f},{self.distance:.2f},"
            f"{self.signal_level:.0f},{self.noise_level:.0f}"
        )


def read_transducer_report(data: bytes) -> TransducerReport:
    """Return the report of a line ``wru``; raise BadMessage."""
    fields = read_report(data, "wru")
    if len(fields) != 5:
        raise BadMessage(f"wru has {len(fields)} fields; expected 5.")
    number, velocity, distance, signal_level, noise_level = (
        parse_number(text, "wru") for text in fields
    )
    return TransducerReport(
        transducer=int(number),
        velocity=velocity,
        distance=distance,
        signal_level=signal_level,
        noise_level=noise_level,
    )
