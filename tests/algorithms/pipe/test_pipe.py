"""The guidance along a line, and the detection of one in drawn images."""

from __future__ import annotations

import math
from dataclasses import fields

import numpy as np
import pytest

from uwsim.algorithms.pipe.camera_line import PipeCameraProportional
from uwsim.algorithms.pipe.guidance import GuidanceGains, LineGuidance
from uwsim.algorithms.pipe.line_detector import LineDetector, fit_line
from uwsim.algorithms.pipe.observed_line import PipeStraight
from uwsim.base.geometry import Intrinsics
from uwsim.base.rng import stream

GAINS = GuidanceGains(speed=0.3, look_ahead=1.0, ki=0.1, kz=0.5, turn_gain=0.8, limit=0.5)
TILT, HEIGHT, WIDTH = 0.75, 1.1, 0.25
LENS = Intrinsics(width=240, height=180, fx=156.0, fy=156.0, cx=119.5, cy=89.5)


def detector() -> LineDetector:
    return LineDetector(
        intrinsics=LENS, tilt=TILT, width=WIDTH, threshold=4.0, min_share=0.3, tolerance=0.12
    )


def draw_line(offset: float, slope: float, *, noise: float = 0.0) -> np.ndarray:
    """Draw a dark line on bright level ground by casting a ray through each pixel."""
    v, u = np.mgrid[: LENS.height, : LENS.width]
    x_n, y_n = (u - LENS.cx) / LENS.fx, (v - LENS.cy) / LENS.fy
    depth = HEIGHT / (math.sin(TILT) + y_n * math.cos(TILT))
    forward = depth * (math.cos(TILT) - y_n * math.sin(TILT))
    across = np.abs(depth * x_n - offset - slope * forward) / math.hypot(1.0, slope)
    grey = np.where((across < WIDTH / 2.0) & (depth > 0.0), 60.0, 140.0)
    grey = grey + noise * stream(0, "pipe").standard_normal(grey.shape)
    return np.repeat(np.clip(np.rint(grey), 0, 255).astype(np.uint8)[..., None], 3, axis=2)


def test_on_the_line_the_vehicle_moves_along_it() -> None:
    x, zero = np.array([1.0, 0.0, 0.0]), np.zeros(3)
    velocity, turn = LineGuidance(GAINS).command(zero, x, x, 0.1)
    np.testing.assert_allclose(velocity, [0.3, 0.0, 0.0])
    assert turn == 0.0


def test_beside_the_line_the_vehicle_aims_at_the_point_ahead() -> None:
    error = np.array([0.0, 1.0, 0.4])  # 1 m to starboard, 0.4 m below
    direction, ahead = np.array([1.0, 0.0, 0.0]), np.array([1.0, 1.0, 0.4])
    velocity, turn = LineGuidance(GAINS).command(error, direction, ahead, 0.0)
    half = 0.3 / math.sqrt(2.0)
    np.testing.assert_allclose(velocity, [half, half, 0.2])
    assert turn == pytest.approx(0.8 * math.pi / 4.0)


def test_the_integral_grows_with_the_error_up_to_its_limit() -> None:
    guidance, x = LineGuidance(GAINS), np.array([1.0, 0.0, 0.0])
    error = np.array([0.0, -0.1, 0.0])
    for _ in range(20):
        velocity, _ = guidance.command(error, x, x, 0.5)
    assert velocity[1] == pytest.approx(-0.03 / math.hypot(1.0, 0.1) - 0.1 * 20 * 0.5 * 0.1)
    for _ in range(1000):
        velocity, _ = guidance.command(error, x, x, 0.5)
    assert velocity[1] == -0.5


@pytest.mark.parametrize(("offset", "slope"), [(0.0, 0.0), (0.2, -0.3), (-0.4, 0.5)])
def test_a_drawn_line_is_found_where_it_is(offset: float, slope: float) -> None:
    line = detector().detect(draw_line(offset, slope, noise=3.0), HEIGHT)
    assert line is not None
    assert line.offset == pytest.approx(offset, abs=0.03)
    assert line.slope == pytest.approx(slope, abs=0.03)
    assert line.share > 0.6


def test_bare_ground_has_no_line() -> None:
    image = draw_line(50.0, 0.0, noise=8.0)
    assert detector().detect(image, HEIGHT) is None


def test_a_fitted_line_is_that_of_least_squares() -> None:
    points = [(0.5, 0.1), (1.0, 0.4), (2.0, 0.3), (3.0, 0.9)]
    slope, offset = np.polyfit(*np.array(points).T, 1)
    assert fit_line(points) == pytest.approx((offset, slope))


def test_the_control_condition_moves_straight_on() -> None:
    velocity, turn = PipeStraight().command({}, 0.1)
    assert (velocity.tolist(), turn) == ([0.3, 0.0, 0.0], 0.0)


def test_the_guidance_without_an_integral_does_not_oppose_a_current() -> None:
    names = [field.name for field in fields(GuidanceGains)]
    parameters = PipeCameraProportional.PARAMETERS
    guidance = LineGuidance(GuidanceGains(**{name: float(parameters[name]) for name in names}))
    x, error = np.array([1.0, 0.0, 0.0]), np.array([0.0, -0.1, 0.0])
    first, _ = guidance.command(error, x, x, 0.5)
    for _ in range(20):
        last, _ = guidance.command(error, x, x, 0.5)
    np.testing.assert_array_equal(first, last)
