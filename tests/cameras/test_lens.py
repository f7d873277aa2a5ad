"""Lenses against OpenCV, and the pinhole that they distort."""

from __future__ import annotations

import math
from dataclasses import replace

import cv2
import numpy as np
import pytest

from uwsim.base.geometry import Intrinsics
from uwsim.cameras import DomePort, FlatPort, Lens
from uwsim.cameras.distortion_fit import apply_model, fit_distortion
from uwsim.cameras.lens_image import check_lens, map_lens
from uwsim.cameras.vignetting import compute_falloff
from uwsim.errors import BadSetting

COEFFICIENTS = (-0.21, 0.06, 0.002, -0.003, -0.01)
PINHOLE = Intrinsics.from_fovy(640, 480, math.radians(50.0))
LENSES = {
    "barrel": Lens(distortion=COEFFICIENTS),
    "flat": Lens(port=FlatPort()),
    "flat and barrel": Lens(
        distortion=(-0.21, 0.06, 0.0, 0.0, -0.01), port=FlatPort(distance=0.01)
    ),
    "dome": Lens(port=DomePort(offset=0.01)),
}


def camera_with(lens: Lens, pinhole: Intrinsics = PINHOLE) -> Intrinsics:
    """Return a camera whose focal length in air is that of a pinhole."""
    scale = lens.magnification
    return replace(pinhole, fx=scale * pinhole.fx, fy=scale * pinhole.fy, lens=lens)


def matrix_of(camera: Intrinsics) -> np.ndarray:
    return np.array([[camera.fx, 0, camera.cx], [0, camera.fy, camera.cy], [0, 0, 1.0]])


def test_a_point_is_where_opencv_projects_it() -> None:
    camera = camera_with(Lens(distortion=COEFFICIENTS))
    points = np.array([[0.3, 0.2, 1.0], [-0.4, 0.3, 1.5], [0.0, -0.5, 2.0]])
    expected, _ = cv2.projectPoints(
        points, np.zeros(3), np.zeros(3), matrix_of(camera), np.array(COEFFICIENTS)
    )
    projected = camera.project(points * [1.0, -1.0, -1.0])
    np.testing.assert_allclose(projected, expected[:, 0], atol=1e-9)


@pytest.mark.parametrize("name", LENSES)
def test_the_ray_of_a_pixel_is_projected_onto_it(name: str) -> None:
    camera = camera_with(LENSES[name])
    rays = camera.rays()
    for row, column in ((0, 0), (10, 600), (240, 320), (479, 100)):
        u, v = camera.pixel(*(2.5 * rays[row, column]).tolist())
        assert (u, v) == pytest.approx((column, row), abs=1e-6)


def test_a_skewed_camera_with_a_lens_maps_rays_back() -> None:
    camera = replace(camera_with(LENSES["barrel"]), skew=7.0)
    assert camera.pixel(*camera.rays()[33, 44].tolist()) == pytest.approx((44, 33), abs=1e-6)


def test_a_camera_behind_a_flat_port_sees_a_smaller_angle() -> None:
    camera = camera_with(LENSES["flat"])
    edge = camera.rays()[0, 320]
    in_water = math.asin(math.sin(math.atan(239.5 / PINHOLE.fy)) / 1.333)
    assert math.atan2(edge[1], 1.0) == pytest.approx(in_water, abs=0.002)


