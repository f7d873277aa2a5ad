"""The response of a camera: the measurements of EMVA 1288 give the numbers back."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.base.numerics.srgb import decode_array
from uwsim.cameras import CameraResponse
from uwsim.cameras.digital_numbers import encode, light_table, srgb_table
from uwsim.cameras.response import weigh_grey

SHAPE = (300, 400)
FLAT = np.ones(SHAPE, np.float32)


def grey_light(level: float) -> np.ndarray:
    return np.full((*SHAPE, 3), level, np.float32)


def test_the_photon_transfer_curve_gives_the_gain_and_the_read_noise() -> None:
    """EMVA 1288: the variance of numbers over their mean has the slope K = 1/gain."""
    camera = CameraResponse(gain=2.6, full_well=10_500, read_noise=4.0, output="linear12")
    means, variances = [], []
    for number, level in enumerate(np.linspace(0.02, 0.8, 9)):
        first, second = (
            camera.digitize(grey_light(level), FLAT, 100 + 2 * number + i).astype(float)
            for i in (0, 1)
        )
        means.append(0.5 * (first + second).mean() - camera.black_level)
        variances.append(0.5 * (first - second).var())
    slope, start = np.polyfit(means, variances, 1)
    assert 1.0 / slope == pytest.approx(2.6, rel=0.01)
    assert start == pytest.approx((4.0 / 2.6) ** 2 + 1.0 / 12.0, abs=2.0)


def test_numbers_are_proportional_to_light_and_time() -> None:
    for time, sensitivity, level in ((0.01, 1e6, 0.3), (0.02, 1e6, 0.3), (0.01, 2e5, 1.5)):
        camera = CameraResponse(
            exposure_time=time, sensitivity=sensitivity, gain=3.0, full_well=1e5, has_noise=False,
            output="linear12",
        )  # fmt: skip
        numbers = camera.expose(grey_light(level), FLAT, 0, exposure=99.0)
        assert int(numbers[0, 0, 0]) == round(64.0 + time * sensitivity * level / 3.0)


def test_without_a_sensitivity_full_scale_of_the_scene_is_full_scale() -> None:
    camera = CameraResponse(has_noise=False, output="linear12")
    numbers = camera.expose(grey_light(0.25), FLAT, 0, exposure=2.0)
    assert int(numbers[0, 0, 0]) == round(64 + 0.5 * (4095 - 64))
    saturated = camera.expose(grey_light(0.6), FLAT, 0, exposure=2.0)
    assert int(saturated.max()) == 4095


def test_a_full_well_saturates_below_full_scale_with_a_low_gain() -> None:
    camera = CameraResponse(
        gain=5.0, full_well=10_000, has_noise=False, output="linear12", sensitivity=1e9
    )
    assert int(camera.expose(grey_light(1.0), FLAT, 0).max()) == 64 + 2000


def test_dark_current_adds_electrons_and_their_noise() -> None:
    camera = CameraResponse(
        dark_current=50.0, exposure_time=8.0, read_noise=2.0, gain=1.0, output="linear12"
    )
    numbers = camera.digitize(grey_light(0.0), FLAT, 3).astype(float)
    assert numbers.mean() == pytest.approx(64.0 + 400.0, abs=0.5)
    assert numbers.var() == pytest.approx(400.0 + 4.0 + 1.0 / 12.0, rel=0.01)


def test_vignetting_scales_light_before_the_noise() -> None:
    camera = CameraResponse(output="linear12", read_noise=1.0)
    edge = camera.digitize(grey_light(0.8), np.full(SHAPE, 0.25, np.float32), 5).astype(float)
    axis = camera.digitize(grey_light(0.8), FLAT, 5).astype(float)
    assert (edge.mean() - 64.0) / (axis.mean() - 64.0) == pytest.approx(0.25, rel=0.002)
    assert edge.var() / axis.var() == pytest.approx(0.25, rel=0.02)


def test_srgb_values_are_those_of_the_standard() -> None:
    table = srgb_table(64.0)
    assert (table[0], table[64], table[4095]) == (0, 0, 255)
    # IEC 61966-2-1: linear 0.5 is 187.5 of 255, 0.18 is 117.6, 0.002 is 6.6
    for light, value in ((0.5, 188), (0.18, 118), (0.002, 7)):
        assert table[round(64.0 + light * 4031.0)] == pytest.approx(value, abs=1)
    stored_values = np.linspace(0.0, 1.0, 101)
    np.testing.assert_allclose(encode(decode_array(stored_values)), stored_values, atol=1e-6)
    assert light_table()[65535] == 1.0


def test_a_grey_camera_weighs_light_and_has_one_noise() -> None:
    light = np.zeros((*SHAPE, 4), np.float32)
    light[..., 1] = 0.5
    grey = weigh_grey(light)
    assert grey.shape == (*SHAPE, 1)
    numbers = CameraResponse(output="linear12").expose(grey, FLAT, 1)
    assert numbers.shape == SHAPE
    assert numbers.dtype == np.uint16
    assert numbers.mean() == pytest.approx(64.0 + 0.7152 * 0.5 * 4031.0, rel=0.002)
    assert CameraResponse().expose(grey, FLAT, 1).dtype == np.uint8
