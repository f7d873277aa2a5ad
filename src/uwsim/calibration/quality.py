"""The quality gates of a calibration, which no instrument is needed for.

A gate that cannot be checked, such as a repeat that was not measured, is stated as not measured.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

from .calibrated_water import CalibratedWater
from .estimate import SHAPE_LIMITS, Estimate
from .forward_model import WaterNumbers

MAX_CHI_SQUARED = 3.0
"""The greatest chi^2 of each degree of freedom: more is ambient light, glare or a mixed dye."""
MAX_REPEAT = 0.03
"""The greatest difference of c between repeats, relative."""
MAX_CHANNEL_SPREAD = 0.15
"""The greatest difference of the added scattering between channels, relative to its mean."""
MAX_DILUTION_ERROR = 0.05
"""The greatest deviation from Beer's law by dilution, relative."""
OPTICAL_DEPTHS = (0.3, 2.0)
"""The optical depths c R between which the forward model and the reference are most certain."""


@dataclass(frozen=True, kw_only=True)
class Gate:
    """A check of quality."""

    name: str
    """The name of the check."""
    subject: str
    """The water or channel that is checked."""
    is_passed: bool | None
    """True if it is passed; None if it was not measured."""
    text: str
    """The number that was found, and the one that was expected."""


def check_quality(
    waters: Sequence[CalibratedWater], references: dict[str, WaterNumbers]
) -> tuple[Gate, ...]:
    """Check the quality of all waters of a calibration."""
    gates: list[Gate] = []
    for water in waters:
        for result in water.channels:
            gates += _check_fit(water.name, result.estimate)
        gates.append(_check_channels(water, references))
    gates += _check_repeats(waters)
    gates += _check_dilution(waters, references)
    return tuple(gates)


def summarize_failures(gates: Sequence[Gate]) -> str:
    """Return one line about the gates that are failed; empty if none is."""
    names = [gate.name for gate in gates if gate.is_passed is False]
    if not names:
        return ""
    n_measured = sum(gate.is_passed is not None for gate in gates)
    return (
        f"{len(names)} of {n_measured} quality gates are failed ({', '.join(dict.fromkeys(names))})"
        ": do not use this water. Compare the exposure times, distances and focal length of the "
        "set-up with those of the pictures."
    )


def _check_fit(name: str, estimate: Estimate) -> list[Gate]:
    subject = f"{name}, {estimate.channel}"
    chi_squared = estimate.reduced_chi_squared
    ranges = [reading.distance for reading in estimate.readings]
    attenuation = estimate.water.beam_attenuation
    depths = (attenuation * min(ranges), attenuation * max(ranges))
    low, high = OPTICAL_DEPTHS
    shape = estimate.water.shape
    is_inside = SHAPE_LIMITS[0] + 1e-3 < shape < SHAPE_LIMITS[1] - 1e-3
    return [
        Gate(
            name="fit",
            subject=subject,
            is_passed=chi_squared <= MAX_CHI_SQUARED,
            text=f"chi² {chi_squared:.2f} per degree of freedom; at most {MAX_CHI_SQUARED:g}",
        ),
        Gate(
            name="range",
            subject=subject,
            is_passed=depths[1] >= low and depths[0] <= high,
            text=f"c R from {depths[0]:.2f} to {depths[1]:.2f}; best {low:g} to {high:g}",
        ),
        Gate(
            name="phase function",
            subject=subject,
            is_passed=is_inside,
            text=f"m = {shape:.2f}; inside of {SHAPE_LIMITS[0]:g} to {SHAPE_LIMITS[1]:g}",
        ),
    ]


def _check_channels(water: CalibratedWater, references: dict[str, WaterNumbers]) -> Gate:
    added_scattering = [
        result.estimate.water.scattering - references[result.estimate.channel].scattering
        for result in water.channels
    ]
    if len(added_scattering) < 2:
        text, is_passed = "one channel", None
    else:
        spread = (max(added_scattering) - min(added_scattering)) / max(
            sum(added_scattering) / len(added_scattering), 1e-9
        )
        text = (
            f"added scattering differs by {spread * 100:.1f} %; at most "
            f"{MAX_CHANNEL_SPREAD * 100:g} % for particles"
        )
        is_passed = spread <= MAX_CHANNEL_SPREAD
    return Gate(name="channels", subject=water.name, is_passed=is_passed, text=text)


def _check_repeats(waters: Sequence[CalibratedWater]) -> list[Gate]:
    gates = []
    for first, second in itertools.combinations(waters, 2):
        if first.dose is None or first.dose != second.dose:
            continue
        for first_estimate, second_estimate in _pair_channels(first, second):
            c1, c2 = first_estimate.water.beam_attenuation, second_estimate.water.beam_attenuation
            difference = abs(c2 - c1) / max(0.5 * (c1 + c2), 1e-9)
            gates.append(
                Gate(
                    name="repeat",
                    subject=f"{first.name}, {second.name}, {first_estimate.channel}",
                    is_passed=difference <= MAX_REPEAT,
                    text=f"c differs by {difference * 100:.1f} %; at most {MAX_REPEAT * 100:g} %",
                )
            )
    return gates or [
        Gate(name="repeat", subject="all", is_passed=None, text="no two waters of one dose")
    ]


def _check_dilution(
    waters: Sequence[CalibratedWater], references: dict[str, WaterNumbers]
) -> list[Gate]:
    gates = []
    for first, second in itertools.combinations(waters, 2):
        if not first.dose or not second.dose or first.dose == second.dose:
            continue
        for first_estimate, second_estimate in _pair_channels(first, second):
            reference = references[first_estimate.channel]
            for name in ("beam_attenuation", "scattering"):
                reference_value = getattr(reference, name)
                increases = [
                    getattr(estimate.water, name) - reference_value
                    for estimate in (first_estimate, second_estimate)
                ]
                if not increases[0] > 0.0:
                    continue
                deviation = increases[1] / increases[0] / (second.dose / first.dose) - 1.0
                symbol = "c" if name == "beam_attenuation" else "b"
                gates.append(
                    Gate(
                        name="dilution",
                        subject=f"{first.name}, {second.name}, {first_estimate.channel}",
                        is_passed=abs(deviation) <= MAX_DILUTION_ERROR,
                        text=f"added {symbol} is {deviation * 100:+.1f} % off the ratio of doses; "
                        f"at most {MAX_DILUTION_ERROR * 100:g} %",
                    )
                )
    return gates or [
        Gate(name="dilution", subject="all", is_passed=None, text="no two waters of known doses")
    ]


def _pair_channels(
    first: CalibratedWater, second: CalibratedWater
) -> list[tuple[Estimate, Estimate]]:
    estimates = {result.estimate.channel: result.estimate for result in second.channels}
    return [
        (result.estimate, estimates[result.estimate.channel])
        for result in first.channels
        if result.estimate.channel in estimates
    ]
