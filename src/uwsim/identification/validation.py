"""The errors of simulations of windows that the coefficients were not fitted to.

A window is simulated from its first measured state, with the first guess and with coefficients that
were fitted without it. The error at a horizon is the root mean square, over windows, of the
difference to the sample nearest to the horizon.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array
from .residuals import N_CHANNELS, Fit, Residuals
from .windows import Windows

HORIZONS = (1.0, 5.0)
"""The horizons, in addition to the length of windows [s]."""
QUANTITIES: Mapping[str, tuple[str, slice]] = {
    "position": ("m", slice(0, 3)),
    "attitude": ("rad", slice(3, 6)),
    "velocity": ("m/s", slice(6, 9)),
    "angular velocity": ("rad/s", slice(9, 12)),
}
"""The quantities, their units, and their channels."""


@dataclass(frozen=True, kw_only=True)
class HorizonError:
    """The error of a quantity at a horizon."""

    quantity: str
    """The quantity."""
    unit: str
    """The unit."""
    horizon: float
    """The horizon [s]."""
    n_windows: int
    """The number of windows."""
    first_error: float
    """The error with the first guess."""
    fitted_error: float
    """The error with coefficients that were fitted to other windows."""


def split_folds(n_windows: int, n_folds: int) -> list[list[int]]:
    """Return the windows of each fold: every n-th window, so that all folds see all manoeuvres."""
    n = min(n_folds, n_windows)
    return [list(range(fold, n_windows, n)) for fold in range(n)]


def simulate_errors(residuals: Residuals, values: Array) -> Array:
    """Return measured minus simulated motion from the first state, (windows, samples, 12)."""
    fit = Fit(values=values, offsets=np.zeros((len(residuals.windows), N_CHANNELS)))
    rows = residuals.compute(fit, np.ones(N_CHANNELS))
    return rows.reshape(len(rows), -1, N_CHANNELS)


def compare_horizons(
    windows: Windows, first_errors: Array, fitted_errors: Array
) -> tuple[HorizonError, ...]:
    """Return the errors at all horizons.

    Args:
        windows: the windows.
        first_errors: the errors with the first guess, (windows, samples, 12).
        fitted_errors: the errors with fitted coefficients, alike.
    """
    length = windows.settings.length
    horizons = sorted({min(horizon, length) for horizon in HORIZONS} | {length})
    times = (windows.index + windows.fraction) * windows.settings.step
    errors = []
    for name, (unit, channels) in QUANTITIES.items():
        columns = measured_columns(windows, channels)
        for horizon in horizons:
            rows, samples = _find_samples(windows, times, horizon)
            pair = [
                _root_mean_square(part[rows, samples][:, columns])
                for part in (first_errors, fitted_errors)
            ]
            if len(rows) and columns:
                errors.append(
                    HorizonError(
                        quantity=name, unit=unit, horizon=horizon, n_windows=len(rows),
                        first_error=pair[0], fitted_error=pair[1],
                    )
                )  # fmt: skip
    return tuple(errors)


def measured_columns(windows: Windows, channels: slice) -> list[int]:
    """Return the channels of a quantity that the logs have."""
    motion = windows.samples
    has_column = np.asarray(np.isfinite(motion).any(axis=(0, 1))).tolist()
    is_measured = [*has_column[:3], *([has_column[3]] * 3), *has_column[7:]]
    return [i for i in range(channels.start, channels.stop) if is_measured[i]]


def _find_samples(
    windows: Windows, times: Array, horizon: float
) -> tuple[Sequence[int], Sequence[int]]:
    """Return the windows that reach a horizon, and the sample of each nearest to it."""
    has_sample = np.isfinite(windows.samples).any(axis=2)
    distance = np.where(has_sample, np.abs(times - horizon), np.inf)
    samples = distance.argmin(axis=1)
    limit = max(0.1 * horizon, windows.settings.step)
    rows = [i for i, sample in enumerate(samples) if distance[i, sample] <= limit]
    return rows, [int(samples[i]) for i in rows]


def _root_mean_square(values: Array) -> float:
    """Return the root mean square of the lengths of rows; 0 without rows."""
    if not values.size:
        return 0.0
    return float(np.sqrt((values * values).sum(axis=1).mean()))
