r"""tidal: a current of tidal constituents.

.. code-block:: xml

    <u:tidal>
      <u:start>3600</u:start>
      <u:constituent>
        <u:name>M2</u:name>
        <u:semiMajor>0.4</u:semiMajor> <u:semiMinor>-0.05</u:semiMinor>
        <u:inclination>M_PI_4</u:inclination> <u:phase>0</u:phase>
      </u:constituent>
      <u:constituent> <u:name>S2</u:name> <u:semiMajor>0.15</u:semiMajor> </u:constituent>
    </u:tidal>
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from ..base.geometry import Array
from ..schema import Spec, element
from .current import MAX_SPEED, Current, CurrentSpec, Place, everywhere

DEGREES_PER_HOUR = {"M2": 28.9841042, "S2": 30.0, "K1": 15.0410686, "O1": 13.9430356}
"""Speed of each constituent (Doodson): periods of 12.4206, 12, 23.9345 and 25.8193 h."""


@dataclass(frozen=True, kw_only=True)
class ConstituentSpec(Spec):
    """A ``<u:constituent>``: the ellipse that one constituent of the tide draws."""

    name: Literal["M2", "S2", "K1", "O1"] = element(namespaced=True)
    """Which: principal lunar, principal solar, lunisolar diurnal or lunar diurnal."""
    semi_major: float = element(namespaced=True, minimum=0, maximum=MAX_SPEED)
    """Highest speed [m/s]."""
    semi_minor: float = element(namespaced=True, default=0.0, minimum=-MAX_SPEED, maximum=MAX_SPEED)
    """Lowest speed; below 0 the velocity turns from y of L to x, else from x to y [m/s]."""
    inclination: float = element(namespaced=True, default=0.0)
    """Of the highest speed, from x of L towards y [rad]."""
    phase: float = element(namespaced=True, default=0.0)
    """Lag of the highest speed behind time 0 [rad]."""

    @property
    def angular_rate(self) -> float:
        """Its speed [rad/s]."""
        return math.radians(DEGREES_PER_HOUR[self.name]) / 3600.0

    @property
    def period(self) -> float:
        """Its period [s]."""
        return 2.0 * math.pi / self.angular_rate


@dataclass(frozen=True, kw_only=True)
class TidalSpec(CurrentSpec):
    """A ``<u:tidal>``: the sum of the ellipses of some constituents of the tide."""

    start: float = element(namespaced=True, default=0.0)
    """Time of the tide when the simulation begins [s]."""
    constituents: tuple[ConstituentSpec, ...] = element("constituent", namespaced=True)
    """What adds up to it."""

    def bind(self, place: Place) -> Tidal:
        """Needs nothing of the scene."""
        return Tidal(self)


class Tidal(Current):
    r"""The sum of tidal ellipses, the same everywhere.

    .. math:: v = \sum_i R(\alpha_i)
        (a_i \cos(\omega_i t - g_i),\ b_i \sin(\omega_i t - g_i),\ 0)

    in L, with semi-axes a and b, inclination :math:`\alpha`, lag g (the usual ellipse parameters;
    Foreman, Manual for Tidal Currents Analysis and Prediction, 1978). M2 and S2 together swell and
    fade in 14.77 days: spring and neap.

    Not modelled: place and depth, other constituents, nodal corrections, the height of the tide,
    and lags of Greenwich: time 0 is the file's own. L's x-y plane is taken as horizontal.
    """

    def __init__(self, spec: TidalSpec) -> None:
        self._start = spec.start
        self._terms = [
            (
                each.angular_rate,
                each.phase,
                each.semi_major,
                each.semi_minor,
                math.cos(each.inclination),
                math.sin(each.inclination),
            )
            for each in spec.constituents
        ]

    @property
    def is_uniform(self) -> bool:
        """Whether it is the same everywhere."""
        return True

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L, (n, 3) [m/s]."""
        x = y = 0.0
        for rate, lag, major, minor, cosine, sine in self._terms:
            angle = rate * (self._start + time) - lag
            along, across = major * math.cos(angle), minor * math.sin(angle)
            x += along * cosine - across * sine
            y += along * sine + across * cosine
        return everywhere(points, x, y, 0.0)

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return its derivative, in L, (n, 3) [m/s2]."""
        x = y = 0.0
        for rate, lag, major, minor, cosine, sine in self._terms:
            angle = rate * (self._start + time) - lag
            along, across = -rate * major * math.sin(angle), rate * minor * math.cos(angle)
            x += along * cosine - across * sine
            y += along * sine + across * cosine
        return everywhere(points, x, y, 0.0)
