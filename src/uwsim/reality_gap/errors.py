r"""The error of the simulated motion at each horizon, with intervals over windows.

The error of a window is the simulated pose in the base frame of the log's pose at that time: surge,
sway and heave [m], and the rotation vector [rad]. Over the windows it has the root mean square

.. math:: \mathrm{RMS} = \sqrt{\tfrac1n \sum_i e_i^2}

and the mean, the bias. Windows that overlap are not independent. The intervals are those of the
moving-block bootstrap (Kuensch 1989): resamples consist of blocks of as many successive windows as
overlap; the limits are the percentiles 2.5 and 97.5. With fewer than `MIN_BLOCKS` blocks there is
no interval.

The *ratio* of a degree of freedom is the slope of the simulated over the measured displacement from
the beginning of a window, through the origin: 0.82 is a vehicle that moves 18 % too little.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.rng import stream

Indices = npt.NDArray[np.int64]
"""The indices of windows in resamples."""

AXES = ("surge", "sway", "heave", "roll", "pitch", "yaw")
"""The names of the degrees of freedom."""
MAIN_HORIZON = 5.0
"""The horizon to which the one of the verdict is nearest [s]."""
N_RESAMPLES = 2000
"""The number of resamples of an interval."""
MIN_BLOCKS = 4
"""The least number of independent blocks of windows for an interval."""


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """A number with its 95 % interval."""

    value: float
    """The number."""
    low: float | None
    """The lower limit; None: too few independent windows."""
    high: float | None
    """The upper limit; None: too few independent windows."""


@dataclass(frozen=True, kw_only=True)
class AxisError:
    """The error of a degree of freedom at a horizon."""

    axis: str
    """The degree of freedom."""
    unit: str
    """The unit: m or rad."""
    rms: Estimate
    """The root mean square."""
    bias: Estimate
    """The mean."""
    ratio: float | None
    """The simulated over the measured displacement; None: the axis hardly moved."""


@dataclass(frozen=True, kw_only=True)
class HorizonError:
    """The errors at a horizon."""

    horizon: float
    """The time after the beginning of a window [s]."""
    n_windows: int
    """The number of windows."""
    n_blocks: float
    """The number of windows that do not overlap."""
    axes: tuple[AxisError, ...]
    """The errors of the degrees of freedom."""
    distance: Estimate
    """The root mean square of the error of the position [m]."""
    path_length: float
    """The mean distance that the vehicle travelled in a window [m]."""

    @property
    def share(self) -> float | None:
        """The error of the position over the distance travelled; None below 1 cm."""
        return self.distance.value / self.path_length if self.path_length > 0.01 else None


def choose_main_horizon(horizons: Sequence[HorizonError]) -> HorizonError:
    """Return the errors at the horizon of the verdict and of the tracks."""
    return min(horizons, key=lambda error: abs(error.horizon - MAIN_HORIZON))


def summarize_horizon(
    horizon: float,
    errors: Array,
    predictions: Array,
    measurements: Array,
    path_length: Array,
    *,
    block: int,
    seed: int,
) -> HorizonError:
    """Return the errors at a horizon.

    Args:
        horizon: the horizon [s].
        errors: the errors of the windows, (n, 6) [m, rad].
        predictions: the simulated displacements from the beginning of each window, (n, 6).
        measurements: the measured displacements, (n, 6).
        path_length: the distance travelled in each window, (n,) [m].
        block: the number of successive windows that overlap.
        seed: the seed of the resamples.
    """
    resamples = _draw_blocks(len(errors), block, seed, f"gap/errors/{horizon:g}")
    distances = np.sqrt((errors[:, :3] * errors[:, :3]).sum(axis=1))
    axes = tuple(
        AxisError(
            axis=name,
            unit="m" if index < 3 else "rad",
            rms=_estimate(errors[:, index], _rms, resamples),
            bias=_estimate(errors[:, index], _mean, resamples),
            ratio=_fit_ratio(predictions[:, index], measurements[:, index]),
        )
        for index, name in enumerate(AXES)
    )
    return HorizonError(
        horizon=horizon,
        n_windows=len(errors),
        n_blocks=len(errors) / block,
        axes=axes,
        distance=_estimate(distances, _rms, resamples),
        path_length=float(path_length.mean()),
    )


def _draw_blocks(n: int, block: int, seed: int, name: str) -> Indices | None:
    """Return the indices of resamples of blocks, (N_RESAMPLES, n); None for too few blocks."""
    if n < MIN_BLOCKS * block:
        return None
    n_blocks = -(-n // block)
    starts = stream(seed, name).integers(0, n - block + 1, (N_RESAMPLES, n_blocks))
    return (starts[:, :, None] + np.arange(block)).reshape(N_RESAMPLES, -1)[:, :n]


def _estimate(
    values: Array, statistic: Callable[[Array], Array], resamples: Indices | None
) -> Estimate:
    value = float(statistic(values[None])[0])
    if resamples is None:
        return Estimate(value=value, low=None, high=None)
    ordered_values = np.sort(statistic(values[resamples]))
    n = len(ordered_values)
    low, high = ordered_values[int(0.025 * n)], ordered_values[int(0.975 * n) - 1]
    return Estimate(value=value, low=float(low), high=float(high))


def _rms(rows: Array) -> Array:
    root: Array = np.sqrt((rows * rows).mean(axis=1))
    return root


def _mean(rows: Array) -> Array:
    mean: Array = rows.mean(axis=1)
    return mean


def _fit_ratio(predictions: Array, measurements: Array) -> float | None:
    square = float((measurements * measurements).sum())
    if square <= len(measurements) * 1e-4:  # 1 cm or 0.6 degrees
        return None
    return float((predictions * measurements).sum()) / square
