r"""Bounded least squares over coefficients and the initial states of all windows.

The sum of squares is

.. math:: \sum_w \lVert r_w(\theta, x_w) \rVert^2
          + \sum_w \lVert x_w / s \rVert^2 + \lVert (\theta - \theta_0) / \sigma_0 \rVert^2

with the weighted residuals r of the windows w, their initial states x, the coefficients
:math:`\theta`, the first guess :math:`\theta_0` with its plausible errors :math:`\sigma_0`, and
wide scales s of the initial states, which matter only for channels without measurements. In each
iteration the initial states are eliminated by a QR decomposition of each window's derivatives
(Golub and Pereyra, SIAM J. Numer. Anal. 10, 1973: variable projection), and a linear problem with
bounds is solved for the coefficients, within a box that shrinks when a step fails. With the loss
``huber``, residuals above `HUBER_LIMIT` count linearly.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..base.geometry import Array
from .residuals import N_CHANNELS, Fit, Residuals
from .triangles import compute_triangles

Loss = Literal["linear", "huber"]
"""The names of the losses."""
HUBER_LIMIT = 3.0
"""The residual above which the loss ``huber`` is linear, in standard deviations of the noise."""
OFFSET_SCALES = np.repeat([1.0, 0.3, 0.5, 0.5], 3)
"""The scales s of the initial states' offsets [m, rad, m/s, rad/s]."""
MAX_ITERATIONS = 40
"""The greatest number of iterations."""
OFFSET_ITERATIONS = 3
"""The number of iterations for which the derivatives with respect to the offsets are kept."""
TOLERANCE = 1e-5
"""The relative decrease of the sum of squares at which a fit ends."""
MAX_BOX, FINAL_BOX = 20.0, 0.1
"""The greatest size of the box, and its smallest size after new derivatives of the offsets."""
MIN_BOX = 1e-4
"""The size of the box, in plausible errors, below which a fit ends."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Solution:
    """The minimum of a sum of squares."""

    fit: Fit
    """The coefficients and initial states."""
    cost: float
    """The sum of squares."""
    n_iterations: int
    """The number of iterations."""
    is_converged: bool
    """True if the fit ended by itself, not by the greatest number of iterations."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ReducedProblem:
    """The linear problem of an iteration, in plausible errors of the coefficients."""

    triangles: Array
    """The triangle of each window without initial states, (windows, q, p)."""
    targets: Array
    """The residuals that belong to them, (windows, q)."""
    offset_rows: Array
    """The rows that give the offsets, (windows, 12, 12 + p + 1)."""


def minimise(
    residuals: Residuals,
    start: Fit,
    weights: Array,
    *,
    loss: Loss = "linear",
    max_iterations: int = MAX_ITERATIONS,
    on_iteration: Callable[[], None] = lambda: None,
) -> Solution:
    """Return the minimum that a start leads to.

    Args:
        residuals: the residuals.
        start: the first coefficients and initial states.
        weights: the inverse of the noise of each channel, (12,).
        loss: the loss.
        max_iterations: the greatest number of iterations.
        on_iteration: a function that is called after each iteration.
    """
    errors = plausible_errors(residuals)
    fit, box = start, 2.0
    rows = residuals.compute(fit, weights)
    cost = compute_cost(residuals, fit, rows, loss)
    offset_slopes, age, n_done = np.empty(0), OFFSET_ITERATIONS, 0
    is_converged = False
    for _ in range(max_iterations):
        if age >= OFFSET_ITERATIONS:
            offset_slopes, age = residuals.differentiate_offsets(fit, weights), 0
        slopes = residuals.differentiate(fit, weights) * errors
        problem = reduce(rows, slopes, offset_slopes, fit.offsets, loss)
        n_done, last_cost = n_done + 1, cost
        while box >= MIN_BOX:
            step = _solve(problem, residuals, fit, errors, box)
            new_fit = Fit(
                values=_clip(residuals, fit.values + errors * step),
                offsets=fit.offsets + _offset_steps(problem, step),
            )
            new_rows = residuals.compute(new_fit, weights)
            new_cost = compute_cost(residuals, new_fit, new_rows, loss)
            if new_cost < cost:
                fit, rows, cost, box = new_fit, new_rows, new_cost, min(2.0 * box, MAX_BOX)
                break
            box = 0.25 * min(box, max(float(np.abs(step).max(initial=0.0)), MIN_BOX))
        on_iteration()
        age += 1
        if box < MIN_BOX or last_cost - cost <= TOLERANCE * cost:
            if age == 1:
                is_converged = True
                break
            box, age = max(box, FINAL_BOX), OFFSET_ITERATIONS
    return Solution(fit=fit, cost=cost, n_iterations=n_done, is_converged=is_converged)


