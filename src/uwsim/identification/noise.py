r"""The noise of each channel of the motion: given, or estimated from the logs.

The first estimate is that of white noise on a smooth signal, from the second differences d of a
channel: :math:`\sigma^2 = \overline{d^2} / 6`. After a fit, it is the standard deviation of the
residuals of the channel. A model that is wrong thereby counts as noise. `measured_noise` does not
depend on a model: of the third differences d, whose variance is :math:`20 \sigma^2`, it takes the
median of the absolute values, which the few samples at steps of the commands hardly change. Noise
that is correlated over several samples, as behind a filter, is underestimated; motion that changes
from sample to sample counts as noise.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..base.geometry import Array
from ..errors import BadSetting, choices
from ..logs.frames import multiply_quaternions
from .residuals import N_CHANNELS, Residuals
from .windows import Windows

GROUPS = ("position", "attitude", "velocity", "angular_velocity")
"""The groups of channels whose noise can be given: m, rad, m/s, rad/s."""
MIN_NOISE = np.repeat([1e-3, 1e-4, 5e-4, 1e-4], 3)
"""The smallest noise of each channel, which a log without noise gets [m, rad, m/s, rad/s]."""
NORMAL_MEDIAN = 0.67449
"""The median of the absolute value of a normal variable with standard deviation 1."""
MAX_CHANGE = 0.05
"""The relative change of noise below which it is not estimated again."""


def parse_noise(text: str) -> dict[str, float]:
    """Return the noise of groups of channels from ``position=0.005,velocity=0.003``.

    Raises:
        BadSetting: a group is unknown, or a number is not positive; with every error.
    """
    noise, errors = {}, []
    for part in filter(None, (piece.strip() for piece in text.split(","))):
        name, _, number = part.partition("=")
        try:
            value = float(number)
        except ValueError:
            value = -1.0
        if name not in GROUPS:
            errors.append(f"--noise {part!r}: unknown.{choices(name, GROUPS)}")
        elif not 0.0 < value < np.inf:
            errors.append(f"--noise {part!r}: expected a number > 0.")
        noise[name] = value
    if errors:
        raise BadSetting("\n".join(errors))
    return noise


def first_noise(residuals: Residuals, settings: Mapping[str, float]) -> Array:
    """Return the noise of each channel before the first fit, (12,)."""
    rows = _read_channels(residuals.windows)
    differences = rows[:, 2:] - 2.0 * rows[:, 1:-1] + rows[:, :-2]
    squares = np.where(np.isfinite(differences), differences * differences, 0.0)
    n = np.maximum(np.isfinite(differences).sum(axis=(0, 1)), 1)
    noise = np.sqrt(squares.sum(axis=(0, 1)) / (6.0 * n))
    return _complete(noise, settings)


def measured_noise(windows: Windows, settings: Mapping[str, float]) -> Array:
    """Return the noise of each channel by the measurements alone, (12,)."""
    rows, turns = _read_channels(windows), _read_turns(windows)
    noise = np.zeros(N_CHANNELS)
    for channel in range(N_CHANNELS):
        steps = rows[:, 1:, channel] - rows[:, :-1, channel]
        if 3 <= channel < 6:
            steps = turns[:, :, channel - 3]
        thirds = steps[:, 2:] - 2.0 * steps[:, 1:-1] + steps[:, :-2]
        sizes = np.abs(thirds[np.isfinite(thirds)])
        if sizes.size:
            noise[channel] = float(np.median(sizes)) / (NORMAL_MEDIAN * np.sqrt(20.0))
    return _complete(noise, settings)


def count_free_measurements(residuals: Residuals, settings: Mapping[str, float]) -> int:
    """Return the number of measurements that the fit leaves to the noise of a channel.

    That of the channel with the fewest measurements counts; 0: the noise of all groups is given.
    """
    if set(settings) >= set(GROUPS):
        return 0
    samples = _read_channels(residuals.windows)
    counts = np.isfinite(samples).sum(axis=(0, 1))
    n_fitted = len(residuals.parameters) + N_CHANNELS * len(residuals.windows)
    share = max(1.0 - n_fitted / max(int(counts.sum()), 1), 0.0)
    return max(int(share * counts[counts > 0].min(initial=1)), 1)


def _read_channels(windows: Windows) -> Array:
    """Return the measurements, (windows, samples, 12), with attitudes as half rotation vectors."""
    samples = windows.samples
    return np.concatenate([samples[:, :, :3], 2.0 * samples[:, :, 4:7], samples[:, :, 7:]], 2)


def _read_turns(windows: Windows) -> Array:
    """Return the rotation vector from each attitude to the next, (windows, samples - 1, 3)."""
    attitudes = windows.samples[:, :, 3:7]
    conjugates = attitudes[:, :-1] * np.array([1.0, -1.0, -1.0, -1.0])
    turns = multiply_quaternions(conjugates.reshape(-1, 4), attitudes[:, 1:].reshape(-1, 4))
    vectors: Array = 2.0 * np.where(turns[:, :1] < 0.0, -turns[:, 1:], turns[:, 1:])
    return vectors.reshape(len(attitudes), -1, 3)


def residual_noise(
    residuals: Residuals, rows: Array, noise: Array, settings: Mapping[str, float]
) -> Array:
    """Return the noise of each channel by the residuals of a fit, (12,).

    Args:
        residuals: the residuals.
        rows: the residuals of the fit, (windows, 12 samples), weighted by the noise before.
        noise: the noise before, (12,).
        settings: the noise that is given.
    """
    values = rows.reshape(-1, N_CHANNELS)
    n = (values != 0.0).sum(axis=0)  # a channel that is not measured has residuals of 0
    n_fitted = len(residuals.parameters) + N_CHANNELS * len(residuals.windows)
    share = max(1.0 - n_fitted / max(int(n.sum()), 1), 0.1)
    estimate = noise * np.sqrt((values * values).sum(axis=0) / np.maximum(share * n, 1.0))
    return _complete(np.where(n > 0, estimate, noise), settings)


def _complete(noise: Array, settings: Mapping[str, float]) -> Array:
    noise = np.maximum(noise, MIN_NOISE)
    for name, value in settings.items():
        first = 3 * GROUPS.index(name)
        noise[first : first + 3] = value
    return noise
