r"""The estimate of a water from readings: a least-squares fit of a, b and the shape m.

.. math::
    \chi^2 = \sum_i \left( \frac{y_i - [\ell_i(a, b, m) - \ell_i(\text{reference})] + \ln G_k}
        {\sigma_i} \right)^2 + \left( \frac{m - 0.7}{0.5} \right)^2

with :math:`y = -\ln(S / S_{ref})` and the losses :math:`\ell` of `forward_model`. Readings without
a reference have :math:`y = -\ln(S / \gamma)`, no loss of the reference, and the unknown gain
:math:`G_k` of their source; the gain of readings with a reference is that of the reference.

The bounds are :math:`a \ge 0`, :math:`b \ge 0` and :math:`-0.3 \le m \le 1.5`. The standard
deviation :math:`\sigma` is that of noise, of the forward model, of the range and of the drift of
lamp and LED. The fit starts from b = 0.7 c and b = 0.8 c at the naive c and twice that; the best
minimum counts.

The covariance is that of noise and of the forward model, through the Jacobian, plus the shift of
the estimate by each systematic error: the attenuation of the reference water, the ranges, and the
drift of each source, in full.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from ..errors import BadSetting
from ..optics.phase_function import FloatArray
from .forward_model import ForwardModel, WaterNumbers
from .readings import LedReading, Reading

SHAPE_PRIOR = (0.7, 0.5)
"""The mean and the standard deviation of the shape m before any reading."""
SHAPE_LIMITS = (-0.3, 1.5)
MAX_ATTENUATION = 100.0
"""The upper bound of a and of b [1/m]."""
START_ALBEDOS = (0.7, 0.8)
START_FACTORS = (1.0, 2.0)
"""The factors of the naive beam attenuation at which the fit starts."""
MIN_READINGS = 3
MIN_BOARD_RANGES = 3
"""The least number of ranges of a board without a reference."""
MIN_LED_RANGES = 2
"""The least number of ranges of an LED without a reference."""
MIN_SPREAD = 0.05
"""The least difference of two ranges, relative to the greater, that counts as two."""
NAMES = ("absorption", "scattering", "shape")


@dataclass(frozen=True, kw_only=True)
class Accuracy:
    """The standard deviations of everything that noise does not include."""

    reference: float = 0.01
    """The standard deviation of the beam attenuation of the reference water [1/m]."""
    distance: float = 0.005
    """The standard deviation of a range, relative."""
    drift: float = 0.01
    """The standard deviation of the light between the reference and a reading, relative."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Estimate:
    """The water of one channel, with its uncertainty."""

    channel: str
    """The name of the channel."""
    water: WaterNumbers
    """The best numbers."""
    covariance: FloatArray
    """The covariance of a, b and m, (3, 3)."""
    chi_squared: float
    """The sum of the squared residuals of the readings, in standard deviations."""
    degrees_of_freedom: int
    """The number of readings less that of unknowns; the shape counts by its prior as none."""
    readings: tuple[Reading, ...]
    """The readings."""
    measured_losses: FloatArray
    """The measured y of each reading, (n,)."""
    fitted_losses: FloatArray
    """The fitted y of each reading, (n,)."""
    errors: FloatArray
    """The standard deviation of each y, (n,)."""
    naive_attenuation: float
    """The beam attenuation that a single reading gives if scattered light is ignored [1/m]."""
    gains: dict[str, float]
    """The gain of each source that has no reference."""

    @property
    def standard_deviations(self) -> dict[str, float]:
        """The standard deviations of a, b, m and c."""
        deviations = np.sqrt(np.diag(self.covariance))
        beam = float(np.sqrt(max(self.covariance[:2, :2].sum(), 0.0)))
        values = dict(zip(NAMES, map(float, deviations), strict=True))
        return {**values, "beam_attenuation": beam}

    @property
    def reduced_chi_squared(self) -> float:
        """The chi^2 of each degree of freedom."""
        return self.chi_squared / max(self.degrees_of_freedom, 1)


def estimate_water(
    readings: Sequence[Reading], reference: WaterNumbers, accuracy: Accuracy | None = None
) -> Estimate:
    """Estimate the water of one channel.

    Args:
        readings: the readings of the channel.
        reference: the reference water; its shape is ignored and taken as that of the water.
        accuracy: the errors besides noise; None: the defaults.

    Raises:
        BadSetting: the readings do not determine the water.
    """
    check_readings(readings)
    fit = _Fit(readings, reference, accuracy or Accuracy())
    first = fit.run(depth=None)
    return fit.run(depth=first.water.beam_attenuation)


