"""The weights of blur, the plan of its levels, the phase polynomial and the transfer curve."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.base.geometry import Intrinsics
from uwsim.optics import FournierForand, HenyeyGreenstein, PhaseFunction, find_water
from uwsim.optics.transmission import compute_direct, compute_full_field
from uwsim.rendering.physical.blur_plan import plan_blur
from uwsim.rendering.physical.blur_weights import (
    N_RANGES,
    N_SHARES,
    compute_share_table,
    compute_weight_table,
    find_table_scale,
)
from uwsim.rendering.physical.optics_block import fit_phase_polynomial
from uwsim.rendering.physical.transfer_curve import decode, encode


@pytest.mark.parametrize("name", ["jerlov-I", "jerlov-3C", "tank"])
def test_weights_are_positive_and_sum_to_the_scattered_light(name: str) -> None:
    medium = find_water(name)
    plan = plan_blur(Intrinsics.from_fovy(640, 480, 0.9), has_blur=True)
    table = compute_weight_table(medium, plan.sigmas, plan.highest_frequency)
    shares = np.arange(N_RANGES - 1) / (N_RANGES - 1.0)
    ranges = find_table_scale(medium) * shares / (1.0 - shares)
    scattered = compute_full_field(medium, ranges) - compute_direct(medium, ranges)
    assert table.min() >= 0.0
    np.testing.assert_allclose(table.sum(axis=0)[:-1], scattered, atol=1e-8)


@pytest.mark.parametrize("name", ["jerlov-I", "jerlov-III", "jerlov-3C", "jerlov-9C", "tank"])
def test_sharp_light_between_the_ranges_of_the_table_is_exact_to_a_third_of_a_percent(
    name: str,
) -> None:
    medium = find_water(name)
    plan = plan_blur(Intrinsics.from_fovy(640, 480, 0.9), has_blur=True)
    settings = medium, plan.sigmas, plan.highest_frequency
    shares, weights = compute_share_table(*settings), compute_weight_table(*settings)
    places = np.linspace(0.0, 0.95, 3001)
    ranges = find_table_scale(medium) * places / (1.0 - places)
    direct = compute_direct(medium, ranges)
    for channel in range(3):
        row = np.interp(places * (N_SHARES - 1), np.arange(N_SHARES), shares[0, :, channel])
        weight = np.interp(places * (N_RANGES - 1), np.arange(N_RANGES), weights[0, :, channel])
        expected = direct[:, channel] + weight
        is_visible = direct[:, channel] > np.exp(-4.0)
        np.testing.assert_allclose(row[is_visible], expected[is_visible], rtol=1.0 / 300.0)


@pytest.mark.parametrize(
    ("width", "fovy", "n_levels"), [(320, 50.0, 6), (640, 50.0, 7), (80, 60.0, 4), (4096, 40.0, 8)]
)
def test_the_levels_of_a_camera_are_from_a_pixel_to_410_mrad(
    width: int, fovy: float, n_levels: int
) -> None:
    lens = Intrinsics.from_fovy(width, 3 * width // 4, math.radians(fovy))
    plan = plan_blur(lens, has_blur=True)
    assert plan.n_levels == n_levels
    assert plan.sigmas[0] * lens.fx == pytest.approx(1.0)
    assert plan.sigmas[-1] == pytest.approx(0.41)
    assert all(0.7 < reach <= 1.0 for reach in plan.reach)


@pytest.mark.parametrize("lens", [(1, 1), (6, 4)])
def test_a_tiny_image_has_no_blur(lens: tuple[int, int]) -> None:
    plan = plan_blur(Intrinsics.from_fovy(*lens, math.radians(120.0)), has_blur=True)
    assert plan.n_levels == 0


@pytest.mark.parametrize("phase", [FournierForand(), HenyeyGreenstein(0.9), HenyeyGreenstein(0.3)])
def test_the_polynomial_gives_the_phase_function(phase: PhaseFunction) -> None:
    angles = np.radians(np.linspace(3.0, 180.0, 500))
    q = np.sqrt(np.sin(0.5 * angles))
    values = np.exp(np.polynomial.polynomial.polyval(q, fit_phase_polynomial(phase)))
    errors = np.abs(values / phase.compute_density(angles) - 1.0)
    assert errors.max() < 0.06
    assert errors[angles > math.radians(75.0)].max() < 0.015


def test_the_transfer_curve_is_that_of_srgb() -> None:
    light = np.linspace(0.0, 1.0, 2001)
    exact = np.where(light > 0.0031308, 1.055 * light ** (1.0 / 2.4) - 0.055, 12.92 * light)
    assert 255.0 * np.abs(encode(light) - exact).max() < 0.02
    assert np.abs(decode(exact) - light).max() < 0.004
    assert decode(np.array([0.0, 1.0])) == pytest.approx([0.0, 1.0])