def linearise(
    residuals: Residuals, fit: Fit, weights: Array, loss: Loss = "linear"
) -> ReducedProblem:
    """Return the linear problem at a fit, for its covariance."""
    rows = residuals.compute(fit, weights)
    slopes = residuals.differentiate(fit, weights) * plausible_errors(residuals)
    offset_slopes = residuals.differentiate_offsets(fit, weights)
    return reduce(rows, slopes, offset_slopes, fit.offsets, loss)


def plausible_errors(residuals: Residuals) -> Array:
    """Return the plausible error of each coefficient, (p,)."""
    return np.array([parameter.plausible_error for parameter in residuals.parameters])


def reduce(
    rows: Array, slopes: Array, offset_slopes: Array, offsets: Array, loss: Loss
) -> ReducedProblem:
    """Eliminate the initial states of all windows.

    Args:
        rows: the residuals, (windows, m).
        slopes: their derivatives with respect to the coefficients, (windows, m, p).
        offset_slopes: their derivatives with respect to the offsets, (windows, m, 12).
        offsets: the offsets, (windows, 12).
        loss: the loss.
    """
    n, _, p = slopes.shape
    scale = np.sqrt(_loss_weights(rows, loss))[:, :, None]
    prior_rows = np.zeros((n, N_CHANNELS, N_CHANNELS + p + 1))
    prior_rows[:, :, :N_CHANNELS] = np.diag(1.0 / OFFSET_SCALES)
    prior_rows[:, :, -1] = offsets / OFFSET_SCALES
    matrix = np.concatenate([offset_slopes, slopes, rows[:, :, None]], axis=2) * scale
    triangle = compute_triangles(np.concatenate([matrix, prior_rows], axis=1))
    lower = triangle[:, N_CHANNELS:, N_CHANNELS:]
    return ReducedProblem(
        triangles=lower[:, :, :p], targets=lower[:, :, p], offset_rows=triangle[:, :N_CHANNELS]
    )


def compute_cost(residuals: Residuals, fit: Fit, rows: Array, loss: Loss) -> float:
    """Return the sum of squares, or of the robust loss."""
    size = np.abs(rows)
    squares = rows * rows
    if loss == "huber":
        squares = np.where(size <= HUBER_LIMIT, squares, 2.0 * HUBER_LIMIT * size - HUBER_LIMIT**2)
    distances = fit.offsets / OFFSET_SCALES
    change = _distance(residuals, fit.values)
    return float(squares.sum() + (distances * distances).sum() + (change * change).sum())


def _distance(residuals: Residuals, values: Array) -> Array:
    """Return the distance from the first guess, in plausible errors, (p,)."""
    guesses = np.array([parameter.first_guess for parameter in residuals.parameters])
    distance: Array = (values - guesses) / plausible_errors(residuals)
    return distance


def _loss_weights(rows: Array, loss: Loss) -> Array:
    if loss == "linear":
        return np.ones_like(rows)
    return np.minimum(1.0, HUBER_LIMIT / np.maximum(np.abs(rows), 1e-12))


def _solve(
    problem: ReducedProblem, residuals: Residuals, fit: Fit, errors: Array, box: float
) -> Array:
    """Return the step of the coefficients within their bounds and a box, in plausible errors."""
    from scipy.optimize import lsq_linear

    p = len(errors)
    matrix = np.concatenate([problem.triangles.reshape(-1, p), np.eye(p)])
    target = np.concatenate([problem.targets.ravel(), _distance(residuals, fit.values)])
    triangle = compute_triangles(np.column_stack([matrix, target])[None])[0]
    minimum = np.array([parameter.minimum for parameter in residuals.parameters])
    maximum = np.array([parameter.maximum for parameter in residuals.parameters])
    low = np.maximum((minimum - fit.values) / errors, -box)
    high = np.minimum((maximum - fit.values) / errors, box)
    result = lsq_linear(
        triangle[:, :p],
        -triangle[:, p],
        bounds=(np.minimum(low, 0.0) - 1e-12, np.maximum(high, 0.0) + 1e-12),
        method="bvls",
    )
    return np.asarray(result.x)


def _offset_steps(problem: ReducedProblem, step: Array) -> Array:
    """Return the steps of the offsets that belong to a step of the coefficients, (windows, 12)."""
    rows = problem.offset_rows
    p = len(step)
    right = rows[:, :, -1] + (rows[:, :, N_CHANNELS : N_CHANNELS + p] * step).sum(axis=2)
    return -np.linalg.solve(rows[:, :, :N_CHANNELS], right[:, :, None])[:, :, 0]


def _clip(residuals: Residuals, values: Array) -> Array:
    minimum = [parameter.minimum for parameter in residuals.parameters]
    maximum = [parameter.maximum for parameter in residuals.parameters]
    return np.clip(values, minimum, maximum)
