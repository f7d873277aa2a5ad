r"""uwsimSinusoid: the current of UWSim's benchmarks, with sinusoidal speed and direction.

.. code-block:: xml

    <u:uwsimSinusoid>
      <u:speed>0.2</u:speed> <u:speedVariation>0.005</u:speedVariation>
      <u:speedPeriod>4</u:speedPeriod>
      <u:theta>M_PI_2</u:theta>
      <u:phi>0</u:phi> <u:phiVariation>0.7</u:phiVariation> <u:phiPeriod>30</u:phiPeriod>
      <u:random>0.01</u:random>
    </u:uwsimSinusoid>
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ..base.geometry import Array, Triple
from ..schema import element
from .current import MAX_SPEED, Current, CurrentSpec, Place, everywhere
from .random_table import Draws

MIN_PERIOD = 0.01
"""No water swells and turns faster [s]."""
RATE = 60.0
"""The random factors are drawn anew this often, and held between [Hz]."""


@dataclass(frozen=True, kw_only=True)
class UwsimSinusoidSpec(CurrentSpec):
    """A ``<u:uwsimSinusoid>``: the current of UWSim's benchmarks.

    A level of a ``<currentForceUpdater>`` is one.
    """

    speed: float = element(namespaced=True, minimum=-MAX_SPEED, maximum=MAX_SPEED)
    """Mean speed [m/s]."""
    speed_variation: float = element(
        namespaced=True, default=0.0, minimum=-MAX_SPEED, maximum=MAX_SPEED
    )
    """Amplitude of its swelling [m/s]."""
    speed_period: float = element(namespaced=True, default=1.0, minimum=MIN_PERIOD)
    """Period of its swelling [s]."""
    theta: float = element(namespaced=True, default=math.pi / 2.0)
    """Polar angle from z of L [rad]."""
    theta_variation: float = element(namespaced=True, default=0.0)
    """Amplitude of its turning in theta [rad]."""
    theta_period: float = element(namespaced=True, default=1.0, minimum=MIN_PERIOD)
    """Period of its turning in theta [s]."""
    phi: float = element(namespaced=True, default=0.0)
    """Azimuth from y of L towards -x of L [rad]."""
    phi_variation: float = element(namespaced=True, default=0.0)
    """Amplitude of its turning in phi [rad]."""
    phi_period: float = element(namespaced=True, default=1.0, minimum=MIN_PERIOD)
    """Period of its turning in phi [s]."""
    random: float = element(namespaced=True, default=0.0, minimum=0, maximum=10)
    """Half-width of the uniform noise on speed and both angles, relative [1]."""

    def bind(self, place: Place) -> UwsimSinusoid:
        """Take the stream ``current``."""
        generator = place.stream("current")
        return UwsimSinusoid(self, Draws(lambda size: generator.uniform(-1.0, 1.0, size), 3))


class UwsimSinusoid(Current):
    r"""The original's function of time, the same everywhere.

    .. math::

        F      &= (F_0 + F_v \sin(2\pi t/T_F)) (1 + e\,r_1) \\
        \theta &= (\theta_0 + \theta_v \sin(2\pi t/T_\theta)) (1 + e\,r_2) \\
        \phi   &= (\phi_0 + \phi_v \sin(2\pi t/T_\phi)) (1 + e\,r_3) \\
        v      &= F\,(-\sin\theta \sin\phi,\ \sin\theta \cos\phi,\ \cos\theta)

    in L, with r uniform in -1..1, drawn anew every 1/60 s and held, and e = ``random``. With
    theta = pi/2 the water flows along y of L, and turns towards -x as phi grows.
    Source: UWSim's benchmark module. It writes 3.14 for pi, takes t from the wall clock, and
    draws at every frame; here t is simulation time.

    Not modelled: any change with place. The acceleration leaves out the jumps of the noise.
    """

    def __init__(self, spec: UwsimSinusoidSpec, draws: Draws) -> None:
        self._spec, self._draws = spec, draws
        self._speed_rate = 2.0 * math.pi / spec.speed_period  # [rad/s]
        self._theta_rate = 2.0 * math.pi / spec.theta_period  # [rad/s]
        self._phi_rate = 2.0 * math.pi / spec.phi_period  # [rad/s]
        self._time = math.nan  # of the newest motion [s]
        self._motion: tuple[Triple, Triple] = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))

    @property
    def is_uniform(self) -> bool:
        """Whether it is the same everywhere."""
        return True

    @property
    def is_still(self) -> bool:
        """Whether its speed is zero at all times."""
        return self._spec.speed == self._spec.speed_variation == 0.0

    def velocity(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the velocity of the water, in L, (n, 3) [m/s]."""
        return everywhere(points, *self._at(time)[0])

    def acceleration(self, points: Array, time: float, vehicles: Sequence[str] = ()) -> Array:
        """Return the derivative with the random factors held, in L, (n, 3) [m/s2]."""
        return everywhere(points, *self._at(time)[1])

    def _at(self, time: float) -> tuple[Triple, Triple]:
        """Velocity [m/s] and acceleration [m/s2]; both are asked for at every step."""
        if time != self._time:
            self._time, self._motion = time, self._move(time)
        return self._motion

    def _move(self, time: float) -> tuple[Triple, Triple]:
        spec = self._spec
        a, b, c = self._factors(time)
        speed = a * (spec.speed + spec.speed_variation * math.sin(self._speed_rate * time))
        theta = b * (spec.theta + spec.theta_variation * math.sin(self._theta_rate * time))
        phi = c * (spec.phi + spec.phi_variation * math.sin(self._phi_rate * time))
        dspeed = a * spec.speed_variation * self._speed_rate * math.cos(self._speed_rate * time)
        dtheta = b * spec.theta_variation * self._theta_rate * math.cos(self._theta_rate * time)
        dphi = c * spec.phi_variation * self._phi_rate * math.cos(self._phi_rate * time)
        sine, cosine = math.sin(theta), math.cos(theta)
        aside, along = -math.sin(phi), math.cos(phi)
        flat, dflat = speed * sine, dspeed * sine + speed * cosine * dtheta
        return (
            (flat * aside, flat * along, speed * cosine),
            (
                dflat * aside - flat * along * dphi,
                dflat * along + flat * aside * dphi,
                dspeed * cosine - speed * sine * dtheta,
            ),
        )

    def _factors(self, time: float) -> tuple[float, float, float]:
        """The factors of speed, theta and phi at a time."""
        e = self._spec.random
        if e == 0.0:
            return 1.0, 1.0, 1.0
        r = self._draws.row(math.floor(time * RATE + 1e-6))
        return 1.0 + e * r[0], 1.0 + e * r[1], 1.0 + e * r[2]