def check_readings(readings: Sequence[Reading]) -> None:
    """Raise BadSetting if readings do not determine the water."""
    if not readings:
        raise BadSetting("There is no reading.")
    channel = readings[0].channel
    n_unknowns = 2 + len(_sources_without_reference(readings))
    if len(readings) < max(MIN_READINGS, n_unknowns):
        raise BadSetting(
            f"Channel {channel!r} has {len(readings)} readings; expected at least "
            f"{max(MIN_READINGS, n_unknowns)}."
        )
    for reading in readings:
        if not reading.signal > 0.0 or not (reading.reference is None or reading.reference > 0.0):
            raise BadSetting(
                f"Channel {channel!r}, {reading.label}: the signal is not positive; remove it."
            )
    if all(reading.reference is None for reading in readings):
        counts = {
            source: _count_ranges([r for r in readings if r.source == source])
            for source in _sources_without_reference(readings)
        }
        required_counts = {
            reading.source: MIN_LED_RANGES if isinstance(reading, LedReading) else MIN_BOARD_RANGES
            for reading in readings
        }
        if not any(counts[source] >= required_counts[source] for source in counts):
            raise BadSetting(
                f"Channel {channel!r} has no reference water, and no source at enough ranges; "
                f"expected a reference, a board at {MIN_BOARD_RANGES} ranges, or an LED at "
                f"{MIN_LED_RANGES}."
            )


def _sources_without_reference(readings: Sequence[Reading]) -> list[str]:
    return sorted({reading.source for reading in readings if reading.reference is None})


def _count_ranges(readings: Sequence[Reading]) -> int:
    """Count the ranges that differ by more than `MIN_SPREAD`."""
    count, last_distance = 0, 0.0
    for distance in sorted(reading.distance for reading in readings):
        if distance * (1.0 - MIN_SPREAD) > last_distance:
            count, last_distance = count + 1, distance
    return count


