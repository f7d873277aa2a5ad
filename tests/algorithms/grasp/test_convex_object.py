"""Objects of any shape, found by their outline."""

from __future__ import annotations

import math

import cv2
import numpy as np
import pytest

from tests.algorithms.grasp.views import BOTTOM, ORANGE, SAND, view
from uwsim.algorithms.grasp import (
    BoxPose,
    ColourDetector,
    ConvexObject,
    ConvexPerception,
    Grasp,
    TargetEstimate,
    View,
)
from uwsim.algorithms.grasp.box import wrap_half_turn
from uwsim.base.numerics.linear import transform_points

WEDGE = np.array(
    [(-0.12, -0.1, 0.0), (0.12, -0.1, 0.0), (0.12, 0.14, 0.0), (-0.12, 0.05, 0.0), (0.0, 0.0, 0.2)]
)  # no symmetry, (n, 3) [m]
TURNS = np.linspace(0.0, 2.0 * math.pi, 24, endpoint=False)
RING = [(r * math.cos(a), r * math.sin(a), z) for a in TURNS for r, z in ((0.1, 0.0), (0.05, 0.3))]


def drawn(model: ConvexObject, pose: BoxPose, seen: View, seed: int = 0) -> np.ndarray:
    """An image (240, 320, 3) of the object's convex hull on sand, with noise."""
    image = np.full((240 * 4, 320 * 4, 3), SAND, np.uint8)
    pixels = seen.project(transform_points(model.points, pose.rotation, pose.position))
    hull = cv2.convexHull(np.rint(pixels * 4.0 + 1.5).astype(np.int32))
    cv2.fillConvexPoly(image, hull, ORANGE)
    small = cv2.resize(image, (320, 240), interpolation=cv2.INTER_AREA).astype(float)
    noise = np.random.Generator(np.random.Philox(seed)).normal(0.0, 2.5, small.shape)
    return np.clip(np.rint(small + noise), 0, 255).astype(np.uint8)


def look(model: ConvexObject, pose: BoxPose, seen: View, n: int = 4) -> TargetEstimate:
    target = TargetEstimate()
    perception = ConvexPerception(ColourDetector(), model)
    for i in range(n):
        perception.observe(drawn(model, pose, seen, i), seen, target, 0.1 * i)
    return target


@pytest.mark.parametrize("heading", [-2.8, 0.0, 0.4, 1.5])
@pytest.mark.parametrize("place", [(-0.5, -0.2), (-0.9, 0.3)])
def test_place_and_heading_of_an_object_are_found(
    heading: float, place: tuple[float, float]
) -> None:
    model = ConvexObject(points=WEDGE, grip_point=np.array([0.0, 0.02, 0.19]))
    true = BoxPose(position=np.array([*place, BOTTOM]), heading=heading)
    found = look(model, true, view(1.5)).pose
    assert found is not None
    assert np.linalg.norm(found.position - true.position) < 0.02
    assert abs(math.remainder(found.heading - heading, 2.0 * math.pi)) < 0.15
    assert np.linalg.norm(model.grasp_point(found) - model.grasp_point(true)) < 0.025


def test_the_place_of_a_round_object_is_found() -> None:
    model = ConvexObject(
        points=np.array(RING), grip_point=np.array([0.0, 0.0, 0.28]), is_round=True
    )
    true = BoxPose(position=np.array([-0.7, 0.2, BOTTOM]), heading=1.0)
    target = look(model, true, view(1.5))
    assert target.pose is not None
    assert np.linalg.norm(model.grasp_point(target.pose) - model.grasp_point(true)) < 0.02


@pytest.mark.parametrize("angle", [0.0, 0.7, -1.2])
def test_the_jaw_closes_along_the_axis_of_the_model(angle: float) -> None:
    model = ConvexObject(points=WEDGE, grip_point=np.zeros(3), closing_angle=angle)
    pose = BoxPose(position=np.zeros(3), heading=0.3)
    north, east, _ = pose.rotation @ np.array([math.cos(angle), math.sin(angle), 0.0])
    assert model.closing_heading(pose) == pytest.approx(wrap_half_turn(math.atan2(east, north)))


def test_what_has_another_outline_is_not_the_object() -> None:
    small = ConvexObject(points=WEDGE, grip_point=np.zeros(3))
    large = ConvexObject(points=2.0 * WEDGE, grip_point=np.zeros(3))
    pose = BoxPose(position=np.array([-0.7, 0.0, BOTTOM]), heading=0.3)
    target = TargetEstimate()
    seen = view(1.5)
    sighting = ConvexPerception(ColourDetector(), large).observe(
        drawn(small, pose, seen), seen, target, 0.0
    )
    assert sighting is None
    assert target.pose is None


def test_the_bundled_grasp_takes_the_box_by_default() -> None:
    grasp = Grasp()
    pose = BoxPose(position=np.array([1.0, 2.0, 4.9]), heading=0.4)
    assert grasp.model().grasp_point(pose)[2] == pytest.approx(4.9 - grasp.box().handle_height)
    assert grasp.model().closing_heading(pose) == pytest.approx(0.4)
