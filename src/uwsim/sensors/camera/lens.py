"""The lens of a camera and the port of its housing.

.. code-block:: xml

    <u:lens>
      <u:k1>-0.12</u:k1> <u:k2>0.02</u:k2>
      <u:flatPort> <u:distance>0.02</u:distance> <u:thickness>0.008</u:thickness> </u:flatPort>
    </u:lens>
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ...cameras import DomePort, FlatPort, Lens
from ...cameras.port import GLASS_INDEX, WATER_INDEX
from ...schema import Spec, element

MAX_LENGTH = 1.0
"""The greatest length in a housing [m]."""


@dataclass(frozen=True, kw_only=True)
class FlatPortSpec(Spec):
    """A ``<u:flatPort>``: a plane of glass across the optical axis."""

    distance: float = element(namespaced=True, default=0.02, minimum=0.0, maximum=MAX_LENGTH)
    """The distance from the entrance pupil of the lens to the glass [m]."""
    thickness: float = element(namespaced=True, default=0.008, minimum=0.0, maximum=MAX_LENGTH)
    """The thickness of the glass [m]."""
    glass_index: float = element(namespaced=True, default=GLASS_INDEX, minimum=1.3, maximum=2.5)
    """The refractive index of the glass [1]; 1.49 is acrylic glass."""
    water_index: float = element(namespaced=True, default=WATER_INDEX, minimum=1.0, maximum=1.6)
    """The refractive index of the water [1]."""


@dataclass(frozen=True, kw_only=True)
class DomePortSpec(Spec):
    """A ``<u:domePort>``: a sphere of glass whose centre is on the optical axis."""

    radius: float = element(
        namespaced=True, default=0.05, exclusive_minimum=0.0, maximum=MAX_LENGTH
    )
    """The inner radius of the sphere [m]."""
    thickness: float = element(namespaced=True, default=0.008, minimum=0.0, maximum=MAX_LENGTH)
    """The thickness of the glass [m]."""
    offset: float = element(namespaced=True, default=0.0, minimum=-MAX_LENGTH, maximum=MAX_LENGTH)
    """The distance from the entrance pupil of the lens forward to the centre of the sphere [m]."""
    glass_index: float = element(namespaced=True, default=GLASS_INDEX, minimum=1.3, maximum=2.5)
    """The refractive index of the glass [1]; 1.49 is acrylic glass."""
    water_index: float = element(namespaced=True, default=WATER_INDEX, minimum=1.0, maximum=1.6)
    """The refractive index of the water [1]."""


@dataclass(frozen=True, kw_only=True)
class LensSpec(Spec):
    """A ``<u:lens>``: the distortion of a lens, and the port in front of it.

    The coefficients are those of ``plumb_bob`` in ROS and OpenCV: in the water without a port, in
    air behind one. Behind a port the field of view and the focal lengths are those in air, and the
    pose of the camera is that of the effective centre, where rays in the water meet.
    """

    k1: float = element(namespaced=True, default=0.0, minimum=-10.0, maximum=10.0)
    """The radial distortion of order 2 [1]."""
    k2: float = element(namespaced=True, default=0.0, minimum=-10.0, maximum=10.0)
    """The radial distortion of order 4 [1]."""
    p1: float = element(namespaced=True, default=0.0, minimum=-1.0, maximum=1.0)
    """The first tangential distortion [1]."""
    p2: float = element(namespaced=True, default=0.0, minimum=-1.0, maximum=1.0)
    """The second tangential distortion [1]."""
    k3: float = element(namespaced=True, default=0.0, minimum=-10.0, maximum=10.0)
    """The radial distortion of order 6 [1]."""
    flat_port: FlatPortSpec | None = element(namespaced=True, default=None)
    """The flat port of the housing."""
    dome_port: DomePortSpec | None = element(namespaced=True, default=None)
    """The dome port of the housing."""
    focus_distance: float = element(namespaced=True, default=1.0, minimum=0.05, maximum=1000.0)
    """The distance from the effective centre at which a port's image is exact [m]."""

    def find_errors(self) -> Iterator[str]:
        """Yield the errors of the port."""
        if self.flat_port is not None and self.dome_port is not None:
            yield "the lens has a <u:flatPort> and a <u:domePort>; expected at most one"
        dome, plane = self.dome_port, self.flat_port
        if dome is not None and abs(dome.offset) >= dome.radius:
            yield (
                f"<u:offset> is {dome.offset:g} m and <u:radius> {dome.radius:g} m; "
                "expected the pupil inside the dome"
            )
        front = 0.0
        if dome is not None:
            front = dome.offset + dome.radius + dome.thickness
        elif plane is not None:
            front = plane.distance + plane.thickness
        if self.focus_distance < 2.0 * front:
            yield (
                f"<u:focusDistance> is {self.focus_distance:g} m and the port reaches to "
                f"{front:g} m; expected at least twice that"
            )

    @property
    def lens(self) -> Lens:
        """The lens with its port."""
        port: FlatPort | DomePort | None = None
        if self.flat_port is not None:
            port = FlatPort(
                distance=self.flat_port.distance,
                thickness=self.flat_port.thickness,
                glass_index=self.flat_port.glass_index,
                water_index=self.flat_port.water_index,
                focus_distance=self.focus_distance,
            )
        elif self.dome_port is not None:
            port = DomePort(
                radius=self.dome_port.radius,
                offset=self.dome_port.offset,
                thickness=self.dome_port.thickness,
                glass_index=self.dome_port.glass_index,
                water_index=self.dome_port.water_index,
                focus_distance=self.focus_distance,
            )
        return Lens(distortion=(self.k1, self.k2, self.p1, self.p2, self.k3), port=port)
