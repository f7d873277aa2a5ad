"""The elements that imaging, scanning and side-scan sonars share."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import ClassVar

from ...schema import MAX_DISTANCE, element
from ..sensor import LookAt, SensorSpec


@dataclass(frozen=True, kw_only=True)
class SonarSpec(SensorSpec):
    """The spec of a sonar that looks along +x, with +z up."""

    frame_rpy: ClassVar[tuple[float, float, float]] = (pi, -0.5 * pi, 0.0)

    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The position of the sonar in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """The orientation of the sonar in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """The viewing target at the start, instead of ``orientation``: a point in L [m], or a direction
    of the vehicle. The sonar stays fixed to its link."""
    range: float = element(default=20.0, exclusive_minimum=0, maximum=10000)
    """The end of the last range bin [m]."""
    min_range: float = element(default=0.5, minimum=0, maximum=10000)
    """The start of the first range bin [m]."""
    bins: int = element(default=500, minimum=1, maximum=10000)
    """The number of range bins, whose equal size is the range resolution."""
    vertical_aperture: float = element(default=20.0, exclusive_minimum=0, maximum=160)
    """The vertical width of each beam at -3 dB of the one-way pattern [deg]."""
    beam_width: float = element(default=1.0, exclusive_minimum=0, maximum=30)
    """The horizontal width of each beam at -3 dB of the two-way pattern [deg]."""
    rows: int = element(default=32, minimum=1, maximum=2048)
    """The number of rays of a beam, one above the other. Small targets get additional rays; a part
    of a large body that is lower than the spacing of the rays may be missed."""
    frequency: float = element(default=900e3, minimum=1000, maximum=5e6)
    """The frequency of the sound, which determines the absorption [Hz]."""
    source_level: float = element(default=210.0, minimum=0, maximum=300)
    """The source level of the ping on the axis of the beam [dB re 1 uPa at 1 m]."""
    noise_level: float = element(default=80.0, minimum=0, maximum=300)
    """The noise level that a beam receives, in the band of the sonar [dB re 1 uPa]."""
    speckle: bool = True
    """True if echoes of many scatterers interfere: their amplitudes are Rayleigh-distributed."""
    multipath: bool = False
    """True if echoes that are reflected at the water's surface are included."""
    image_floor: float = element(default=-75.0, minimum=-300, maximum=300)
    """The target strength that is black in images [dB re 1 m2]."""
    image_range: float = element(default=50.0, exclusive_minimum=0, maximum=300)
    """The dynamic range of images, from black to white [dB]."""

    @property
    def n_cells(self) -> int:
        """The number of range bins that the sonar stores, over all beams and pings."""
        return self.bins

    @property
    def n_rays(self) -> int:
        """The number of rays of a ping, without rays outside the outermost beams."""
        return self.rows
