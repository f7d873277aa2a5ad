from __future__ import annotations

import numpy as np
import pytest

from tests.algorithms.textures import Texture, rectangle
from uwsim.algorithms.direct_tracker import DirectTracker
from uwsim.algorithms.esm.alignment import Method, align, zncc
from uwsim.algorithms.esm.homography import homography_between, warp
from uwsim.algorithms.esm.template import extract_template

QUAD = rectangle(160.0, 120.0, 100.0, 100.0)


def rms(homography: np.ndarray, target: np.ndarray) -> float:
    return float(np.sqrt(((warp(homography, QUAD) - target) ** 2).sum(axis=1).mean()))


@pytest.mark.parametrize("photometric", [True, False])
@pytest.mark.parametrize("blend", ["esm", "ic", "fc"])
@pytest.mark.parametrize("seed", range(4))
def test_a_synthetic_warp_is_recovered_to_a_twentieth_of_a_pixel(
    blend: str, photometric: bool, seed: int
) -> None:
    texture = Texture(seed, shortest=12.0)
    template = extract_template(texture.image(), QUAD)
    rng = np.random.Generator(np.random.Philox(seed))
    target = QUAD + 2.5 * rng.standard_normal((4, 2))
    image = texture.image(homography_between(QUAD, target))
    method = Method(blend=blend, photometric=photometric, max_iterations=40)
    assert rms(align(image, template, np.eye(3), method).homography, target) < 0.05


def test_a_rotated_patch_is_recovered_too() -> None:
    texture = Texture(3, shortest=12.0)
    quad = np.array([[120.0, 90.0], [190.0, 130.0], [170.0, 165.0], [100.0, 125.0]])
    tracker = DirectTracker.from_image(texture.image(), quad, levels=3, method=Method())
    assert isinstance(tracker, DirectTracker)
    target = quad + np.array([[3.0, 1.0], [2.0, -1.0], [4.0, 0.5], [2.5, 2.0]])
    estimate = tracker.step(texture.image(homography_between(quad, target)))
    assert np.sqrt(((estimate.corners - target) ** 2).sum(axis=1).mean()) < 0.05
    assert estimate.zncc > 0.98


def test_large_motion_needs_the_pyramid() -> None:
    texture = Texture(5, shortest=8.0, longest=40.0, waves=40)
    target = QUAD + np.array([12.0, -9.0])
    image = texture.image(homography_between(QUAD, target))
    error = {}
    for levels in (1, 3):
        tracker = DirectTracker.from_image(texture.image(), QUAD, levels=levels, method=Method())
        assert isinstance(tracker, DirectTracker)
        error[levels] = np.abs(tracker.step(image).corners - target).max()
    assert error[3] < 0.1 < 1.0 < error[1]


def one_step_error(blend: str, scale: float) -> float:
    """Corner error left by one step from a guess that is off by ``scale`` pixels."""
    texture = Texture(9, shortest=60.0, longest=120.0, waves=40)
    image = texture.image()
    template = extract_template(image, QUAD)
    offsets = scale * np.array([[1.0, 0.5], [-0.6, 1.0], [0.3, -1.0], [-0.8, -0.2]])
    method = Method(blend=blend, photometric=False, max_iterations=1)
    return rms(
        align(image, template, homography_between(QUAD, QUAD + offsets), method).homography, QUAD
    )


def test_one_step_of_esm_is_of_second_order_and_one_of_its_relatives_of_first() -> None:
    def order(blend: str, scale: float) -> float:
        return float(np.log2(one_step_error(blend, 2 * scale) / one_step_error(blend, scale)))

    assert order("ic", 4.0) == pytest.approx(2.0, abs=0.4)  # error ~ x^2: first order
    assert order("fc", 4.0) == pytest.approx(2.0, abs=0.4)
    assert order("esm", 8.0) == pytest.approx(3.0, abs=0.4)  # error ~ x^3: second order
    assert one_step_error("esm", 4.0) < 0.3 * one_step_error("ic", 4.0)


def convergence(
    blend: str, sigma: float, *, trials: int, photometric: bool = True
) -> tuple[float, float]:
    """Share of trials [%] that end within 1 px RMS, and mean iterations, from 25 at most."""
    image = Texture(1, shortest=20.0, longest=100.0, waves=40).image()
    template = extract_template(image, QUAD)
    rng = np.random.Generator(np.random.Philox(7))
    method = Method(blend=blend, photometric=photometric, max_iterations=25, precision=1e-3)
    good, iterations = 0, 0
    for offsets in sigma * rng.standard_normal((trials, 4, 2)):
        result = align(image, template, homography_between(QUAD, QUAD + offsets), method)
        good += rms(result.homography, QUAD) < 1.0
        iterations += result.iterations
    return 100.0 * good / trials, iterations / trials


@pytest.mark.parametrize("sigma", [8.0, 15.0])
def test_esm_needs_fewer_steps_and_fails_no_more_often_in_sixty_trials(sigma: float) -> None:
    esm, ic = (convergence(blend, sigma, trials=60) for blend in ("esm", "ic"))
    assert esm[0] >= ic[0] - 1.0
    assert esm[1] < ic[1]


