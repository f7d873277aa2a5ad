"""The attribution of a residual: what is evident, and what no coefficient explains."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from uwsim.reality_gap.attribution import Cause, attribute_residual
from uwsim.reality_gap.coefficients import Coefficient, describe_clock

RNG = np.random.default_rng(5)
EFFECTS = {"drag": RNG.standard_normal((60, 6)), "mass": RNG.standard_normal((60, 6))}
COEFFICIENTS = [
    Coefficient(key=key, name=key, change=lambda dynamics, factor: dynamics, advice="")
    for key in EFFECTS
]


def simulate(changes: Sequence[tuple[Coefficient, float]]) -> np.ndarray:
    """Return twists that are linear in the factors."""
    twists = np.ones((60, 6))
    for coefficient, factor in changes:
        twists = twists + (factor - 1.0) * EFFECTS[coefficient.key]
    return twists


def attribute(measurements: np.ndarray) -> tuple[Cause | None, float]:
    result = attribute_residual(measurements, COEFFICIENTS, simulate, duration=1.0, block=1, seed=0)
    return result.evident_cause, result.unexplained_share


def test_a_coefficient_that_explains_most_of_the_error_is_evident() -> None:
    noise = 0.1 * np.random.default_rng(1).standard_normal((60, 6))
    cause, rest = attribute(simulate([(COEFFICIENTS[0], 1.3)]) + noise)
    assert cause is not None
    assert cause.factor == pytest.approx(1.3, abs=0.03)
    assert cause.share + rest == pytest.approx(1.0)


def test_a_coefficient_that_explains_a_third_of_the_error_is_not_evident() -> None:
    noise = np.random.default_rng(1).standard_normal((60, 6))
    cause, rest = attribute(simulate([(COEFFICIENTS[0], 1.7)]) + noise)
    assert cause is None
    assert 0.5 < rest < 0.8


@pytest.mark.parametrize(
    ("low", "high", "is_clock", "is_evident"),
    [
        (1.2, 1.4, False, True),
        (0.2, 0.6, False, True),
        (-0.4, 0.56, False, False),  # a negative lag
        (0.9, 1.2, False, False),  # no change
        (None, None, False, False),
        (-0.1, 0.6, True, True),  # the shift of a clock may be large
    ],
)
def test_an_interval_that_has_1_or_an_impossible_value_is_no_evidence(
    low: float | None, high: float | None, is_clock: bool, is_evident: bool
) -> None:
    cause = Cause(
        coefficient=describe_clock("thrusters") if is_clock else COEFFICIENTS[0],
        factor=0.5,
        low=low,
        high=high,
        share=0.9,
        confidence=1.0,
        equivalents=(),
    )
    assert cause.is_evident is is_evident
