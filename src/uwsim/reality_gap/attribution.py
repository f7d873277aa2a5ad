r"""Attribution of the gap to coefficients of the vehicle.

In short windows the simulated twist differs from the measured one by the residual :math:`r`. Each
coefficient :math:`k` is scaled by :math:`1 + \epsilon_k` in a simulation of its own, and the same
windows are run again: the difference over :math:`\epsilon_k` is its column :math:`J_k`. If one
coefficient is wrong by the factor :math:`1 + \delta`, then :math:`r \approx -J_k \delta`. The
least-squares estimate and the share of the residual that it explains are

.. math:: \delta_k = -\frac{J_k \cdot r}{J_k \cdot J_k}, \qquad
    R_k^2 = \frac{(J_k \cdot r)^2}{(J_k \cdot J_k)(r \cdot r)}

Angular velocities are multiplied by the vehicle's radius of gyration, so that all rows are
velocities. The coefficients with nearly the largest :math:`R_k^2` are refined: the vehicle gets the
estimated factor, and the step is repeated (Gauss-Newton) up to `N_REFINEMENTS` times. The one that
removes the most of the residual is a cause. The remaining
residual is then attributed in the same way, up to `MAX_CAUSES` coefficients, as long as each
explains `MIN_SHARE` of the first residual. The interval of a factor and the confidence in a name
are those of resamples of the windows, by blocks.

The clock of the commands is a cause like a coefficient: the times of the commands are shifted, and
the shift [s] is the factor minus 1. A cause is *evident*, and in the verdict, if it explains
`MIN_EVIDENT_SHARE` of the residual, and the interval of its factor excludes 1 and values of 0 or
less. An effect of a coefficient on the windows is linear near its value, the refined one is not:
the share of the first cause is that after its refinement.

What is not modelled: an error outside of the list (a tether, a current that the scene lacks, a
wrong frame of the log) is attributed to the coefficients that resemble it most.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
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
MAX_CANDIDATES = 3
"""The greatest number of coefficients that are refined to choose one."""
NEAR_SHARE = 0.7
"""The linear share, over the largest, from which a coefficient is refined as well."""
MIN_CORRELATION = 0.95
"""The correlation of two effects from which the windows cannot tell them apart."""
MIN_RESIDUAL = 1e-4
"""The root mean square of the residual below which nothing is attributed [m/s]."""
MIN_SPEED = 0.005
"""The root mean square of the velocity along an axis for a ratio [m/s]."""
N_RESAMPLES = 500
"""The number of resamples of the windows."""
MIN_EVIDENT_SHARE = 0.5
"""The least share of the residual of a coefficient that the verdict names."""

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
    """The share of resamples in which the coefficient, or one alike, explains the most [0..1]."""
    equivalents: tuple[str, ...]
    """The names of coefficients whose effects the windows cannot tell apart from it."""

    @property
    def shift(self) -> float:
        """The shift of the times of the commands, of their clock [s]."""
        return self.factor - 1.0

    @property
    def is_evident(self) -> bool:
        """True if the verdict may name the coefficient.

        It explains `MIN_EVIDENT_SHARE` of the residual. The interval of its factor excludes 1 and
        impossible values: a negative lag, mass, drag or thrust. Without an interval, nothing is
        evident.
        """
        if self.low is None or self.high is None or self.share < MIN_EVIDENT_SHARE:
            return False
        is_possible = self.coefficient.is_clock or self.low > 0.0
        return is_possible and not self.low <= 1.0 <= self.high


@dataclass(frozen=True)
class Share:
    """The share of the residual that a coefficient alone explains."""

    coefficient: Coefficient
    """The coefficient."""
    share: float
    """The share of the residual's square [0..1]; after its refinement if it is the first cause."""
    factor: float
    """The factor of the coefficient."""


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
    shares: tuple[Share, ...]
    """The share of the residual that each coefficient alone explains, the largest first."""

    @property
    def unexplained_share(self) -> float:
        """The share of the residual's square that no cause explains [0..1]."""
        return max(0.0, 1.0 - sum(cause.share for cause in self.causes))

    @property
    def evident_cause(self) -> Cause | None:
        """The coefficient that explains the most, if it is evident."""
        return self.causes[0] if self.causes and self.causes[0].is_evident else None


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
    search = _Search(coefficients, effects, simulate, measurements, residual)
    causes: list[Cause] = []
    is_small = first_square <= len(measurements) * MIN_RESIDUAL**2
    while len(causes) < MAX_CAUSES and not is_small:
        cause = search.find_cause(block, seed)
        if cause is None:
            break
        causes.append(cause)
    n_windows = len(measurements)
    return Attribution(
        duration=duration,
        n_windows=n_windows,
        residual=float(np.sqrt(first_square / n_windows)),
        remainder=float(np.sqrt(_square(search.residual) / n_windows)),
        causes=tuple(causes),
        speed_ratios=tuple(
            _fit_ratio(base[:, axis], measurements[:, axis]) for axis in range(base.shape[1])
        ),
        shares=_refine_share(_list_shares(residual, coefficients, effects), causes),
    )


