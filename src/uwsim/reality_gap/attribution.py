r"""Attribution of the gap to coefficients of the vehicle.

In short windows the simulated twist differs from the measured one by the residual :math:`r`. Each
coefficient :math:`k` is scaled by :math:`1 + \epsilon_k` in a simulation of its own, and the same
windows are run again: the difference over :math:`\epsilon_k` is its column :math:`J_k`. If one
coefficient is wrong by the factor :math:`1 + \delta`, then :math:`r \approx -J_k \delta`. The
least-squares estimate and the share of the residual that it explains are

.. math:: \delta_k = -\frac{J_k \cdot r}{J_k \cdot J_k}, \qquad
    R_k^2 = \frac{(J_k \cdot r)^2}{(J_k \cdot J_k)(r \cdot r)}

Angular velocities are multiplied by the vehicle's radius of gyration, so that all rows are
velocities. The coefficient with the largest :math:`R_k^2` is refined: the vehicle gets the
estimated factor, and the step is repeated (Gauss-Newton) up to `N_REFINEMENTS` times. The remaining
residual is then attributed in the same way, up to `MAX_CAUSES` coefficients, as long as each
explains `MIN_SHARE` of the first residual. The interval of a factor and the confidence in a name
are those of resamples of the windows, by blocks.

What is not modelled: an error outside of the list (a tether, a current that the scene lacks, a
wrong frame of the log) is attributed to the coefficients that resemble it most.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array
from ..base.rng import stream
from .coefficients import Coefficient

N_REFINEMENTS = 3
"""The number of Gauss-Newton steps for a factor."""
MAX_CAUSES = 3
"""The greatest number of coefficients that are named."""
MIN_SHARE = 0.05
"""The least share of the first residual that a further coefficient explains."""
MIN_CORRELATION = 0.95
"""The correlation of two effects from which the windows cannot tell them apart."""
MIN_RESIDUAL = 1e-4
"""The root mean square of the residual below which nothing is attributed [m/s]."""
MIN_SPEED = 0.005
"""The root mean square of the velocity along an axis for a ratio [m/s]."""
N_RESAMPLES = 500
"""The number of resamples of the windows."""
FACTOR_LIMITS = (0.05, 20.0)
"""The limits of a factor."""

RunWindows = Callable[[Sequence[tuple[Coefficient, float]]], Array]
"""A function that returns the simulated twists of the windows, weighted, (n, 6) [m/s], of a vehicle
with some coefficients scaled by factors."""


@dataclass(frozen=True, kw_only=True)
class Cause:
    """A coefficient that explains a part of the residual."""

    coefficient: Coefficient
    """The coefficient."""
    factor: float
    """The factor on the simulated coefficient that fits the log best."""
    low: float | None
    """The lower limit of the 95 % interval of the factor; None: too few windows."""
    high: float | None
    """The upper limit."""
    share: float
    """The share of the first residual's square that the factor removes [0..1]."""
    confidence: float | None
    """The share of resamples in which the coefficient explains the most [0..1]."""
    equivalents: tuple[str, ...]
    """The names of coefficients whose effects the windows cannot tell apart from it."""


@dataclass(frozen=True, kw_only=True)
class Attribution:
    """The attribution of the gap to coefficients."""

    duration: float
    """The length of the short windows [s]."""
    n_windows: int
    """The number of windows."""
    residual: float
    """The root mean square of the weighted residual of a window [m/s]."""
    remainder: float
    """The same after all causes are corrected [m/s]."""
    causes: tuple[Cause, ...]
    """The causes, the first explains the most."""
    speed_ratios: tuple[float | None, ...]
    """The slope of simulated over measured velocities at the ends of the windows, by axis; None:
    the vehicle hardly moved along the axis."""
    shares: tuple[tuple[str, float, float], ...]
    """The name, the share of the residual and the factor of each coefficient alone, by share."""


def attribute_residual(
    measurements: Array,
    coefficients: Sequence[Coefficient],
    run_windows: RunWindows,
    *,
    duration: float,
    block: int,
    seed: int,
    on_run: Callable[[], None] = lambda: None,
) -> Attribution:
    """Find the coefficients that explain the residual.

    Args:
        measurements: the measured twists at the ends of the windows, weighted, (n, 6) [m/s].
        coefficients: the coefficients.
        run_windows: runs the windows with coefficients scaled.
        duration: the length of the windows [s].
        block: the number of successive windows that are resampled together.
        seed: the seed of the resamples.
        on_run: a function that is called after each run of the windows.
    """

    def simulate(changes: Sequence[tuple[Coefficient, float]]) -> Array:
        twists = run_windows(changes)
        on_run()
        return twists

    base = simulate(())
    effects = [
        (simulate([(coefficient, 1.0 + coefficient.step)]) - base) / coefficient.step
        for coefficient in coefficients
    ]
    residual = base - measurements
    first_square = _square(residual)
    causes: list[Cause] = []
    changes: list[tuple[Coefficient, float]] = []
    shares_alone = _list_shares(residual, coefficients, effects)
    is_small = first_square <= len(measurements) * MIN_RESIDUAL**2
    while len(causes) < MAX_CAUSES and not is_small:
        used_keys = {cause.coefficient.key for cause in causes}
        open_indices = [i for i, c in enumerate(coefficients) if c.key not in used_keys]
        if not open_indices:
            break
        index = max(open_indices, key=lambda i: _share(residual, effects[i]))
        if _share(residual, effects[index]) * _square(residual) < MIN_SHARE * first_square:
            break
        factor, new_residual = _refine(
            coefficients[index], effects[index], residual, measurements, changes, simulate
        )
        removed_share = (_square(residual) - _square(new_residual)) / first_square
        if removed_share < MIN_SHARE:
            break
        resamples = _resample(residual, effects, open_indices, block, seed, len(causes))
        slope = -_dot(effects[index], residual) / _square(effects[index])
        causes.append(
            _make_cause(coefficients, effects, index, factor, slope, removed_share, resamples)
        )
        changes.append((coefficients[index], factor))
        residual = new_residual
    n_windows = len(measurements)
    return Attribution(
        duration=duration,
        n_windows=n_windows,
        residual=float(np.sqrt(first_square / n_windows)),
        remainder=float(np.sqrt(_square(residual) / n_windows)),
        causes=tuple(causes),
        speed_ratios=tuple(
            _fit_ratio(base[:, axis], measurements[:, axis]) for axis in range(base.shape[1])
        ),
        shares=shares_alone,
    )


