r"""The check whether a model explains logs at all: noise, held-out windows, readings, weight.

The residuals of a fit are compared with the noise that the measurements show by themselves, because
a noise that is estimated from residuals hides a wrong model. A fit must predict held-out windows
better than its first guess. `readings` names signs, units and frames that would explain the logs
better. A large free weight, and positions at the surface, do not fit the deep water of the model.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array
from ..physics.hydrodynamics import columns as c
from .parameters import Numbers
from .readings import MAX_ERROR_RATIO, Reading
from .residuals import CHANNELS
from .validation import QUANTITIES, HorizonError
from .vehicle_model import VehicleModel
from .windows import Windows

MAX_NOISE_RATIO = 5.0
"""The ratio of residuals and noise of the measurements from which on the check warns."""
MAX_ATTITUDE_ERROR = 0.5
"""The error of the attitude at the longest horizon from which on the check warns [rad]."""
MAX_FREE_WEIGHT = 0.05
"""The difference of weight and buoyancy, relative to the weight, from which on the check warns."""
NOISE_FACTOR = 3.0
"""The error in standard deviations of the noise below which an error cannot become smaller."""
N_LISTED = 3
"""The greatest number of channels that a warning lists."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ModelCheck:
    """The result of a check."""

    measured_noise: Array
    """The noise of each channel by the measurements alone, (12,)."""
    noise_ratios: Array
    """The residuals of each channel, in that noise, (12,); NaN where nothing was measured."""
    readings: tuple[Reading, ...]
    """The readings, the one with the smallest error first."""
    warnings: tuple[str, ...]
    """The sentences about a model that does not explain the logs; empty: it does."""


def check_model(
    model: VehicleModel,
    windows: Windows,
    numbers: Numbers,
    *,
    residual_noise: Array,
    measured_noise: Array,
    horizons: Sequence[HorizonError],
    readings: Sequence[Reading],
) -> ModelCheck:
    """Check a fit.

    Args:
        model: the vehicle.
        windows: the windows.
        numbers: the numbers of the vehicle with the fitted coefficients.
        residual_noise: the standard deviation of the residuals of each channel, (12,).
        measured_noise: the noise of each channel by the measurements, (12,).
        horizons: the errors on held-out windows.
        readings: the readings, the one with the smallest error first.
    """
    ratios = np.where(_find_measured(windows), residual_noise / measured_noise, np.nan)
    warnings = _describe_readings(readings)
    warnings += _describe_noise(ratios)
    warnings += _describe_horizons(horizons, measured_noise)
    if not model.is_planar:
        warnings += _describe_weight(model, numbers)
        warnings += _describe_surface(numbers, windows)
    return ModelCheck(
        measured_noise=measured_noise,
        noise_ratios=ratios,
        readings=tuple(readings),
        warnings=tuple(warnings),
    )


def _find_measured(windows: Windows) -> Array:
    """Return the channels that the logs have, (12,)."""
    has_column = np.asarray(np.isfinite(windows.samples).any(axis=(0, 1)))
    return np.concatenate([has_column[:3], has_column[4:7], has_column[7:]])


def _describe_readings(readings: Sequence[Reading]) -> list[str]:
    best_reading = readings[0] if readings else None
    if (
        best_reading is None
        or best_reading.fitted_error is None
        or best_reading.fitted_error > MAX_ERROR_RATIO
    ):
        return []
    gain = 100.0 * (1.0 - best_reading.fitted_error)
    return [
        f"The error is {gain:.0f} % smaller with {best_reading.text}. Check the mapping file "
        "and the vehicle's file."
    ]


def _describe_noise(ratios: Array) -> list[str]:
    known_ratios = np.nan_to_num(ratios)
    order = np.argsort(-known_ratios, kind="stable")[:N_LISTED].tolist()
    parts = [
        f"{CHANNELS[i]} {known_ratios[i]:.0f} times"
        for i in order
        if known_ratios[i] > MAX_NOISE_RATIO
    ]
    if not parts:
        return []
    return [
        "The model does not explain the logs. In noise of the measurements, residuals are: "
        f"{', '.join(parts)}. Signs, units, frames, coefficients that are not free, a current or a "
        "tether can be the reason."
    ]


def _describe_horizons(horizons: Sequence[HorizonError], noise: Array) -> list[str]:
    last_horizon = max((error.horizon for error in horizons), default=0.0)
    sentences = []
    for error in horizons:
        if error.horizon != last_horizon:
            continue
        _, channels = QUANTITIES[error.quantity]
        floor = NOISE_FACTOR * float(np.sqrt((noise[channels] * noise[channels]).sum()))
        if error.fitted_error >= error.first_error and error.fitted_error > floor:
            sentences.append(
                "The fit predicts held-out windows no better than the first guess: "
                f"{error.quantity} after {last_horizon:g} s {error.fitted_error:.3g} {error.unit}, "
                f"before {error.first_error:.3g} {error.unit}."
            )
        if error.quantity == "attitude" and error.fitted_error > MAX_ATTITUDE_ERROR:
            sentences.append(
                f"The attitude is wrong by {error.fitted_error:.2g} rad after {last_horizon:g} s. "
                "Check the signs of the thrusters, and the frames of the log."
            )
    return sentences


def _describe_weight(model: VehicleModel, numbers: Numbers) -> list[str]:
    vehicle = numbers.vehicle
    gravity = float(np.sqrt((vehicle.gravity * vehicle.gravity).sum()))
    mass = float(vehicle.rigid_body[0])
    free_mass = mass - float(vehicle.bodies[:, c.DISPLACED_MASS].sum())
    if abs(free_mass) <= MAX_FREE_WEIGHT * mass:
        return []
    verb = "sinks" if free_mass > 0.0 else "rises"
    share = 100.0 * abs(free_mass) / mass
    return [
        f"{model.name} {verb} with {gravity * abs(free_mass):.0f} N, {share:.0f} % of its weight. "
        "Check mass and volume; --planar fits a surface craft."
    ]


def _describe_surface(numbers: Numbers, windows: Windows) -> list[str]:
    displaced_mass = float(numbers.vehicle.bodies[:, c.DISPLACED_MASS].sum())
    depth = 0.5 * (displaced_mass / numbers.vehicle.density) ** (1.0 / 3.0)
    heights = np.nan_to_num(windows.samples[:, :, 2], nan=-np.inf)
    n = int((heights > -depth).any(axis=1).sum())
    if not n:
        return []
    return [
        f"{n} of {len(windows)} windows have positions above {depth:.2g} m of depth. The model is "
        "deep water: leave them out, set the origin in a mapping file, or use --planar."
    ]
