"""Clouds of sediment: the balance of mass, their motion, and their optical depth."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.particles.puffs import (
    BIRTH,
    ENTRAINMENT,
    FLOOR,
    MASS,
    MAX_PUFFS,
    VARIANCE,
    Puffs,
    X,
    Z,
    compute_optical_depth,
)
from uwsim.particles.sediment import SedimentSpec

STILL = np.zeros(3)
SPEC = SedimentSpec(settling_speed=0.002, diffusivity=0.003)


def add_puff(puffs: Puffs, mass: float = 0.01, height: float = 0.3) -> None:
    """Add a puff that rests, above a floor at -10 m."""
    puffs.add(np.array([1.0, 2.0, -10.0 + height]), 0.2, mass, STILL, -10.0)


def test_eroded_mass_is_in_suspension_or_settled() -> None:
    puffs = Puffs(SPEC)
    for number in range(400):
        if number < 200:
            place = np.array([0.01 * number, 0.0, -9.8])
            puffs.add(place, 0.2, 0.002, np.array([0.3, 0.0, 0.1]), -10.0)
        puffs.advance(0.25 * (number + 1), np.array([0.1, 0.0, 0.0]))
        assert puffs.state.n_puffs <= MAX_PUFFS
        suspended_mass = puffs.state.puffs[:, MASS].sum()
        total = suspended_mass + puffs.state.settled_mass
        assert total == pytest.approx(puffs.state.eroded_mass, rel=1e-12)
    assert puffs.state.settled_mass > 0.0


def test_all_sediment_settles_in_the_end() -> None:
    puffs = Puffs(SedimentSpec(settling_speed=0.05))
    add_puff(puffs)
    for step in range(1, 2400):
        puffs.advance(0.25 * step, STILL)
    assert puffs.state.n_puffs == 0
    assert puffs.state.settled_mass == pytest.approx(0.01, rel=1e-12)


def test_a_puff_drifts_with_the_water_and_sinks() -> None:
    puffs = Puffs(SPEC)
    add_puff(puffs)
    for step in range(1, 41):
        puffs.advance(0.25 * step, np.array([0.1, -0.05, 0.0]))
    centre = puffs.state.puffs[0, X : Z + 1]
    np.testing.assert_allclose(centre, [2.0, 1.5, -9.7 - 0.002 * 10.0], atol=1e-9)


def test_a_puff_grows_by_diffusion() -> None:
    puffs = Puffs(SPEC)
    add_puff(puffs)
    puffs.advance(20.0, STILL)
    assert puffs.state.puffs[0, VARIANCE] == pytest.approx(0.04 + 2.0 * 0.003 * 20.0)


def test_a_puff_comes_to_rest_and_has_entrained_water_on_its_way() -> None:
    puffs = Puffs(SedimentSpec(settling_speed=0.0, diffusivity=0.0))
    puffs.add(np.zeros(3), 0.2, 0.01, np.array([0.6, 0.0, 0.0]), -1.0)
    for step in range(1, 161):
        puffs.advance(0.25 * step, STILL)
    assert puffs.state.puffs[0, X] == pytest.approx(0.6 * 2.0, rel=1e-6)
    width = math.sqrt(puffs.state.puffs[0, VARIANCE])
    assert width == pytest.approx(0.2 + ENTRAINMENT * 1.2, rel=1e-6)


def test_the_loss_to_the_floor_is_the_flux_of_the_density_there() -> None:
    puffs = Puffs(SedimentSpec(settling_speed=0.002, diffusivity=0.0))
    add_puff(puffs)
    puffs.advance(0.01, STILL)
    # twice the density of one Gaussian, for the mirror image in the floor
    flux = 2.0 * 0.002 * 0.01 / (math.sqrt(2.0 * math.pi) * 0.2) * math.exp(-0.5 * 1.5**2)
    assert puffs.state.settled_mass == pytest.approx(0.01 * flux, rel=1e-3)


def test_merged_puffs_keep_mass_centre_and_spread() -> None:
    puffs = Puffs(SPEC)
    rng = np.random.default_rng(1)
    for _ in range(MAX_PUFFS):
        puffs.add(rng.normal(size=3), 0.2, float(rng.uniform(0.01, 0.02)), STILL, -10.0)
    before = puffs.state.puffs[:2].copy()
    puffs.add(np.zeros(3), 0.2, 0.01, STILL, -10.0)
    merged = puffs.state.puffs[0]
    masses = before[:, MASS]
    centre = (masses[:, None] * before[:, X : Z + 1]).sum(axis=0) / masses.sum()
    assert merged[MASS] == pytest.approx(masses.sum())
    np.testing.assert_allclose(merged[X : Z + 1], centre)
    squares = ((before[:, X : Z + 1] - centre) ** 2).sum(axis=1) + 3.0 * before[:, VARIANCE]
    assert 3.0 * merged[VARIANCE] == pytest.approx((masses * squares).sum() / masses.sum())
    assert puffs.state.n_puffs == MAX_PUFFS
    assert merged[FLOOR] == -10.0
    assert merged[BIRTH] == 0.0


def test_images_between_two_steps_do_not_change_the_state() -> None:
    puffs = Puffs(SPEC)
    add_puff(puffs)
    before = puffs.state.puffs.copy()
    predicted_puffs = puffs.predict(1.0, np.array([0.1, 0.0, 0.0]))
    assert predicted_puffs[0, X] == pytest.approx(1.1)
    np.testing.assert_array_equal(puffs.state.puffs, before)
    puffs.advance(1.0, np.array([0.1, 0.0, 0.0]))
    np.testing.assert_array_equal(puffs.state.puffs[:1], predicted_puffs)


@pytest.mark.parametrize("end", [0.8, 2.0, 2.3, 50.0])
@pytest.mark.parametrize("offset", [0.0, 0.2, 0.7])
def test_the_optical_depth_is_the_integral_of_the_density(end: float, offset: float) -> None:
    centre, width, mass = np.array([offset, 0.1, 2.0]), 0.35, 0.02
    ray = np.array([0.0, 0.0, 1.0])
    distances = np.linspace(0.0, end, 40001)
    squares = offset**2 + 0.1**2 + (distances - 2.0) ** 2
    density = mass * (2.0 * math.pi * width**2) ** -1.5 * np.exp(-squares / (2.0 * width**2))
    expected = 500.0 * np.trapezoid(density, distances)
    depth = compute_optical_depth(centre, width, mass, 500.0, ray, end)
    assert depth == pytest.approx(expected, rel=1e-6, abs=1e-9)
