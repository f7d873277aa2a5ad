"""Errors of inertial sensors have the Allan deviations of their specification."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from uwsim.base import rng
from uwsim.base.numerics.jit import njit
from uwsim.sensors.drift import FLOOR, PEAK, Drift, DriftSpec, draw_errors

RATE = 10.0


@njit
def draw(drifts: Any, time: float) -> tuple[np.ndarray, float]:
    errors = np.empty(3)
    variance = draw_errors(drifts[0], time, errors)
    return errors, variance


def errors(n: int, **fields: float) -> np.ndarray:
    """Errors of three axes at `RATE`, (n, 3)."""
    drift = Drift(DriftSpec(**fields), rng.stream(1, "test"))
    return np.array([draw(drift.parameters, (k + 1) / RATE)[0] for k in range(n)])


def allan(series: np.ndarray, m: int) -> np.ndarray:
    """Overlapping Allan deviation of columns (n, k) over m samples, (k,) (IEEE Std 952, C.1)."""
    sums = np.cumsum(np.vstack([np.zeros(series.shape[1]), series]), axis=0)
    means = (sums[m:] - sums[:-m]) / m
    return np.asarray(np.sqrt(0.5 * np.mean((means[m:] - means[:-m]) ** 2, axis=0)))


def test_white_noise_has_the_slope_of_minus_a_half() -> None:
    """N / sqrt(tau): 3 x 400 intervals or more; within 8 %, 4 standard errors (99.99 %)."""
    series = errors(20_000, noise_density=0.01)
    for m in (1, 10, 50):
        found = np.sqrt(np.mean(allan(series, m) ** 2))
        assert found == pytest.approx(0.01 / np.sqrt(m / RATE), rel=0.08)
    assert np.std(series) == pytest.approx(0.01 * np.sqrt(RATE), rel=0.015)


def test_a_random_walk_has_the_slope_of_a_half() -> None:
    """K sqrt(tau / 3): within 20 % (99.9 %); m >= 10, where the steps are small."""
    series = errors(20_000, random_walk=0.01)
    for m in (10, 50):
        found = np.sqrt(np.mean(allan(series, m) ** 2))
        assert found == pytest.approx(0.01 * np.sqrt(m / RATE / 3.0), rel=0.2)


def test_the_floor_of_the_bias_is_that_of_the_data_sheet() -> None:
    """Greatest at 1.89 T, and there 0.664 B: within 15 % (99.9 %)."""
    time = 2.0
    series = errors(30_000, bias_instability=0.01, correlation_time=time)
    floor = np.sqrt(np.mean(allan(series, round(1.89 * time * RATE)) ** 2))
    assert floor == pytest.approx(FLOOR * 0.01, rel=0.15)
    assert pytest.approx(0.664, abs=5e-4) == FLOOR


def test_the_greatest_deviation_of_a_gauss_markov_process() -> None:
    x = np.linspace(1.0, 4.0, 300_001)  # tau / T
    variance = 2.0 / x * (1.0 - (3.0 - 4.0 * np.exp(-x) + np.exp(-2.0 * x)) / (2.0 * x))
    assert np.sqrt(variance.max()) == pytest.approx(PEAK, abs=5e-5)
    assert x[variance.argmax()] == pytest.approx(1.89, abs=0.01)


def test_the_bias_does_not_depend_on_how_often_it_is_sampled() -> None:
    """Samples a correlation time apart: deviation s and correlation 1/e, both within 4 %."""
    drift = Drift(DriftSpec(bias_instability=1.0, correlation_time=0.1), rng.stream(3, "test"))
    series = np.array([draw(drift.parameters, k * 0.1)[0] for k in range(10_000)])
    std = DriftSpec(bias_instability=1.0).bias_std
    assert np.std(series) == pytest.approx(std, rel=0.04)
    lag = np.mean(series[1:] * series[:-1]) / np.mean(series**2)
    assert lag == pytest.approx(np.exp(-1.0), abs=0.03)


def test_the_variance_that_is_published_is_that_of_the_errors() -> None:
    """2000 runs of the same sensor, at 50 s: within 10 % (99.9 %)."""
    spec = DriftSpec(
        noise_density=0.1, bias_instability=0.2, random_walk=0.03, turn_on_bias=0.1,
    )  # fmt: skip
    found = []
    for seed in range(700):
        drift = Drift(spec, rng.stream(seed, "test"))
        draw(drift.parameters, 49.9)
        error, variance = draw(drift.parameters, 50.0)
        found.append(error)
    walked = spec.random_walk**2 * 49.9  # before the first sample nothing walks
    assert np.var(found) == pytest.approx(variance - walked, rel=0.13)


def test_the_errors_follow_the_formulas_of_the_page() -> None:
    """Drawn by the same generator in Python, axis by axis."""
    spec = DriftSpec(
        noise_density=0.1, bias_instability=0.2, random_walk=0.03, turn_on_bias=0.4,
        correlation_time=2.0,
    )  # fmt: skip
    drift, random = Drift(spec, rng.stream(1, "test")), rng.stream(1, "test")
    constant = 0.4 * random.standard_normal(3)
    bias, walk, before = spec.bias_std * random.standard_normal(3), np.zeros(3), None
    for time in (0.1, 0.15, 0.4):
        lasted = 0.0 if before is None else time - before
        white, w2, w3 = random.standard_normal((3, 3))
        kept = np.exp(-lasted / 2.0)
        bias = kept * bias + spec.bias_std * np.sqrt(1.0 - kept**2) * w2
        walk = walk + 0.03 * np.sqrt(lasted) * w3
        expected = 0.1 / np.sqrt(lasted or 0.01) * white + constant + bias + walk
        error, variance = draw(drift.parameters, time)
        assert error == pytest.approx(expected, rel=1e-12)
        slow = 0.4**2 + spec.bias_std**2 + 0.03**2 * time
        assert variance == pytest.approx(0.1**2 / (lasted or 0.01) + slow)
        before = time
    assert drift.state.rng.standard_normal() == random.standard_normal()
