"""The formats of instrument streams: the topic's type of each, and the function that writes it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ...autopilots.instruments.dvl import is_known
from ...autopilots.instruments.dvpdl import PositionDelta
from ...autopilots.instruments.rdi_pd4 import write_pd4
from ...autopilots.instruments.rdi_pd6 import write_pd6
from ...autopilots.instruments.water_linked import VelocityReport
from ...messages import DVL, Imu, NavSatFix, Pressure, Range
from .measurements import InstrumentCarrier


@dataclass(frozen=True)
class Sample:
    """A message of a topic, and what its bytes depend on besides."""

    carrier: InstrumentCarrier
    """The vehicle with the instruments."""
    message: Any
    """The message."""
    interval_us: int | None
    """The time since the last message [us]; None for the first."""
    is_depth: bool
    """True if a pressure sensor measures depth."""


@dataclass(frozen=True)
class Format:
    """A format of an instrument."""

    message_type: type
    """The type of the messages from which it is written."""
    write: Callable[[Sample], bytes]
    """The function that returns the bytes of a sample; none if there are no bytes to send."""


def _write_dvpdl(sample: Sample) -> bytes:
    """Return the motion since the last message: the present velocity times the time since then."""
    if sample.interval_us is None:
        return b""
    ping, seconds = sample.carrier.read_ping(sample.message), sample.interval_us / 1e6
    is_locked = is_known(ping.velocity)
    x, y, z = (seconds * v for v in ping.velocity) if is_locked else (0.0, 0.0, 0.0)
    delta = PositionDelta(
        time_us=ping.time_us - sample.carrier.epoch_us,
        interval_us=sample.interval_us,
        position_delta=(x, y, z),
        confidence=100 if is_locked else 0,
    )
    return delta.dvpdl().to_bytes()


def _write_wrz(sample: Sample) -> bytes:
    """Return a velocity report; its figure of merit is the size of the error velocity."""
    ping = sample.carrier.read_ping(sample.message)
    error = abs(ping.error_velocity) if is_known(ping.velocity) else 0.0
    variance = error**2
    report = VelocityReport(
        velocity=ping.velocity,
        altitude=ping.altitude,
        figure_of_merit=error,
        covariance=(variance, 0.0, 0.0, 0.0, variance, 0.0, 0.0, 0.0, variance),
        time_us=ping.time_us,
        sent_us=ping.time_us,
        interval_ms=(sample.interval_us or 0) / 1000.0,
    )
    return report.to_bytes()


def _depth(sample: Sample) -> bytes:
    reading = sample.carrier.read_pressure(sample.message, is_depth=sample.is_depth)
    return reading.isdpt().to_bytes()


FORMATS: dict[str, Format] = {
    "GGA": Format(NavSatFix, lambda s: s.carrier.read_fix(s.message).gga().to_bytes()),
    "RMC": Format(NavSatFix, lambda s: s.carrier.read_fix(s.message).rmc().to_bytes()),
    "VTG": Format(NavSatFix, lambda s: s.carrier.read_fix(s.message).vtg().to_bytes()),
    "GSA": Format(NavSatFix, lambda s: s.carrier.read_fix(s.message).gsa().to_bytes()),
    "ZDA": Format(NavSatFix, lambda s: s.carrier.read_fix(s.message).zda().to_bytes()),
    "HDT": Format(Imu, lambda s: s.carrier.read_imu(s.message).hdt().to_bytes()),
    "PRDID": Format(Imu, lambda s: s.carrier.read_imu(s.message).prdid().to_bytes()),
    "PASHR": Format(Imu, lambda s: s.carrier.read_imu(s.message).pashr().to_bytes()),
    "ISDPT": Format(Pressure, _depth),
    "DBT": Format(Range, lambda s: s.carrier.read_range(s.message).dbt().to_bytes()),
    "DPT": Format(Range, lambda s: s.carrier.read_range(s.message).dpt().to_bytes()),
    "PD4": Format(DVL, lambda s: write_pd4(s.carrier.read_ping(s.message))),
    "PD4EARTH": Format(DVL, lambda s: write_pd4(s.carrier.read_ping(s.message), "earth")),
    "PD6": Format(DVL, lambda s: write_pd6(s.carrier.read_ping(s.message))),
    "DVPDL": Format(DVL, _write_dvpdl),
    "WRZ": Format(DVL, _write_wrz),
}
"""The formats that are written from the messages of a topic."""
BEACON_FORMATS = ("PSONLLD", "PSIMSSB")
"""The formats of acoustic positioning, which are written from the vehicle's pose."""
