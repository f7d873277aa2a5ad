r"""A measured water in the units of its users, with standard deviations.

The standard deviation of a quantity :math:`q(c, b)` is that of its linear approximation,

.. math::
    s^2 = J \, \Sigma \, J^T + (f q)^2, \quad
    J = (\partial q/\partial c, \partial q/\partial b)

with the covariance :math:`\Sigma` of beam attenuation and scattering, and the relative error
:math:`f` of the formula itself: 10 % for diffuse attenuation and Secchi depth. For small errors it
agrees with the formulas that are usually quoted, such as :math:`s_c / (2 c)` for the fog density.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from ..errors import BadSetting, ErrorCollector
from .lamp_light import Lamp
from .medium import PETZOLD_AVERAGE, Medium
from .phase_function import PhaseFunction
from .visibility import (
    compute_fog_density,
    compute_lamp_range,
    compute_secchi_depth,
    compute_transfer,
    compute_visual_range,
    find_feature_frequency,
)

FORMULA_ERROR = 0.1
"""The relative error of Kirk's and of Preisendorfer's formula."""
DIFFERENCE = 1e-4
"""The relative difference of coefficients by which derivatives are computed."""

Covariance = tuple[tuple[float, float], tuple[float, float]]


@dataclass(frozen=True, kw_only=True)
class WaterEstimate:
    """A measured water in one channel."""

    beam_attenuation: float
    """The beam attenuation c [1/m]."""
    scattering: float
    """The scattering coefficient b [1/m], at most c."""
    covariance: Covariance = ((0.0, 0.0), (0.0, 0.0))
    """The covariance of c and b [1/m^2]."""
    phase_function: PhaseFunction = PETZOLD_AVERAGE
    """The phase function."""

    def __post_init__(self) -> None:
        errors = ErrorCollector()
        with errors.collect():
            self.make_medium(self.beam_attenuation, self.scattering)
        (variance_c, covariance), (mirrored_covariance, variance_b) = self.covariance
        with errors.collect():
            if not (
                variance_c >= 0.0
                and variance_b >= 0.0
                and covariance == mirrored_covariance
                and covariance**2 <= variance_c * variance_b * (1.0 + 1e-9)
            ):
                raise BadSetting(
                    f"{self.covariance} is no covariance of two coefficients; expected a symmetric "
                    "matrix without negative eigenvalues."
                )
        errors.raise_errors()

    def make_medium(self, beam_attenuation: float, scattering: float) -> Medium:
        """Return a medium of one channel with this phase function."""
        return Medium.from_beam_attenuation([beam_attenuation], [scattering], self.phase_function)


@dataclass(frozen=True, kw_only=True)
class View:
    """The conditions in which a water is judged; the defaults are those of the paper's tracker."""

    distance: float = 1.36
    """The range of the target [m]."""
    feature_width: float = 0.02
    """The width of the features that an algorithm needs [m]."""
    lamp: Lamp = field(
        default_factory=lambda: Lamp(
            position=(0.3, 0.0, 0.0),
            direction=(0.0, 0.0, 1.0),
            intensity=(1.0,),
            half_angle=math.radians(30.0),
        )
    )
    """The lamp of the vehicle, in the frame of its camera, which looks along z."""
    min_contrast: float = 0.05
    """The smallest contrast that an algorithm needs."""


@dataclass(frozen=True, kw_only=True)
class Quantity:
    """A number with its unit and standard deviation."""

    name: str
    """The name of the quantity, with its conditions."""
    value: float
    """The value; infinite where there is no limit."""
    standard_deviation: float
    """The standard deviation, in the unit of the value."""
    unit: str
    """The unit; empty for a pure number."""


