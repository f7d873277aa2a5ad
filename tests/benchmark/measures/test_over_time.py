"""Statistics of what an algorithm feeds are over time: publishing more, or less, buys nothing."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
import pytest

from tests.support.fakes import FakeBody, FakeCamera, FakeWorld
from uwsim.benchmark.ground_truth import CentroidFromCameraSpec, ConstantSpec, RelativeLocationSpec
from uwsim.benchmark.measures import EuclideanNorm, EuclideanNormSpec
from uwsim.messages import Float32MultiArray, floats

FRAME = 10
"""Steps between two images."""
SECOND = 500
"""Steps in a second."""
Say = Callable[[int], Sequence[Sequence[float]]]
"""What is published at a step, counted from the start: any number of estimates."""


class Scene:
    """A body that goes to and fro in front of a camera, and where it is seen."""

    def __init__(self, *, quirks: frozenset[str] = frozenset()) -> None:
        self.body = FakeBody((0.0, 0.0, -1.0))
        self.camera = FakeCamera()
        self.camera.n_images = 0
        self.world = FakeWorld({"box": self.body}, {"cam": self.camera}, compatibility=quirks)
        self.seen: list[np.ndarray] = []

    def bind(self, value: str = "mean") -> EuclideanNorm:
        truth = CentroidFromCameraSpec(camera="cam", target="box")
        spec = EuclideanNormSpec(name="e", ground_truth=truth, target="estimate", value=value)  # type: ignore[arg-type]
        return spec.bind(self.world)

    def truth(self, step: int) -> np.ndarray:
        """Where the body is seen (2,) [px]."""
        x = 0.1 * math.sin(2.0 * math.pi * step / (2 * SECOND))
        return np.array([159.5 + 257.34083 * x, 119.5])

    def level(self, say: Say, *, steps: int = 2 * SECOND, value: str = "mean") -> EuclideanNorm:
        """Measure a level in which an algorithm says what ``say`` gives for each step."""
        norm = self.bind(value)
        norm.start()
        publish = self.world.bus.publisher("estimate", Float32MultiArray)
        for step in range(1, steps + 1):
            self.body.move((self.truth(step)[0] - 159.5) / 257.34083, 0.0, -1.0)
            if step % FRAME == 0:
                self.camera.n_images += 1
            for estimate in say(step):
                publish(floats(estimate))
            self.world.advance()
            norm.update()
        return norm


def mean(say: Say, **options: object) -> float:
    value = Scene().level(say, **options).value  # type: ignore[arg-type]
    assert value is not None
    return value


def honest(step: int) -> list[np.ndarray]:
    """One pixel off, in answer to each image."""
    return [Scene().truth(step) + np.array([1.0, 0.0])] if step % FRAME == 0 else []


def frozen(step: int) -> list[np.ndarray]:
    """Where it was at first, in answer to each image."""
    return [Scene().truth(0)] if step % FRAME == 0 else []


FROZEN = float(np.mean([abs(Scene().truth(s)[0] - 159.5) for s in range(FRAME, 1001, FRAME)]))


def test_a_tracker_that_answers_each_image_has_the_mean_of_its_errors() -> None:
    assert mean(honest) == pytest.approx(1.0, abs=1e-4)
    assert mean(frozen) == pytest.approx(FROZEN, rel=1e-4)


def test_a_burst_of_guesses_while_they_are_good_counts_no_more_than_one() -> None:
    def burst(step: int) -> list[np.ndarray]:
        return [Scene().truth(0)] * (300 if step < FRAME else 1 if step % FRAME == 0 else 0)

    norm = Scene().level(burst)
    assert norm.value == pytest.approx(FROZEN, rel=1e-4)
    assert norm.details["n"] == 300 * (FRAME - 1) + 100  # and it is said how many there were
    assert norm.details["frames"] == 100


def test_a_guess_at_every_step_is_no_better_than_one_at_every_image() -> None:
    assert mean(lambda step: [Scene().truth(0)]) == pytest.approx(FROZEN, rel=1e-4)


def test_who_publishes_only_while_it_is_sure_is_held_to_it_meanwhile() -> None:
    def sure(step: int) -> list[np.ndarray]:
        is_near = abs(Scene().truth(step)[0] - 159.5) < 5.0
        return [Scene().truth(step)] if is_near and step % FRAME == 0 else []

    norm = Scene().level(sure)
    assert norm.value is not None
    assert norm.value > 0.7 * FROZEN
    assert norm.details["answered"] < 0.25


def test_who_never_answers_for_more_than_a_second_has_no_value() -> None:
    norm = Scene().level(lambda step: honest(step) if step < SECOND - FRAME else [])
    assert norm.value is None


def test_an_estimate_before_the_image_is_no_better_than_one_in_answer_to_it() -> None:
    def early(step: int) -> list[np.ndarray]:
        return [Scene().truth(step)] if step % FRAME == FRAME - 1 else []

    assert mean(early) > 0.1  # it has moved since: one step of the way
    assert mean(early) == pytest.approx(
        np.mean([abs(Scene().truth(s)[0] - Scene().truth(s - 1)[0]) for s in range(10, 1001, 10)]),
        rel=1e-3,
    )


def test_good_and_bad_ones_in_turn_cost_their_mean() -> None:
    def in_turn(step: int) -> list[np.ndarray]:
        off = 0.0 if step % (2 * FRAME) else 10.0
        return [Scene().truth(step) + np.array([off, 0.0])] if step % FRAME == 0 else []

    assert mean(in_turn) == pytest.approx(5.0, abs=1e-3)


def test_one_good_estimate_at_the_end_is_held_against_what_came_before_it() -> None:
    def late(step: int) -> list[np.ndarray]:
        return [Scene().truth(step)] if step == 400 else []

    norm = Scene().level(late, steps=400)
    expected = np.mean(
        [abs(Scene().truth(s)[0] - Scene().truth(400)[0]) for s in range(10, 401, 10)]
    )
    assert norm.value == pytest.approx(expected, rel=1e-4)
    assert expected > 5.0
    assert norm.details["frames"] == 40
    assert norm.details["answered"] == pytest.approx(1 / 40)
    assert Scene().level(late, steps=400, value="last").value == pytest.approx(0.0, abs=1e-4)


def test_what_is_no_estimate_is_counted_and_leaves_the_one_before_in_force() -> None:
    def doubtful(step: int) -> list[Sequence[float]]:
        if step % FRAME:
            return []
        return [Scene().truth(step)] if step % (2 * FRAME) == 0 else [[math.nan, 1.0], [1.0]]

    norm = Scene().level(doubtful)
    assert (norm.details["n"], norm.details["refused"]) == (50, 100)
    assert norm.details["frames"] == 100
    # the first image is scored with the first estimate, the odd ones with that before them
    held = [abs(Scene().truth(s)[0] - Scene().truth(s - 10)[0]) for s in range(30, 1001, 20)]
    first = abs(Scene().truth(10)[0] - Scene().truth(20)[0])
    assert norm.value == pytest.approx((sum(held) + first) / 100, rel=1e-3)


def test_the_newest_good_one_of_a_step_counts() -> None:
    scene = Scene()
    norm = scene.level(lambda step: [[9.0, 9.0], scene.truth(step), [math.nan, 0.0]])
    assert norm.value == pytest.approx(0.0, abs=1e-4)


def test_statistics_are_over_the_images_and_components_too() -> None:
    def once(step: int) -> list[np.ndarray]:
        return [np.array([159.5, 116.5])] if step == 5 else []

    details = Scene().level(once, steps=400).details
    errors = [Scene().truth(s) - [159.5, 116.5] for s in range(10, 401, 10)]
    norms = [math.hypot(*error) for error in errors]
    assert details["mean"] == pytest.approx(np.mean(norms), rel=1e-5)
    assert details["rms"] == pytest.approx(math.sqrt(np.mean(np.square(norms))), rel=1e-5)
    assert details["std"] == pytest.approx(np.std(norms), rel=1e-4)
    assert details["max"] == pytest.approx(max(norms), rel=1e-5)
    assert details["y.mean"] == pytest.approx(3.0)
    assert (details["n"], details["y.n"], details["frames"]) == (1.0, 1.0, 40.0)


@pytest.mark.parametrize(
    ("truth", "unseen"),
    [
        (ConstantSpec(values=(159.5, 119.5)), None),
        (RelativeLocationSpec(from_="box", to="box"), None),
        (CentroidFromCameraSpec(camera="cam", target="box"), None),
    ],
)
def test_without_images_every_step_is_a_sample(truth: object, unseen: None) -> None:
    scene = Scene()
    scene.camera.n_images = unseen
    norm = EuclideanNormSpec(
        name="e",
        ground_truth=truth,
        target="estimate",
        value="mean",  # type: ignore[arg-type]
    ).bind(scene.world)
    norm.start()
    width = len(norm.log_header) - 1
    for step in range(20):
        if step == 9:
            scene.world.bus.publisher("estimate", Float32MultiArray)(floats([0.0] * width))
        scene.world.advance()
        norm.update()
    assert (norm.details["n"], norm.details["frames"]) == (1.0, 20.0)


def test_a_level_without_an_image_has_a_last_norm_and_no_mean() -> None:
    for value in ("last", "mean"):
        norm = Scene().level(lambda step: [Scene().truth(step)], steps=5, value=value)
        assert (norm.value is None) is (value == "mean")
    assert norm.missing_reason == "its camera took no image while the measure was on"
