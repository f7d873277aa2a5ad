"""Reconstruction from point clouds: frames, what counts, and compatibility quirks."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.support.fakes import FakeBody, FakeWorld
from uwsim.base.geometry import Pose, rotation_from_rpy, rotation_y, rotation_z
from uwsim.benchmark.measures.reconstruction_3d import Reconstruction3D, Reconstruction3DSpec
from uwsim.errors import BadSetting, UnknownName
from uwsim.messages import PointCloud2, point_cloud
from uwsim.world import Box

EXACT = 1e-9
BLACK_BOX = Box((-0.5, -0.3, 0.0), (0.5, 0.3, 0.4))
FRONT = np.array([[0.52, 0.0, 0.2], [0.50, 0.1, 0.3], [0.46, -0.1, 0.25], [2.0, 0.0, 0.2]])
"""Three points near the face x = 0.5 with the errors 0.02, 0, 0.04, and one far away."""


def sea(
    *quirks: str, target: Pose | None = None, frame: Pose | None = None, box: Box | None = BLACK_BOX
) -> FakeWorld:
    target, frame = target or Pose.identity(), frame or Pose.identity()
    bodies = {
        "blackbox": FakeBody(tuple(target.position), rotation=target.rotation, box=box),
        "arm": FakeBody(tuple(frame.position), rotation=frame.rotation),
    }
    return FakeWorld(bodies, compatibility=frozenset(quirks))


def bound(world: FakeWorld, lod: float = 0.1) -> Reconstruction3D:
    return Reconstruction3DSpec(
        name="r", target="blackbox", topic="/cloud", from_="arm", level_of_detail=lod
    ).bind(world)


def cloud(points: np.ndarray) -> PointCloud2:
    """A cloud of doubles, so that no digit is lost."""
    message = point_cloud(points)
    for i, field in enumerate(message.fields):
        field.datatype, field.offset = 8, 8 * i
    message.point_step, message.row_step = 24, 24 * len(points)
    message.data = np.frombuffer(np.asarray(points, dtype="<f8").tobytes(), dtype=np.uint8)
    return message


def send(world: FakeWorld, measure: Reconstruction3D, *clouds: PointCloud2) -> None:
    publish = world.bus.publisher("cloud", PointCloud2)
    for each in clouds:
        publish(each)
    world.advance()
    measure.update()


def in_frame(world: FakeWorld, points: np.ndarray) -> np.ndarray:
    """Points of the target's frame as the arm sees them."""
    arm, target = world.body("arm"), world.body("blackbox")
    frame_from_target = arm.world_from_body.inverse() @ target.world_from_body
    return frame_from_target.transform(points)


def check_front(measure: Reconstruction3D) -> None:
    """Assert what `FRONT` gives."""
    assert measure.value == pytest.approx(0.02, abs=EXACT)
    details = measure.details
    assert details["mean_error"] == measure.value
    assert details["error_variance"] == pytest.approx(0.0004, abs=EXACT)
    assert details["outlier_share"] == pytest.approx(0.25, abs=EXACT)
    assert (details["n_inliers"], details["n_outliers"], details["n_ground"]) == (3.0, 1.0, 0.0)


def test_points_near_a_face_by_hand() -> None:
    world = sea()
    measure = bound(world)
    assert (measure.value, measure.missing_reason) == (None, "it was never on")
    measure.start()
    send(world, measure, cloud(FRONT))
    check_front(measure)
    # nodes on x = 0.5: (0.52, 0, 0.2) marks y 3 z 2; (0.5, 0.1, 0.3) y 4 z 3; (0.46, -0.1, 0.25)
    # y 2, z 2 and 3
    assert measure.details["coverage"] == pytest.approx(4 / 205, abs=EXACT)
    assert measure.unit == "m"
    assert measure.fed_by_algorithm
    assert measure.longest_silence == 0.0


@pytest.mark.parametrize("tilt", [(0.0, 0.0, 0.0), (0.1, -0.2, 0.4), (math.pi, 0.1, -2.0)])
def test_the_box_may_lie_as_it_likes_and_the_frame_too(tilt: tuple[float, float, float]) -> None:
    world = sea(
        target=Pose(np.array([2.0, -1.0, -4.0]), rotation_from_rpy(*tilt)),
        frame=Pose(np.array([0.5, 1.0, -2.0]), rotation_from_rpy(-0.7, 0.9, 2.1)),
    )
    measure = bound(world)
    measure.start()
    points = FRONT.copy()
    if tilt[0] == math.pi:  # its other face of z stands on the ground
        points[:, 2] = 0.4 - points[:, 2]
    send(world, measure, cloud(in_frame(world, points)))
    check_front(measure)


