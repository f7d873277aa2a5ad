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
from typing import Any

import numpy as np

from ..base.geometry import Array
from ..base.numerics.calls import address_of
from ..base.numerics.draws import STREAM, normal, stream_of
from ..base.numerics.jit import njit
from ..base.numerics.memory import view_doubles
from ..base.record import Record
from ..schema import Spec, element

FLOOR = math.sqrt(2.0 * math.log(2.0) / math.pi)
"""The Allan deviation of flicker noise of the bias instability 1 [1]."""
PEAK = 0.6174
"""The greatest Allan deviation of a Gauss-Markov process of the standard deviation 1 [1]."""
FIRST_INTERVAL = 0.01
"""The averaging time of the first sample [s]."""


@dataclass(frozen=True, kw_only=True)
class DriftSpec(Spec):
    """A ``<u:gyro>`` or ``<u:accelerometer>``: its errors, the same for each axis."""

    noise_density: float = element(namespaced=True, default=0.0, minimum=0, maximum=1e3)
    """The density N of the white noise [rad/s/sqrt(Hz), or m/s2/sqrt(Hz)]."""
    bias_instability: float = element(namespaced=True, default=0.0, minimum=0, maximum=1e3)
    """The bias instability B of a data sheet: floor of the Allan deviation [rad/s, or m/s2]."""
    correlation_time: float = element(
        namespaced=True, default=300.0, exclusive_minimum=0, maximum=1e9
    )
    """The correlation time T of the bias [s]."""
    random_walk: float = element(namespaced=True, default=0.0, minimum=0, maximum=1e3)
    """The random walk K of the rate or the acceleration [rad/s/sqrt(s), or m/s2/sqrt(s)]."""
    turn_on_bias: float = element(namespaced=True, default=0.0, minimum=0, maximum=1e3)
    """The standard deviation of the constant bias of a run [rad/s, or m/s2]."""

    @property
    def bias_std(self) -> float:
        """The standard deviation s of the varying bias [rad/s, or m/s2]."""
        return self.bias_instability * FLOOR / PEAK


@dataclass(slots=True)
class DriftState(Record):
    """The slow errors of three axes."""

    rng: np.random.Generator
    """The generator of the errors."""
    constant: Array
    """The bias of this run, (3,)."""
    bias: Array
    """The varying bias, (3,)."""
    walk: Array
    """The random walk, (3,)."""
    time: Array
    """The time of the last errors, NaN before the first ones, (1,) [s]."""


DRIFT = np.dtype(
    [
        ("stream", STREAM),
        ("constant", np.int64),  # addresses of the arrays of a `DriftState`
        ("bias", np.int64),
        ("walk", np.int64),
        ("time", np.int64),
        ("density_squared", np.float64),
        ("bias_std", np.float64),
        ("correlation_time", np.float64),
        ("random_walk", np.float64),
        ("walk_squared", np.float64),
        ("constant_variance", np.float64),  # of the bias of a run and of the one that wanders
    ]
)
"""The errors of three axes, for compiled code."""


class Drift:
    """The errors of three axes, from sample to sample; `draw_errors` draws them."""

    def __init__(self, spec: DriftSpec, rng: np.random.Generator) -> None:
        constant = spec.turn_on_bias * rng.standard_normal(3)
        bias = spec.bias_std * rng.standard_normal(3)
        self.state = state = DriftState(rng, constant, bias, np.zeros(3), np.full(1, math.nan))
        """The slow errors."""
        self.parameters = np.zeros(1, DRIFT)
        """The input of `draw_errors`, (1,)."""
        row = self.parameters[0]
        row["stream"] = stream_of(rng)
        for name in ("constant", "bias", "walk", "time"):
            row[name] = address_of(getattr(state, name))
        row["density_squared"], row["bias_std"] = spec.noise_density**2, spec.bias_std
        row["correlation_time"], row["random_walk"] = spec.correlation_time, spec.random_walk
        row["walk_squared"] = spec.random_walk**2
        row["constant_variance"] = spec.turn_on_bias**2 + spec.bias_std**2


@njit
def draw_errors(drift: Any, time: float, errors: Array) -> float:
    """Write the errors at ``time`` [s] into (3,); return the variance of each.

    Args:
        drift: a record of `DRIFT`.
        time: when the sample is taken [s].
        errors: into which they are written.
    """
    last_time, constant, bias = (
        view_doubles(drift.time, 1),
        view_doubles(drift.constant, 3),
        view_doubles(drift.bias, 3),
    )
    walk = view_doubles(drift.walk, 3)
    interval = 0.0 if math.isnan(last_time[0]) else time - last_time[0]
    last_time[0] = time
    decay = math.exp(-interval / drift.correlation_time)
    bias_step = drift.bias_std * math.sqrt(1.0 - decay * decay)
    walk_step = drift.random_walk * math.sqrt(interval)
    white = drift.density_squared / (interval if interval != 0.0 else FIRST_INTERVAL)
    std = math.sqrt(white)
    for i in range(3):
        errors[i] = std * normal(drift.stream)
    for i in range(3):
        bias[i] = decay * bias[i] + bias_step * normal(drift.stream)
    for i in range(3):
        walk[i] = walk[i] + walk_step * normal(drift.stream)
        errors[i] = ((errors[i] + constant[i]) + bias[i]) + walk[i]
    variance: float = white + (drift.constant_variance + drift.walk_squared * time)
    return variance
