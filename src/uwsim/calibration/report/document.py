"""The numbers of a calibration as JSON."""

from __future__ import annotations

import json
import math
from typing import Any

from ...version import __version__
from ..calibrate import Calibration
from ..calibrated_water import CalibratedWater, ChannelResult
from .numbers import round_number

FORMAT = 1
"""The version of the format."""


def json_text(calibration: Calibration) -> str:
    """Return ``calibration.json``: the same measurements give the same bytes."""
    document = {
        "uwsim_calibration": FORMAT,
        "version": __version__,
        "view": {
            "distance": calibration.view.distance,
            "feature_width": calibration.view.feature_width,
        },
        "seed": calibration.seed,
        "references": {
            name: {"absorption": water.absorption, "scattering": water.scattering}
            for name, water in calibration.measurements.references.items()
        },
        "waters": [_describe_water(water) for water in calibration.waters],
        "gates": [
            {
                "name": gate.name,
                "subject": gate.subject,
                "is_passed": gate.is_passed,
                "text": gate.text,
            }
            for gate in calibration.gates
        ],
    }
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


def _describe_water(water: CalibratedWater) -> dict[str, Any]:
    return {
        "name": water.name,
        "dose": water.dose,
        "shape": round_number(water.shape),
        "remarks": list(water.remarks),
        "channels": [_describe_channel(result) for result in water.channels],
    }


def _describe_channel(result: ChannelResult) -> dict[str, Any]:
    estimate, backscatter = result.estimate, result.backscatter
    readings = zip(
        estimate.readings,
        estimate.measured_losses,
        estimate.fitted_losses,
        estimate.errors,
        strict=True,
    )
    return {
        "name": estimate.channel,
        "absorption": round_number(estimate.water.absorption),
        "scattering": round_number(estimate.water.scattering),
        "beam_attenuation": round_number(estimate.water.beam_attenuation),
        "shape": round_number(estimate.water.shape),
        "standard_deviations": {
            name: round_number(value) for name, value in estimate.standard_deviations.items()
        },
        "covariance": [[round_number(value) for value in row] for row in estimate.covariance],
        "chi_squared": round_number(estimate.chi_squared),
        "degrees_of_freedom": estimate.degrees_of_freedom,
        "naive_attenuation": round_number(estimate.naive_attenuation),
        "gains": {name: round_number(value) for name, value in estimate.gains.items()},
        "readings": [
            {
                "reading": reading.label,
                "distance": round_number(reading.distance),
                "measured_loss": round_number(float(measured_loss)),
                "fitted_loss": round_number(float(fitted_loss)),
                "standard_deviation": round_number(float(error)),
            }
            for reading, measured_loss, fitted_loss, error in readings
        ],
        "quantities": [
            {
                "name": quantity.name,
                "unit": quantity.unit,
                "value": _number(quantity.value),
                "low": _number(quantity.low),
                "high": _number(quantity.high),
            }
            for quantity in result.quantities
        ],
        "scattering_at_170_degrees": None
        if backscatter is None
        else {
            "value": round_number(backscatter.value),
            "standard_deviation": round_number(backscatter.standard_deviation),
            "ratio_to_phase_function": round_number(backscatter.ratio),
        },
    }


def _number(number: float) -> float | None:
    """Return a number for JSON, which has no infinity."""
    return round_number(number) if math.isfinite(number) else None