def test_a_box_on_its_side_is_seen_from_its_new_top() -> None:
    world = sea(target=Pose(np.zeros(3), rotation_y(math.pi / 2)))  # its -x is up
    measure = bound(world)
    measure.start()
    on_top = np.array([[-0.5, y, z] for y in np.linspace(-0.3, 0.3, 7) for z in (0.0, 0.2, 0.4)])
    send(world, measure, cloud(in_frame(world, on_top)))
    n_nodes = 11 * 7 * 5 - 3 * 5 * 10  # the open side is x = 0.5
    assert measure.details["coverage"] == pytest.approx(21 / n_nodes, abs=EXACT)
    assert measure.value == pytest.approx(0.0, abs=EXACT)
    below = np.array([[0.48, 0.8, 0.8], [0.5, 0.0, 0.6]])
    send(world, measure, cloud(in_frame(world, below)))
    assert measure.details["n_ground"] == 2.0


def test_each_cloud_is_placed_where_the_frame_stands_when_it_arrives() -> None:
    world = sea()
    measure = bound(world)
    measure.start()
    arm = world.body("arm")
    assert isinstance(arm, FakeBody)
    for place, turn in (((0.3, 0.2, 0.1), 0.5), ((-1.0, 0.0, 2.0), -1.0)):
        arm.move(*place)
        arm.turn(rotation_z(turn))
        send(world, measure, cloud(in_frame(world, FRONT)))
    assert measure.value == pytest.approx(0.02, abs=EXACT)
    assert measure.details["error_variance"] == pytest.approx(0.0016 / 5, abs=EXACT)
    assert measure.details["n_clouds"] == 2.0


def test_the_original_places_all_clouds_where_the_frame_stood_at_first() -> None:
    world = sea("reconstruction-transform")
    measure = bound(world)
    arm = world.body("arm")
    assert isinstance(arm, FakeBody)
    arm.move(0.0, 0.1, 0.0)
    measure.start()
    send(world, measure, cloud(np.array([[0.52, 0.0, 0.2], [0.52, 0.25, 0.2]])))
    assert measure.value == pytest.approx(0.02, abs=EXACT)
    repaired = sea()
    now = bound(repaired)
    moved = repaired.body("arm")
    assert isinstance(moved, FakeBody)
    moved.move(0.0, 0.1, 0.0)
    now.start()
    send(repaired, now, cloud(np.array([[0.52, 0.0, 0.2], [0.52, 0.25, 0.2]])))
    assert now.value == pytest.approx((0.02 + math.hypot(0.02, 0.05)) / 2, abs=EXACT)


def test_the_originals_box_is_right_for_quarter_turns_and_wrong_for_others() -> None:
    for turn, is_right in ((math.pi / 2, True), (math.pi / 4, False)):
        target = Pose(np.array([1.0, 2.0, 0.0]), rotation_z(turn))
        values = []
        for quirks in ((), ("reconstruction-box",)):
            world = sea(*quirks, target=target)
            measure = bound(world)
            measure.start()
            send(world, measure, cloud(in_frame(world, FRONT)))
            values.append(measure.details)
        assert values[0]["mean_error"] == pytest.approx(0.02, abs=EXACT)
        assert (values[1] == pytest.approx(values[0], abs=EXACT)) is is_right


def test_the_originals_box_at_45_degrees_by_hand() -> None:
    world = sea("reconstruction-box", target=Pose(np.zeros(3), rotation_z(math.pi / 4)))
    measure = bound(world)
    measure.start()
    # corners (-0.5, -0.3) and (0.5, 0.3) turned: x' +-0.2/sqrt(2), y' +-0.8/sqrt(2)
    send(world, measure, cloud(np.array([[0.2 / math.sqrt(2) + 0.03, 0.0, 0.2]])))
    assert measure.value == pytest.approx(0.03, abs=EXACT)


def test_the_original_divides_by_another_number_of_nodes() -> None:
    shares = {}
    for quirks in ((), ("reconstruction-coverage",)):
        world = sea(*quirks, box=Box((0.0, 0.0, 0.0), (1.0, 0.5, 0.375)))
        measure = bound(world, 0.125)
        measure.start()
        send(world, measure, cloud(np.array([[1.0, 0.0625, 0.0]])))
        shares[quirks] = measure.details["coverage"]
    assert shares == {
        (): pytest.approx(2 / 117, abs=EXACT),
        ("reconstruction-coverage",): pytest.approx(2 / 124, abs=EXACT),
    }


def test_without_an_inlier_there_is_no_value_and_the_reason_counts_the_rest() -> None:
    world = sea()
    measure = bound(world)
    measure.start()
    assert (measure.value, measure.missing_reason) == (None, "no cloud on '/cloud'")
    assert measure.details["coverage"] is None
    send(world, measure, cloud(np.array([[3.0, 0.0, 0.3], [3.0, 0.0, 0.0], [np.nan, 0.0, 0.0]])))
    assert measure.value is None
    assert measure.missing_reason == (
        "none of the points on '/cloud' belongs to the target: 1 are ground, 1 outliers, "
        "1 no places"
    )
    details = measure.details
    assert (details["mean_error"], details["error_variance"]) == (None, None)
    assert (details["coverage"], details["outlier_share"]) == (0.0, 1.0)