def convert_water(estimate: WaterEstimate, view: View | None = None) -> tuple[Quantity, ...]:
    """Convert a measured water to the quantities of its users.

    Args:
        estimate: the water, in one channel.
        view: the distance, feature, lamp and contrast; None gives the defaults.
    """
    conditions = View() if view is None else view
    distance, lamp = conditions.distance, conditions.lamp
    frequency = find_feature_frequency(conditions.feature_width, distance)
    detail = f"{frequency:.3g} cycles/rad at {distance:g} m"
    sharpest_detail = f"sharpest detail at {distance:g} m"
    rows: tuple[tuple[str, str, float, Callable[[Medium], float]], ...] = (
        ("beam attenuation c", "1/m", 0.0, lambda w: float(w.beam_attenuation[0])),
        ("scattering b", "1/m", 0.0, lambda w: w.scattering[0]),
        ("absorption a", "1/m", 0.0, lambda w: w.absorption[0]),
        ("attenuation length", "m", 0.0, lambda w: float(w.attenuation_length[0])),
        (
            f"contrast left, {sharpest_detail}",
            "",
            0.0,
            lambda w: float(compute_transfer(w, distance)[0]),
        ),
        (
            f"contrast left, {detail}",
            "",
            0.0,
            lambda w: float(compute_transfer(w, distance, frequency)[0]),
        ),
        (
            f"UWSim fog density, {sharpest_detail}",
            "1/m",
            0.0,
            lambda w: float(compute_fog_density(w, distance)[0]),
        ),
        (
            f"UWSim fog density, {detail}",
            "1/m",
            0.0,
            lambda w: float(compute_fog_density(w, distance, frequency)[0]),
        ),
        (
            "diffuse attenuation Kd",
            "1/m",
            FORMULA_ERROR,
            lambda w: float(w.diffuse_attenuation[0]),
        ),
        ("visual range of a black target", "m", 0.0, lambda w: float(compute_visual_range(w)[0])),
        ("Secchi depth", "m", FORMULA_ERROR, lambda w: float(compute_secchi_depth(w)[0])),
        (
            f"range in the light of the lamp, contrast {conditions.min_contrast:g}",
            "m",
            0.0,
            lambda w: float(compute_lamp_range(w, lamp, conditions.min_contrast)[0]),
        ),
    )
    return tuple(
        Quantity(
            name=name,
            value=function(estimate.make_medium(estimate.beam_attenuation, estimate.scattering)),
            standard_deviation=propagate_error(estimate, function, formula_error=formula_error),
            unit=unit,
        )
        for name, unit, formula_error, function in rows
    )


def propagate_error(
    estimate: WaterEstimate,
    function: Callable[[Medium], float],
    *,
    formula_error: float = 0.0,
) -> float:
    """Compute the standard deviation of a function of a measured water.

    Args:
        estimate: the water, in one channel.
        function: the quantity of a medium of one channel.
        formula_error: the relative error of the formula itself.
    """
    c, b = estimate.beam_attenuation, estimate.scattering
    value = function(estimate.make_medium(c, b))
    if not math.isfinite(value):
        return math.inf
    step = DIFFERENCE * c
    # One-sided where b would leave 0..c.
    low_b, high_b = max(b - step, 0.0), min(b + step, c)
    low_c, high_c = max(c - step, b), c + step
    slope_c = _difference(estimate, function, ((low_c, b), (high_c, b)), high_c - low_c)
    slope_b = _difference(estimate, function, ((c, low_b), (c, high_b)), high_b - low_b)
    (variance_c, covariance), (_, variance_b) = estimate.covariance
    variance = (
        slope_c * slope_c * variance_c
        + 2.0 * slope_c * slope_b * covariance
        + slope_b * slope_b * variance_b
    )
    return math.sqrt(max(variance, 0.0) + (formula_error * value) ** 2)


def _difference(
    estimate: WaterEstimate,
    function: Callable[[Medium], float],
    ends: tuple[tuple[float, float], tuple[float, float]],
    step: float,
) -> float:
    """Compute the quotient of differences between two pairs of coefficients c and b."""
    low, high = (function(estimate.make_medium(c, b)) for c, b in ends)
    return (high - low) / step if step > 0.0 else 0.0
