"""The short formulas of shaders against the phase functions that they stand for."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.optics import (
    FournierForand,
    HenyeyGreenstein,
    PhaseFunction,
    SmallAngleTerms,
    fit_backward_cubic,
    fit_encircled_terms,
    fit_transform_terms,
)

MODELS = [
    HenyeyGreenstein(0.9),
    HenyeyGreenstein(0.95),
    HenyeyGreenstein(0.8),
    FournierForand(),
    FournierForand(1.15, 4.0),
    FournierForand(1.05, 3.3),
]
FREQUENCIES = np.geomspace(0.15, 200.0, 101)  # [cycles/rad]
ANGLES = np.geomspace(1e-3, math.radians(30.0), 101)  # [rad]
REFERENCE_TERMS = SmallAngleTerms(weights=(0.127, 0.341, 0.517), angles=(0.0009, 0.0141, 0.093))
"""The terms of Fournier and Forand's default in the reference tables of this project."""


@pytest.mark.parametrize("phase", MODELS, ids=str)
def test_the_terms_give_the_transform(phase: PhaseFunction) -> None:
    terms = fit_transform_terms(phase)
    assert 1 <= len(terms.weights) <= 3
    np.testing.assert_allclose(
        terms.compute_transform(FREQUENCIES), phase.compute_transform(FREQUENCIES), atol=0.003
    )


@pytest.mark.parametrize("phase", MODELS, ids=str)
def test_the_terms_give_the_encircled_energy(phase: PhaseFunction) -> None:
    terms = fit_encircled_terms(phase)
    np.testing.assert_allclose(
        terms.compute_encircled_energy(ANGLES), phase.compute_encircled_energy(ANGLES), atol=0.004
    )


def test_the_fit_agrees_with_the_published_terms() -> None:
    terms = fit_transform_terms(FournierForand())
    frequencies = FREQUENCIES[FREQUENCIES > 0.3]
    np.testing.assert_allclose(
        terms.compute_transform(frequencies),
        REFERENCE_TERMS.compute_transform(frequencies),
        atol=0.006,
    )


def test_henyey_and_greenstein_needs_one_large_term_at_its_angle() -> None:
    terms = fit_encircled_terms(HenyeyGreenstein(0.9))
    assert terms.angles[0] == pytest.approx(0.1 / math.sqrt(0.9), rel=0.01)


@pytest.mark.parametrize("phase", MODELS, ids=str)
def test_the_cubic_gives_the_backward_density(phase: PhaseFunction) -> None:
    cosines = np.linspace(-1.0, math.cos(math.radians(75.0)), 100)
    density = phase.compute_density(np.arccos(cosines))
    cubic = np.exp(np.polyval(fit_backward_cubic(phase), cosines))
    np.testing.assert_allclose(cubic, density, rtol=0.006)


@pytest.mark.parametrize(
    ("phase", "reference_cubic"),
    [
        (HenyeyGreenstein(0.9), (0.2098, 0.6724, 1.5020, -5.0793)),
        (FournierForand(), (0.0441, 1.1578, 1.4895, -5.4774)),
    ],
    ids=str,
)
def test_the_cubic_agrees_with_the_published_one(
    phase: PhaseFunction, reference_cubic: tuple[float, ...]
) -> None:
    cosines = np.linspace(-1.0, math.cos(math.radians(75.0)), 100)
    difference = np.polyval(fit_backward_cubic(phase), cosines) - np.polyval(
        reference_cubic, cosines
    )
    np.testing.assert_allclose(difference, 0.0, atol=0.012)


def test_a_fit_is_the_same_each_time() -> None:
    assert fit_transform_terms(FournierForand()) == fit_transform_terms(FournierForand())
