r"""powerProfile, logProfile, layers: currents that depend on depth.

.. code-block:: xml

    <u:powerProfile>
      <u:velocity> <x>0.4</x> <y>0</y> <z>0</z> </u:velocity> <u:depth>20</u:depth>
    </u:powerProfile>
    <u:logProfile>
      <u:velocity> <x>0.4</x> <y>0</y> <z>0</z> </u:velocity> <u:depth>20</u:depth>
      <u:roughness>0.001</u:roughness>
    </u:logProfile>
    <u:layers>
      <u:layer>
        <u:depth>0</u:depth> <u:velocity> <x>0.5</x> <y>0</y> <z>0</z> </u:velocity>
      </u:layer>
      <u:layer>
        <u:depth>5</u:depth> <u:velocity> <x>0.1</x> <y>0.1</y> <z>0</z> </u:velocity>
      </u:layer>
    </u:layers>

Depth counts from the still surface, whichever way the file's z points. All are steady, and none
knows the ground: the depth of the water is what the file says.
"""

from __future__ import annotations

import abc
import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array, Triple
from ..base.numerics.elementwise import log, power
from ..errors import BadSetting
from ..schema import Spec, element
from .current import MAX_SPEED, Current, CurrentSpec, Place

KARMAN = 0.41
"""Von Karman's constant [1]."""


@dataclass(frozen=True, kw_only=True)
class PowerProfileSpec(CurrentSpec):
    """A ``<u:powerProfile>``: speed grows with a power of the height above ground."""

    velocity: Triple = element(namespaced=True, minimum=-MAX_SPEED, maximum=MAX_SPEED)
    """Velocity of the water at the surface, in L [m/s]."""
    depth: float = element(namespaced=True, above=0)
    """Depth of the ground below the still surface [m]."""
    exponent: float = element(namespaced=True, default=1.0 / 7.0, above=0)
    """Exponent of the power law [1]."""

    def bind(self, place: Place) -> PowerProfile:
        """Take the surface and the direction down from the scene."""
        return PowerProfile(self, place)


@dataclass(frozen=True, kw_only=True)
class LogProfileSpec(CurrentSpec):
    """A ``<u:logProfile>``: speed grows with the logarithm of the height above ground."""

    velocity: Triple = element(namespaced=True, minimum=-MAX_SPEED, maximum=MAX_SPEED)
    """Velocity of the water at the surface, in L [m/s]."""
    depth: float = element(namespaced=True, above=0)
    """Depth of the ground below the still surface [m]."""
    roughness: float = element(namespaced=True, default=0.001, above=0)
    """Roughness length z0 of the bottom: mud 0.0002, gravel 0.005 [m]."""

    def bind(self, place: Place) -> LogProfile:
        """Take the surface and the direction down from the scene.

        Raises:
            BadSetting: the water is not deeper than its ground is rough.
        """
        if self.depth <= self.roughness:
            raise BadSetting(
                f"<u:logProfile> has depth {self.depth:g} m and roughness {self.roughness:g} m; "
                "expected a depth above the roughness."
            )
        return LogProfile(self, place)


@dataclass(frozen=True, kw_only=True)
class LayerSpec(Spec):
    """A ``<u:layer>``: how the water moves at one depth."""

    depth: float = element(namespaced=True)
    """Below the still surface [m]."""
    velocity: Triple = element(namespaced=True, minimum=-MAX_SPEED, maximum=MAX_SPEED)
    """Velocity of the water there, in L [m/s]."""


@dataclass(frozen=True, kw_only=True)
class LayersSpec(CurrentSpec):
    """A ``<u:layers>``: velocities at given depths, linear between them."""

    layers: tuple[LayerSpec, ...] = element("layer", namespaced=True)
    """From the top down."""

    def bind(self, place: Place) -> Layers:
        """Take the surface and the direction down from the scene.

        Raises:
            BadSetting: a layer does not lie below the one before it.
        """
        depths = [layer.depth for layer in self.layers]
        for above, below in itertools.pairwise(depths):
            if below <= above:
                raise BadSetting(
                    f"A <u:layer> of depth {below:g} m follows one of {above:g} m; "
                    "expected them from the top down, each depth once."
                )
        return Layers(self, place)


class Profile(Current, abc.ABC):
    """A steady current that depends on depth alone."""

    def __init__(self, place: Place) -> None:
        self._place = place

    @abc.abstractmethod
    def at_depth(self, depths: Array) -> Array:
        """Return the velocity in L at ``depths`` below the still surface (n,) [m]: (n, 3) [m/s]."""

    @property
    def is_steady(self) -> bool:
        """Whether it is the same at all times: yes."""
        return True

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L, (n, 3) [m/s]."""
        return self.at_depth(self._place.depths(points))

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return zeros, (n, 3) [m/s2]."""
        return np.zeros((len(points), 3))


class PowerProfile(Profile):
    r"""Speed by the power law over the height above ground.

    .. math:: v(d) = v_0 \left(\frac{h - d}{h}\right)^{1/7}

    at depth d in water of depth h: the velocity of the surface above it, none below the ground
    (Soulsby, Dynamics of Marine Sands, 1997, has 1/7 for tidal flow). Not modelled: turning with
    depth, time.
    """

    def __init__(self, spec: PowerProfileSpec, place: Place) -> None:
        super().__init__(place)
        self._surface = np.array(spec.velocity)  # (3,) [m/s]
        self._depth, self._exponent = spec.depth, spec.exponent

    def at_depth(self, depths: Array) -> Array:
        """Return the velocity at a depth, (n, 3) [m/s]."""
        height = np.clip(1.0 - depths / self._depth, 0.0, 1.0)
        velocities: Array = power(height, self._exponent)[:, None] * self._surface
        return velocities


class LogProfile(Profile):
    r"""Speed by the law of the wall over the height above ground.

    .. math:: v(d) = v_0 \frac{\ln((h - d)/z_0)}{\ln(h/z_0)} \quad
        \left(u = \frac{u_*}{0.41} \ln \frac{h - d}{z_0}\right)

    at depth d in water of depth h: the velocity of the surface above it, none from z0 down
    (Soulsby, Dynamics of Marine Sands, 1997). It holds near the ground and is commonly used up to
    the surface. Not modelled: turning with depth, stratification, time.
    """

    def __init__(self, spec: LogProfileSpec, place: Place) -> None:
        super().__init__(place)
        self._surface = np.array(spec.velocity)  # (3,) [m/s]
        self._depth, self._roughness = spec.depth, spec.roughness

    def at_depth(self, depths: Array) -> Array:
        """Return the velocity at a depth, (n, 3) [m/s]."""
        heights = np.clip(self._depth - depths, self._roughness, self._depth)
        share = log(heights / self._roughness) / math.log(self._depth / self._roughness)
        velocities: Array = share[:, None] * self._surface
        return velocities


class Layers(Profile):
    """Velocities at given depths, linear between them, and even above the first and below the last.

    Not modelled: mixing, internal waves, time.
    """

    def __init__(self, spec: LayersSpec, place: Place) -> None:
        super().__init__(place)
        self._depths = np.array([layer.depth for layer in spec.layers])  # (k,) [m]
        self._velocities = np.array([layer.velocity for layer in spec.layers])  # (k, 3) [m/s]

    def at_depth(self, depths: Array) -> Array:
        """Return the velocity at a depth, (n, 3) [m/s]."""
        velocities = np.empty((len(depths), 3))
        for axis in range(3):
            velocities[:, axis] = np.interp(depths, self._depths, self._velocities[:, axis])
        return velocities
