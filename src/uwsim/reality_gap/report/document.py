"""The numbers of a gap as JSON, and the errors of its windows as CSV."""

from __future__ import annotations

import csv
import io
import json
import math
from typing import Any

from ...version import __version__
from ..attribution import Attribution
from ..coefficients import Coefficient
from ..errors import AXES, Estimate, HorizonError
from ..gap import Gap

FORMAT = 1
"""The version of the format."""


def json_text(gap: Gap) -> str:
    """Return ``gap.json``: the same log and scene give the same bytes."""
    log = gap.log
    document = {
        "uwsim_gap": FORMAT,
        "version": __version__,
        "verdict": gap.verdict,
        "log": {
            "name": log.path.rsplit("/", 1)[-1],
            "format": log.format,
            "sha256": log.sha256,
            "vehicle": log.vehicle,
            "duration": round_number(log.duration),
            "twists": None if log.motion is None else log.motion.twist_source,
        },
        "scene": {"name": gap.scene, "digest": gap.scene_digest, "vehicle": gap.vehicle},
        "settings": {
            "windows": gap.settings.n_windows,
            "horizons": list(gap.settings.horizons),
            "seed": gap.settings.seed,
            "commands": list(gap.command_kinds),
        },
        "n_windows": len(gap.windows.starts),
        "radius_of_gyration": round_number(gap.radius),
        "horizons": [_describe_horizon(error) for error in gap.horizons],
        "attribution": None if gap.attribution is None else _describe(gap.attribution),
        "sensors": [
            {
                "sensor": residual.sensor,
                "topic": residual.topic,
                "quantity": residual.quantity,
                "unit": residual.unit,
                "n": residual.n_readings,
                "rms": round_number(residual.rms),
                "bias": round_number(residual.bias),
                "measured_deviation": round_number(residual.measured_deviation),
            }
            for residual in gap.sensors
        ],
        "spectrum": _describe_spectrum(gap),
        "remarks": list(gap.remarks),
    }
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


def csv_text(gap: Gap) -> str:
    """Return ``windows.csv``: the errors of each window at each horizon."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    units = ("m", "m", "m", "rad", "rad", "rad")
    names = [f"{axis}_error_{unit}" for axis, unit in zip(AXES, units, strict=True)]
    writer.writerow(["start_s", "horizon_s", *names])
    for horizon, errors in gap.window_errors.items():
        starts = gap.windows.starts[list(gap.windows.fits[horizon])].tolist()
        for start, row in zip(starts, errors.tolist(), strict=False):
            writer.writerow([f"{start:.6g}", f"{horizon:g}", *(f"{value:.6g}" for value in row)])
    return stream.getvalue()


def round_number(number: float | None) -> float | None:
    """Return a number with six digits, so that files do not depend on the processor."""
    if number is None or not math.isfinite(number):
        return None
    return float(f"{number:.6g}")


def _describe_estimate(estimate: Estimate) -> dict[str, float | None]:
    return {
        "value": round_number(estimate.value),
        "low": round_number(estimate.low),
        "high": round_number(estimate.high),
    }


def _describe_horizon(error: HorizonError) -> dict[str, Any]:
    return {
        "horizon": error.horizon,
        "n_windows": error.n_windows,
        "n_independent": round_number(error.n_blocks),
        "distance": _describe_estimate(error.distance),
        "path_length": round_number(error.path_length),
        "share_of_path": round_number(error.share),
        "axes": [
            {
                "axis": axis.axis,
                "unit": axis.unit,
                "rms": _describe_estimate(axis.rms),
                "bias": _describe_estimate(axis.bias),
                "displacement_ratio": round_number(axis.ratio),
            }
            for axis in error.axes
        ],
    }


def _describe(attribution: Attribution) -> dict[str, Any]:
    return {
        "duration": attribution.duration,
        "n_windows": attribution.n_windows,
        "residual": round_number(attribution.residual),
        "remainder": round_number(attribution.remainder),
        "unexplained_share": round_number(attribution.unexplained_share),
        "causes": [
            {
                "coefficient": cause.coefficient.key,
                "name": cause.coefficient.name,
                "place": cause.coefficient.advice,
                **_describe_factor(cause.coefficient, cause.factor, cause.low, cause.high),
                "share": round_number(cause.share),
                "confidence": round_number(cause.confidence),
                "is_evident": cause.is_evident,
                "equivalents": list(cause.equivalents),
            }
            for cause in attribution.causes
        ],
        "speed_ratios": {
            axis: round_number(ratio)
            for axis, ratio in zip(AXES, attribution.speed_ratios, strict=True)
        },
        "single_coefficients": [
            {
                "name": row.coefficient.name,
                "share": round_number(row.share),
                **_describe_factor(row.coefficient, row.factor),
            }
            for row in attribution.shares
        ],
    }


def _describe_factor(
    coefficient: Coefficient, factor: float, *limits: float | None
) -> dict[str, float | None]:
    """Return the factor with its limits, or the shift of a clock [s]."""
    offset, name = (1.0, "shift") if coefficient.is_clock else (0.0, "factor")
    numbers = dict(zip((name, "low", "high"), (factor, *limits), strict=False))
    return {
        key: None if number is None else round_number(number - offset)
        for key, number in numbers.items()
    }


def _describe_spectrum(gap: Gap) -> dict[str, Any] | None:
    residuals = gap.residuals
    if residuals is None:
        return None
    return {
        "interval": round_number(residuals.interval),
        "n_steps": len(residuals.times),
        "frequencies": [round_number(value) for value in residuals.frequencies.tolist()],
        "densities": {
            axis: [round_number(value) for value in residuals.densities[:, index].tolist()]
            for index, axis in enumerate(AXES)
        },
    }
