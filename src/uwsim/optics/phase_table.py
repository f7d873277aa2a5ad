"""A phase function as a table, such as a measured one."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ..base.numerics.elementwise import exp, log
from ..errors import BadSetting, ErrorCollector
from .phase_function import MIN_ANGLE, N_ANGLES, FloatArray, PhaseFunction

MAX_ROWS = 10_000
"""The greatest number of rows of a table."""
MIN_ROWS = 5
MAX_FIRST_ANGLE = math.radians(10.0)
"""The greatest first angle of a table [rad]; what is below is extrapolated."""
MIN_LAST_ANGLE = math.radians(150.0)
"""The smallest last angle of a table [rad]; what is above has the last value."""
ANGLE_TOLERANCE = 1e-5
"""The distance by which a last angle may exceed pi [rad]: 3.1416 does."""
MAX_INTEGRAL_ERROR = 0.1
"""The greatest distance from 1 of the integral of a table over all directions."""
MIN_VALUE = 1e-12
"""The smallest value of a table [1/sr]; those of water are above 1e-5."""
MAX_VALUE = 1e18
"""The greatest value of a table [1/sr]: those of power laws at the smallest angle are below."""
STEEPEST_RISE = 10.0
"""The steepest rising power law of the extrapolation to zero."""
MIN_LOG_STEP = 1e-12
"""The smallest difference of the logarithms of the first two angles that sets a power law."""
STEEPEST_SLOPE = -1.9
"""The steepest power law of the extrapolation to zero; at -2 the fraction would be infinite."""


@dataclass(frozen=True)
class PhaseTable(PhaseFunction):
    r"""A phase function by values at angles.

    Between two rows, :math:`\ln p` is linear in :math:`\ln\theta`, and in :math:`\theta` before the
    first positive angle of a table that begins at zero. Below the first angle of any other table,
    the power law of its first two rows continues. The values are divided by their integral over
    all directions, which must be 1 within 10 %: scale a measured volume scattering function
    [1/m/sr] by 1/b first (`from_scattering_function`).
    """

    angles: tuple[float, ...]
    """The scattering angles [rad], increasing, from at most 10 to at least 150 degrees."""
    values: tuple[float, ...]
    """The values at the angles [1/sr], from `MIN_VALUE` to `MAX_VALUE`."""

    def __post_init__(self) -> None:
        errors = ErrorCollector()
        for text in self._find_errors():
            with errors.collect():
                raise BadSetting(text)
        errors.raise_errors()
        if not abs(self._integral - 1.0) <= MAX_INTEGRAL_ERROR:
            raise BadSetting(
                f"The integral of a phase function over all directions is {self._integral:.4g}; "
                f"expected 1 within {MAX_INTEGRAL_ERROR:g}."
            )

    @classmethod
    def from_scattering_function(
        cls, angles: tuple[float, ...], values: tuple[float, ...]
    ) -> tuple[PhaseTable, float]:
        """Return the phase function of a volume scattering function, and its scattering b [1/m].

        Args:
            angles: the scattering angles [rad].
            values: the volume scattering function at the angles [1/m/sr].
        """
        table = object.__new__(cls)
        object.__setattr__(table, "angles", angles)
        object.__setattr__(table, "values", values)
        errors = ErrorCollector()
        for text in table._find_errors():
            with errors.collect():
                raise BadSetting(text)
        errors.raise_errors()
        scattering = table._integral
        return cls(angles, tuple(value / scattering for value in values)), scattering

    def compute_density(self, angle: npt.ArrayLike) -> FloatArray:
        """Compute the phase function at scattering angles [rad]; the result is in 1/sr."""
        return exp(self._interpolate(angle)) / self._integral

    def compute_cumulative(self, angle: npt.ArrayLike) -> FloatArray:
        """Compute the fraction of the light that is scattered by less than angles [rad]."""
        angles = np.asarray(angle, dtype=np.float64)
        log_angles, shares = self._cumulative_table
        valid_angles = np.clip(angles, MIN_ANGLE, math.pi)
        return np.where(angles > 0.0, np.interp(log(valid_angles), log_angles, shares), 0.0)

    def _find_errors(self) -> list[str]:
        """Return everything that is wrong with the rows, before anything is computed."""
        n_angles, n_values = len(self.angles), len(self.values)
        if n_angles != n_values:
            return [
                f"A phase function has {n_angles} angles and {n_values} values; expected one "
                "value for each angle."
            ]
        if not MIN_ROWS <= n_angles <= MAX_ROWS:
            return [f"A phase function has {n_angles} rows; expected {MIN_ROWS} to {MAX_ROWS}."]
        if not all(math.isfinite(number) for number in self.angles + self.values):
            return ["A phase function has a number that is not finite."]
        errors = []
        pairs = zip(self.angles, self.angles[1:], strict=False)
        for row, (angle, next_angle) in enumerate(pairs, start=2):
            if not angle < next_angle:
                errors.append(
                    f"Angle {row} of a phase function, {next_angle:g} rad, is not greater "
                    f"than the angle before it, {angle:g} rad."
                )
                break
        if not 0.0 <= self.angles[0] <= MAX_FIRST_ANGLE:
            errors.append(
                f"A phase function begins at {self.angles[0]:g} rad; expected 0 to "
                f"{MAX_FIRST_ANGLE:.4g} rad."
            )
        if not MIN_LAST_ANGLE <= self.angles[-1] <= math.pi + ANGLE_TOLERANCE:
            errors.append(
                f"A phase function ends at {self.angles[-1]:g} rad; expected "
                f"{MIN_LAST_ANGLE:.4g} to {math.pi:.5g} rad."
            )
        for value in (min(self.values), max(self.values)):
            if not MIN_VALUE <= value <= MAX_VALUE:
                errors.append(
                    f"A phase function has the value {value:g}; expected {MIN_VALUE:g} to "
                    f"{MAX_VALUE:g} 1/sr."
                )
                break
        return errors

    def _interpolate(self, angle: npt.ArrayLike) -> FloatArray:
        """Return ln p before its normalisation."""
        angles = np.clip(np.asarray(angle, dtype=np.float64), MIN_ANGLE, math.pi)
        log_values = log(np.array(self.values))
        if self.angles[0] < MIN_ANGLE:
            rows = np.array(self.angles[1:])
            interpolated_values = np.interp(log(angles), log(rows), log_values[1:])
            share = np.minimum(angles, rows[0]) / rows[0]
            start = log_values[0] + share * (log_values[1] - log_values[0])
            return np.where(angles < rows[0], start, interpolated_values)
        log_rows = log(np.array(self.angles))
        step = max(log_rows[1] - log_rows[0], MIN_LOG_STEP)
        slope = (log_values[1] - log_values[0]) / step
        slope = min(max(slope, STEEPEST_SLOPE), STEEPEST_RISE)
        start = log_values[0] + slope * (log(angles) - log_rows[0])
        interpolated_values = np.interp(log(angles), log_rows, log_values)
        return np.where(angles < self.angles[0], start, interpolated_values)

    @cached_property
    def _integral(self) -> float:
        """The integral of the values over all directions."""
        return float(self._raw_table[1][-1])

    @cached_property
    def _raw_table(self) -> tuple[FloatArray, FloatArray]:
        """The logarithms of angles, and the integrals of the values up to them."""
        log_angles = np.linspace(math.log(MIN_ANGLE), math.log(math.pi), N_ANGLES)
        angles = exp(log_angles)
        values = exp(self._interpolate(angles))
        rings = 2.0 * math.pi * values * np.sin(angles) * angles  # over the logarithm of the angle
        slope = float(log(rings[1] / rings[0])) / (log_angles[1] - log_angles[0])
        first = rings[0] / slope  # the power law below the first angle
        steps = 0.5 * (rings[1:] + rings[:-1]) * np.diff(log_angles)
        return log_angles, np.append(first, first + np.cumsum(steps))

    @cached_property
    def _cumulative_table(self) -> tuple[FloatArray, FloatArray]:
        """The logarithms of angles, and the shares of the light up to them."""
        log_angles, integrals = self._raw_table
        return log_angles, integrals / integrals[-1]
