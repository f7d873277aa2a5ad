"""Path following, against trajectories worked out by hand."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
import pytest

from tests.support.fakes import FakeBody, FakeWorld
from uwsim.base.geometry import rotation_from_rpy, rotation_z
from uwsim.base.numerics.polyline import Polyline
from uwsim.benchmark.measures.path_following import PathFollowing, PathFollowingSpec
from uwsim.benchmark.reference_path import ReferencePathSpec
from uwsim.errors import UnknownName
from uwsim.messages import Path, Point, PoseStamped, Quaternion, header
from uwsim.messages import Pose as PoseMessage

STRAIGHT = [(0.0, 0.0, 0.0), (10.0, 0.0, 0.0)]
CORNER = [(0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (4.0, 3.0, 0.0)]
EXACT = 1e-9


def message(points: Sequence[Sequence[float]]) -> Path:
    turn = Quaternion(x=0.0, y=0.0, z=0.0, w=1.0)
    poses = [
        PoseStamped(
            header=header(0.0), pose=PoseMessage(position=Point(x=x, y=y, z=z), orientation=turn)
        )
        for x, y, z in points
    ]
    return Path(header=header(0.0), poses=poses)


def following(
    world: FakeWorld,
    points: Sequence[Sequence[float]] | None = STRAIGHT,
    *,
    from_: str | None = None,
    value: str = "last",
) -> PathFollowing:
    """A measure that was started after the path, if any, came."""
    spec = PathFollowingSpec(name="p", target="v", topic="path", from_=from_, value=value)  # type: ignore[arg-type]
    measure = spec.bind(world)
    if points is not None:
        send(world, points)
    measure.start()
    return measure


def send(world: FakeWorld, points: Sequence[Sequence[float]]) -> None:
    world.bus.publisher("path", Path)(message(points))
    world.bus.deliver()


def go(
    world: FakeWorld, measure: PathFollowing, where: Callable[[float], tuple[float, float, float]],
    seconds: float,
) -> None:  # fmt: skip
    """Let the body be where ``where`` says at each step of some time from 0 on."""
    body = world.bodies["v"]
    assert isinstance(body, FakeBody)
    for _ in range(round(seconds / world.timestep)):
        world.advance()
        body.move(*where(world.time))
        measure.update()


def test_beside_a_straight_path_the_error_is_the_distance_times_the_time() -> None:
    world = FakeWorld({"v": FakeBody((0.0, 0.3, 0.4))}, timestep=0.01)
    measure = following(world)
    go(world, measure, lambda t: (t, 0.3, 0.4), 5.0)
    assert measure.value == pytest.approx(0.5 * 5.0, abs=EXACT)
    assert measure.unit == "m s"
    details = measure.details
    assert details["iae"] == measure.value
    assert details["ise"] == pytest.approx(0.25 * 5.0, abs=EXACT)
    assert details["distance"] == pytest.approx(0.5, abs=EXACT)
    assert details["max"] == details["distance"]
    assert details["waypoint"] == 0.0
    assert details["share"] == pytest.approx(0.5, abs=EXACT)
    assert details["n"] == 501.0


def test_an_error_that_grows_evenly_is_integrated_without_error() -> None:
    world = FakeWorld({"v": FakeBody()}, timestep=0.01)
    measure = following(world)
    go(world, measure, lambda t: (1.0, t, 0.0), 2.0)
    assert measure.value == pytest.approx(2.0**2 / 2.0, abs=EXACT)
    assert measure.details["ise"] == pytest.approx(2.0**3 / 3.0, abs=EXACT)
    assert measure.details["max"] == pytest.approx(2.0, abs=EXACT)


def test_the_original_sums_the_error_and_calls_it_the_square() -> None:
    world = FakeWorld({"v": FakeBody()}, timestep=0.01, compatibility=frozenset({"path-ise"}))
    measure = following(world)
    go(world, measure, lambda t: (1.0, t, 0.0), 2.0)
    summed = sum(0.01 * k * 0.01 for k in range(1, 201))
    assert measure.value == pytest.approx(summed, abs=EXACT)
    assert measure.details["ise"] == measure.details["iae"] == measure.value
    assert measure.detail_units["ise"] == "m s"
    assert following(FakeWorld({"v": FakeBody()})).detail_units["ise"] == "m^2 s"


def test_past_the_ends_of_the_path_the_ends_count() -> None:
    world = FakeWorld({"v": FakeBody((-3.0, 4.0, 0.0))})
    measure = following(world)
    assert measure.details["distance"] == pytest.approx(5.0, abs=EXACT)
    assert measure.details["share"] == 0.0
    go(world, measure, lambda t: (13.0, 0.0, 4.0), world.timestep)
    assert measure.details["distance"] == pytest.approx(5.0, abs=EXACT)
    assert measure.details["share"] == 1.0


def test_round_a_corner_the_nearer_segment_is_the_current_one() -> None:
    world = FakeWorld({"v": FakeBody()}, timestep=0.5)
    measure = following(world, CORNER)
    places = [(2.0, 0.5, 0.0), (3.6, 0.2, 0.0), (3.8, 0.3, 0.0), (4.1, 2.0, 0.0)]
    seen = []
    for place in places:
        go(world, measure, lambda t, place=place: place, world.timestep)  # type: ignore[misc]
        seen.append((measure.details["waypoint"], measure.details["distance"]))
    assert seen == [
        (0.0, pytest.approx(0.5, abs=EXACT)),
        (0.0, pytest.approx(0.2, abs=EXACT)),
        (1.0, pytest.approx(0.2, abs=EXACT)),
        (1.0, pytest.approx(0.1, abs=EXACT)),
    ]
    assert measure.details["share"] == pytest.approx(6.0 / 7.0, abs=EXACT)


def test_as_near_to_both_the_current_segment_stays() -> None:
    world = FakeWorld({"v": FakeBody((5.0, -1.0, 0.0))})  # nearest to the corner itself
    measure = following(world, CORNER)
    assert measure.details["waypoint"] == 0.0
    assert measure.details["distance"] == pytest.approx(math.sqrt(2.0), abs=EXACT)


def test_one_segment_a_step_and_never_back() -> None:
    stairs = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (2.0, 1.0, 0.0)]
    world = FakeWorld({"v": FakeBody((2.0, 1.0, 0.0))})
    measure = following(world, stairs)
    waypoints = [measure.details["waypoint"]]
    for _ in range(2):
        go(world, measure, lambda t: (2.0, 1.0, 0.0), world.timestep)
        waypoints.append(measure.details["waypoint"])
    assert waypoints == [1.0, 2.0, 2.0]
    go(world, measure, lambda t: (0.0, 0.0, 0.0), world.timestep)
    assert measure.details["waypoint"] == 2.0
    assert measure.details["distance"] == pytest.approx(math.sqrt(2.0), abs=EXACT)
    assert measure.details["share"] == 1.0  # how far it came, though it went back


def test_a_path_turns_and_moves_with_the_frame_it_is_given_in() -> None:
    turn = rotation_from_rpy(0.3, -0.4, 1.2)
    place = np.array([5.0, -2.0, 1.0])
    frame = FakeBody(tuple(place), rotation=turn)
    body = FakeBody(tuple(place + turn @ np.array([2.0, 0.6, -0.8])))
    world = FakeWorld({"v": body, "f": frame})
    measure = following(world, from_="f")
    assert measure.details["distance"] == pytest.approx(1.0, abs=EXACT)
    assert measure.details["share"] == pytest.approx(0.2, abs=EXACT)
    frame.move(*(place + turn @ np.array([0.0, 0.6, -0.8])))
    world.advance()
    measure.update()
    assert measure.details["distance"] == pytest.approx(0.0, abs=EXACT)


@pytest.mark.parametrize(
    ("place", "turn", "quirk"), [((5.0, -2.0, 1.0), 0.9, True), ((0.0, 0.0, 0.0), 0.9, False)]
)
def test_the_original_adds_the_place_of_the_frame_to_the_path(
    place: tuple[float, float, float], turn: float, quirk: bool
) -> None:
    frame = FakeBody(place, rotation=rotation_z(turn))
    body = FakeBody(tuple(np.array(place) + rotation_z(turn) @ np.array([2.0, 1.0, 0.0])))
    world = FakeWorld({"v": body, "f": frame}, compatibility=frozenset({"path-frame"}))
    measure = following(world, from_="f")
    moved = Polyline(np.array(STRAIGHT) + np.array(place))
    expected, _ = moved.find_nearest(0, np.array([2.0, 1.0, 0.0]))
    assert measure.details["distance"] == pytest.approx(expected, abs=EXACT)
    assert (abs(expected - 1.0) > 1e-6) is quirk


def test_without_from_the_path_is_in_the_world() -> None:
    world = FakeWorld({"v": FakeBody((3.0, 0.0, -2.0))})
    assert following(world).details["distance"] == pytest.approx(2.0, abs=EXACT)


def test_without_a_path_there_is_no_value_and_the_reason_says_so() -> None:
    world = FakeWorld({"v": FakeBody()})
    spec = PathFollowingSpec(name="p", target="v", topic="path")
    measure = spec.bind(world)
    assert (measure.value, measure.missing_reason) == (None, "it was never on")
    measure.start()
    assert (measure.value, measure.missing_reason) == (None, "no path on 'path'")
    assert measure.details["n"] == 0.0
    assert measure.details["iae"] is None
    assert measure.log_values == (None,) * 5
    nowhere = PathFollowingSpec(name="p", target="v").bind(world)
    nowhere.start()
    assert nowhere.missing_reason == "neither <topic> nor <u:path> gives a path"
    assert not measure.fed_by_algorithm


def test_what_passed_before_there_was_a_path_does_not_count() -> None:
    world = FakeWorld({"v": FakeBody((1.0, 2.0, 0.0))}, timestep=0.5)
    measure = following(world, None)
    go(world, measure, lambda t: (1.0, 2.0, 0.0), 5.0)
    world.bus.publisher("path", Path)(message(STRAIGHT))
    go(world, measure, lambda t: (1.0, 2.0, 0.0), 0.5)
    assert measure.value == 0.0
    go(world, measure, lambda t: (1.0, 2.0, 0.0), 3.0)
    assert measure.value == pytest.approx(6.0, abs=EXACT)


def test_what_passes_during_a_pause_does_not_count() -> None:
    world = FakeWorld({"v": FakeBody((1.0, 2.0, 0.0))}, timestep=0.5)
    measure = following(world)
    go(world, measure, lambda t: (1.0, 2.0, 0.0), 1.0)
    world.advance(100)
    measure.start()
    go(world, measure, lambda t: (1.0, 2.0, 0.0), 1.0)
    assert measure.value == pytest.approx(4.0, abs=EXACT)


def test_the_first_path_stays_until_the_level_is_over() -> None:
    world = FakeWorld({"v": FakeBody((1.0, 2.0, 0.0))})
    measure = following(world)
    send(world, [(0.0, 2.0, 0.0), (1.0, 2.0, 0.0)])
    measure.update()
    assert measure.details["distance"] == 2.0
    measure.close()
    next_level = following(world, None)
    assert next_level.details["distance"] == 0.0


def test_a_path_that_came_before_the_level_began_is_taken_when_it_starts() -> None:
    world = FakeWorld({"v": FakeBody((1.0, 2.0, 0.0))})
    spec = PathFollowingSpec(name="p", target="v", topic="path")
    spec.bind(world).close()  # every name is looked up before the algorithm starts
    send(world, STRAIGHT)
    measure = spec.bind(world)
    measure.start()
    assert measure.details["distance"] == 2.0


@pytest.mark.parametrize(
    ("points", "why"),
    [
        ([], "the path on 'path' has no points"),
        ([(0.0, math.nan, 0.0)], "the path on 'path' has points that are no finite numbers"),
    ],
)
def test_a_path_that_cannot_be_followed_is_passed_over(
    points: list[tuple[float, float, float]], why: str
) -> None:
    world = FakeWorld({"v": FakeBody((1.0, 2.0, 0.0))})
    measure = following(world, points)
    assert (measure.value, measure.missing_reason, measure.notes) == (None, why, (why,))
    send(world, STRAIGHT)
    measure.update()
    assert measure.details["distance"] == 2.0


def test_a_single_point_is_a_path_without_a_length() -> None:
    world = FakeWorld({"v": FakeBody((3.0, 4.0, 0.0))})
    measure = following(world, [(0.0, 0.0, 0.0)])
    assert measure.details["distance"] == 5.0
    assert measure.details["share"] is None
    assert measure.reasons == {"share": "the path has no length"}
    assert measure.value == 0.0


TWICE = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 0.0, 0.0), (2.0, 0.0, 0.0), (2.0, 9.0, 0.0)]


def test_a_point_given_twice_holds_nobody_up_and_is_still_counted() -> None:
    world = FakeWorld({"v": FakeBody()})
    measure = following(world, TWICE)
    go(world, measure, lambda t: (1.5, 0.0, 0.0), world.timestep)
    assert (measure.details["distance"], measure.details["waypoint"]) == (0.0, 1.0)
    go(world, measure, lambda t: (2.0, 4.5, 0.0), world.timestep)
    assert (measure.details["distance"], measure.details["waypoint"]) == (0.0, 3.0)
    assert measure.details["share"] == pytest.approx(6.5 / 11.0, abs=EXACT)


def test_in_the_original_a_point_given_twice_ends_the_path() -> None:
    world = FakeWorld({"v": FakeBody()}, compatibility=frozenset({"path-repeats"}))
    measure = following(world, TWICE)
    go(world, measure, lambda t: (1.5, 0.0, 0.0), 10 * world.timestep)
    assert (measure.details["distance"], measure.details["waypoint"]) == (0.5, 0.0)


def test_the_value_may_be_a_statistic_of_the_distance() -> None:
    world = FakeWorld({"v": FakeBody((0.0, 3.0, 0.0))}, timestep=0.5)
    measure = following(world, value="rms")
    go(world, measure, lambda t: (0.0, 4.0, 0.0), 0.5)
    assert measure.value == pytest.approx(math.sqrt(12.5), abs=EXACT)
    assert measure.unit == "m"
    assert measure.details["iae"] == pytest.approx(1.75, abs=EXACT)
    assert measure.detail_units["iae"] == "m s"


def test_its_log_begins_with_the_originals_three_details() -> None:
    world = FakeWorld({"v": FakeBody((0.0, 3.0, 0.0))}, timestep=0.5)
    measure = following(world)
    go(world, measure, lambda t: (0.0, 3.0, 0.0), 1.0)
    assert measure.log_header == ("iae", "distance", "waypoint", "ise", "share")
    assert measure.log_values == pytest.approx((3.0, 3.0, 0.0, 9.0, 0.0), abs=EXACT)


def test_every_detail_has_a_unit() -> None:
    measure = following(FakeWorld({"v": FakeBody()}))
    assert set(measure.details) == set(measure.detail_units)


def test_names_that_are_not_there_are_errors_that_name_the_right_one() -> None:
    world = FakeWorld({"girona500": FakeBody()})
    with pytest.raises(UnknownName, match="Did you mean 'girona500'"):
        PathFollowingSpec(name="p", target="girona50", topic="t").bind(world)
    with pytest.raises(UnknownName, match="Did you mean 'girona500'"):
        PathFollowingSpec(name="p", target="girona500", topic="t", from_="girona5").bind(world)


def test_a_path_of_one_point_is_a_place_and_for_the_original_no_path() -> None:
    body = FakeBody((0.0, 3.0, 4.0))
    for quirks, value in ((frozenset[str](), 5.0), (frozenset({"path-point"}), None)):
        world = FakeWorld({"v": body}, timestep=1.0, compatibility=quirks)
        measure = following(world, [(0.0, 0.0, 0.0)])
        world.advance()
        measure.update()
        assert measure.value == value
    assert measure.missing_reason == "the path on 'path' has one point"


@pytest.mark.parametrize("topic", [None, "path"])
def test_a_path_of_the_file_is_followed_and_published_where_there_is_a_topic(
    topic: str | None,
) -> None:
    world = FakeWorld({"v": FakeBody((0.0, 0.3, 0.4))}, timestep=0.01)
    reference = ReferencePathSpec(points=(0.0, 0.0, 0.0, 10.0, 0.0, 0.0))
    spec = PathFollowingSpec(name="p", target="v", topic=topic, reference=reference)
    measure = spec.bind(world)
    inbox = world.bus.inbox("path", Path)
    measure.start()
    world.bus.deliver()
    go(world, measure, lambda t: (t, 0.3, 0.4), 5.0)
    assert measure.value == pytest.approx(0.5 * 5.0, abs=EXACT)
    assert measure.details["share"] == pytest.approx(0.5, abs=EXACT)
    published = inbox.take()
    assert len(published) == (topic is not None)
    for path in published:
        assert [pose.pose.position.x for pose in path.poses] == [0.0, 10.0]


def test_without_topic_and_path_there_is_no_value() -> None:
    measure = PathFollowingSpec(name="p", target="v").bind(FakeWorld({"v": FakeBody()}))
    measure.start()
    assert measure.value is None
    assert measure.missing_reason == "neither <topic> nor <u:path> gives a path"


def task(world: FakeWorld, points: Sequence[float] = (0, 0, 0, 10, 0, 0)) -> PathFollowing:
    """A task along a path: to 80 % of it, and no farther than 1 m from it."""
    spec = PathFollowingSpec(
        name="p",
        target="v",
        value="rms",
        end_share=0.8,
        max_distance=1.0,
        reference=ReferencePathSpec(points=tuple(map(float, points))),
    )
    measure = spec.bind(world)
    measure.start()
    return measure


def test_a_path_ends_the_level_at_its_share() -> None:
    world = FakeWorld({"v": FakeBody((0.0, 0.0, 0.0))}, timestep=0.01)
    measure = task(world)
    go(world, measure, lambda t: (t, 0.0, 0.0), 7.9)
    assert (measure.ends_level, measure.task_status) == (
        None, ("timeout", "reached 0.79 of the path")
    )  # fmt: skip
    assert measure.details["time_done"] is None
    assert measure.reasons["time_done"] == "the end of the path was not reached"
    go(world, measure, lambda t: (t, 0.0, 0.0), 0.2)
    assert measure.ends_level is not None
    assert measure.task_status == ("ok", None)
    assert measure.details["time_done"] == pytest.approx(8.0, abs=EXACT)
    assert "time_done" not in measure.reasons


def test_a_body_too_far_from_the_path_is_lost() -> None:
    world = FakeWorld({"v": FakeBody((0.0, 0.0, 0.0))}, timestep=0.01)
    measure = task(world)
    go(world, measure, lambda t: (t, t, 0.0), 1.01)
    assert measure.task_status == ("lost", "1.01 m from the path at 1.01 s")
    assert measure.ends_level == "1.01 m from the path at 1.01 s"


def test_a_path_without_an_end_is_no_task() -> None:
    world = FakeWorld({"v": FakeBody((0.0, 0.3, 0.4))}, timestep=0.01)
    measure = following(world)
    go(world, measure, lambda t: (t, 50.0, 0.0), 11.0)
    assert (measure.ends_level, measure.task_status) == (None, None)
    assert "time_done" not in measure.details


def test_the_line_of_an_object_is_a_path_at_a_height() -> None:
    world = FakeWorld({"v": FakeBody((1.0, 0.0, 5.0))}, timestep=0.01)
    world.courses["pipe"] = np.array([[0.0, 0.0, 3.0], [9.0, 0.0, 3.0]])
    reference = ReferencePathSpec(object="pipe", height=1.5)
    measure = PathFollowingSpec(name="p", target="v", value="max", reference=reference).bind(world)
    measure.start()
    assert measure.value == 0.5
    with pytest.raises(UnknownName, match="cable"):
        ReferencePathSpec(object="cable").read("", world)


@pytest.mark.parametrize(
    ("reference", "message"),
    [
        (ReferencePathSpec(object="pipe", points=(0.0, 0.0, 0.0)), "needs one of"),
        (ReferencePathSpec(points=(0.0, 0.0, 0.0), height=1.0), "above an <u:object>"),
    ],
)
def test_a_path_of_two_sources_is_an_error(reference: ReferencePathSpec, message: str) -> None:
    assert message in reference.errors()[0]
