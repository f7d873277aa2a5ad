"""The rows of the tables of an identification, for the terminal and the page."""

from __future__ import annotations

from collections.abc import Sequence

from ..identify import Identification
from ..uncertainty import Estimate
from ..validation import HorizonError
from .numbers import format_interval

Row = tuple[str, ...]
COEFFICIENT_HEADER = ("coefficient", "unit", "first guess", "identified", "95 % interval", "")
"""The header of the table of coefficients."""
HORIZON_HEADER = ("error", "unit", "horizon", "windows", "before", "after")
"""The header of the table of errors."""
DOUBTS = {
    "idle": "the axis was never excited",
    "noise": "noise makes most of the information",
    "bound": "the interval reaches 0, or another bound of the range",
}
"""The reasons of doubt that one sentence gives for all coefficients."""


def make_coefficient_rows(estimates: Sequence[Estimate]) -> list[Row]:
    """Return the rows of the coefficients."""
    rows: list[Row] = []
    for estimate in estimates:
        value, interval = format_interval(estimate)
        parameter = estimate.parameter
        unit = "factor" if parameter.unit == "1" else parameter.unit
        guess = f"{parameter.first_guess:.4g}"
        rows.append((parameter.name, unit, guess, value, interval, _describe_state(estimate)))
    return rows


def make_horizon_rows(errors: Sequence[HorizonError]) -> list[Row]:
    """Return the rows of the errors of held-out windows."""
    return [
        (
            error.quantity,
            error.unit,
            f"{error.horizon:g} s",
            str(error.n_windows),
            f"{error.first_error:.3g}",
            f"{error.fitted_error:.3g}",
        )
        for error in errors
    ]


def list_warnings(result: Identification) -> list[str]:
    """Return the sentences that a reader must not miss."""
    estimates = result.uncertainty.estimates
    warnings = [direction.describe() for direction in result.uncertainty.weak_directions]
    weak_names = {name for entry in result.uncertainty.weak_directions for name in entry.names}
    warnings += [
        f"{estimate.parameter.name} is not determined: its error is too large."
        for estimate in estimates
        if estimate.doubt == "error" and estimate.parameter.name not in weak_names
    ]
    for doubt, sentence in DOUBTS.items():
        names = [entry.parameter.name for entry in estimates if entry.doubt == doubt]
        if names:
            warnings.append(f"Not determined, because {sentence}: {', '.join(names)}.")
    warnings += [
        f"{estimate.parameter.name} is at the bound of its range."
        for estimate in estimates
        if estimate.is_at_bound and estimate.value != 0.0 and estimate.doubt != "bound"
    ]
    n_ended = result.settings.n_starts - result.n_unfinished
    if result.n_same_minimum * 2 < n_ended:
        warnings.append(
            f"Only {result.n_same_minimum} of {n_ended} starts reach the same minimum: there may "
            "be a better one."
        )
    return warnings


def _describe_state(estimate: Estimate) -> str:
    if not estimate.is_determined:
        return "not determined"
    return "at its bound" if estimate.is_at_bound else ""
