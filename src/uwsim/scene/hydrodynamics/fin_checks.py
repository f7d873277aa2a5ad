"""Return every error in the numbers of a fin."""

from __future__ import annotations

import math

import numpy as np

from ...base.numerics.linear import length
from ...schema import Numbers
from .number_checks import beyond_limits, listed, number_errors
from .spec import MAX_POINTS, FinSpec

ALONG = 0.1
"""A chord that is turned less than this out of the axis is along it [rad]."""


def fin_errors(fin: FinSpec) -> list[str]:
    """Return every error in the numbers of a fin."""
    who = f"fin {fin.name!r}"
    if errors := number_errors(who, fin):
        return errors
    axis, chord = np.array(fin.axis), np.array(fin.chord)
    for name, direction in (("axis", axis), ("chord", chord)):
        if not length(direction) > 1e-9:
            errors.append(f"{who}: {name} is 0 0 0; expected a direction")
    if not errors and length(np.cross(axis, chord)) < ALONG * length(axis) * length(chord):
        errors.append(f"{who}: chord is along the axis; expected it across the span")
    if not fin.limits[0] <= 0.0 <= fin.limits[1] or max(map(abs, fin.limits)) > math.pi:
        errors.append(
            f"{who}: limits are {listed(fin.limits)}; expected least <= 0 <= greatest, within "
            "-3.14 3.14 [rad]"
        )
    if fin.coefficients:
        errors += _table_errors(who, fin.coefficients)
    elif fin.slope == 0.0:
        errors.append(
            f"{who}: nothing says how much it lifts; expected one of <aspectRatio>, <liftSlope> "
            "and <coefficients>"
        )
    return errors + beyond_limits(who, fin)


def _table_errors(who: str, coefficients: Numbers) -> list[str]:
    if len(coefficients) % 3 or not 6 <= len(coefficients) <= 3 * MAX_POINTS:
        return [
            f"{who}: coefficients are {len(coefficients)} numbers; expected 2 to {MAX_POINTS} "
            "rows of angle, lift and drag coefficient"
        ]
    angles, _, drags = np.reshape(coefficients, (-1, 3)).T
    errors = []
    if not np.all(np.diff(angles) > 0.0) or max(abs(angles)) > 3.1416:
        errors.append(
            f"{who}: coefficients have the angles {listed(angles)}; expected them rising, within "
            "-3.14 3.14 [rad]"
        )
    if min(drags) < 0.0:
        errors.append(f"{who}: coefficients have the drag {listed(drags)}; expected none below 0")
    return errors