def test_in_the_original_nothing_is_an_error_of_0_with_a_variance_of_0_by_minus_1() -> None:
    world = sea("reconstruction-empty")
    measure = bound(world)
    assert measure.value is None
    measure.start()
    assert (measure.value, measure.missing_reason) == (0.0, None)
    variance = measure.details["error_variance"]
    assert variance == 0.0
    assert math.copysign(1.0, variance) == -1.0
    assert measure.details["coverage"] == 0.0
    assert measure.details["outlier_share"] is None
    assert measure.reasons == {"outlier_share": "there was no inlier and no outlier: 0/0"}
    send(world, measure, cloud(FRONT))
    check_front(measure)
    assert measure.reasons == {}


def test_one_inlier_has_no_variance_and_the_reason_says_so() -> None:
    world = sea()
    measure = bound(world)
    measure.start()
    send(world, measure, cloud(FRONT[:1]))
    assert measure.value == pytest.approx(0.02, abs=EXACT)
    assert measure.details["error_variance"] is None
    assert measure.reasons == {"error_variance": "there was one inlier only"}


def test_what_came_before_the_start_is_forgotten_and_the_rest_adds_up() -> None:
    world = sea()
    measure = bound(world)
    world.bus.publisher("cloud", PointCloud2)(cloud(FRONT + 9.0))
    world.advance()
    measure.start()
    send(world, measure, cloud(FRONT[:2]), cloud(FRONT[2:]))
    check_front(measure)
    assert measure.details["n_clouds"] == 2.0
    world.advance(10_000)
    measure.update()
    check_front(measure)


def test_a_cloud_that_cannot_be_read_is_a_note_and_no_crash() -> None:
    world = sea()
    measure = bound(world)
    measure.start()
    blind, cut = cloud(FRONT), cloud(FRONT)
    blind.fields = blind.fields[:1]
    cut.data = cut.data[:50]
    send(world, measure, blind, cut, blind)
    first = "a cloud on '/cloud' was not used: it has no field 'y'; its fields: 'x'"
    assert (measure.value, measure.missing_reason) == (None, first)
    assert measure.notes == (
        first,
        "a cloud on '/cloud' was not used: it has 50 bytes, 1 x 4 points need 96",
    )
    send(world, measure, cloud(FRONT))
    check_front(measure)


def test_its_log_has_the_originals_four_details() -> None:
    world = sea()
    measure = bound(world)
    measure.start()
    send(world, measure, cloud(FRONT))
    assert measure.log_header == ("mean_error", "error_variance", "coverage", "outlier_share")
    assert measure.log_values == pytest.approx((0.02, 0.0004, 4 / 205, 0.25), abs=EXACT)


def test_every_detail_has_a_unit() -> None:
    measure = bound(sea())
    assert set(measure.details) == set(measure.detail_units)
    assert measure.detail_units["error_variance"] == "m^2"


def test_with_details_to_globals_result_dat_has_the_originals_names() -> None:
    spec = Reconstruction3DSpec(
        name="r", target="b", topic="t", from_="f", detailed_results_to_globals=True
    )
    assert dict(spec.original_fields) == {
        "mean error": "r.mean_error",
        "error variance": "r.error_variance",
        "coverage %": "r.coverage",
        "outliers %": "r.outlier_share",
    }
    plain = Reconstruction3DSpec(name="r", target="b", topic="t", from_="f")
    assert dict(plain.original_fields) == {"r": "r"}


def test_without_from_clouds_are_given_in_the_world() -> None:
    stands = Pose.from_rpy((1.0, 2.0, -3.0), (0.0, 0.0, 0.5))
    values = []
    for frame, frame_pose in ((None, Pose.identity()), ("arm", Pose.identity())):
        world = sea(target=stands, frame=frame_pose)
        measure = Reconstruction3DSpec(
            name="r", target="blackbox", topic="/cloud", from_=frame, level_of_detail=0.1
        ).bind(world)
        send(world, measure, cloud(stands.transform(np.array([[0.1, 0.2, 0.49]]))))
        values.append(measure.value)
    assert values[0] is not None
    assert values[0] == values[1]


def test_what_has_no_shape_cannot_be_rebuilt_and_what_is_not_there_is_named() -> None:
    with pytest.raises(BadSetting, match=r"'blackbox' has no shape .* link@visual") as shapeless:
        bound(sea(box=None))
    assert shapeless.value.name == "blackbox"
    with pytest.raises(BadSetting, match=r"<levelOfDetail> 0\.0001 m makes more than") as fine:
        bound(sea(), lod=0.0001)
    assert fine.value.name == "r"
    with pytest.raises(UnknownName, match="Did you mean 'blackbox'"):
        Reconstruction3DSpec(name="r", target="blackbx", topic="t", from_="arm").bind(sea())


def test_it_listens_no_more_when_closed() -> None:
    world = sea()
    measure = bound(world)
    measure.close()
    assert not world.bus.has_subscribers("cloud")
