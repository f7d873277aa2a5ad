"""The spec of sonars that measure echoes."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import ClassVar

from ...schema import MAX_DISTANCE, element
from ..sensor import LookAt, SensorSpec


@dataclass(frozen=True, kw_only=True)
class SonarSpec(SensorSpec):
    """A sonar that looks along +x, with +z up."""

    frame_rpy: ClassVar[tuple[float, float, float]] = (pi, -0.5 * pi, 0.0)

    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """Position of the sonar in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """Orientation of the sonar in the link's frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """Viewing target at the start, instead of ``orientation``: a point in L [m], or a direction
    of the vehicle. It stays fixed to its link."""
    range: float = element(default=20.0, above=0, maximum=10000)
    """End of the last bin of range [m]."""
    min_range: float = element(default=0.5, minimum=0, maximum=10000)
    """Begin of the first bin of range [m]."""
    bins: int = element(default=500, minimum=1, maximum=10000)
    """Bins of range, of equal size: the resolution, the length of the pulse."""
    vertical_aperture: float = element(default=20.0, above=0, maximum=160)
    """Height of its beams between the points of half power, one way [deg]."""
    beam_width: float = element(default=1.0, above=0, maximum=30)
    """Width of a beam between the points of half power, there and back [deg]."""
    rows: int = element(default=32, minimum=1, maximum=2048)
    """Rays of a beam one above the other. Small targets get rays of their own; what is lower than
    the distance of two rays and part of a large body may be missed."""
    frequency: float = element(default=900e3, minimum=1000, maximum=5e6)
    """Frequency of the sound, for its absorption [Hz]."""
    source_level: float = element(default=210.0, minimum=0, maximum=300)
    """Source level of the ping on the axis of the beam [dB re 1 uPa at 1 m]."""
    noise_level: float = element(default=80.0, minimum=0, maximum=300)
    """Of what a beam receives without any echo, in the band of the sonar [dB re 1 uPa]."""
    speckle: bool = True
    """Whether echoes of many scatterers interfere: Rayleigh amplitudes."""
    multipath: bool = False
    """Whether echoes by way of the water's surface are there, too."""
    image_floor: float = element(default=-75.0, minimum=-300, maximum=300)
    """Target strength that is black in images [dB re 1 m2]."""
    image_range: float = element(default=50.0, above=0, maximum=300)
    """From black to white in images [dB]."""

    @property
    def n_cells(self) -> int:
        """Bins of all beams, or of all pings that it keeps."""
        return self.bins

    @property
    def n_rays(self) -> int:
        """Rays of a ping, but for those beside the outermost beams."""
        return self.rows
