r"""Short formulas in place of a phase function, for shaders.

The transform and the encircled energy of single scattering (`phase_function`) are sums of at most
three terms of Henyey and Greenstein's small-angle form, with weights :math:`w_i` and angles
:math:`\theta_i`:

.. math::
    Q(\psi) = \sum_i w_i \frac{1 - e^{-x_i}}{x_i}, \; x_i = 2 \pi \psi \theta_i, \qquad
    EE(\theta) = \sum_i w_i \left( 1 + u_i - \sqrt{1 + u_i^2} \right), \; u_i = \theta / \theta_i

The two have fits of their own: the transform is that of a plane (tangents of angles), the encircled
energy that of a sphere. A weight may be negative. From 75 to 180 degrees, which a camera sees of
the veil of a lamp beside it, :math:`\ln p` is a cubic of :math:`\cos\theta`.

Fitted numbers are rounded to five digits.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..base.numerics.elementwise import exp, log
from ..base.numerics.linear import multiply_matrices, product, solve
from .phase_function import FloatArray, PhaseFunction

MAX_TERMS = 3
FREQUENCIES = (0.15, 200.0)
"""The limits of the fitted frequencies [cycles/rad]: those of the five blur levels."""
ANGLES = (1e-3, math.radians(30.0))
"""The limits of the fitted angles [rad]."""
SUFFICIENT_ERROR = 1e-3
"""The largest error at which a fit with fewer terms is used."""
N_POINTS = 40
MIN_RATIO = 1.5
"""The smallest ratio of the angles of two terms; equal angles would have opposite weights."""
MAX_RATIO = 300.0
TERM_ANGLES = (1e-5, 1.0)
"""The limits of the smallest angle of a term [rad]."""
BACKWARD_ANGLE = math.radians(75.0)
"""The smallest angle of the cubic [rad]."""
N_NODES = 64
N_ITERATIONS = 60
DIFFERENCE = 1e-5
"""The difference of parameters by which derivatives are computed."""

Basis = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True)
class SmallAngleTerms:
    """A sum of small-angle terms that stands for a phase function."""

    weights: tuple[float, ...]
    """The weight of each term; the sum is about 1 - bb/b."""
    angles: tuple[float, ...]
    """The angle of each term [rad], increasing."""

    def compute_transform(self, frequency: npt.ArrayLike) -> FloatArray:
        """Compute the transform Q at frequencies [cycles/rad]."""
        return self._sum(2.0 * math.pi * np.asarray(frequency, dtype=np.float64), _transform_term)

    def compute_encircled_energy(self, angle: npt.ArrayLike) -> FloatArray:
        """Compute the encircled energy EE within angles [rad]."""
        angles = np.asarray(angle, dtype=np.float64)
        total = np.zeros_like(angles)
        for weight, term_angle in zip(self.weights, self.angles, strict=True):
            total = total + weight * _encircled_term(angles / term_angle)
        return total

    def _sum(self, variable: FloatArray, basis: Basis) -> FloatArray:
        total = np.zeros_like(variable)
        for weight, angle in zip(self.weights, self.angles, strict=True):
            total = total + weight * basis(variable * angle)
        return total


def fit_transform_terms(phase: PhaseFunction) -> SmallAngleTerms:
    """Fit small-angle terms to the transform Q of a phase function, for the blur of images.

    The fit has the least squared error at 40 frequencies of the five blur levels, and the fewest
    terms whose largest error there is 0.001, else three. For Fournier and Forand's default, the
    largest error is 0.0022.
    """
    frequencies = _space(FREQUENCIES)
    targets = phase.compute_transform(frequencies)
    start_angles = _find_start_angles(phase)
    return _fit_terms(
        lambda angle: _transform_term(2.0 * math.pi * frequencies * angle), targets, start_angles
    )


def fit_encircled_terms(phase: PhaseFunction) -> SmallAngleTerms:
    """Fit small-angle terms to the encircled energy EE of a phase function, to 30 degrees."""
    angles = _space(ANGLES)
    targets = phase.compute_encircled_energy(angles)
    start_angles = _find_start_angles(phase)
    return _fit_terms(lambda angle: _encircled_term(angles / angle), targets, start_angles)


def fit_backward_cubic(phase: PhaseFunction) -> tuple[float, float, float, float]:
    """Fit ln p over the cosine of the angle by a cubic, from 75 to 180 degrees.

    The cubic is the Chebyshev series of ln p to the third order, close to the best one in the
    largest error: 0.5 % for Fournier and Forand's default, 0.3 % for Henyey and Greenstein's.

    Returns:
        The coefficients of the third, second, first and zeroth power of the cosine.
    """
    low, high = -1.0, math.cos(BACKWARD_ANGLE)
    nodes = math.pi * (np.arange(N_NODES) + 0.5) / N_NODES
    middle, half_width = (high + low) / 2.0, (high - low) / 2.0
    angles = [math.acos(middle + half_width * math.cos(node)) for node in nodes]
    values = log(phase.compute_density(np.array(angles)))
    series = [2.0 / N_NODES * float(np.sum(values * np.cos(order * nodes))) for order in range(4)]
    c0, c1, c2, c3 = series[0] / 2.0, series[1], series[2], series[3]
    # The polynomial of y = (cosine - middle) / half_width, then of the cosine.
    p0, p1, p2, p3 = c0 - c2, c1 - 3.0 * c3, 2.0 * c2, 4.0 * c3
    scale, shift = 1.0 / half_width, -middle / half_width
    return (
        _round_number(p3 * scale**3),
        _round_number((p2 + 3.0 * p3 * shift) * scale**2),
        _round_number((p1 + 2.0 * p2 * shift + 3.0 * p3 * shift**2) * scale),
        _round_number(p0 + p1 * shift + p2 * shift**2 + p3 * shift**3),
    )


def _fit_terms(
    evaluate_term: Callable[[float], FloatArray],
    targets: FloatArray,
    start_angles: list[FloatArray],
) -> SmallAngleTerms:
    """Return the fit with the fewest sufficient terms, or the best one of all numbers of terms."""
    best_terms, least_error = SmallAngleTerms((), ()), math.inf
    for starts in start_angles:
        terms, largest_error = _fit_angles(evaluate_term, targets, starts)
        if largest_error < least_error:
            best_terms, least_error = terms, largest_error
        if least_error <= SUFFICIENT_ERROR:
            break
    return best_terms


def _fit_angles(
    evaluate_term: Callable[[float], FloatArray], targets: FloatArray, start_angles: FloatArray
) -> tuple[SmallAngleTerms, float]:
    """Fit a number of terms; the weights follow from the angles by linear least squares.

    Returns:
        The terms, rounded, and their largest error.
    """

    def make_columns(parameters: FloatArray) -> FloatArray:
        angles = exp(np.cumsum(parameters))
        return np.stack([evaluate_term(float(angle)) for angle in angles], axis=1)

    def compute_weights(columns: FloatArray) -> FloatArray:
        rows = np.ascontiguousarray(columns.T)
        return solve(multiply_matrices(rows, columns), product(rows, targets))

    def compute_errors(parameters: FloatArray) -> FloatArray:
        columns = make_columns(parameters)
        return product(columns, compute_weights(columns)) - targets

    n_gaps = len(start_angles) - 1
    low = log(np.array([TERM_ANGLES[0]] + [MIN_RATIO] * n_gaps))
    high = log(np.array([TERM_ANGLES[1]] + [MAX_RATIO] * n_gaps))
    start = np.clip(np.diff(log(start_angles), prepend=0.0), low, high)
    parameters = _minimise_squares(compute_errors, start, low, high)
    weights = compute_weights(make_columns(parameters))
    terms = SmallAngleTerms(
        weights=tuple(_round_number(weight) for weight in weights.tolist()),
        angles=tuple(_round_number(angle) for angle in exp(np.cumsum(parameters)).tolist()),
    )
    return terms, float(np.max(np.abs(compute_errors(parameters))))


def _minimise_squares(
    compute_errors: Callable[[FloatArray], FloatArray],
    start: FloatArray,
    low: FloatArray,
    high: FloatArray,
) -> FloatArray:
    """Minimise a sum of squares over a few bounded parameters, by Levenberg and Marquardt.

    scipy's method calls LAPACK, whose last digits depend on the processor.

    Args:
        compute_errors: computes the errors of parameters (n,), (m,).
        start: the parameters at the start, (n,).
        low: the lower bounds, (n,).
        high: the upper bounds, (n,).
    """
    parameters, errors, damping = start, compute_errors(start), 1e-3
    for _ in range(N_ITERATIONS):
        steps = DIFFERENCE * np.eye(len(start))
        columns = [
            (compute_errors(parameters + step) - compute_errors(parameters - step))
            / (2.0 * DIFFERENCE)
            for step in steps
        ]
        rows = np.stack(columns)
        curvature = multiply_matrices(rows, np.ascontiguousarray(rows.T))
        damped_curvature = (
            curvature + damping * np.diag(np.diag(curvature)) + 1e-15 * np.eye(len(start))
        )
        trial = np.clip(parameters - solve(damped_curvature, product(rows, errors)), low, high)
        trial_errors = compute_errors(trial)
        if float(np.sum(trial_errors**2)) < float(np.sum(errors**2)):
            parameters, errors, damping = trial, trial_errors, damping / 5.0
        else:
            damping *= 5.0
    return parameters


def _find_start_angles(phase: PhaseFunction) -> list[FloatArray]:
    """Return angles that divide the light into equal shares, for one to three terms."""
    angles = _space((1e-4, 0.5))
    shares = phase.compute_cumulative(angles)
    return [
        np.interp((np.arange(n_terms) + 0.5) / n_terms, shares / shares[-1], angles)
        for n_terms in range(1, MAX_TERMS + 1)
    ]


def _transform_term(x: FloatArray) -> FloatArray:
    positive = np.maximum(x, 1e-9)
    term: FloatArray = (1.0 - exp(-positive)) / positive
    return term


def _encircled_term(u: FloatArray) -> FloatArray:
    term: FloatArray = 1.0 + u - np.sqrt(1.0 + u * u)
    return term


def _round_number(number: float) -> float:
    """Round a number to five digits."""
    return float(f"{number:.5g}")


def _space(limits: tuple[float, float]) -> FloatArray:
    low, high = limits
    return exp(np.linspace(math.log(low), math.log(high), N_POINTS))
