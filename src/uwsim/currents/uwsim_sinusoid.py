r"""uwsimSinusoid: a uniform current whose speed and direction vary as sines of time.

This is the current of the benchmarks of UWSim, the C++ simulator whose files `uwsim` reads.

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
from .current import MAX_SPEED, CurrentSpec, SceneContext
from .flow_function import QUERY, FlowFunction, Record, write_everywhere
from .random_table import ROWS, RandomTable

MIN_PERIOD = 0.01
"""The shortest period of a sine that a file may state [s]."""
RATE = 60.0
"""The rate at which random factors are drawn; they are constant between draws [Hz]."""


@dataclass(frozen=True, kw_only=True)
class UwsimSinusoidSpec(CurrentSpec):
    """A ``<u:uwsimSinusoid>``: the current of UWSim's benchmarks.

    Each level of a ``<currentForceUpdater>`` is a current of this kind.
    """

    speed: float = element(namespaced=True, minimum=-MAX_SPEED, maximum=MAX_SPEED)
    """The mean speed [m/s]."""
    speed_variation: float = element(
        namespaced=True, default=0.0, minimum=-MAX_SPEED, maximum=MAX_SPEED
    )
    """The amplitude of the variation of speed [m/s]."""
    speed_period: float = element(namespaced=True, default=1.0, minimum=MIN_PERIOD)
    """The period of the variation of speed [s]."""
    theta: float = element(namespaced=True, default=math.pi / 2.0)
    """The polar angle of the velocity from the z axis of L [rad]."""
    theta_variation: float = element(namespaced=True, default=0.0)
    """The amplitude of the variation of theta [rad]."""
    theta_period: float = element(namespaced=True, default=1.0, minimum=MIN_PERIOD)
    """The period of the variation of theta [s]."""
    phi: float = element(namespaced=True, default=0.0)
    """The azimuth of the velocity from the y axis of L towards -x of L [rad]."""
    phi_variation: float = element(namespaced=True, default=0.0)
    """The amplitude of the variation of phi [rad]."""
    phi_period: float = element(namespaced=True, default=1.0, minimum=MIN_PERIOD)
    """The period of the variation of phi [s]."""
    random: float = element(namespaced=True, default=0.0, minimum=0, maximum=10)
    """The half-width of the relative, uniform noise of the speed and of both angles [1]."""

    def bind(self, context: SceneContext) -> UwsimSinusoid:
        """Create the current with the random stream ``current``."""
        return UwsimSinusoid(self, context.stream("current"))


SINE = np.dtype([("mean", np.float64), ("variation", np.float64), ("rate", np.float64)])
"""A sine of time about a mean: the mean, the amplitude, and the angular rate [rad/s]."""
SINUSOID = np.dtype(
    [
        ("speed", SINE),  # [m/s]
        ("theta", SINE),  # [rad]
        ("phi", SINE),  # [rad]
        ("random", np.float64),  # the half-width of the relative noise [1]
        ("draws", np.int64),  # the address of a record of `random_table.ROWS`
    ]
)
"""The parameters of `flow_sinusoid`."""


class UwsimSinusoid(CompiledCurrent):
    r"""A uniform current whose speed F and direction are sines of time, with uniform noise.

    .. math::

        F      &= (F_0 + F_v \sin(2\pi t/T_F)) (1 + e\,r_1) \\
        \theta &= (\theta_0 + \theta_v \sin(2\pi t/T_\theta)) (1 + e\,r_2) \\
        \phi   &= (\phi_0 + \phi_v \sin(2\pi t/T_\phi)) (1 + e\,r_3) \\
        v      &= F\,(-\sin\theta \sin\phi,\ \sin\theta \cos\phi,\ \cos\theta)

    in L, with random numbers r uniform in -1..1, drawn every 1/60 s and constant between draws, and
    the relative noise e = ``random``. With theta = pi/2 and phi = 0 the water flows along y of L;
    as phi grows, the velocity turns towards -x. Source: the benchmark module of UWSim (C++), which
    takes 3.14 for pi and t from the wall clock, and draws in every rendered frame; here t is the
    simulation time.

    Not modelled: variation in space. The acceleration does not include the jumps of the noise.
    """

    def __init__(self, spec: UwsimSinusoidSpec, rng: np.random.Generator) -> None:
        self._is_still = spec.speed == spec.speed_variation == 0.0
        draws = RandomTable(lambda shape, _: rng.uniform(-1.0, 1.0, shape), 3)
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
            prepare=lambda end_time: draws.extend(draw_of(end_time)) if is_random else None,
            memory_owners=(draws,),
        )

    @property
    def is_uniform(self) -> bool:
        """True if the velocity is the same at every point; it always is."""
        return True

    @property
    def is_still(self) -> bool:
        """True if the speed is zero at all times."""
        return self._is_still


@njit
def draw_of(time: float) -> int:
    """Return the index of the random factors at a time [s]."""
    return max(0, math.floor(time * RATE + 1e-6))


@njit
def evaluate_sine(sine: Record, factor: float, time: float) -> tuple[float, float]:
    """Return the value of a `SINE` at a time [s], and its derivative by time, times a factor."""
    if sine.variation == 0.0:
        return factor * sine.mean, 0.0
    angle = sine.rate * time
    return (
        factor * (sine.mean + sine.variation * math.sin(angle)),
        factor * sine.variation * sine.rate * math.cos(angle),
    )


def flow_sinusoid(parameters_address: int, query_address: int, time: float) -> None:
    """Evaluate a query of UWSim's current; see `uwsim.currents.flow_function`."""
    current = carray(pointer(parameters_address), (1,), SINUSOID)[0]
    a, b, c, e = 1.0, 1.0, 1.0, current.random
    if e != 0.0:
        table, row = carray(pointer(current.draws), (1,), ROWS)[0], 3 * draw_of(time)
        rows = view_doubles(table.rows, 3 * table.n)
        a, b, c = (
            1.0 + e * rows[row],
            1.0 + e * rows[row + 1],
            1.0 + e * rows[row + 2],
        )
    speed, speed_rate = evaluate_sine(current.speed, a, time)
    theta, theta_rate = evaluate_sine(current.theta, b, time)
    phi, phi_rate = evaluate_sine(current.phi, c, time)
    sine, cosine = math.sin(theta), math.cos(theta)
    x, y = -math.sin(phi), math.cos(phi)
    level_speed, level_rate = (
        speed * sine,
        speed_rate * sine + speed * cosine * theta_rate,
    )
    velocity = (level_speed * x, level_speed * y, speed * cosine)
    acceleration = (
        level_rate * x - level_speed * y * phi_rate,
        level_rate * y + level_speed * x * phi_rate,
        speed_rate * cosine - speed * sine * theta_rate,
    )
    write_everywhere(carray(pointer(query_address), (1,), QUERY)[0], velocity, acceleration)
