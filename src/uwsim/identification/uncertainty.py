r"""The intervals and correlations of coefficients, and combinations that the logs do not determine.

With the derivatives :math:`J_w` of the weighted residuals of a window, without initial states, the
covariance for white noise is :math:`H^{-1}`, :math:`H = \sum_w J_w^T J_w + \Sigma_0^{-1}`, with the
plausible errors of the first guess in :math:`\Sigma_0`. Residuals of a wrong model are correlated
in time. Windows are then the independent units, and the covariance is (White, Econometrica 48,
1980; Liang and Zeger, Biometrika 73, 1986)

.. math:: H^{-1} \Bigl(\sum_w g_w g_w^T + \Sigma_0^{-1}\Bigr) H^{-1},
          \qquad g_w = (1 - J_w^T J_w H^{-1})^{-1} J_w^T r_w

with the gradient g of each window. The factor before it undoes that a window fits itself, which
makes its residuals too small if there are few (Bell and McCaffrey, Survey Methodology 28, 2002; the
jackknife). An interval is the wider one of both, with quantiles of Student's t. Its degrees of
freedom are those of the noise's estimate for white noise, and for windows the effective number of
those that inform a coefficient, :math:`(\sum_w a_w)^2 / \sum_w a_w^2 - 1` with their information a.

A coefficient is *determined* if none of these holds:

- *idle*: its axis was never excited.
- *noise*: noise makes more than `MAX_NOISE_SHARE` of the information about it. The states at which
  derivatives are taken follow the noise of the measurements. A vehicle at rest then seems to move,
  and a coefficient seems to be known (Cook and Stefanski, J. Am. Stat. Assoc. 89, 1994). The share
  is the part of the information that further noise of the same size adds to it.
- *error*: the logs leave more than `MAX_ERROR` plausible errors of a first guess.
- *bound*: its interval reaches the bound of its range, such as 0 for a damping.

A direction of the coefficients, in plausible errors, is not determined if the logs leave an error
of more than `MAX_ERROR` along it (singular values of the scaled derivatives).
"""

from __future__ import annotations

import itertools
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..base.geometry import Array
from .least_squares import ReducedProblem
from .parameters import AXIS_GROUPS, Parameter
from .triangles import compute_triangles

CONFIDENCE = 0.95
"""The confidence of intervals."""
MAX_ERROR = 0.5
"""The greatest error of a coefficient that is determined, in plausible errors of a first guess."""
MAX_NOISE_SHARE = 0.3
"""The greatest share of noise in the information about a coefficient that is determined."""
MIN_FREEDOM = 2.0
"""The smallest number of degrees of freedom of an interval."""
MIN_SHARE = 0.2
"""The relative change of a coefficient along a direction, compared with the greatest one, from
which on it is listed."""


Doubt = Literal["", "idle", "noise", "error", "bound"]
"""The reasons why a coefficient is not determined; empty: it is."""


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """The estimate of a coefficient."""

    parameter: Parameter
    """The coefficient."""
    value: float
    """The value."""
    standard_error: float
    """The standard error."""
    low: float
    """The lower end of its interval."""
    high: float
    """The upper end of its interval."""
    doubt: Doubt
    """The reason why the logs do not determine it; empty: they do."""
    is_at_bound: bool
    """The flag of a value at its smallest or greatest value."""

    @property
    def is_determined(self) -> bool:
        """The flag of a coefficient that the logs determine."""
        return not self.doubt


