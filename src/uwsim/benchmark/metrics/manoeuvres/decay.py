r"""Free decay: period and damping of an oscillation, from a record of its angle.

A vehicle is released with a list or trim, and its angle :math:`\varphi` is recorded. The model is

.. math::
    \ddot\varphi + p_1 \dot\varphi + p_2 |\dot\varphi| \dot\varphi
    + \omega^2 (\varphi - \varphi_0) = 0

Its integral from the release on is linear in the coefficients, which least squares over all samples
gives (Morrison and Yeung 1985 fit records in the same way):

.. math::
    \dot\varphi = -p_1 (\varphi - \varphi(0)) - p_2 \int |\dot\varphi| \dot\varphi \, dt
    - \omega^2 \int \varphi \, dt + \omega^2 \varphi_0 t

The natural period is :math:`2 \pi / \omega`. The damping ratio at an amplitude A is that of an
equal loss of energy in a cycle: :math:`\zeta = p_1 / (2 \omega) + 4 p_2 A / (3 \pi)`. Samples are
used until the swing has decayed to 5 % of the release angle. Not modelled: a stiffness that depends
on the angle, and motion in other directions, which adds to mass and damping.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ....base.geometry import Array
from ....base.numerics.linear import multiply_matrices, solve

MIN_SAMPLES = 20
"""The smallest number of samples for a fit."""
MIN_SHARE = 0.05
"""The share of the release angle below which the swing counts as ended [1]."""


@dataclass(frozen=True, kw_only=True)
class Decay:
    """The numbers of a free decay."""

    period: float
    """The natural period, without damping [s]."""
    linear: float
    """The coefficient :math:`p_1` of the linear damping [1/s]."""
    quadratic: float
    """The coefficient :math:`p_2` of the quadratic damping [1/rad]."""
    offset: float
    """The angle at rest :math:`\varphi_0` [rad]."""
    residual: float
    """The root mean square of the residuals of the angular velocity [rad/s]."""

    def damping_ratio(self, amplitude: float) -> float:
        """Return the damping ratio of a swing with an amplitude [rad]."""
        omega = 2.0 * math.pi / self.period
        return self.linear / (2.0 * omega) + 4.0 * self.quadratic * amplitude / (3.0 * math.pi)


def fit_decay(times: Array, angles: Array) -> Decay | None:
    """Fit period and damping to a record; None if the vehicle does not return.

    Args:
        times: the times from the release on, equally spaced, (n,) [s].
        angles: the angles, (n,) [rad].
    """
    end = float(np.mean(angles[-max(1, len(angles) // 10) :]))
    is_swinging = np.abs(angles - end) > MIN_SHARE * abs(angles[0] - end)
    n = int(np.flatnonzero(is_swinging)[-1]) + 1 if is_swinging.any() else 0
    if n < MIN_SAMPLES:
        return None
    t, phi = times[:n], angles[:n]
    rates = np.gradient(phi, t)
    rates[0] = 0.0
    columns = np.column_stack(
        [-(phi - phi[0]), -_integrate(np.abs(rates) * rates, t), -_integrate(phi, t), t]
    )
    scales = np.abs(columns).max(axis=0)
    if not scales.all():
        return None
    scaled_columns = columns / scales
    # the ends have one-sided differences, which are less accurate
    inner_rows, target = scaled_columns[1:-1], rates[1:-1]
    normal = multiply_matrices(np.ascontiguousarray(inner_rows.T), np.ascontiguousarray(inner_rows))
    p1, p2, stiffness, slope = solve(normal, (inner_rows * target[:, None]).sum(axis=0)) / scales
    if not stiffness > 0.0:
        return None
    residuals = target - (inner_rows * (np.array([p1, p2, stiffness, slope]) * scales)).sum(axis=1)
    return Decay(
        period=2.0 * math.pi / math.sqrt(stiffness),
        linear=float(p1),
        quadratic=float(p2),
        offset=float(slope / stiffness),
        residual=math.sqrt(float(np.mean(residuals**2))),
    )


def _integrate(values: Array, times: Array) -> Array:
    """Return the integral of values from the first sample on, by the trapezoidal rule, (n,)."""
    steps = 0.5 * (values[1:] + values[:-1]) * np.diff(times)
    return np.concatenate([[0.0], np.cumsum(steps)])


def fit_two_powers(x: Array, y: Array) -> tuple[float, float]:
    """Fit :math:`y = a x + b x^2` with a, b >= 0 by least squares, weighted by 1 / x^2.

    The weights make relative errors equal: small amplitudes and speeds count as large ones do.
    """
    ratio = y / x
    mean_x, mean_ratio = float(np.mean(x)), float(np.mean(ratio))
    spread = float(np.sum((x - mean_x) ** 2))
    b = float(np.sum((x - mean_x) * (ratio - mean_ratio))) / spread if spread > 0.0 else 0.0
    a = mean_ratio - b * mean_x
    if b < 0.0:
        return mean_ratio, 0.0
    if a < 0.0:
        return 0.0, float(np.sum(x * ratio) / np.sum(x**2))
    return a, b
