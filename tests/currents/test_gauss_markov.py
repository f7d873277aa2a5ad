"""Gauss-Markov: its statistics are what the file says, whatever the step."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.base.rng import stream
from uwsim.currents import Current, GaussMarkov, GaussMarkovSpec, SceneContext

ORIGIN = np.zeros((1, 3))


def context(seed: int = 0) -> SceneContext:
    return SceneContext(stream=lambda name: stream(seed, name))


def wandering(seed: int = 0, **other: object) -> GaussMarkov:
    values = {"deviation": (0.1, 0.1, 0.1), "mu": 0.5, "step": 0.1, **other}
    return GaussMarkovSpec(**values).bind(context(seed))  # type: ignore[arg-type]


def samples(current: Current, n: int, step: float) -> np.ndarray:
    return np.array([current.velocity(ORIGIN, k * step)[0] for k in range(n)])


@pytest.mark.parametrize("step", [pytest.param(0.05, marks=pytest.mark.slow), 0.2, 1.0])
def test_neither_deviation_nor_memory_depends_on_the_step(step: float) -> None:
    current = wandering(step=step)
    v = samples(current, 8_000, 1.0)  # at nodes of every step
    correlation = np.mean(v[1:] * v[:-1]) / np.mean(v * v)
    # standard errors of 3 x 8 000 samples with memory: 0.7 % and 0.005
    assert np.std(v) == pytest.approx(0.1, rel=0.02)
    assert correlation == pytest.approx(math.exp(-0.5), abs=0.015)


def test_from_one_step_to_the_next_it_remembers_e_to_the_minus_mu_dt() -> None:
    v = samples(wandering(step=0.1), 15_000, 0.1)
    correlation = np.mean(v[1:] * v[:-1]) / np.mean(v * v)
    assert correlation == pytest.approx(math.exp(-0.05), abs=0.003)


def test_it_begins_in_its_stationary_state() -> None:
    first = np.array([samples(wandering(seed), 1, 1.0)[0] for seed in range(1000)])
    assert np.std(first) == pytest.approx(0.1, rel=0.04)
    assert np.mean(first) == pytest.approx(0.0, abs=0.008)


def test_it_wanders_about_its_mean_and_not_about_zero() -> None:
    v = samples(wandering(mean=(0.2, -0.1, 0.0), deviation=(0.02, 0.0, 0.01)), 10_000, 1.0)
    assert np.mean(v, axis=0) == pytest.approx([0.2, -0.1, 0.0], abs=0.001)
    assert np.std(v, axis=0) == pytest.approx([0.02, 0.0, 0.01], rel=0.03)


def test_between_two_steps_it_runs_straight_and_exerts_no_inertial_force() -> None:
    current = wandering(step=0.5)
    a, half, b = (current.velocity(ORIGIN, t) for t in (3.0, 3.25, 3.5))
    assert half == pytest.approx((a + b) / 2.0)
    assert not current.acceleration(ORIGIN, 3.1).any()


def test_the_axes_know_nothing_of_each_other() -> None:
    v = samples(wandering(step=1.0), 8_000, 2.0)
    assert np.corrcoef(v.T) == pytest.approx(np.eye(3), abs=0.05)


def test_it_answers_the_same_in_any_order() -> None:
    late_first = wandering()
    late = late_first.velocity(ORIGIN, 700.03)
    early = late_first.velocity(ORIGIN, 0.4)
    early_first = wandering()
    assert (early_first.velocity(ORIGIN, 0.4) == early).all()
    assert (early_first.velocity(ORIGIN, 700.03) == late).all()