class _Fit:
    """The least-squares problem of one channel."""

    def __init__(
        self, readings: Sequence[Reading], reference: WaterNumbers, accuracy: Accuracy
    ) -> None:
        self._readings = tuple(readings)
        self._reference = reference
        self._accuracy = accuracy
        self._model = ForwardModel.from_readings(readings)
        self._sources = _sources_without_reference(readings)
        self._has_reference = np.array([r.reference is not None for r in readings])
        self._measured_losses = np.array([_measure_loss(reading) for reading in readings])
        self._gain_columns = (
            np.array(
                [[float(r.source == source) for source in self._sources] for r in readings]
            ).reshape(len(readings), len(self._sources))
            * ~self._has_reference[:, None]
        )
        self._noise = np.array([reading.noise for reading in readings])
        self._set_errors(1.0)

    def run(self, depth: float | None) -> Estimate:
        """Fit, with the errors of the forward model at a beam attenuation [1/m]."""
        naive_attenuation = self._estimate_naively()
        attenuation = naive_attenuation if depth is None else depth
        self._set_errors(attenuation)
        solutions = []
        for factor, albedo in itertools.product(START_FACTORS, START_ALBEDOS):
            start = self._make_start(factor * naive_attenuation, albedo)
            solutions.append(
                least_squares(
                    self._compute_residuals,
                    start,
                    bounds=self._bounds,
                    x_scale="jac",
                    xtol=1e-12,
                    ftol=1e-12,
                    gtol=1e-12,
                )
            )
        best_solution = min(solutions, key=lambda solution: float(solution.cost))
        return self._summarise(np.asarray(best_solution.x), naive_attenuation)

    @property
    def _bounds(self) -> tuple[list[float], list[float]]:
        n_gains = len(self._sources)
        low = [0.0, 0.0, SHAPE_LIMITS[0], *[-np.inf] * n_gains]
        high = [MAX_ATTENUATION, MAX_ATTENUATION, SHAPE_LIMITS[1], *[np.inf] * n_gains]
        return low, high

    def _estimate_naively(self) -> float:
        """Return the beam attenuation of the narrowest reading if scattered light is ignored."""
        leds = [i for i, r in enumerate(self._readings) if isinstance(r, LedReading)]
        candidates = leds or list(range(len(self._readings)))
        with_reference = [i for i in candidates if self._has_reference[i]]
        lengths = self._model.path_lengths
        if with_reference:
            index = min(with_reference, key=lambda i: _size_of(self._readings[i]))
            added_attenuation = float(self._measured_losses[index] / lengths[index])
            return max(added_attenuation + self._reference.beam_attenuation, 0.01)
        lengths, losses = lengths[candidates], self._measured_losses[candidates]
        if np.ptp(lengths) <= MIN_SPREAD * np.max(lengths):  # no line is determined
            return max(float(np.mean(losses) / np.mean(lengths)), 0.01)
        return max(float(np.polyfit(lengths, losses, 1)[0]), 0.01)

    def _make_start(self, attenuation: float, albedo: float) -> FloatArray:
        water = WaterNumbers((1.0 - albedo) * attenuation, albedo * attenuation, SHAPE_PRIOR[0])
        rest = self._model.compute_losses(water) - self._measured_losses
        gains = [float(np.mean(rest[column > 0.0])) for column in self._gain_columns.T]
        start = np.array([water.absorption, water.scattering, water.shape, *gains])
        start[:2] = np.clip(start[:2], 1e-6, MAX_ATTENUATION - 1e-6)
        return start

    def _set_errors(self, attenuation: float) -> None:
        """Set the standard deviations of all y for a beam attenuation [1/m]."""
        common_error = np.hypot(2.0 * self._accuracy.distance, self._accuracy.drift)
        self._model_errors = np.array(
            [r.estimate_model_error(attenuation * r.distance) for r in self._readings]
        )
        self._errors = np.sqrt(self._noise**2 + self._model_errors**2 + common_error**2)

    def _compute_fitted_losses(self, parameters: FloatArray, reference: WaterNumbers) -> FloatArray:
        a, b, m = parameters[:3]
        losses = self._model.compute_losses(WaterNumbers(a, b, m))
        same_shape = WaterNumbers(reference.absorption, reference.scattering, m)
        reference_losses = self._model.compute_losses(same_shape)
        fitted_losses: FloatArray = losses - np.where(self._has_reference, reference_losses, 0.0)
        if self._sources:
            fitted_losses = fitted_losses - self._gain_columns @ parameters[3:]
        return fitted_losses

    def _compute_residuals(self, parameters: FloatArray) -> FloatArray:
        fitted_losses = self._compute_fitted_losses(parameters, self._reference)
        prior = (parameters[2] - SHAPE_PRIOR[0]) / SHAPE_PRIOR[1]
        return np.append((self._measured_losses - fitted_losses) / self._errors, prior)

    def _summarise(self, parameters: FloatArray, naive_attenuation: float) -> Estimate:
        residuals = self._compute_residuals(parameters)
        n_unknowns = 2 + len(self._sources)
        return Estimate(
            channel=self._readings[0].channel,
            water=WaterNumbers(*(float(value) for value in parameters[:3])),
            covariance=self._compute_covariance(parameters)[:3, :3],
            chi_squared=float(np.sum(residuals**2)),
            degrees_of_freedom=len(self._readings) - n_unknowns,
            readings=self._readings,
            measured_losses=self._measured_losses,
            fitted_losses=self._compute_fitted_losses(parameters, self._reference),
            errors=self._errors,
            naive_attenuation=naive_attenuation,
            gains={
                source: float(np.exp(value))
                for source, value in zip(self._sources, parameters[3:], strict=True)
            },
        )

    def _compute_covariance(self, parameters: FloatArray) -> FloatArray:
        """Return the covariance of the parameters, with the systematic errors."""
        columns = []
        for index in range(len(parameters)):
            step = np.zeros(len(parameters))
            step[index] = 1e-5
            low = np.maximum(parameters - step, [0.0, 0.0, *[-np.inf] * (len(parameters) - 2)])
            high = low + 2.0 * step
            difference = self._compute_residuals(high) - self._compute_residuals(low)
            columns.append(difference / 2e-5)
        jacobian = np.stack(columns, axis=1)
        # The errors include those that all readings of a source share, which are added in full.
        independent = np.hypot(self._noise, self._model_errors) / self._errors
        inverse = np.linalg.pinv(jacobian.T @ jacobian)
        projection = inverse @ jacobian.T
        covariance = (projection * np.append(independent, 1.0) ** 2) @ projection.T
        for change in self._list_systematic_changes(parameters):
            residuals = np.append(change / self._errors, 0.0)
            shift = projection @ residuals
            covariance = covariance + np.outer(shift, shift)
        return np.asarray(covariance)

    def _list_systematic_changes(self, parameters: FloatArray) -> list[FloatArray]:
        """Return the change of every y by one standard deviation of each systematic error."""
        accuracy, reference = self._accuracy, self._reference
        wrong_reference = WaterNumbers(
            reference.absorption + accuracy.reference, reference.scattering, reference.shape
        )
        changes = [
            self._compute_fitted_losses(parameters, wrong_reference)
            - self._compute_fitted_losses(parameters, reference)
        ]
        fitted_losses = self._compute_fitted_losses(parameters, reference)
        geometric = np.where(self._has_reference, 0.0, 2.0)
        for source in sorted({reading.source for reading in self._readings}):
            is_source = np.array([reading.source == source for reading in self._readings])
            drift = np.where(self._has_reference, accuracy.drift, 0.0)
            changes.append(is_source * drift)
            changes.append(is_source * accuracy.distance * (np.abs(fitted_losses) + geometric))
        for distance in sorted({r.distance for r in self._readings if r.reference is None}):
            is_group = np.array(
                [r.distance == distance and r.reference is None for r in self._readings]
            )
            changes.append(is_group * np.hypot(accuracy.drift, 2.0 * accuracy.distance))
        return changes


def _size_of(reading: Reading) -> float:
    size = getattr(reading, "half_angle", None)
    return float(size if size is not None else getattr(reading, "side", 0.0))


def _measure_loss(reading: Reading) -> float:
    """Return y, the loss of ln(signal): against the reference, or with the geometry removed."""
    if reading.reference is not None:
        return -float(np.log(reading.signal / reading.reference))
    return -float(np.log(reading.signal / reading.geometry))
