r"""The information about coefficients that is made by the noise of the measurements alone.

The initial states of windows are fitted. They follow the noise, so that a vehicle at rest seems to
turn and to drift a little. Derivatives at such states are not 0, and a fit takes noise for
information about coefficients. With initial states x and errors :math:`\pm \delta` of the same
covariance, the information :math:`I = \sum_w J_w^T J_w` rises by

.. math:: \tfrac{1}{2} \bigl(I(x + \delta) + I(x - \delta)\bigr) - I(x)
          = \sum_w \delta J_w^T \, \delta J_w

which is also the part that the errors of x have put into I (the step of SIMEX: Cook and Stefanski,
J. Am. Stat. Assoc. 89, 1994). The pair of signs cancels the mixed terms.
"""

from __future__ import annotations

import numpy as np

from ..base.geometry import Array
from ..base.rng import stream
from .least_squares import Loss, ReducedProblem, linearise
from .residuals import N_CHANNELS, Fit, Residuals


def measure_noise_information(
    residuals: Residuals,
    fit: Fit,
    problem: ReducedProblem,
    weights: Array,
    loss: Loss,
    *,
    seed: int = 0,
) -> Array:
    """Return the information about each coefficient that noise makes, (p,), in plausible errors.

    Args:
        residuals: the residuals.
        fit: the minimum.
        problem: the linear problem at the minimum.
        weights: the inverse of the noise of each channel, (12,).
        loss: the loss.
        seed: the seed of the draws.
    """
    draws = stream(seed, "identification/noise information").standard_normal(fit.offsets.shape)
    triangles = problem.offset_rows[:, :, :N_CHANNELS]
    errors = np.linalg.solve(triangles, draws[:, :, None])[:, :, 0]
    information = np.zeros(len(residuals.parameters))
    for sign in (1.0, -1.0):
        moved_fit = Fit(values=fit.values, offsets=fit.offsets + sign * errors)
        moved_problem = linearise(residuals, moved_fit, weights, loss)
        information += 0.5 * (moved_problem.triangles * moved_problem.triangles).sum(axis=(0, 1))
    information -= (problem.triangles * problem.triangles).sum(axis=(0, 1))
    return np.maximum(information, 0.0)
