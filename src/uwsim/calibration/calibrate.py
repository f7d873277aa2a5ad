"""From measurements to a calibration."""

from __future__ import annotations

from dataclasses import dataclass

from ..errors import BadSetting, ErrorCollector
from .backscatter import estimate_backscatter
from .calibrated_water import CalibratedWater, ChannelResult
from .estimate import estimate_water
from .measurements import Measurements, WaterReadings
from .quality import Gate, check_quality
from .quantities import View, convert_estimate


@dataclass(frozen=True, kw_only=True)
class Calibration:
    """The result of a calibration."""

    measurements: Measurements
    """The readings that it was computed from."""
    view: View
    """The distance and the scale of contrast and fog."""
    seed: int
    """The seed of the samples of intervals."""
    waters: tuple[CalibratedWater, ...]
    """The waters."""
    gates: tuple[Gate, ...]
    """The quality gates."""


def calibrate(
    measurements: Measurements, view: View | None = None, *, seed: int = 0
) -> Calibration:
    """Calibrate all waters of measurements.

    Args:
        measurements: the readings.
        view: the distance and the scale of contrast and fog; None: the defaults.
        seed: the seed of the samples of intervals.

    Raises:
        SeveralErrors: (or BadSetting for one) readings do not determine waters.
    """
    conditions = View() if view is None else view
    errors = ErrorCollector()
    waters = []
    for water in measurements.waters:
        with errors.collect():
            waters.append(_calibrate_water(water, measurements, conditions, seed))
    errors.raise_errors()
    return Calibration(
        measurements=measurements,
        view=conditions,
        seed=seed,
        waters=tuple(waters),
        gates=check_quality(waters, measurements.references),
    )


def _calibrate_water(
    water: WaterReadings, measurements: Measurements, view: View, seed: int
) -> CalibratedWater:
    channels = [
        channel
        for channel in measurements.references
        if any(reading.channel == channel for reading in water.readings)
    ]
    if not channels:
        raise BadSetting(f"Water {water.name!r} has no reading that can be used.")
    errors = ErrorCollector()
    results = []
    for channel in channels:
        readings = [reading for reading in water.readings if reading.channel == channel]
        reference = measurements.references[channel]
        with errors.collect():
            try:
                estimate = estimate_water(readings, reference, measurements.accuracy)
            except BadSetting as error:
                raise BadSetting(f"Water {water.name!r}: {error}") from None
            backscatter = next(
                (
                    estimate_backscatter(estimate, reading, reference)
                    for reading in water.open_water
                    if reading.channel == channel
                ),
                None,
            )
            results.append(
                ChannelResult(
                    estimate=estimate,
                    quantities=convert_estimate(estimate, view, seed=seed),
                    backscatter=backscatter,
                )
            )
    errors.raise_errors()
    return CalibratedWater(
        name=water.name, dose=water.dose, channels=tuple(results), remarks=water.remarks
    )
