"""The rate over a step: it solves the midpoint rule, and never gains energy."""

from __future__ import annotations

import numpy as np
import pytest

from tests.physics.fossen import skew
from uwsim.physics.hydrodynamics.kernel import midpoint as mp

STEP = 0.01  # [s]


def by_momentum(p: np.ndarray) -> np.ndarray:
    """The matrix of twist x* p, rotational part first."""
    return np.block([[-skew(p[:3]), -skew(p[3:])], [-skew(p[3:]), np.zeros((3, 3))]])


def solved(
    inertia: np.ndarray, drag: np.ndarray, twist: np.ndarray, wrench: np.ndarray
) -> np.ndarray:
    """The rate under a wrench, without the gyroscopic terms in it."""
    b = np.zeros(mp.NUMBERS)
    momentum = inertia @ twist
    b[mp.INERTIA : mp.INERTIA + 36] = inertia.ravel()
    b[mp.SUM : mp.SUM + 36] = (inertia + drag).ravel()
    b[mp.TWIST : mp.TWIST + 6] = twist
    b[mp.MOMENTUM : mp.MOMENTUM + 6] = momentum
    b[mp.FORCE : mp.FORCE + 6] = wrench - by_momentum(momentum) @ twist
    mp.solve_rate(b, STEP)
    return b[mp.RATE : mp.RATE + 6].copy()


def a_body(random: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Inertia and implicit drag of a body of any shape, thin ones as well."""
    axes = np.linalg.qr(random.normal(size=(6, 6)))[0]
    inertia = axes @ np.diag(10.0 ** random.uniform(-6, 1, 6)) @ axes.T
    return inertia, np.diag(10.0 ** random.uniform(-6, 1, 6))


@pytest.mark.parametrize("seed", range(5))
def test_the_midpoint_rule_holds_with_drag_in_the_sum_and_not_in_the_momentum(seed: int) -> None:
    random = np.random.default_rng(seed)
    inertia, drag = a_body(random)
    twist, wrench = 0.1 * random.normal(size=6), 0.1 * random.normal(size=6)
    wrench = (inertia + drag) @ wrench
    rate = solved(inertia, drag, twist, wrench)
    middle = twist + 0.5 * STEP * rate
    left = (inertia + drag) @ rate + by_momentum(inertia @ middle) @ middle - wrench
    assert np.abs(left).max() < 1e-6 * np.abs(wrench).max()


@pytest.mark.parametrize("spin", [1.0, 100.0, 10_000.0])
@pytest.mark.parametrize("seed", range(5))
def test_no_body_gains_energy_however_fast_it_turns(seed: int, spin: float) -> None:
    random = np.random.default_rng(seed)
    inertia, drag = a_body(random)
    twist, wrench = spin * random.normal(size=6), random.normal(size=6)
    rate = solved(inertia, drag, twist, wrench)
    middle = twist + 0.5 * STEP * rate
    gained, work = middle @ (inertia + drag) @ rate, middle @ wrench
    scale = np.abs(middle) @ np.abs(inertia + drag) @ np.abs(rate)
    assert abs(gained - work) < 1e-6 * scale