@pytest.mark.slow
@pytest.mark.parametrize("photometric", [True, False])
@pytest.mark.parametrize("sigma", [4.0, 8.0, 10.0, 12.0, 15.0, 20.0])
def test_esm_needs_fewer_steps_and_fails_no_more_often_in_500_trials(
    sigma: float, photometric: bool
) -> None:
    esm, ic = (
        convergence(blend, sigma, trials=500, photometric=photometric) for blend in ("esm", "ic")
    )
    assert esm[0] >= ic[0] - 1.0
    if sigma >= 8.0:
        assert esm[1] < ic[1]


@pytest.mark.parametrize(("gain", "bias"), [(0.2, 100.0), (0.6, -30.0), (1.3, 5.0)])
def test_light_does_not_look_like_motion(gain: float, bias: float) -> None:
    texture = Texture(2, shortest=12.0)
    template = extract_template(texture.image(), QUAD)
    target = QUAD + np.array([2.0, -1.5])
    moved = texture.image(homography_between(QUAD, target))
    plain = align(moved, template, np.eye(3), Method())
    lit = align(gain * moved + np.float32(bias), template, np.eye(3), Method())
    assert lit.homography == pytest.approx(plain.homography, abs=1e-3)
    assert rms(lit.homography, target) < 0.05
    assert zncc(gain * moved + np.float32(bias), template, lit.homography) == pytest.approx(
        zncc(moved, template, plain.homography), abs=1e-3
    )


def test_without_normalisation_light_does_look_like_motion() -> None:
    texture = Texture(2, shortest=12.0)
    template = extract_template(texture.image(), QUAD)
    lit = 0.4 * texture.image() + np.float32(20.0)
    method = Method(photometric=False, max_iterations=40)
    assert rms(align(lit, template, np.eye(3), method).homography, QUAD) > 1.0


@pytest.mark.parametrize("transmission", [0.05, 0.1, 0.2, 0.5])
@pytest.mark.parametrize("offset", [0.0, 0.3])
def test_the_correlation_of_a_noisy_image_is_the_law_even_between_pixels(
    transmission: float, offset: float
) -> None:
    texture = Texture(4, shortest=20.0)
    image, sigma = texture.image(), 4.0
    template = extract_template(image, QUAD)
    rng = np.random.Generator(np.random.Philox(3))
    shift = homography_between(QUAD, QUAD + offset)
    noise = sigma * rng.standard_normal(image.shape)
    noisy = (transmission * texture.image(shift) + noise).astype(np.float32)
    signal = transmission * template.contrast
    expected = signal / np.hypot(signal, sigma)
    assert zncc(noisy, template, shift) == pytest.approx(expected, abs=0.03)


def test_an_image_turned_inside_out_correlates_at_minus_one() -> None:
    image = Texture().image()
    template = extract_template(image, QUAD)
    assert zncc(255.0 - image, template, np.eye(3)) == pytest.approx(-1.0, abs=1e-5)


@pytest.mark.parametrize("offset", [1000.0, 140.0])
def test_a_patch_that_is_not_in_the_image_has_no_correlation(offset: float) -> None:
    image = Texture().image()
    template = extract_template(image, QUAD)
    guess = homography_between(QUAD, QUAD + np.array([offset + 60.0, 0.0]))
    assert zncc(image, template, guess) == -1.0
    result = align(image, template, guess, Method())
    assert result.iterations == 0
    assert result.homography == pytest.approx(guess)


def test_a_patch_half_outside_is_aligned_by_the_other_half() -> None:
    texture = Texture(6, shortest=16.0)
    template = extract_template(texture.image(), QUAD)
    target = QUAD + np.array([140.0, 0.0])
    image = texture.image(homography_between(QUAD, target))
    guess = homography_between(QUAD, target + np.array([1.0, -1.0]))
    assert rms(align(image, template, guess, Method()).homography, target) < 0.2


def test_a_blank_image_leaves_the_guess_alone() -> None:
    template = extract_template(Texture().image(), QUAD)
    guess = homography_between(QUAD, QUAD + 2.0)
    result = align(np.full((240, 320), 16.0, np.float32), template, guess, Method())
    assert result.homography == pytest.approx(guess)
    assert result.iterations == 0


def test_stripes_leave_the_guess_alone_rather_than_slide_along() -> None:
    u = np.broadcast_to(np.arange(320.0), (240, 320))
    stripes = (128 + 40 * np.sin(u / 5)).astype(np.float32)
    template = extract_template(stripes, QUAD)
    result = align(
        stripes, template, homography_between(QUAD, QUAD + np.array([1.0, 0.0])), Method()
    )
    assert np.abs(warp(result.homography, QUAD) - QUAD).max() < 3.0


def test_the_same_images_give_the_same_bits() -> None:
    texture = Texture(8)
    template = extract_template(texture.image(), QUAD)
    image = texture.image(homography_between(QUAD, QUAD + 1.7))
    results = [align(image, template, np.eye(3), Method()).homography for _ in range(3)]
    assert results[0].tobytes() == results[1].tobytes() == results[2].tobytes()