@dataclass(frozen=True, kw_only=True)
class WeakDirection:
    """A combination of coefficients that the logs do not determine."""

    names: tuple[str, ...]
    """The coefficients that change along it."""
    changes: tuple[float, ...]
    """The relative changes, compared with the greatest one."""
    error: float
    """The error that the logs leave along it, in plausible errors; infinite: they say nothing."""

    def describe(self) -> str:
        """Return a sentence about the combination."""
        left = "nothing" if self.error > 100.0 else f"{self.error:.1f} plausible errors"
        if len(self.names) == 1:
            return (
                f"{self.names[0]} is not determined: the logs leave {left} of doubt."
                if (left != "nothing")
                else f"{self.names[0]} is not determined: the logs say nothing about it."
            )
        names = f"{', '.join(self.names[:-1])} and {self.names[-1]}"
        is_ratio = min(self.changes) > 0.0
        relation = "only their ratios are" if is_ratio else "only a combination of them is"
        return (
            f"{names} are not determined together: {relation}. Fix one by a measurement of its own."
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class Uncertainty:
    """The uncertainty of a fit."""

    estimates: tuple[Estimate, ...]
    """The estimate of each coefficient."""
    correlations: Array
    """The correlations of the coefficients, (p, p)."""
    weak_directions: tuple[WeakDirection, ...]
    """The combinations that the logs do not determine."""
    correction: float
    """The median ratio of the standard errors by windows to those for white noise."""


def compute_uncertainty(
    problem: ReducedProblem,
    parameters: Sequence[Parameter],
    values: Array,
    *,
    noise_information: Array | None = None,
    n_measurements: int = 0,
    idle_axes: Collection[str] = (),
) -> Uncertainty:
    """Compute intervals, correlations and weak directions.

    Args:
        problem: the linear problem at the minimum, in plausible errors.
        parameters: the coefficients.
        values: their values, (p,).
        noise_information: the part of the information about each that noise adds, (p,).
        n_measurements: the number of measurements by which the noise was estimated, without those
            that the fit used up; 0: the noise is known.
        idle_axes: the axes that were never excited.
    """
    from scipy.special import stdtrit

    p, n = len(parameters), len(problem.triangles)
    scales = np.array([parameter.plausible_error for parameter in parameters])
    guesses = np.array([parameter.first_guess for parameter in parameters])
    rows = problem.triangles.reshape(-1, p)
    hessian = np.einsum("ij,ik->jk", rows, rows) + np.eye(p)
    covariance = np.linalg.inv(hessian)
    gradients = (problem.triangles * problem.targets[:, :, None]).sum(axis=1)  # (n, p)
    gradients = gradients + (values - guesses) / scales / n  # the sum at a minimum is 0
    information = np.einsum("wij,wik->wjk", problem.triangles, problem.triangles)  # (n, p, p)
    left_out = np.eye(p) - (information[:, :, None, :] * covariance).sum(axis=3)
    gradients = np.linalg.solve(left_out, gradients[:, :, None])[:, :, 0]
    spread = np.einsum("ij,ik->jk", gradients, gradients)
    window_squares = np.diag(np.linalg.multi_dot([covariance, spread, covariance]))
    guess_squares = (covariance * covariance).sum(axis=1)  # of the first guess, which is given
    white_errors = np.sqrt(np.diag(covariance))
    window_errors = np.sqrt(window_squares + guess_squares) if n > 1 else white_errors
    level, shares = 0.5 + 0.5 * CONFIDENCE, np.einsum("wii->wi", information)
    total = shares.sum(axis=0)
    n_effective = total * total / np.maximum((shares * shares).sum(axis=0), 1e-300)
    freedom = np.maximum(n_effective - 1.0, MIN_FREEDOM)
    white_quantile = float(stdtrit(max(n_measurements, 1) if n_measurements else np.inf, level))
    half_widths = white_quantile * white_errors
    if n > 1:
        quantiles, normal = stdtrit(freedom, level), stdtrit(np.inf, level)
        squares = quantiles * quantiles * window_squares + normal * normal * guess_squares
        half_widths = np.maximum(half_widths, np.sqrt(squares))
    errors = np.maximum(white_errors, window_errors)
    noise_parts = np.zeros(p) if noise_information is None else noise_information
    estimates = tuple(
        _make_estimate(parameter, value, error, half_width, reason)
        for parameter, value, error, half_width, reason in zip(
            parameters,
            values.tolist(),
            errors.tolist(),
            half_widths.tolist(),
            _find_doubts(parameters, noise_parts / np.maximum(total, 1e-300), idle_axes),
            strict=True,
        )
    )
    return Uncertainty(
        estimates=estimates,
        correlations=covariance / np.outer(white_errors, white_errors),
        weak_directions=_find_weak_directions(rows, parameters, values),
        correction=float(np.median(window_errors / white_errors)),
    )


def _find_doubts(
    parameters: Sequence[Parameter], noise_shares: Array, idle_axes: Collection[str]
) -> list[Doubt]:
    """Return the reasons that do not follow from intervals."""
    reasons: list[Doubt] = []
    for parameter, share in zip(parameters, noise_shares.tolist(), strict=True):
        if parameter.group in AXIS_GROUPS and parameter.key in idle_axes:
            reasons.append("idle")
        else:
            reasons.append("noise" if share > MAX_NOISE_SHARE else "")
    return reasons


def _make_estimate(
    parameter: Parameter, value: float, error: float, half_width: float, reason: Doubt
) -> Estimate:
    """Return an estimate; error and half width are in plausible errors."""
    scale = parameter.plausible_error
    reach = 1e-3 * (parameter.maximum - parameter.minimum)
    # plausible errors are relative: a coefficient far above its first guess has greater ones
    is_positive = parameter.first_guess > 0.0 and parameter.minimum >= 0.0
    growth = max(1.0, value / parameter.first_guess) if is_positive else 1.0
    is_low = value - parameter.minimum <= min(reach, 0.01 * scale)
    low, high = value - scale * half_width, value + scale * half_width
    if not reason and error > MAX_ERROR * growth:
        reason = "error"
    if not reason and (low <= parameter.minimum or high >= parameter.maximum):
        reason = "bound"
    return Estimate(
        parameter=parameter,
        value=value,
        standard_error=scale * error,
        low=max(low, parameter.minimum),
        high=min(high, parameter.maximum),
        doubt=reason,
        is_at_bound=is_low or parameter.maximum - value <= min(reach, 0.01 * scale),
    )


def _find_weak_directions(
    rows: Array, parameters: Sequence[Parameter], values: Array
) -> tuple[WeakDirection, ...]:
    """Return a basis of the combinations that are not determined, of few coefficients each."""
    triangle = compute_triangles(rows[None])[0]
    _, sizes, directions = np.linalg.svd(triangle)
    errors = np.array([parameter.plausible_error for parameter in parameters])
    scales = errors / np.maximum(np.abs(values), 0.1 * errors)  # to relative changes
    basis = simplify_basis(directions[sizes * MAX_ERROR < 1.0] * scales)
    weak_directions = []
    for changes in basis:
        direction = changes / scales
        answer = np.sqrt((np.einsum("ij,j->i", triangle, direction) ** 2).sum())
        error = float(np.sqrt((direction * direction).sum()) / max(answer, 1e-300))
        indices = [i for i in range(len(changes)) if abs(changes[i]) >= MIN_SHARE]
        weak_directions.append(
            WeakDirection(
                names=tuple(parameters[i].name for i in indices),
                changes=tuple(float(changes[i]) for i in indices),
                error=error,
            )
        )
    return tuple(weak_directions)


def simplify_basis(vectors: Array) -> Array:
    """Return vectors of the same span with many small elements, whose greatest element is 1.

    A vector is replaced by its difference to a multiple of another as long as elements vanish.

    Args:
        vectors: linearly independent vectors, (k, p).
    """
    basis = _reduce_rows(vectors.copy())
    is_simpler = True
    while is_simpler:
        is_simpler = False
        for i, j in itertools.permutations(range(len(basis)), 2):
            for column in np.flatnonzero(np.abs(basis[j]) >= MIN_SHARE).tolist():
                candidate = basis[i] - basis[i, column] / basis[j, column] * basis[j]
                candidate /= candidate[np.abs(candidate).argmax()]
                if _count_elements(candidate) < _count_elements(basis[i]):
                    basis[i], is_simpler = candidate, True
    return basis


def _count_elements(vector: Array) -> int:
    return int((np.abs(vector) >= MIN_SHARE).sum())


def _reduce_rows(basis: Array) -> Array:
    """Return the reduced row echelon form by elimination with full pivoting."""
    pivots: list[int] = []
    for k in range(len(basis)):
        part = np.abs(basis[k:])
        part[:, pivots] = 0.0
        row, column = divmod(int(part.argmax()), basis.shape[1])
        basis[[k, k + row]] = basis[[k + row, k]]
        basis[k] /= basis[k, column]
        pivots.append(column)
        for other in range(len(basis)):
            if other != k:
                basis[other] -= basis[other, column] * basis[k]
    for vector in basis:
        vector /= vector[np.abs(vector).argmax()]
    return basis
