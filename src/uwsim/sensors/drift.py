r"""Noise of inertial sensors: white noise, bias instability and random walk.

With the time :math:`\Delta t` since the last sample,

.. math::

    n_k &= \frac{N}{\sqrt{\Delta t}} w_1 + b_0 + b_k + r_k \\
    b_k &= e^{-\Delta t / T} b_{k-1} + s \sqrt{1 - e^{-2 \Delta t / T}} \, w_2 \\
    r_k &= r_{k-1} + K \sqrt{\Delta t} \, w_3

where the w are normal with a deviation of 1: N is the noise density, K the random walk, and b a
Gauss-Markov process of the correlation time T. Its Allan variance,

.. math:: \sigma^2(\tau) = \frac{2 s^2 T}{\tau}
    \Bigl[1 - \frac{T}{2 \tau} (3 - 4 e^{-\tau/T} + e^{-2\tau/T})\Bigr],

is greatest at 1.89 T, with a deviation of 0.6174 s. The bias instability B of a data sheet
is the floor of the Allan deviation divided by :math:`\sqrt{2 \ln 2 / \pi} = 0.664`; s is chosen so
that the greatest deviation of b is that floor. Those of white noise and random walk are
:math:`N / \sqrt\tau` and :math:`K \sqrt{\tau / 3}`. After IEEE Std 952-1997, annex C.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array
from ..base.record import Record
from ..schema import Spec, element

FLOOR = math.sqrt(2.0 * math.log(2.0) / math.pi)
"""Allan deviation of flicker noise of the bias instability 1 [1]."""
PEAK = 0.6174
"""Greatest Allan deviation of a Gauss-Markov process of the standard deviation 1 [1]."""
FIRST = 0.01
"""What the first sample is a mean over [s]."""


@dataclass(frozen=True, kw_only=True)
class DriftSpec(Spec):
    """A ``<u:gyro>`` or ``<u:accelerometer>``: errors, the same for each axis."""

    noise_density: float = element(namespaced=True, default=0.0, minimum=0, maximum=1e3)
    """White noise, N [rad/s/sqrt(Hz), or m/s2/sqrt(Hz)]."""
    bias_instability: float = element(namespaced=True, default=0.0, minimum=0, maximum=1e3)
    """B of a data sheet, from the floor of the Allan deviation [rad/s, or m/s2]."""
    correlation_time: float = element(namespaced=True, default=300.0, above=0, maximum=1e9)
    """Of the bias, T [s]."""
    random_walk: float = element(namespaced=True, default=0.0, minimum=0, maximum=1e3)
    """Of the rate or the acceleration, K [rad/s/sqrt(s), or m/s2/sqrt(s)]."""
    turn_on_bias: float = element(namespaced=True, default=0.0, minimum=0, maximum=1e3)
    """Constant bias of a run, standard deviation [rad/s, or m/s2]."""

    @property
    def bias_std(self) -> float:
        """Standard deviation of the bias that wanders, s [rad/s, or m/s2]."""
        return self.bias_instability * FLOOR / PEAK


@dataclass(slots=True)
class DriftState(Record):
    """The slow errors of three axes."""

    random: np.random.Generator
    """The generator of the errors."""
    constant: list[float]
    """The bias of this run, (3,)."""
    bias: list[float]
    """The bias that wanders, (3,)."""
    walk: list[float]
    """The random walk, (3,)."""
    time: float | None
    """When they were last drawn [s]."""


class Drift:
    """The errors of three axes, from sample to sample."""

    def __init__(self, spec: DriftSpec, random: np.random.Generator) -> None:
        self._spec = spec
        constant: list[float] = (spec.turn_on_bias * random.standard_normal(3)).tolist()
        bias: list[float] = (spec.bias_std * random.standard_normal(3)).tolist()
        self.state = DriftState(random, constant, bias, [0.0, 0.0, 0.0], None)
        """Its slow errors."""

    def sample(self, time: float) -> tuple[Array, float]:
        """Return the errors at ``time`` [s], (3,), and the variance of each."""
        spec, state = self._spec, self.state
        lasted = 0.0 if state.time is None else time - state.time
        state.time = time
        draws = state.random.standard_normal((3, 3)).tolist()
        bias_std, kept = spec.bias_std, math.exp(-lasted / spec.correlation_time)
        wander, walk = bias_std * math.sqrt(1.0 - kept * kept), spec.random_walk * math.sqrt(lasted)
        variance = spec.noise_density**2 / (lasted or FIRST)
        slow = spec.turn_on_bias**2 + bias_std**2 + spec.random_walk**2 * time
        std = math.sqrt(variance)
        # Plain floats: three numbers at every sample are dearer as arrays.
        state.bias = [kept * b + wander * n for b, n in zip(state.bias, draws[1], strict=True)]
        state.walk = [w + walk * n for w, n in zip(state.walk, draws[2], strict=True)]
        axes = zip(draws[0], state.constant, state.bias, state.walk, strict=True)
        error = np.array([std * white + c + bias + walked for white, c, bias, walked in axes])
        return error, variance + slow
