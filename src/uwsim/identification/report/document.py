"""The numbers of an identification as JSON."""

from __future__ import annotations

import json
from typing import Any

from ...version import __version__
from ..identify import Identification
from ..model_check import ModelCheck
from ..residuals import CHANNELS
from ..uncertainty import Estimate
from .numbers import round_number

FORMAT = 2
"""The version of the format; 2 has `model_check` and the reasons of doubt."""
N_READINGS = 5
"""The greatest number of other readings."""


def json_text(result: Identification) -> str:
    """Return ``identification.json``: the same logs and settings give the same bytes."""
    settings, uncertainty = result.settings, result.uncertainty
    document = {
        "uwsim_identification": FORMAT,
        "version": __version__,
        "vehicle": result.model.name,
        "first_guess": result.model.hydrodynamics.name,
        "logs": [
            {"name": log.path.replace("\\", "/").rsplit("/", 1)[-1], "sha256": log.sha256}
            for log in result.logs
        ],
        "settings": {
            "free": list(settings.free_names),
            "window": settings.windows.length,
            "step": settings.windows.step,
            "rate": settings.windows.rate,
            "starts": settings.n_starts,
            "folds": settings.n_folds,
            "loss": settings.loss,
            "seed": settings.seed,
            "planar": result.model.is_planar,
        },
        "model_check": _describe_check(result.check),
        "coefficients": [_describe_estimate(estimate) for estimate in uncertainty.estimates],
        "correlations": [
            [round_number(round(value, 6)) for value in row]
            for row in uncertainty.correlations.tolist()
        ],
        "undetermined_combinations": [
            {
                "coefficients": list(direction.names),
                "relative_changes": [round_number(change) for change in direction.changes],
                "error": round_number(direction.error),
                "text": direction.describe(),
            }
            for direction in uncertainty.weak_directions
        ],
        "interval_method": "the wider of white noise and robust over windows",
        "window_correction": round_number(uncertainty.correction),
        "noise": {
            channel: round_number(noise)
            for channel, noise in zip(CHANNELS, result.noise.tolist(), strict=True)
        },
        "chi_squared_per_measurement": round_number(result.chi_squared),
        "starts_at_this_minimum": result.n_same_minimum,
        "unfinished_starts": result.n_unfinished,
        "windows": len(result.windows),
        "held_out_errors": [
            {
                "quantity": error.quantity,
                "unit": error.unit,
                "horizon": error.horizon,
                "windows": error.n_windows,
                "before": round_number(error.first_error),
                "after": round_number(error.fitted_error),
            }
            for error in result.horizons
        ],
        "excitation": [
            {
                "axis": row.axis,
                "rms_velocity": round_number(row.speed),
                "max_velocity": round_number(row.max_speed),
                "is_excited": row.is_excited,
            }
            for row in result.excitation
        ],
        "advice": list(result.advice),
        "remarks": list(result.windows.remarks),
    }
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


def _describe_check(check: ModelCheck) -> dict[str, Any]:
    return {
        "warnings": list(check.warnings),
        "measured_noise": {
            channel: round_number(noise)
            for channel, noise in zip(CHANNELS, check.measured_noise.tolist(), strict=True)
        },
        "residuals_in_measured_noise": {
            channel: round_number(ratio)
            for channel, ratio in zip(CHANNELS, check.noise_ratios.tolist(), strict=True)
        },
        "other_readings": [
            {
                "reading": reading.text,
                "relative_error": round_number(reading.error),
                "relative_error_fitted": None
                if reading.fitted_error is None
                else round_number(reading.fitted_error),
            }
            for reading in check.readings[:N_READINGS]
        ],
    }


def _describe_estimate(estimate: Estimate) -> dict[str, Any]:
    return {
        "name": estimate.parameter.name,
        "unit": estimate.parameter.unit,
        "value": round_number(estimate.value),
        "low": round_number(estimate.low),
        "high": round_number(estimate.high),
        "standard_error": round_number(estimate.standard_error),
        "first_guess": round_number(estimate.parameter.first_guess),
        "is_determined": estimate.is_determined,
        "doubt": estimate.doubt or None,
        "is_at_bound": estimate.is_at_bound,
    }