class _Search:
    """The search for causes, one after the other, each with the factors of those before.

    Args:
        coefficients: the coefficients.
        effects: their effects, each (n, 6) [m/s].
        simulate: runs the windows with coefficients scaled.
        measurements: the measured twists, (n, 6) [m/s].
        residual: the residual without a change, (n, 6) [m/s].
    """

    def __init__(
        self,
        coefficients: Sequence[Coefficient],
        effects: Sequence[Array],
        simulate: RunWindows,
        measurements: Array,
        residual: Array,
    ) -> None:
        self._coefficients, self._effects, self._simulate = coefficients, effects, simulate
        self._measurements, self._first_square = measurements, _square(residual)
        self._changes: list[tuple[Coefficient, float]] = []
        self.residual = residual
        """The residual with the factors so far, (n, 6) [m/s]."""

    def find_cause(self, block: int, seed: int) -> Cause | None:
        """Find the coefficient that removes the most; None if it is less than `MIN_SHARE`."""
        coefficients, effects, residual = self._coefficients, self._effects, self.residual
        keys_in_use = {coefficient.key for coefficient, _ in self._changes}
        open_indices = [i for i, c in enumerate(coefficients) if c.key not in keys_in_use]
        if not open_indices:
            return None
        candidates = _choose_candidates(residual, effects, open_indices)
        limit = MIN_SHARE * self._first_square
        if _share(residual, effects[candidates[0]]) * _square(residual) < limit:
            return None
        refinements = {i: self._refine(coefficients[i], effects[i]) for i in candidates}
        removals = {i: _square(residual) - _square(refinements[i][1]) for i in candidates}
        index = max(candidates, key=removals.__getitem__)
        if removals[index] < limit:
            return None
        factor, self.residual = refinements[index]
        cause = _make_cause(
            coefficients,
            effects,
            index,
            factor,
            share=removals[index] / self._first_square,
            slope=-_dot(effects[index], residual) / _square(effects[index]),
            resamples=_resample(residual, effects, open_indices, block, seed, len(self._changes)),
            refuted_indices=[i for i in candidates if removals[i] < NEAR_SHARE * removals[index]],
        )
        self._changes.append((coefficients[index], factor))
        return cause

    def _refine(self, coefficient: Coefficient, effect: Array) -> tuple[float, Array]:
        """Return the factor of a coefficient and the residual with it, by Gauss-Newton steps."""
        factor, best_residual = 1.0, self.residual
        low, high = coefficient.limits
        for _ in range(N_REFINEMENTS):
            step = -_dot(effect, best_residual) / _square(effect)
            new_factor = min(max(factor + step, low), high)
            if abs(new_factor - factor) < 1e-4:
                break
            twists = self._simulate([*self._changes, (coefficient, new_factor)])
            new_residual = twists - self._measurements
            if _square(new_residual) >= _square(best_residual):
                break
            # the slope between the two factors is the effect at the new one (a secant step)
            effect = (new_residual - best_residual) / (new_factor - factor)
            factor, best_residual = new_factor, new_residual
        return factor, best_residual


def _choose_candidates(
    residual: Array, effects: Sequence[Array], indices: Sequence[int]
) -> list[int]:
    """Return the coefficients whose linear share is nearly the largest, the largest first."""
    shares = {i: _share(residual, effects[i]) for i in indices}
    order = sorted(indices, key=lambda i: -shares[i])
    limit = NEAR_SHARE * shares[order[0]]
    return [i for i in order[:MAX_CANDIDATES] if shares[i] >= limit]


def _make_cause(
    coefficients: Sequence[Coefficient],
    effects: Sequence[Array],
    index: int,
    factor: float,
    *,
    share: float,
    slope: float,
    resamples: tuple[Array, Array] | None,
    refuted_indices: Collection[int],
) -> Cause:
    similar_indices = [
        i
        for i, effect in enumerate(effects)
        if _correlation(effect, effects[index]) > MIN_CORRELATION
    ]
    low = high = confidence = None
    if resamples is not None:
        slopes, winners = resamples
        sorted_slopes = np.sort(slopes[:, index])
        n = len(sorted_slopes)
        # the spread of the linear estimates about theirs, around the refined factor
        low = factor + float(sorted_slopes[int(0.025 * n)]) - slope
        high = factor + float(sorted_slopes[int(0.975 * n) - 1]) - slope
        confidence = float(np.isin(winners, [index, *similar_indices]).mean())
    equivalents = [i for i in similar_indices if i != index and i not in refuted_indices]
    return Cause(
        coefficient=coefficients[index],
        factor=factor,
        low=low,
        high=high,
        share=share,
        confidence=confidence,
        equivalents=tuple(coefficients[i].name for i in equivalents),
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
) -> list[Share]:
    shares = []
    for coefficient, effect in zip(coefficients, effects, strict=True):
        square = _square(effect)
        slope = -_dot(effect, residual) / square if square > 0.0 else 0.0
        shares.append(Share(coefficient, _share(residual, effect), 1.0 + slope))
    return shares


def _refine_share(shares: Sequence[Share], causes: Sequence[Cause]) -> tuple[Share, ...]:
    """Return the shares in their order, with the refined numbers of the first cause."""
    first_causes = {cause.coefficient.key: cause for cause in causes[:1]}
    refined_shares = []
    for row in shares:
        cause = first_causes.get(row.coefficient.key)
        refined_shares.append(
            row if cause is None else Share(row.coefficient, cause.share, cause.factor)
        )
    return tuple(sorted(refined_shares, key=lambda row: -row.share))


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
