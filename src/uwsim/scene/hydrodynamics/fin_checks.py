"""Checks of the numbers of fins in hydrodynamics files."""

from __future__ import annotations

import math

import numpy as np

from ...base.numerics.linear import length
from ...schema import Numbers
from .number_checks import limit_errors, number_errors, text_of
from .spec import MAX_POINTS, FinSpec

MIN_CHORD_ANGLE = 0.1
"""The angle between chord and axis below which they count as parallel [rad]."""


def fin_errors(fin: FinSpec) -> list[str]:
    """Return every error in the numbers of a fin."""
    owner = f"fin {fin.name!r}"
    if errors := number_errors(owner, fin):
        return errors
    axis, chord = np.array(fin.axis), np.array(fin.chord)
    for name, direction in (("axis", axis), ("chord", chord)):
        if not length(direction) > 1e-9:
            errors.append(f"{owner}: {name} is 0 0 0; expected a direction")
    if not errors and length(np.cross(axis, chord)) < MIN_CHORD_ANGLE * length(axis) * length(
        chord
    ):
        errors.append(f"{owner}: chord is along the axis; expected it across the span")
    if not fin.limits[0] <= 0.0 <= fin.limits[1] or max(map(abs, fin.limits)) > math.pi:
        errors.append(
            f"{owner}: limits are {text_of(fin.limits)}; expected least <= 0 <= greatest, within "
            "-3.14 3.14 [rad]"
        )
    if fin.coefficients:
        errors += _table_errors(owner, fin.coefficients)
    elif fin.slope == 0.0:
        errors.append(
            f"{owner}: the lift is not given; expected one of <aspectRatio>, <liftSlope> "
            "and <coefficients>"
        )
    return errors + limit_errors(owner, fin)


def _table_errors(owner: str, coefficients: Numbers) -> list[str]:
    if len(coefficients) % 3 or not 6 <= len(coefficients) <= 3 * MAX_POINTS:
        return [
            f"{owner}: coefficients are {len(coefficients)} numbers; expected 2 to {MAX_POINTS} "
            "rows of angle, lift and drag coefficient"
        ]
    angles, _, drags = np.reshape(coefficients, (-1, 3)).T
    errors = []
    if not np.all(np.diff(angles) > 0.0) or max(abs(angles)) > 3.1416:
        errors.append(
            f"{owner}: coefficients have the angles {text_of(angles)}; expected them rising, "
            "within -3.14 3.14 [rad]"
        )
    if min(drags) < 0.0:
        errors.append(
            f"{owner}: coefficients have the drag {text_of(drags)}; expected none below 0"
        )
    return errors
