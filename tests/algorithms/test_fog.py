"""What fog does to the trackers: a plane that sways behind a camera, in thickening water."""

from __future__ import annotations

import functools
import math

import numpy as np
import pytest

from tests.algorithms.textures import Texture, rectangle, through_fog
from uwsim.algorithms.direct_tracker import DirectTracker
from uwsim.algorithms.esm.alignment import Method
from uwsim.algorithms.esm.homography import homography_between
from uwsim.algorithms.esm.pyramid import to_grey
from uwsim.algorithms.esm.template import extract_template
from uwsim.algorithms.tracker import LossTest

QUAD = rectangle(80.0, 40.0, 93.0, 28.0)
SIZE = (160, 80)  # width, height [px]
DISTANCE = 1.3  # [m]


def contrast_at_loss(sigma: float, zncc_threshold: float, *, seed: int) -> float:
    """Share of the contrast that is left when esm says lost; 10 images a level, 2 % a level."""
    clear = Texture(seed).image(width=SIZE[0], height=SIZE[1])
    rng = np.random.Generator(np.random.Philox(seed))
    first = to_grey(through_fog(clear, 1.0, rng, sigma=sigma))
    tracker = DirectTracker.from_image(first, QUAD, levels=3, method=Method())
    assert isinstance(tracker, DirectTracker)
    loss = LossTest(zncc_threshold=zncc_threshold, frames=5)
    transmission = 1.5 * law(clear, sigma, zncc_threshold)
    while transmission > 0.01:
        transmission *= 0.98
        for _ in range(10):
            image = to_grey(through_fog(clear, transmission, rng, sigma=sigma))
            if loss.check(tracker.step(image), *SIZE):
                return transmission
    raise AssertionError("never lost")


def law(clear: np.ndarray, sigma: float, zncc_threshold: float) -> float:
    """T = sigma / (S sqrt(1/z^2 - 1))."""
    template = extract_template(clear, QUAD)
    assert template is not None
    return sigma / (template.contrast * math.sqrt(1.0 / zncc_threshold**2 - 1.0))


@pytest.mark.parametrize(
    ("sigma", "zncc_threshold"), [(2.0, 0.5), (4.0, 0.5), (8.0, 0.5), (4.0, 0.4), (4.0, 0.6)]
)
def test_esm_is_lost_where_the_contrast_to_noise_law_says(
    sigma: float, zncc_threshold: float
) -> None:
    seed = int(sigma)
    expected = law(Texture(seed).image(width=SIZE[0], height=SIZE[1]), sigma, zncc_threshold)
    lost_at = contrast_at_loss(sigma, zncc_threshold, seed=seed)
    assert 0.9 * expected < lost_at < 1.1 * expected


@functools.cache
def sweep(name: str) -> tuple[tuple[float, ...], float]:
    """Mean 8-vector corner error a fog level [px], and the fog at which it was lost (or inf)."""
    texture = Texture(11)
    rng = np.random.Generator(np.random.Philox(2))
    tracker: DirectTracker | None = None
    loss = LossTest(zncc_threshold=0.5, frames=5)
    errors = []
    for level in range(27):
        fog, sum_of_errors = 0.05 * level, 0.0
        for k in range(8):
            phase = 0.25 * (8 * level + k)
            sway = np.array([6.0 * math.sin(phase), 4.0 * math.sin(1.4 * phase)])
            clear = texture.image(
                homography_between(QUAD, QUAD + sway), width=SIZE[0], height=SIZE[1]
            )
            transmission = math.exp(-((fog * DISTANCE) ** 2))
            image = to_grey(through_fog(clear, transmission, rng, sigma=3.4))
            if name == "frozen":
                sum_of_errors += float(np.linalg.norm(np.tile(sway, 4)))
                continue
            if tracker is None:
                method = Method(photometric=name == "esm")
                made = DirectTracker.from_image(image, QUAD, levels=3, method=method)
                assert isinstance(made, DirectTracker)
                tracker = made
            estimate = tracker.step(image)
            sum_of_errors += float(np.linalg.norm(estimate.corners - (QUAD + sway)))
            if loss.check(estimate, *SIZE):
                return tuple(errors), fog
        errors.append(sum_of_errors / 8)
    return tuple(errors), math.inf


def test_normalisation_carries_esm_through_fog_that_ends_plain_esm() -> None:
    assert sweep("ssd-esm")[1] < 0.7
    assert 1.15 < sweep("esm")[1] < 1.4


def test_until_it_is_lost_esm_is_within_five_pixels_and_its_error_grows() -> None:
    errors, _ = sweep("esm")
    assert max(errors) < 5.0
    assert max(errors[:10]) < 0.5
    assert np.mean(errors[-4:]) > 4.0 * np.mean(errors[:4])


@pytest.mark.parametrize("name", ["esm", "ssd-esm"])
def test_a_plane_that_moves_distinguishes_trackers_from_frozen(name: str) -> None:
    errors, _ = sweep(name)
    frozen, _ = sweep("frozen")
    few_levels = min(len(errors), 5)
    assert all(errors[i] < frozen[i] for i in range(few_levels))
    assert np.mean(frozen) > 5.0


def test_a_low_image_alone_is_not_a_loss_but_five_are() -> None:
    texture = Texture(1)
    tracker = DirectTracker.from_image(
        texture.image(width=SIZE[0], height=SIZE[1]), QUAD, levels=3, method=Method()
    )
    assert isinstance(tracker, DirectTracker)
    blank = np.full((80, 160), 16.0, np.float32)
    loss = LossTest(zncc_threshold=0.5, frames=5)
    for _ in range(3):
        for _ in range(4):
            assert loss.check(tracker.step(blank), *SIZE) is None
        assert loss.check(tracker.step(texture.image(width=SIZE[0], height=SIZE[1])), *SIZE) is None
    reasons = [loss.check(tracker.step(blank), *SIZE) for _ in range(5)]
    assert reasons == [None] * 4 + ["ZNCC -1.00 on 5 frames"]
