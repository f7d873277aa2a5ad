"""The random numbers of electrons against the distributions that they stand for."""

from __future__ import annotations

import hashlib

import numpy as np
import pytest
from scipy import stats

from uwsim.cameras import CameraResponse
from uwsim.cameras.electrons import INVERSION_LIMIT

SHAPE = (400, 500)


def draw_electrons(mean: float, read_noise: float, key: int = 12345) -> np.ndarray:
    """Draw electrons of one mean, in steps of 1/8 e-, from -256 e- on."""
    response = CameraResponse(
        full_well=1e6, gain=0.125, black_level=2048.0, read_noise=read_noise, output="linear12",
        sensitivity=mean, exposure_time=1.0,
    )  # fmt: skip
    light = np.ones((*SHAPE, 3), np.float32)
    numbers = response.digitize(light, np.ones(SHAPE, np.float32), key)
    assert numbers.min() > 0
    assert numbers.max() < 4095
    return (numbers.astype(float) - 2048.0) * 0.125


@pytest.mark.parametrize("read_noise", [1.0, 2.4, 10.0])
@pytest.mark.parametrize("mean", [0.0, 1.0, 5.0, 20.0, 100.0])
def test_electrons_have_the_moments_of_shot_noise_and_read_noise(
    mean: float, read_noise: float
) -> None:
    electrons = draw_electrons(mean, read_noise)
    n, variance = electrons.size, mean + read_noise**2
    assert electrons.mean() == pytest.approx(mean, abs=5.0 * (variance / n) ** 0.5)
    # Steps of 1/8 e- add 1/8^2/12; five standard errors of a variance are 0.9 %.
    assert electrons.var() - 0.125**2 / 12.0 == pytest.approx(variance, rel=0.009)
    skewness = mean / variance**1.5
    assert stats.skew(electrons.ravel()) == pytest.approx(skewness, abs=0.05 * skewness + 0.016)


@pytest.mark.parametrize("read_noise", [1.0, 2.4])
@pytest.mark.parametrize("mean", [1.0, 3.0, 10.0, 60.0])
def test_the_distribution_is_near_that_of_a_poisson_number_plus_read_noise(
    mean: float, read_noise: float
) -> None:
    electrons = draw_electrons(mean, read_noise)
    deviation = (mean + read_noise**2) ** 0.5
    places = np.arange(-4.0 * read_noise, mean + 6.0 * deviation, 0.5)
    counts = np.arange(0, 200)
    exact = (
        stats.poisson.pmf(counts, mean)
        * stats.norm.cdf((places[:, None] + 0.0625 - counts) / read_noise)
    ).sum(axis=1)
    drawn = np.array([(electrons <= place).mean() for place in places])
    # The law lacks the excess kurtosis, which is at most 0.25 with 1 e- of read noise.
    assert np.abs(drawn - exact).max() < (0.012 if read_noise < 2.0 else 0.006)


@pytest.mark.parametrize("mean", [0.05, 0.7, 4.0, 25.0])
def test_a_camera_that_counts_photons_has_poisson_numbers(mean: float) -> None:
    electrons = draw_electrons(mean, 0.0)
    counts, observed = np.unique(electrons, return_counts=True)
    assert np.all(counts == np.floor(counts))
    expected = stats.poisson.pmf(counts, mean) * electrons.size
    is_common = expected > 20.0
    chi_square = ((observed - expected)[is_common] ** 2 / expected[is_common]).sum()
    assert chi_square < stats.chi2.ppf(0.9999, is_common.sum())


def test_the_exact_law_goes_over_into_the_normal_one() -> None:
    for mean in (INVERSION_LIMIT - 0.01, INVERSION_LIMIT + 0.01):
        electrons = draw_electrons(mean, 0.5)
        assert electrons.mean() == pytest.approx(mean, abs=0.04)
        assert electrons.var() == pytest.approx(mean + 0.25, rel=0.01)


def test_noise_depends_on_the_key_and_the_pixel_alone() -> None:
    first, again, other = (draw_electrons(50.0, 2.0, key) for key in (1, 1, 2))
    assert np.array_equal(first, again)
    assert abs(np.corrcoef(first.ravel(), other.ravel())[0, 1]) < 0.01
    channels = first.reshape(-1, 3)
    assert np.abs(np.corrcoef(channels.T) - np.eye(3)).max() < 0.015
    neighbours = np.corrcoef(first[:, 1:, 0].ravel(), first[:, :-1, 0].ravel())[0, 1]
    assert abs(neighbours) < 0.015


def test_an_image_has_these_bytes_on_every_processor() -> None:
    light = np.linspace(0.0, 1.2, 64 * 48 * 3, dtype=np.float32).reshape(48, 64, 3)
    falloff = np.ones((48, 64), np.float32)
    digests = [
        hashlib.sha256(response.expose(light, falloff, 7).tobytes()).hexdigest()[:16]
        for response in (
            CameraResponse(),
            CameraResponse(output="linear12", read_noise=0.4, full_well=200.0, dark_current=30.0),
        )
    ]
    assert digests == ["930b9796a9bb2772", "503a688be89882f6"]
