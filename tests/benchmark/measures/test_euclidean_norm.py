"""The Euclidean norm: which estimates are scored, against what, and when there is no value."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.support.fakes import FakeBody, FakeCamera, FakeWorld
from uwsim.benchmark.ground_truth import (
    CentroidFromCameraSpec,
    ConstantSpec,
    CornersFromCameraSpec,
    RelativeLocationSpec,
)
from uwsim.benchmark.measures import EuclideanNorm, EuclideanNormSpec
from uwsim.benchmark.triggers import ServiceSpec
from uwsim.errors import UnknownName
from uwsim.messages import Empty, Float32MultiArray, GTpublish, GTpublishResponse, floats
from uwsim.runs.trial.triggered_measure import TriggeredMeasure
from uwsim.world import Box

STEPS_PER_SECOND = 500


def norm_of(world: FakeWorld, *truth: float, value: str = "last") -> EuclideanNorm:
    spec = EuclideanNormSpec(
        name="e", ground_truth=ConstantSpec(values=truth), target="estimate", value=value
    )  # type: ignore[arg-type]
    return spec.bind(world)


def say(world: FakeWorld, norm: EuclideanNorm, *estimate: float) -> None:
    """Publish an estimate, let one step pass, let the measure look."""
    world.bus.publisher("estimate", Float32MultiArray)(floats(estimate))
    world.advance()
    norm.update()


def wait(world: FakeWorld, norm: EuclideanNorm, steps: int) -> None:
    for _ in range(steps):
        world.advance()
        norm.update()


def test_the_norm_is_the_root_of_the_summed_squares() -> None:
    world = FakeWorld()
    norm = norm_of(world, 10.0, 20.0, 30.0)
    norm.start()
    say(world, norm, 9.0, 22.0, 28.0)
    assert norm.value == 3.0
    assert norm.log_header == ("total", "1", "2", "3")
    assert norm.log_values == (3.0, 1.0, -2.0, 2.0)


def test_an_estimate_holds_until_the_next() -> None:
    world = FakeWorld()
    norm = norm_of(world, 0.0)
    norm.start()
    for error, steps in ((3.0, 10), (5.0, 32)):
        say(world, norm, error)
        wait(world, norm, steps)
    assert norm.details["n"] == 2.0
    assert norm.details["mean"] == pytest.approx((3.0 * 11 + 5.0 * 33) / 44)


def test_of_two_estimates_in_one_step_the_newer_is_scored() -> None:
    world = FakeWorld()
    norm = norm_of(world, 0.0)
    norm.start()
    world.bus.publisher("estimate", Float32MultiArray)(floats([9.0]))
    say(world, norm, 2.0)
    assert (norm.value, norm.details["n"], norm.details["frames"]) == (2.0, 2.0, 1.0)


@pytest.mark.parametrize(
    ("value", "expected"),
    [("last", 1.0), ("mean", 3.0), ("rms", math.sqrt(35 / 3)), ("max", 5.0)],
)
def test_the_value_is_the_statistic_the_file_asks_for(value: str, expected: float) -> None:
    world = FakeWorld()
    norm = norm_of(world, 0.0, value=value)
    norm.start()
    for estimate in (3.0, -5.0, 1.0):
        say(world, norm, estimate)
    assert norm.value == pytest.approx(expected)


def test_every_component_has_its_statistics() -> None:
    world = FakeWorld()
    norm = norm_of(world, 0.0, 0.0)
    norm.start()
    say(world, norm, -3.0, 4.0)
    say(world, norm, 5.0, 12.0)
    assert norm.details == pytest.approx(
        {
            "mean": 9.0, "rms": math.sqrt(97.0), "max": 13.0, "std": 4.0, "n": 2.0,
            "1.mean": -1.0, "1.rms": math.sqrt(17.0), "1.max": 5.0, "1.std": 4.0, "1.n": 2.0,
            "2.mean": -8.0, "2.rms": math.sqrt(80.0), "2.max": 12.0, "2.std": 4.0, "2.n": 2.0,
            "refused": 0.0, "frames": 2.0, "answered": 1.0,
        }
    )  # fmt: skip


def test_no_estimate_is_no_value_and_a_reason_never_minus_one() -> None:
    world = FakeWorld()
    norm = norm_of(world, 0.0)
    assert (norm.value, norm.missing_reason) == (None, "it was never on")
    norm.start()
    wait(world, norm, 10)
    assert (norm.value, norm.missing_reason) == (None, "no estimate on 'estimate'")
    assert norm.details["n"] == 0.0
    assert norm.details["mean"] is None


def test_what_arrived_before_the_start_is_forgotten() -> None:
    world = FakeWorld()
    norm = norm_of(world, 0.0)
    world.bus.publisher("estimate", Float32MultiArray)(floats([7.0]))
    world.advance()
    norm.start()
    wait(world, norm, 1)
    assert norm.value is None


def test_an_estimate_of_the_wrong_length_is_not_scored_and_says_so() -> None:
    world = FakeWorld()
    norm = norm_of(world, 1.0, 2.0)
    norm.start()
    say(world, norm, 1.0)
    assert norm.value is None
    assert norm.missing_reason == "the estimate on 'estimate' has 1 numbers, expected 2"
    say(world, norm, 1.0, 2.0)
    assert (norm.value, norm.missing_reason) == (0.0, None)


def test_an_estimate_that_is_not_finite_is_not_scored() -> None:
    world = FakeWorld()
    norm = norm_of(world, 1.0)
    norm.start()
    say(world, norm, math.nan)
    assert norm.missing_reason == "the estimate on 'estimate' is not finite"


@pytest.mark.parametrize("value", ["last", "mean"])
def test_an_estimate_older_than_a_second_is_not_scored(value: str) -> None:
    world = FakeWorld()
    norm = norm_of(world, 0.0, value=value)
    norm.start()
    say(world, norm, 4.0)
    wait(world, norm, STEPS_PER_SECOND)
    assert norm.value == 4.0
    wait(world, norm, 1)
    assert norm.value is None
    assert norm.missing_reason == "no estimate on 'estimate' for 1.002 s from 0.002 s on"
    assert norm.longest_silence == pytest.approx(1.002)


def test_a_silence_in_the_middle_is_not_healed_by_an_estimate_after_it() -> None:
    world = FakeWorld()
    norm = norm_of(world, 0.0)
    norm.start()
    wait(world, norm, STEPS_PER_SECOND + 1)
    say(world, norm, 4.0)
    assert norm.value is None


def test_the_original_lets_the_last_norm_stand() -> None:
    world = FakeWorld(compatibility=frozenset({"last-norm"}))
    norm = norm_of(world, 0.0)
    norm.start()
    say(world, norm, 4.0)
    assert norm.log_values == (4.0, -4.0)
    wait(world, norm, 5 * STEPS_PER_SECOND)
    assert (norm.value, norm.missing_reason) == (4.0, None)
    assert norm.longest_silence == 0.0  # so that the level is no timeout
    assert norm.log_values == (4.0, 0.0)  # its components are those of no new estimate


def test_in_the_original_an_estimate_counts_that_came_while_the_measure_was_off() -> None:
    for quirks, value in ((frozenset[str](), 4.0), (frozenset({"last-norm"}), 7.0)):
        world = FakeWorld(compatibility=quirks)
        spec = EuclideanNormSpec(
            name="e", ground_truth=ConstantSpec(values=(0.0,)), target="estimate",
            stop_on=ServiceSpec(target="stop"),
        )  # fmt: skip
        triggered = TriggeredMeasure(spec, world)
        publish = world.bus.publisher("estimate", Float32MultiArray)
        triggered.tick()
        for estimate in (4.0, 7.0):
            publish(floats([estimate]))
            world.advance()
            triggered.tick()
            if estimate == 4.0:
                world.bus.services.call("stop", Empty())
                world.advance()
                triggered.tick()
        triggered.end()
        assert triggered.value == value


def test_where_no_estimate_came_at_all_the_original_has_none_either() -> None:
    norm = norm_of(world := FakeWorld(compatibility=frozenset({"last-norm"})), 0.0)
    norm.start()
    wait(world, norm, 2 * STEPS_PER_SECOND)
    assert norm.value is None
    assert norm.longest_silence == pytest.approx(2.0)


def test_a_log_keeps_the_components_of_the_newest_estimate() -> None:
    world = FakeWorld()
    norm = norm_of(world, 0.0)
    norm.start()
    say(world, norm, 4.0)
    wait(world, norm, 3)
    assert norm.log_values == (4.0, -4.0)


def seen_box(**camera: object) -> tuple[FakeWorld, FakeBody]:
    """A box of 0.4 x 0.2 x 0.1 m straight below a camera that looks down from 1.05 m."""
    box = Box((-0.2, -0.1, -0.05), (0.2, 0.1, 0.05))
    body = FakeBody((0.0, 0.0, -1.05), box=box)
    return FakeWorld({"box": body}, {"cam": FakeCamera(**camera)}), body  # type: ignore[arg-type]


def started_on_the_box() -> tuple[FakeWorld, FakeBody, EuclideanNorm, np.ndarray]:
    """`seen_box` with a measure that is on, and an estimate that is the truth."""
    world, body = seen_box()
    norm = corners_spec().bind(world)
    norm.start()
    seen = norm.ground_truth
    assert seen is not None
    say(world, norm, *seen)
    return world, body, norm, seen


def test_a_log_shows_how_an_old_estimate_becomes_wrong_and_then_nothing() -> None:
    world, body, norm, seen = started_on_the_box()
    assert norm.log_values[0] == pytest.approx(0.0, abs=1e-4)
    body.move(0.1, 0.0, -1.05)  # the truth goes on, the estimate does not
    wait(world, norm, STEPS_PER_SECOND)
    assert norm.log_values[0] == pytest.approx(2.0 * 0.1 * 257.34083, rel=1e-5)
    wait(world, norm, 1)
    assert norm.log_values == (None,) * 9
    say(world, norm, *seen)
    assert norm.log_values[0] == pytest.approx(2.0 * 0.1 * 257.34083, rel=1e-5)


def test_a_log_has_a_gap_where_the_truth_is_gone() -> None:
    world, body, norm, _ = started_on_the_box()
    body.move(0.0, 0.0, 3.0)
    wait(world, norm, 1)
    assert norm.log_values == (None,) * 9


def test_a_measure_that_starts_again_logs_nothing_of_its_first_time() -> None:
    world = FakeWorld()
    norm = norm_of(world, 0.0)
    norm.start()
    say(world, norm, 4.0)
    norm.start()
    assert norm.log_values == (None, None)


def corners_spec(publish_on: str | None = None) -> EuclideanNormSpec:
    truth = CornersFromCameraSpec(camera="cam", target="box", publish_on=publish_on)
    return EuclideanNormSpec(name="corners", ground_truth=truth, target="estimate")


def test_at_the_start_the_truth_is_handed_to_the_algorithm() -> None:
    world, _ = seen_box()
    told: list[GTpublish] = []

    def listen(request: GTpublish) -> GTpublishResponse:
        told.append(request)
        return GTpublishResponse()

    world.bus.services.serve("autoInit", GTpublish, listen)
    norm = corners_spec("autoInit").bind(world)
    assert told == []
    norm.start()
    f = 257.34083
    expected = [
        159.5 - 0.2 * f, 119.5 - 0.1 * f, 159.5 + 0.2 * f, 119.5 - 0.1 * f,
        159.5 + 0.2 * f, 119.5 + 0.1 * f, 159.5 - 0.2 * f, 119.5 + 0.1 * f,
    ]  # fmt: skip
    assert told[0].groundTruth.dtype == np.float32
    assert told[0].groundTruth == pytest.approx(expected, abs=1e-3)
    assert norm.notes == ()


def test_if_nobody_takes_the_truth_that_is_noted_and_no_error() -> None:
    world, _ = seen_box()
    norm = corners_spec("autoInit").bind(world)
    norm.start()
    assert norm.notes == ("'autoInit' was not called: it is not offered",)


def test_the_truth_is_that_of_the_step_at_which_the_estimate_arrives() -> None:
    world, body, norm, seen = started_on_the_box()
    assert norm.value == pytest.approx(0.0, abs=1e-4)
    body.move(0.1, 0.0, -1.05)
    say(world, norm, *seen)
    assert norm.value == pytest.approx(2.0 * 0.1 * 257.34083, rel=1e-5)  # four corners, each as far


def test_a_target_behind_the_camera_has_no_truth_and_that_is_reported() -> None:
    world, body = seen_box()
    norm = corners_spec("autoInit").bind(world)
    body.move(0.0, 0.0, 3.0)
    world.bus.services.serve("autoInit", GTpublish, lambda request: GTpublishResponse())
    norm.start()
    say(world, norm, *range(8))
    assert (norm.value, norm.missing_reason) == (None, "no truth: the target is behind the camera")
    assert norm.notes == ("'autoInit' was not called: the target is behind the camera",)


def test_an_algorithm_that_reports_is_not_silent_though_there_is_no_truth() -> None:
    world, body = seen_box()
    norm = corners_spec().bind(world)
    norm.start()
    body.move(0.0, 0.0, 3.0)
    for _ in range(4):
        wait(world, norm, STEPS_PER_SECOND // 2)
        say(world, norm, *range(8))
    assert norm.longest_silence < 1.01


def test_the_unit_is_that_of_the_truth() -> None:
    world, _ = seen_box()
    assert corners_spec().bind(world).unit == "px"
    assert norm_of(world, 1.0).unit == "1"
    located = RelativeLocationSpec(from_="box", to="box")
    spec = EuclideanNormSpec(name="r", ground_truth=located, target="estimate")
    assert spec.bind(world).unit == "m"


def test_a_closed_measure_hears_nothing_more() -> None:
    world = FakeWorld()
    norm = norm_of(world, 0.0)
    norm.close()
    assert not world.bus.has_subscribers("estimate")


@pytest.mark.parametrize(
    ("truth", "right"),
    [
        (CornersFromCameraSpec(camera="kam", target="box"), "cam"),
        (CentroidFromCameraSpec(camera="cam", target="bax"), "box"),
        (RelativeLocationSpec(from_="box", to="bax"), "box"),
    ],
)
def test_a_misspelt_name_is_an_error_that_names_the_right_one(
    truth: CornersFromCameraSpec, right: str
) -> None:
    world, _ = seen_box()
    with pytest.raises(UnknownName, match=f"Did you mean '{right}'"):
        EuclideanNormSpec(name="e", ground_truth=truth, target="estimate").bind(world)


@pytest.mark.parametrize(("steps", "is_noted"), [((0.0, 0.0, 0.0), True), ((0.0, 0.01), False)])
def test_estimates_that_never_leave_the_start_are_noted(
    steps: tuple[float, ...], is_noted: bool
) -> None:
    """An error of exactly 0 in every fog is no merit of a tracker whose target is at rest."""
    world, _ = seen_box()
    told: list[GTpublish] = []

    def listen(request: GTpublish) -> GTpublishResponse:
        told.append(request)
        return GTpublishResponse()

    world.bus.services.serve("autoInit", GTpublish, listen)
    norm = corners_spec("autoInit").bind(world)
    norm.start()
    for step in steps:
        say(world, norm, *(told[0].groundTruth + np.float32(step)).tolist())
    assert any("exactly the start that 'autoInit' was given" in note for note in norm.notes) is (
        is_noted
    )
