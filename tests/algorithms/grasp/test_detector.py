"""The detector in fog: what is faintly orange is found, what is dark is not."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.algorithms.grasp.camera import Pinhole, View
from uwsim.algorithms.grasp.detector import ColourDetector
from uwsim.base.geometry import Pose

FOG = (5.0, 33.0, 43.0)
"""Colour of the fog of grasp-scene, as a camera shows it."""
VIEW = View(
    pinhole=Pinhole(width=320, height=240, fx=208.0, fy=208.0, cx=159.5, cy=119.5),
    navigation_from_camera=Pose.identity(),
    seabed_depth=1.7,
)
"""From 1.7 m above the bottom."""


def foggy(transmission: float, colour: tuple[float, float, float]) -> np.ndarray:
    """An image of fog with a thing of the size of the box, seen through it, (240, 320, 3)."""
    random = np.random.default_rng(1)
    image = np.full((240, 320, 3), FOG)
    image[100:140, 150:170] = transmission * np.array(colour) + (1.0 - transmission) * np.array(FOG)
    noisy = image + random.normal(0.0, 2.55, image.shape)
    return np.clip(np.round(noisy), 0, 255).astype(np.uint8)


@pytest.mark.parametrize("transmission", [1.0, 0.3, 0.15])
def test_an_orange_box_is_found_through_fog(transmission: float) -> None:
    [outline] = ColourDetector().detect(foggy(transmission, (220.0, 95.0, 20.0)), VIEW)
    assert outline.centre == pytest.approx((159.5, 119.5), abs=2.0)


def test_a_dark_hull_before_the_fog_is_no_box() -> None:
    assert ColourDetector().detect(foggy(1.0, (4.0, 9.0, 11.0)), VIEW) == []


def test_fog_alone_is_no_box() -> None:
    assert ColourDetector().detect(foggy(1.0, FOG), VIEW) == []


def test_an_orange_box_is_found_where_the_light_falls_off_and_the_hull_is_none() -> None:
    """Sand that is brighter ahead than aft is no noise; nor is the hull in a corner a box."""
    image = foggy(0.3, (220.0, 95.0, 20.0)).astype(float)
    ahead = np.linspace(1.0, 0.0, 240)[:, None, None]
    image += ahead**2 * np.array([75.0, 55.0, 40.0])
    image[200:240, 0:45] = (4.0, 9.0, 11.0)
    noise = np.random.default_rng(2).normal(0.0, 2.55, image.shape)
    found = ColourDetector().detect(np.clip(image + noise, 0, 255).astype(np.uint8), VIEW)
    assert [outline.centre for outline in found] == [pytest.approx((159.5, 119.5), abs=3.0)]


def test_the_arm_before_the_camera_is_no_box_and_does_not_hide_it() -> None:
    image = foggy(0.1, (220.0, 95.0, 20.0))
    image[150:240, 60:200] = (220, 150, 20)
    [outline] = ColourDetector().detect(image, VIEW)
    assert outline.centre == pytest.approx((159.5, 119.5), abs=3.0)
