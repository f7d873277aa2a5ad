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
from dataclasses import dataclass

import numpy as np

from ..base.numerics.calls import address_of
from ..base.numerics.jit import njit
from ..base.numerics.memory import carray, pointer, view_doubles
from ..schema import element
from .compiled import CompiledCurrent
from .current import MAX_SPEED, CurrentSpec, Place
from .flow_function import QUERY, FlowFunction, Record, write_everywhere
from .random_table import ROWS, RandomTable

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
        return UwsimSinusoid(self, place.stream("current"))


SWING = np.dtype([("mean", np.float64), ("variation", np.float64), ("rate", np.float64)])
"""A sine of time about a mean; its rate is in rad/s."""
SINUSOID = np.dtype(
    [
        ("speed", SWING),
        ("theta", SWING),
        ("phi", SWING),
        ("random", np.float64),
        ("draws", np.int64),  # the address of a record of `random_table.ROWS`
    ]
)
"""UWSim's current, for compiled code."""


class UwsimSinusoid(CompiledCurrent):
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

    def __init__(self, spec: UwsimSinusoidSpec, random: np.random.Generator) -> None:
        self._is_still = spec.speed == spec.speed_variation == 0.0
        draws = RandomTable(lambda shape, _: random.uniform(-1.0, 1.0, shape), 3)
        row = np.zeros(1, SINUSOID)
        for name in ("speed", "theta", "phi"):
            row[name]["mean"] = getattr(spec, name)
            row[name]["variation"] = getattr(spec, f"{name}_variation")
            row[name]["rate"] = 2.0 * math.pi / getattr(spec, f"{name}_period")
        row["random"], row["draws"] = spec.random, address_of(draws.record)
        is_random = spec.random != 0.0
        self._flow = FlowFunction(
            function=flow_sinusoid,
            parameters=row,
            prepare=lambda until: draws.extend(draw_of(until)) if is_random else None,
            kept=(draws,),
        )

    @property
    def is_uniform(self) -> bool:
        """Whether it is the same everywhere."""
        return True

    @property
    def is_still(self) -> bool:
        """Whether its speed is zero at all times."""
        return self._is_still


@njit
def draw_of(time: float) -> int:
    """Return the number of the random factors that hold at a time [s]."""
    return max(0, math.floor(time * RATE + 1e-6))


@njit
def swung(swing: Record, factor: float, time: float) -> tuple[float, float]:
    """Return the value of a sine at a time, and its derivative."""
    turn = swing.rate * time
    return (
        factor * (swing.mean + swing.variation * math.sin(turn)),
        factor * swing.variation * swing.rate * math.cos(turn),
    )


def flow_sinusoid(parameters: int, values: int, time: float) -> None:
    """Answer a query about UWSim's current; see `uwsim.currents.flow_function`."""
    current = carray(pointer(parameters), (1,), SINUSOID)[0]
    a, b, c, e = 1.0, 1.0, 1.0, current.random
    if e != 0.0:
        table, first = carray(pointer(current.draws), (1,), ROWS)[0], 3 * draw_of(time)
        rows = view_doubles(table.rows, 3 * table.n)
        a, b, c = 1.0 + e * rows[first], 1.0 + e * rows[first + 1], 1.0 + e * rows[first + 2]
    speed, dspeed = swung(current.speed, a, time)
    theta, dtheta = swung(current.theta, b, time)
    phi, dphi = swung(current.phi, c, time)
    sine, cosine = math.sin(theta), math.cos(theta)
    aside, along = -math.sin(phi), math.cos(phi)
    flat, dflat = speed * sine, dspeed * sine + speed * cosine * dtheta
    velocity, acceleration = np.empty(3), np.empty(3)
    velocity[0], velocity[1], velocity[2] = flat * aside, flat * along, speed * cosine
    acceleration[0] = dflat * aside - flat * along * dphi
    acceleration[1] = dflat * along + flat * aside * dphi
    acceleration[2] = dspeed * cosine - speed * sine * dtheta
    write_everywhere(carray(pointer(values), (1,), QUERY)[0], velocity, acceleration)