@pytest.mark.parametrize("name", LENSES)
@pytest.mark.parametrize("fovy", [40.0, 60.0])
def test_camera_info_undistorts_straight_lines_within_a_fifth_of_a_pixel(
    name: str, fovy: float
) -> None:
    """The image of a straight line is curved; OpenCV makes it straight with K and D."""
    camera = camera_with(LENSES[name], Intrinsics.from_fovy(640, 480, math.radians(fovy)))
    fit = fit_distortion(camera)
    assert fit.residual < 0.2
    rays = camera.rays()
    reach, height = 0.75 * rays[240, 639, 0], 0.8 * rays[0, 320, 1]
    line = np.stack(
        [np.linspace(-reach, reach, 41), np.full(41, height), np.full(41, -1.0)], axis=1
    )
    drawn = camera.project(line)
    offsets = drawn[:, 1] - np.interp(drawn[:, 0], drawn[[0, -1], 0], drawn[[0, -1], 1])
    if name == "flat":
        assert np.abs(offsets).max() > 1.0  # it is curved
    straight = cv2.undistortPoints(
        drawn[:, None], matrix_of(camera), np.array(fit.coefficients), P=matrix_of(camera)
    )[:, 0]
    expected = replace(camera, lens=None).project(line)
    np.testing.assert_allclose(straight, expected, atol=0.2)


def test_a_wide_lens_behind_a_flat_port_needs_the_rational_model() -> None:
    camera = camera_with(LENSES["flat"], Intrinsics.from_fovy(640, 480, math.radians(85.0)))
    fit = fit_distortion(camera)
    assert fit.model == "rational_polynomial"
    assert fit.residual < 0.1
    ours = apply_model(fit.coefficients, np.array([0.2]), np.array([-0.1]))
    theirs, _ = cv2.projectPoints(
        np.array([[0.2, -0.1, 1.0]]), np.zeros(3), np.zeros(3), np.eye(3),
        np.array(fit.coefficients),
    )  # fmt: skip
    np.testing.assert_allclose(np.ravel(ours), theirs.ravel(), atol=1e-12)


def test_a_lens_without_distortion_leaves_an_image_as_it_is() -> None:
    lens_image = map_lens(camera_with(Lens(), Intrinsics.from_fovy(40, 30, 0.8)))
    generator = np.random.default_rng(3)
    size = lens_image.pinhole.height, lens_image.pinhole.width
    light = generator.random((*size, 4)).astype(np.float32)
    np.testing.assert_allclose(lens_image.interpolate(light), light[2:32, 2:42, :3], atol=1e-5)
    numbers = (light * 60000).astype(np.uint16)
    np.testing.assert_allclose(lens_image.interpolate(numbers), numbers[2:32, 2:42], atol=1)
    ids = generator.integers(0, 9, size).astype(np.uint16)
    assert np.array_equal(lens_image.pick(ids), ids[2:32, 2:42])


def test_the_planar_depth_of_a_wall_is_the_same_through_a_lens() -> None:
    camera = camera_with(LENSES["barrel"])
    lens_image = map_lens(camera)
    ranges = (3.0 * lens_image.pinhole.ray_lengths).astype(np.float32)
    depth = lens_image.pick_range(ranges) / camera.ray_lengths
    np.testing.assert_allclose(depth, 3.0, rtol=1e-5)


def test_a_lens_that_folds_the_image_is_refused() -> None:
    lens = Lens(distortion=(-0.8, 0.0, 0.0, 0.0, 0.0))
    camera = camera_with(lens, Intrinsics.from_fovy(640, 480, math.radians(90.0)))
    with pytest.raises(BadSetting, match="folds"):
        check_lens(camera)


def test_a_lens_that_needs_a_much_larger_image_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("uwsim.cameras.lens_image.MAX_SIZE_RATIO", 1.2)
    camera = camera_with(LENSES["barrel"], Intrinsics.from_fovy(640, 480, math.radians(60.0)))
    for check in (check_lens, map_lens):
        with pytest.raises(BadSetting, match=r"at most 1\.2 times"):
            check(camera)


def test_vignetting_is_the_fourth_power_of_the_cosine_in_front_of_the_lens() -> None:
    angle = math.atan(math.hypot(319.5, 239.5) / PINHOLE.fx)  # in air
    for camera in (PINHOLE, camera_with(LENSES["flat"])):
        falloff = compute_falloff(camera, None)
        assert falloff[0, 0] == pytest.approx(math.cos(angle) ** 4, rel=1e-5)
    assert compute_falloff(PINHOLE, (-0.3, 0.0, -0.1))[0, 0] == pytest.approx(0.6, abs=0.003)
