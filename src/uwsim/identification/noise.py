r"""The noise of each channel of the motion: given, or estimated from the logs.

The first estimate is that of white noise on a smooth signal, from the second differences d of a
channel: :math:`\sigma^2 = \overline{d^2} / 6`. After a fit, it is the standard deviation of the
residuals of the channel. A model that is wrong thereby counts as noise.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..base.geometry import Array
from ..errors import BadSetting, choices
from .residuals import N_CHANNELS, Residuals

GROUPS = ("position", "attitude", "velocity", "angular_velocity")
"""The groups of channels whose noise can be given: m, rad, m/s, rad/s."""
MIN_NOISE = np.repeat([1e-3, 1e-4, 5e-4, 1e-4], 3)
"""The smallest noise of each channel, which a log without noise gets [m, rad, m/s, rad/s]."""
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
    samples = residuals.windows.samples
    rows = np.concatenate([samples[:, :, :3], 2.0 * samples[:, :, 4:7], samples[:, :, 7:]], 2)
    differences = rows[:, 2:] - 2.0 * rows[:, 1:-1] + rows[:, :-2]
    squares = np.where(np.isfinite(differences), differences * differences, 0.0)
    n = np.maximum(np.isfinite(differences).sum(axis=(0, 1)), 1)
    noise = np.sqrt(squares.sum(axis=(0, 1)) / (6.0 * n))
    return _complete(noise, settings)


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
