r"""An estimated water in the units of its users, with intervals from samples.

1000 waters are drawn from the covariance of a, b and m. Every quantity is computed for each; its
interval is from the 2.5th to the 97.5th percentile. Kirk's diffuse attenuation and Preisendorfer's
Secchi depth have a relative error of 10 % of their own, which is drawn as well. Drawn coefficients
below zero count as zero, and the shape is limited to 0..1 and rounded to 1/16.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..base.rng import stream
from ..optics import Medium
from ..optics.conversions import FORMULA_ERROR
from ..optics.medium import MAX_CHANNELS
from ..optics.phase_function import FloatArray
from ..optics.visibility import (
    compute_fog_density,
    compute_secchi_depth,
    compute_transfer,
    compute_visual_range,
    find_feature_frequency,
)
from .estimate import Estimate
from .forward_model import make_phase_function

N_SAMPLES = 1000
PERCENTILES = (2.5, 97.5)
N_SHAPES = 16
"""The number of steps of the shape from 0 to 1."""
CONTRAST_FREQUENCIES = (100.0, 10.0, 1.0)
"""The scales at which the contrast is reported [cycles/rad]."""


@dataclass(frozen=True, kw_only=True)
class View:
    """The conditions in which a water is judged; the defaults are those of the paper's tracker."""

    distance: float = 1.36
    """The range of the target [m]."""
    feature_width: float = 0.02
    """The width of the features that an algorithm needs [m]."""


@dataclass(frozen=True, kw_only=True)
class Quantity:
    """A number with its unit and 95 % interval."""

    name: str
    """The name, with its conditions."""
    unit: str
    """The unit; empty for a pure number."""
    value: float
    """The value for the best estimate."""
    low: float
    """The lower limit of the interval."""
    high: float
    """The upper limit of the interval."""


Function = Callable[[Medium], FloatArray]
"""A quantity of each channel of a medium, (n,)."""


def convert_estimate(estimate: Estimate, view: View, *, seed: int = 0) -> tuple[Quantity, ...]:
    """Convert an estimate to the quantities of its users.

    Args:
        estimate: the water of one channel.
        view: the distance and the scale of contrast and fog.
        seed: the seed of the samples.
    """
    generator = stream(seed, f"calibrate/{estimate.channel}/water")
    samples = draw_samples(estimate, generator)
    best_numbers = np.array(
        [[getattr(estimate.water, n) for n in ("absorption", "scattering", "shape")]]
    )
    quantities = [
        _summarise("shape m of the phase function", "", best_numbers[0, 2], samples[:, 2]),
    ]
    valid_samples = samples.copy()
    valid_samples[:, :2] = np.maximum(valid_samples[:, :2], 0.0)
    valid_samples[:, 2] = np.round(np.clip(valid_samples[:, 2], 0.0, 1.0) * N_SHAPES) / N_SHAPES
    for name, unit, formula_error, function in _list_functions(view):
        values = _evaluate(function, valid_samples)
        if formula_error > 0.0:
            values = values * (1.0 + formula_error * generator.standard_normal(N_SAMPLES))
        quantities.append(
            _summarise(name, unit, float(_evaluate(function, best_numbers)[0]), values)
        )
    return tuple(quantities)


def draw_samples(estimate: Estimate, generator: np.random.Generator) -> FloatArray:
    """Draw waters from the covariance of an estimate: a, b and m, (`N_SAMPLES`, 3)."""
    water = estimate.water
    means = np.array([water.absorption, water.scattering, water.shape])
    # A triangular root of the covariance; a tiny diagonal keeps it positive.
    root = np.linalg.cholesky(estimate.covariance + 1e-15 * np.eye(3))
    samples: FloatArray = means + generator.standard_normal((N_SAMPLES, 3)) @ root.T
    return samples


def _list_functions(view: View) -> list[tuple[str, str, float, Function]]:
    distance = view.distance
    frequency = find_feature_frequency(view.feature_width, distance)
    at_distance = f"at {distance:g} m"
    detail = f"features of {view.feature_width * 100:g} cm {at_distance}"
    rows: list[tuple[str, str, float, Function]] = [
        ("beam attenuation c", "1/m", 0.0, lambda w: w.beam_attenuation),
        ("scattering b", "1/m", 0.0, lambda w: np.array(w.scattering)),
        ("absorption a", "1/m", 0.0, lambda w: np.array(w.absorption)),
        ("attenuation length 1/c", "m", 0.0, lambda w: w.attenuation_length),
        (
            f"contrast of the sharpest detail {at_distance}",
            "",
            0.0,
            lambda w: compute_transfer(w, distance),
        ),
    ]
    rows += [
        (
            f"contrast of {scale:g} cycles/rad {at_distance}",
            "",
            0.0,
            partial(compute_transfer, distance=distance, frequency=scale),
        )
        for scale in CONTRAST_FREQUENCIES
    ]
    rows += [
        (
            f"UWSim fog, sharpest detail {at_distance}",
            "1/m",
            0.0,
            lambda w: compute_fog_density(w, distance),
        ),
        (
            f"UWSim fog, {detail}",
            "1/m",
            0.0,
            lambda w: compute_fog_density(w, distance, frequency),
        ),
        ("diffuse attenuation Kd", "1/m", FORMULA_ERROR, lambda w: w.diffuse_attenuation),
        ("visual range of a black target", "m", 0.0, compute_visual_range),
        ("Secchi depth", "m", FORMULA_ERROR, compute_secchi_depth),
    ]
    return rows


def _evaluate(function: Function, samples: FloatArray) -> FloatArray:
    """Evaluate a function of a medium for waters, (n, 3), in groups of one shape."""
    values = np.zeros(len(samples))
    for shape in np.unique(samples[:, 2]):
        indices = np.flatnonzero(samples[:, 2] == shape)
        for start in range(0, len(indices), MAX_CHANNELS):
            group = indices[start : start + MAX_CHANNELS]
            medium = Medium(
                absorption=tuple(samples[group, 0].tolist()),
                scattering=tuple(samples[group, 1].tolist()),
                phase_function=make_phase_function(float(shape)),
            )
            values[group] = function(medium)
    return values


def _summarise(name: str, unit: str, value: float, samples: FloatArray) -> Quantity:
    low, high = np.percentile(samples, PERCENTILES)
    return Quantity(name=name, unit=unit, value=float(value), low=float(low), high=float(high))
