r"""gaussMarkov: a current that is a Gauss-Markov process about a mean.

.. code-block:: xml

    <u:gaussMarkov>
      <u:mean> <x>0.2</x> <y>0</y> <z>0</z> </u:mean>
      <u:deviation> <x>0.03</x> <y>0.03</y> <z>0</z> </u:deviation>
      <u:mu>0.02</u:mu>
    </u:gaussMarkov>
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array, Triple
from ..base.numerics.calls import address_of
from ..base.numerics.jit import njit
from ..base.numerics.memory import carray, pointer, view_doubles
from ..schema import element
from .compiled import CompiledCurrent
from .current import MAX_SPEED, CurrentSpec, SceneContext
from .flow_function import QUERY, FlowFunction, write_everywhere
from .random_table import ROWS, RandomTable


@dataclass(frozen=True, kw_only=True)
class GaussMarkovSpec(CurrentSpec):
    """A ``<u:gaussMarkov>``: a first-order Gauss-Markov process about a mean."""

    mean: Triple = element(
        namespaced=True, default=(0.0, 0.0, 0.0), minimum=-MAX_SPEED, maximum=MAX_SPEED
    )
    """The mean velocity, in L [m/s]."""
    deviation: Triple = element(namespaced=True, minimum=0.0, maximum=MAX_SPEED)
    """The standard deviation of the velocity along each axis of L [m/s]."""
    mu: float = element(namespaced=True, exclusive_minimum=0)
    """The inverse of the correlation time [1/s]."""
    step: float = element(namespaced=True, default=0.05, minimum=0.001)
    """The time between random numbers, with linear interpolation between them [s]."""

    def bind(self, context: SceneContext) -> GaussMarkov:
        """Create the current with the random stream ``current``."""
        return GaussMarkov(self, context.stream("current"))


GAUSS_MARKOV = np.dtype(
    [
        ("mean", np.float64, 3),  # in L [m/s]
        ("deviation", np.float64, 3),  # in L [m/s]
        ("step", np.float64),  # [s]
        ("states", np.int64),  # the address of a record of `random_table.ROWS`
    ]
)
"""The parameters of `flow_gauss_markov`."""


class GaussMarkov(CompiledCurrent):
    r"""A uniform current whose velocity is a first-order Gauss-Markov process.

    .. math:: \dot x + \mu x = w, \quad v = \bar v + x

    along each axis of L (Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control, section
    10.7), with the mean velocity :math:`\bar v` and white noise w of such a strength that the
    standard deviation :math:`\sigma` of x is ``deviation``. The exact solution at the times
    :math:`k h`, with the step h, is

    .. math:: x_{k+1} = e^{-\mu h} x_k + \sigma \sqrt{1 - e^{-2 \mu h}}\; n_k,
        \quad n_k \sim N(0, 1)

    and :math:`x_0` has the stationary distribution, so neither standard deviation nor correlation
    depends on h. (They do where ``amplitude * uniform`` is added at every step, as some simulators
    do.) Between two of these times x is interpolated linearly, which reduces its variance by a
    share of about :math:`\mu h / 3`.

    The process has no derivative: the slope of the linear interpolation grows as
    :math:`1/\sqrt{h}` and has no physical meaning. The acceleration is therefore zero: the current
    exerts drag but no inertial force.

    Not modelled: variation in space; correlation between axes; limits to the speed.
    """

    def __init__(self, spec: GaussMarkovSpec, rng: np.random.Generator) -> None:
        decay = math.exp(-spec.mu * spec.step)
        gain = math.sqrt(-math.expm1(-2.0 * spec.mu * spec.step))
        states = RandomTable(  # of unit variance, at k * step
            lambda shape, rows: _next_states(decay, gain, rng.standard_normal(shape), rows),
            3,
        )
        row = np.zeros(1, GAUSS_MARKOV)
        row["mean"], row["deviation"], row["step"] = spec.mean, spec.deviation, spec.step
        row["states"] = address_of(states.record)
        self._flow = FlowFunction(
            function=flow_gauss_markov,
            parameters=row,
            prepare=lambda end: states.extend(math.floor(max(0.0, end) / spec.step + 1e-6) + 1),
            memory_owners=(states,),
        )

    @property
    def is_uniform(self) -> bool:
        """True if the velocity is the same at every point; it always is."""
        return True


@njit
def _next_states(decay: float, gain: float, noise: Array, last_states: Array) -> Array:
    """Return the next states of unit variance, (n, 3).

    Args:
        decay: the factor of the previous state [1].
        gain: the factor of the noise [1].
        noise: numbers of the standard normal distribution, (n, 3).
        last_states: the states before, (k, 3); empty at the start.
    """
    states = noise.copy()
    for i in range(len(noise)):
        if i > 0 or len(last_states) > 0:
            state = states[i - 1] if i > 0 else last_states[-1]
            for k in range(3):
                states[i, k] = decay * state[k] + gain * noise[i, k]
    return states


def flow_gauss_markov(parameters_address: int, query_address: int, time: float) -> None:
    """Evaluate a query of a Gauss-Markov process; see `uwsim.currents.flow_function`.

    The acceleration is zero; see `GaussMarkov`.
    """
    current = carray(pointer(parameters_address), (1,), GAUSS_MARKOV)[0]
    table = carray(pointer(current.states), (1,), ROWS)[0]
    states = view_doubles(table.rows, 3 * table.n)
    position = max(0.0, time) / current.step
    k = math.floor(position + 1e-6)
    fraction = max(0.0, position - k)
    velocity = np.empty(3)
    for i in range(3):
        start, end = states[3 * k + i], states[3 * k + 3 + i]
        velocity[i] = current.mean[i] + current.deviation[i] * (start + (end - start) * fraction)
    write_everywhere(carray(pointer(query_address), (1,), QUERY)[0], velocity, np.zeros(3))