def _refine(
    coefficient: Coefficient,
    effect: Array,
    residual: Array,
    measurements: Array,
    changes: Sequence[tuple[Coefficient, float]],
    simulate: RunWindows,
) -> tuple[float, Array]:
    """Return the factor of a coefficient and the residual with it, by Gauss-Newton steps."""
    factor, best_residual = 1.0, residual
    for _ in range(N_REFINEMENTS):
        step = -_dot(effect, best_residual) / _square(effect)
        new_factor = min(max(factor + step, FACTOR_LIMITS[0]), FACTOR_LIMITS[1])
        if abs(new_factor - factor) < 1e-4:
            break
        twists = simulate([*changes, (coefficient, new_factor)])
        new_residual = twists - measurements
        if _square(new_residual) >= _square(best_residual):
            break
        # the slope between the two factors is the effect at the new one (a secant step)
        effect = (new_residual - best_residual) / (new_factor - factor)
        factor, best_residual = new_factor, new_residual
    return factor, best_residual


def _make_cause(
    coefficients: Sequence[Coefficient],
    effects: Sequence[Array],
    index: int,
    factor: float,
    slope: float,
    share: float,
    resamples: tuple[Array, Array] | None,
) -> Cause:
    low = high = confidence = None
    if resamples is not None:
        slopes, winners = resamples
        sorted_slopes = np.sort(slopes[:, index])
        n = len(sorted_slopes)
        # the spread of the linear estimates about theirs, around the refined factor
        low = factor + float(sorted_slopes[int(0.025 * n)]) - slope
        high = factor + float(sorted_slopes[int(0.975 * n) - 1]) - slope
        confidence = float((winners == index).mean())
    equivalents = tuple(
        coefficients[i].name
        for i, effect in enumerate(effects)
        if i != index and _correlation(effect, effects[index]) > MIN_CORRELATION
    )
    return Cause(
        coefficient=coefficients[index],
        factor=factor,
        low=low,
        high=high,
        share=share,
        confidence=confidence,
        equivalents=equivalents,
    )


def _resample(
    residual: Array,
    effects: Sequence[Array],
    indices: Sequence[int],
    block: int,
    seed: int,
    number: int,
) -> tuple[Array, Array] | None:
    """Return the linear estimates, (N_RESAMPLES, k), and the coefficient with the most share."""
    n = len(residual)
    if n < 4 * block:
        return None
    cross = np.array([(effect * residual).sum(axis=1) for effect in effects])  # (k, n)
    squares = np.array([(effect * effect).sum(axis=1) for effect in effects])
    starts = stream(seed, f"gap/attribution/{number}").integers(
        0, n - block + 1, (N_RESAMPLES, -(-n // block))
    )
    draws = (starts[:, :, None] + np.arange(block)).reshape(N_RESAMPLES, -1)[:, :n]
    cross_sums = np.array([row[draws].sum(axis=1) for row in cross]).T
    square_sums = np.array([row[draws].sum(axis=1) for row in squares]).T
    safe_squares = np.where(square_sums > 0.0, square_sums, 1.0)
    shares = np.where(square_sums > 0.0, cross_sums * cross_sums / safe_squares, 0.0)
    is_open = np.zeros(len(effects), dtype=bool)
    is_open[list(indices)] = True
    return -cross_sums / safe_squares, np.where(is_open, shares, -1.0).argmax(axis=1)


def _list_shares(
    residual: Array, coefficients: Sequence[Coefficient], effects: Sequence[Array]
) -> tuple[tuple[str, float, float], ...]:
    rows = []
    for coefficient, effect in zip(coefficients, effects, strict=True):
        square = _square(effect)
        slope = -_dot(effect, residual) / square if square > 0.0 else 0.0
        rows.append((coefficient.name, _share(residual, effect), 1.0 + slope))
    return tuple(sorted(rows, key=lambda row: -row[1]))


def _share(residual: Array, effect: Array) -> float:
    square = _square(effect) * _square(residual)
    if square <= 0.0:
        return 0.0
    return _dot(effect, residual) ** 2 / square


def _correlation(a: Array, b: Array) -> float:
    square = _square(a) * _square(b)
    return abs(_dot(a, b)) / float(np.sqrt(square)) if square > 0.0 else 0.0


def _fit_ratio(predictions: Array, measurements: Array) -> float | None:
    square = _square(measurements)
    if square < len(measurements) * MIN_SPEED**2:
        return None
    return _dot(predictions, measurements) / square


def _dot(a: Array, b: Array) -> float:
    return float((a * b).sum())


def _square(a: Array) -> float:
    return float((a * a).sum())
