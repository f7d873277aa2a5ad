r"""An ultra-short baseline (USBL) acoustic positioning system: the position of a beacon.

.. code-block:: xml

    <u:usbl>
      <name>usbl</name> <relativeTo>base_link</relativeTo>
      <position> <x>0.6</x> <y>0</y> <z>0</z> </position>
      <beacon>dock</beacon> <beaconPosition> <x>0.5</x> <y>0</y> <z>0</z> </beaconPosition>
      <range>150</range> <rangeStd>0.05</rangeStd> <angleStd>0.02</angleStd> <dropout>0.1</dropout>
    </u:usbl>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..base.geometry import Array, Triple
from ..base.numerics.linear import cross, length, rotate, rotate_back
from ..base.record import RandomState
from ..messages import Point, PointStamped, header
from ..schema import MAX_DISTANCE, element
from ..world import Body, SensorWorld
from .sensor import Carrier, SensorSpec


@dataclass(frozen=True, kw_only=True)
class UsblSpec(SensorSpec):
    """A ``<u:usbl>``."""

    message_type: ClassVar[type] = PointStamped

    position: Triple = element(default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """The position of the transceiver in the link's frame [m]."""
    orientation: Triple = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """The orientation of the transceiver in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    beacon: str = element(refers_to="body")
    """The body that carries the beacon: a vehicle (its base), ``vehicle/link``, or an object."""
    beacon_position: Triple = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The position of the beacon in the frame of that body [m]."""
    range: float = element(default=500.0, exclusive_minimum=0.0, maximum=MAX_DISTANCE)
    """The distance beyond which the beacon is not heard [m]."""
    range_std: float = element(default=0.0, minimum=0.0, maximum=1000.0)
    """The standard deviation of the noise of the distance [m]."""
    angle_std: float = element(default=0.0, minimum=0.0, maximum=1.0)
    """The standard deviation of the noise of the direction, about each of two axes across it
    [rad]."""
    dropout: float = element(default=0.0, minimum=0.0, maximum=1.0)
    """The share of the replies that is lost [1]."""

    def bind(self, world: SensorWorld, vehicle: Carrier) -> Usbl:
        """Mount the transceiver; raise UnknownName if there is no such link or beacon."""
        rng = world.stream(f"{vehicle.name}/{self.name}/noise")
        return Usbl(self, vehicle.mount(self), world.body(self.beacon), rng)


class Usbl:
    r"""A transceiver that measures the position of a beacon in its own axes.

    With the true position :math:`p = r\,u` and independent normal draws :math:`n_i`,

    .. math:: \hat p = (r + \sigma_r n_0)
        \frac{u + \sigma_a n_1\, a + \sigma_a n_2\, b}{\lVert \cdot \rVert}

    with the unit vectors a and b across u. A lost reply gives no message. Each sample takes four
    draws, so that a lost reply does not change the noise of the others.

    Not modelled: the time of travel, in which the vehicle moves (0.13 s for 100 m and back), the
    error of the sound speed, refraction, bodies between the two, multipath, other beacons, and
    noise that grows with the distance.
    """

    def __init__(self, spec: UsblSpec, mount: Body, beacon: Body, rng: np.random.Generator) -> None:
        self._spec, self._mount, self._beacon = spec, mount, beacon
        self._beacon_position = np.array(spec.beacon_position)  # in the frame of its body (3,) [m]
        self.state = RandomState(rng)
        """The state: the generator of the noise."""

    def sample(self, time: float) -> PointStamped | None:
        """Measure at ``time`` [s]; return None if no reply is received."""
        normals, fate = self.state.rng.standard_normal(3).tolist(), self.state.rng.random()
        position = self._true_position()
        distance = length(position)
        if distance > self._spec.range or fate < self._spec.dropout:
            return None
        x, y, z = self._with_noise(position, distance, normals).tolist()
        return PointStamped(header=header(time, self._spec.name), point=Point(x=x, y=y, z=z))

    def _true_position(self) -> Array:
        """Return the position of the beacon in the axes of the transceiver, (3,) [m]."""
        body, mount = self._beacon.world_from_body, self._mount.world_from_body
        beacon = body.position + rotate(body.rotation, self._beacon_position)
        return rotate_back(mount.rotation, beacon - mount.position)

    def _with_noise(self, position: Array, distance: float, normals: list[float]) -> Array:
        if distance == 0.0:
            return position
        direction = position / distance
        axis = np.eye(3)[int(np.argmin(np.abs(direction)))]
        side = cross(direction, axis)
        side = side / length(side)
        offset = normals[1] * side + normals[2] * cross(direction, side)
        vector = direction + self._spec.angle_std * offset
        result: Array = (distance + self._spec.range_std * normals[0]) * vector / length(vector)
        return result
