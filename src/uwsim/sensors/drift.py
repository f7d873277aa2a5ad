r"""Noise of inertial sensors: white noise, bias instability and random walk.

With the time :math:`\Delta t` since the last sample,

.. math::

    n_k &= \frac{N}{\sqrt{\Delta t}} w_1 + b_0 + b_k + r_k \\
    b_k &= e^{-\Delta t / T} b_{k-1} + s \sqrt{1 - e^{-2 \Delta t / T}} \, w_2 \\
    r_k &= r_{k-1} + K \sqrt{\Delta t} \, w_3

where the w are standard normal random numbers. N is the noise density, K the coefficient of the
random walk r, :math:`b_0` the constant bias of the run, and :math:`b_k` a Gauss-Markov process with
the correlation time T and the standard deviation s. The Allan variance of :math:`b_k`,

.. math:: \sigma^2(\tau) = \frac{2 s^2 T}{\tau}
    \Bigl[1 - \frac{T}{2 \tau} (3 - 4 e^{-\tau/T} + e^{-2\tau/T})\Bigr],

is greatest at 1.89 T, where the Allan deviation is 0.6174 s. The bias instability B of a data sheet
is the floor of the Allan deviation divided by :math:`\sqrt{2 \ln 2 / \pi} = 0.664`; s is chosen so
that the greatest Allan deviation of :math:`b_k` is that floor. The Allan deviations of the white
noise and the random walk are :math:`N / \sqrt\tau` and :math:`K \sqrt{\tau / 3}`. After IEEE Std
952-1997, annex C.
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
"""The floor of the Allan deviation of flicker noise whose bias instability is 1 [1]."""
PEAK = 0.6174
"""The greatest Allan deviation of a Gauss-Markov process with the standard deviation 1 [1]."""
FIRST_INTERVAL = 0.01
"""The averaging time of the first sample, which has no sample before it [s]."""


@dataclass(frozen=True, kw_only=True)
class DriftSpec(Spec):
    """A ``<u:gyro>`` or ``<u:accelerometer>``: the errors of each of its three axes."""

    noise_density: float = element(namespaced=True, default=0.0, minimum=0, maximum=1e3)
    """The density N of the white noise [rad/s/sqrt(Hz), or m/s2/sqrt(Hz)]."""
    bias_instability: float = element(namespaced=True, default=0.0, minimum=0, maximum=1e3)
    """The bias instability B of a data sheet: the floor of the Allan deviation divided by 0.664
    [rad/s, or m/s2]."""
    correlation_time: float = element(
        namespaced=True, default=300.0, exclusive_minimum=0, maximum=1e9
    )
    """The correlation time T of the bias [s]."""
    random_walk: float = element(namespaced=True, default=0.0, minimum=0, maximum=1e3)
    """The coefficient K of the random walk [rad/s/sqrt(s), or m/s2/sqrt(s)]."""
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
    """The constant bias of the run, (3,) [rad/s, or m/s2]."""
    bias: Array
    """The varying bias, (3,) [rad/s, or m/s2]."""
    walk: Array
    """The random walk, (3,) [rad/s, or m/s2]."""
    time: Array
    """The time of the last sample, NaN before the first, (1,) [s]."""


DRIFT = np.dtype(
    [
        ("stream", STREAM),
        ("constant", np.int64),  # addresses of the arrays of a `DriftState`
        ("bias", np.int64),
        ("walk", np.int64),
        ("time", np.int64),
        ("density_squared", np.float64),  # N squared
        ("bias_std", np.float64),  # s
        ("correlation_time", np.float64),  # T [s]
        ("random_walk", np.float64),  # K
        ("walk_squared", np.float64),  # K squared
        ("constant_variance", np.float64),  # of b_0 + b_k
    ]
)
"""The parameters of the errors of three axes, for compiled code."""


class Drift:
    """The errors of three axes, which `draw_errors` draws for each sample."""

    def __init__(self, spec: DriftSpec, rng: np.random.Generator) -> None:
        constant = spec.turn_on_bias * rng.standard_normal(3)
        bias = spec.bias_std * rng.standard_normal(3)
        self.state = state = DriftState(rng, constant, bias, np.zeros(3), np.full(1, math.nan))
        """The slow errors."""
        self.parameters = np.zeros(1, DRIFT)
        """The parameters for `draw_errors`, a record of `DRIFT`, (1,)."""
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
    """Draw the errors of a sample; return the variance of each.

    Args:
        drift: a record of `DRIFT`.
        time: the time of the sample [s].
        errors: the array into which the errors are written, (3,) [rad/s, or m/s2].
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
    white_variance = drift.density_squared / (interval if interval != 0.0 else FIRST_INTERVAL)
    std = math.sqrt(white_variance)
    for i in range(3):
        errors[i] = std * normal(drift.stream)
    for i in range(3):
        bias[i] = decay * bias[i] + bias_step * normal(drift.stream)
    for i in range(3):
        walk[i] = walk[i] + walk_step * normal(drift.stream)
        errors[i] = ((errors[i] + constant[i]) + bias[i]) + walk[i]
    variance: float = white_variance + (drift.constant_variance + drift.walk_squared * time)
    return variance
