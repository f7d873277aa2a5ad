"""From a drawn image to the pose of the box."""

import numpy as np
import pytest

from tests.algorithms.grasp.views import BOTTOM, BOX, draw, pose, view
from uwsim.algorithms.direct_tracker import DirectTracker
from uwsim.algorithms.esm.alignment import Method
from uwsim.algorithms.grasp.box import BoxPose, wrap_half_turn
from uwsim.algorithms.grasp.box_pose import Sighting, pose_from_face, pose_from_outline
from uwsim.algorithms.grasp.detector import ColourDetector
from uwsim.algorithms.grasp.perception import Perception
from uwsim.algorithms.grasp.target import TargetEstimate
from uwsim.base.geometry import Pose
from uwsim.base.numerics.linear import transform_points

PLACES = [(-0.6, 0.0, 0.0), (-0.5, 0.2, 0.7), (-0.8, -0.3, 1.5), (-0.9, 0.4, 2.4), (-0.4, 0.0, 0.2)]


def track(image: np.ndarray, quad: np.ndarray) -> DirectTracker | str:
    method = Method(blend="esm", photometric=True, max_iterations=10, precision=1e-3)
    return DirectTracker.from_image(image, quad, levels=2, method=method)


def off(sighting: Sighting | None, true: BoxPose) -> tuple[float, float]:
    """Distance of the handle [m] and of the heading [rad]."""
    assert sighting is not None
    away = float(np.linalg.norm(BOX.grasp_point(sighting.pose) - BOX.grasp_point(true)))
    return away, abs(wrap_half_turn(sighting.pose.heading - true.heading))


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("fog", [1.0, 0.3])
def test_an_outline_gives_the_pose(place: tuple[float, float, float], fog: float) -> None:
    true, seen = pose(*place), view()
    (outline,) = ColourDetector().detect(draw(true, seen, fog=fog), seen)
    away, turned = off(pose_from_outline(outline, seen, BOX), true)
    assert away < 0.05  # the paint of the drawing has no worn edges: it looks larger
    assert turned < 0.06


def test_sand_alone_has_no_outline_nor_has_a_box_in_thick_fog() -> None:
    seen = view()
    assert ColourDetector().detect(draw(None, seen), seen) == []
    assert ColourDetector().detect(draw(pose(*PLACES[0]), seen, fog=0.01), seen) == []


def test_a_box_that_is_half_out_of_the_image_is_no_surprise() -> None:
    seen = view()
    true = pose(-0.8, 1.15, 0.3)
    for outline in ColourDetector().detect(draw(true, seen), seen):
        sighting = pose_from_outline(outline, seen, BOX)
        assert sighting is None or sighting.covariance[1, 1] < 1.0
        assert not outline.is_known.all()


def test_the_corners_of_the_face_give_the_pose() -> None:
    true, seen = pose(-0.7, 0.1, 0.4), view()
    corners = seen.project(transform_points(BOX.top_face, true.rotation, true.position))
    near = pose(-0.65, 0.15, 0.3)
    away, turned = off(pose_from_face(corners, seen, BOX, near), true)
    assert away < 0.002
    assert turned < 0.002


def test_a_box_that_is_seen_again_and_again_is_tracked_and_its_place_gets_surer() -> None:
    true, seen, target = pose(-0.7, 0.1, 0.4), view(), TargetEstimate()
    perception = Perception(ColourDetector(), track, BOX)
    deviations = []
    for k in range(30):
        perception.observe(draw(true, seen, seed=k), seen, target, 0.1 * k)
        deviations.append(target.deviation)
    assert perception.is_tracking
    assert target.pose is not None
    assert np.linalg.norm(BOX.grasp_point(target.pose) - BOX.grasp_point(true)) < 0.05
    assert deviations[-1] < 0.5 * deviations[0]


def test_a_track_ends_when_the_box_is_gone() -> None:
    true, seen, target = pose(-0.7, 0.1, 0.4), view(), TargetEstimate()
    perception = Perception(ColourDetector(), track, BOX)
    for k in range(10):
        perception.observe(draw(true, seen, seed=k), seen, target, 0.1 * k)
    for k in range(3):
        assert perception.observe(draw(None, seen, seed=k), seen, target, 2.0) is None
    assert not perception.is_tracking


def test_a_target_ignores_one_wrong_sighting_and_believes_many() -> None:
    target = TargetEstimate()
    right = Sighting(pose=pose(0, 0, 0), covariance=1e-4 * np.eye(6), residual=0.1)
    wrong = Sighting(pose=pose(1, 0, 0), covariance=1e-4 * np.eye(6), residual=0.1)
    for k in range(5):
        assert target.update(right, float(k))
    assert not target.update(wrong, 5.0)
    assert target.pose is not None
    assert target.pose.position[0] == pytest.approx(0.0)
    for k in range(20):
        target.update(wrong, 6.0 + k)
    assert target.pose.position[0] == pytest.approx(1.0)


def test_the_front_of_a_box_is_its_back() -> None:
    target = TargetEstimate()
    for heading in (0.1, 0.1 + np.pi, 0.1 - np.pi):
        one = Sighting(pose=pose(0, 0, heading), covariance=1e-4 * np.eye(6), residual=0.1)
        assert target.update(one, 0.0)
    assert target.pose is not None
    assert wrap_half_turn(target.pose.heading) == pytest.approx(0.1)


def test_a_pose_goes_to_numbers_and_back() -> None:
    one = BoxPose(position=np.array([1.0, 2.0, BOTTOM]), heading=0.7, tilt=(0.05, -0.1))
    again = BoxPose.from_pose(Pose(one.position, one.rotation))
    assert again.vector == pytest.approx(one.vector)
    assert BoxPose.from_vector(one.vector).vector == pytest.approx(one.vector)
