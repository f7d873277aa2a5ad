from __future__ import annotations

import numpy as np
import pytest

from tests.algorithms.fake_node import FakeNode
from tests.algorithms.textures import Texture, rectangle, through_fog
from uwsim.algorithms import ALGORITHMS, check_parameters
from uwsim.algorithms.esm.homography import homography_between, warp
from uwsim.algorithms.tracker import Estimate, LossTest
from uwsim.errors import BadSetting

QUAD = rectangle(160.0, 120.0, 93.0, 28.0)
BLIND = (
    "autopilot-path",
    "autopilot-station",
    "cable-camera",
    "cable-no-memory",
    "dob-mpc",
    "docking",
    "docking-girona",
    "docking-girona-usbl",
    "docking-girona-usbl-p",
    "docking-usbl",
    "docking-usbl-p",
    "formation-p",
    "formation-pi",
    "homing",
    "homing-los",
    "mpc",
    "net-inspection",
    "net-inspection-fixed",
    "nothing",
    "operator-continuous",
    "operator-predict",
    "operator-wait",
    "pilot",
    "pipe-camera",
    "pipe-camera-p",
    "pipe-following",
    "pipe-straight",
    "plug",
    "plug-rigid",
    "plug-truth",
    "position-lqr",
    "position-p",
    "position-pi",
    "reach",
    "reach-p",
    "relay-hold",
    "relay-shuttle",
    "rendezvous-predict",
    "rendezvous-pursuit",
    "rendezvous-wait",
    "search",
    "search-camera",
    "search-sonar",
    "search-truth",
    "survey",
    "survey-no-dvl",
    "survey-truth",
    "scripted",
    "valve",
    "valve-rigid",
    "valve-truth",
)
LOOKING = [name for name in ALGORITHMS if name not in BLIND and not name.startswith("grasp")]
TRACKERS = [name for name in LOOKING if name != "frozen"]


def started(name: str, **parameters: float | str) -> FakeNode:
    node = FakeNode(parameters=parameters)
    ALGORITHMS[name]().start(node)
    return node


@pytest.mark.parametrize("name", LOOKING)
def test_the_benchmark_is_started_once_after_the_first_image(name: str) -> None:
    node = started(name)
    assert node.calls == []
    image = Texture().image()
    for _ in range(3):
        node.show(image)
    assert node.calls == ["startBench"]


@pytest.mark.parametrize("name", LOOKING)
def test_a_benchmark_that_waits_for_nobody_is_fine(name: str) -> None:
    node = started(name)
    node.known_services.clear()
    node.show(Texture().image())
    node.auto_init(QUAD)
    assert node.statuses == ["tracking"]


@pytest.mark.parametrize("name", LOOKING)
def test_nothing_is_published_before_auto_init(name: str) -> None:
    node = started(name)
    node.show(Texture().image())
    node.show(Texture().image())
    assert node.published == []


@pytest.mark.parametrize("name", LOOKING)
def test_a_plane_that_stands_still_is_found_where_it_is_in_the_order_handed_in(name: str) -> None:
    for first in range(4):
        node = started(name)
        image = Texture().image()
        node.show(image)
        quad = np.roll(QUAD, first, axis=0)
        node.auto_init(quad)
        node.show(image)
        assert node.corners[0] == pytest.approx(quad, abs=0.1)
        assert node.centroids[0] == pytest.approx([160.0, 120.0], abs=0.1)


@pytest.mark.parametrize("name", TRACKERS)
def test_a_plane_that_moves_is_followed(name: str) -> None:
    node = started(name)
    texture = Texture(shortest=6.0, waves=40)
    node.show(texture.image())
    node.auto_init(QUAD)
    for k in range(1, 8):
        target = QUAD + np.array([2.0 * k, 1.5 * k]) + 0.3 * k * np.array([[1, 0], [0, 1]] * 2)
        node.show(texture.image(homography_between(QUAD, target)))
        assert np.abs(node.corners[-1] - target).max() < (5.0 if name == "orb" else 0.1)
    assert node.statuses == ["tracking"]


def test_frozen_echoes_exactly_what_auto_init_gave() -> None:
    node = started("frozen")
    node.show(Texture().image())
    quad = np.float32([[10.1, 20.2], [90.3, 25.4], [88.5, 60.6], [9.7, 55.8]])
    node.auto_init(quad)
    for _ in range(3):
        node.show(np.zeros((240, 320)))
    assert [c.tolist() for c in node.corners] == [quad.tolist()] * 3
    assert node.statuses == ["tracking"]


def moved(shift: float) -> np.ndarray:
    """The texture's image with everything in it ``shift`` [px] to the right."""
    return Texture(shortest=6.0, waves=40).image(
        homography_between(QUAD, QUAD + np.array([shift, 0.0]))
    )


@pytest.mark.parametrize("name", LOOKING)
def test_a_second_auto_init_gives_the_pose_and_no_new_template(name: str) -> None:
    node = started(name)
    node.show(moved(0.0))
    node.auto_init(QUAD)
    node.show(moved(0.0))
    node.auto_init(QUAD + np.array([40.0, 0.0]))  # told in the image as it was before the jump
    node.show(moved(40.0))
    assert node.corners[-1] == pytest.approx(
        QUAD + np.array([40.0, 0.0]), abs=5.0 if name == "orb" else 0.1
    )
    assert node.statuses == ["tracking", "tracking"]


@pytest.mark.parametrize("name", TRACKERS)
def test_a_lost_tracker_tracks_again_from_where_auto_init_says(name: str) -> None:
    node = started(name)
    node.show(moved(0.0))
    node.auto_init(QUAD)
    rng = np.random.Generator(np.random.Philox(5))
    while len(node.statuses) < 2:
        node.show(through_fog(moved(0.0), 0.0, rng, sigma=20.0))
    lost = len(node.corners)
    node.show(moved(40.0))
    assert len(node.corners) == lost  # silent until it is told
    node.auto_init(QUAD + np.array([40.0, 0.0]))
    node.show(moved(40.0))
    assert node.corners[-1] == pytest.approx(
        QUAD + np.array([40.0, 0.0]), abs=5.0 if name == "orb" else 0.1
    )
    assert [status.split(":")[0] for status in node.statuses] == ["tracking", "lost", "tracking"]


def test_a_second_auto_init_outside_the_image_is_a_loss_and_no_failure() -> None:
    node = started("esm")
    node.show(moved(0.0))
    node.auto_init(QUAD)
    node.auto_init(QUAD + 1000.0)
    node.show(moved(0.0))
    assert node.corners == []
    assert node.statuses[1].startswith("lost: autoInit: corner NW (")
    node.auto_init(QUAD)
    node.show(moved(0.0))
    assert node.corners[0] == pytest.approx(QUAD, abs=0.1)


@pytest.mark.parametrize("name", LOOKING)
def test_without_auto_init_the_corners_can_be_a_parameter(name: str) -> None:
    node = started(name, corners=" ".join(f"{number:g}" for number in QUAD.reshape(-1)))
    node.show(moved(0.0))
    node.show(moved(2.0))
    assert node.statuses == ["tracking"]
    moved_to = QUAD + np.array([0.0 if name == "frozen" else 2.0, 0.0])
    assert node.corners[0] == pytest.approx(moved_to, abs=5.0 if name == "orb" else 0.1)


@pytest.mark.parametrize("corners", ["1 2 3", "a b c d e f g h", "1 2 3 4 5 6 7 nan"])
def test_corners_that_are_no_eight_numbers_are_refused_before_anything_runs(corners: str) -> None:
    for name in ("esm", "frozen", "p"):
        with pytest.raises(BadSetting, match=r"'corners' .*; expected eight numbers"):
            check_parameters(ALGORITHMS[name], {"corners": corners})


def test_auto_init_before_the_first_image_waits_for_it() -> None:
    node = started("esm")
    node.auto_init(QUAD + 40.0)
    node.auto_init(QUAD)
    image = Texture().image()
    node.show(image)
    node.show(image)
    assert node.statuses == ["tracking"]
    assert node.corners[0] == pytest.approx(QUAD, abs=0.05)


def test_auto_init_inside_start_bench_takes_the_first_image() -> None:
    node = FakeNode()
    node.known_services["startBench"] = lambda _: node.auto_init(QUAD)
    ALGORITHMS["esm"]().start(node)
    node.show(Texture().image())
    assert node.statuses == ["tracking"]
    assert node.corners == []


@pytest.mark.parametrize("name", TRACKERS)
def test_a_patch_that_vanishes_is_lost_once_and_then_silent(name: str) -> None:
    node = started(name)
    image = Texture(shortest=6.0).image()
    node.show(image)
    node.auto_init(QUAD)
    rng = np.random.Generator(np.random.Philox(5))
    for _ in range(4):
        node.show(through_fog(image, 0.0, rng, sigma=20.0))
    assert not any(status.startswith("lost: ZNCC") for status in node.statuses)
    for _ in range(4):
        node.show(through_fog(image, 0.0, rng, sigma=20.0))
    assert len(node.statuses) == 2
    assert node.statuses[1].startswith("lost: ")
    before = len(node.published)
    node.show(image)
    node.show(image)
    assert len(node.published) == before


def test_the_reason_of_a_loss_carries_its_numbers() -> None:
    node = started("esm", lost_frames=3.0, zncc_threshold=0.7)
    texture = Texture()
    node.show(texture.image())
    node.auto_init(QUAD)
    rng = np.random.Generator(np.random.Philox(5))
    while len(node.statuses) < 2:
        node.show(through_fog(texture.image(), 0.3, rng, sigma=20.0))
    number = float(node.statuses[1].removeprefix("lost: ZNCC ").removesuffix(" on 3 frames"))
    assert number < 0.7
    assert len(node.corners) == 3


def test_a_low_image_in_between_is_forgiven() -> None:
    node = started("esm")
    image = Texture().image()
    node.show(image)
    node.auto_init(QUAD)
    for _ in range(5):
        for _ in range(4):
            node.show(np.full((240, 320), 90, np.uint8))
        node.show(image)
    assert node.statuses == ["tracking"]


def test_a_patch_whose_centre_leaves_the_image_is_lost_at_once() -> None:
    node = started("esm")
    texture = Texture()
    node.show(texture.image())
    node.auto_init(QUAD)
    for k in range(1, 40):
        node.show(texture.image(homography_between(QUAD, QUAD + np.array([7.0 * k, 0.0]))))
    assert node.statuses[1].startswith("lost: ")
    assert "centre (32" in node.statuses[1] or "ZNCC" in node.statuses[1]


def test_a_corner_outside_the_image_is_no_loss() -> None:
    check = LossTest(zncc_threshold=0.5, frames=5).check
    corners = np.array([[220.0, 60.0], [325.0, 60.0], [325.0, 90.0], [220.0, 90.0]])
    inside = Estimate(corners=corners, centroid=corners.mean(axis=0), zncc=0.9)
    assert check(inside, 320, 240) is None
    gone = corners + np.array([50.0, 0.0])
    why = check(Estimate(corners=gone, centroid=gone.mean(axis=0), zncc=0.9), 320, 240)
    assert why == "the quad's centre (322.5, 75.0) is outside the 320x240 image"


NAN = float("nan")


@pytest.mark.parametrize("name", TRACKERS)
@pytest.mark.parametrize(
    ("quad", "why"),
    [
        (QUAD * np.array([NAN, 1.0]), "outside"),
        (QUAD + 1000.0, "outside"),
        (QUAD - np.array([150.0, 0.0]), "outside"),
        (rectangle(160, 120, 5, 5), "smaller"),
        (rectangle(160, 120, 90, 0), "not convex"),
        (QUAD[[0, 2, 1, 3]], "not convex"),
    ],
)
def test_a_quad_that_cannot_be_followed_is_a_failure_with_its_reason(
    name: str, quad: np.ndarray, why: str
) -> None:
    node = started(name)
    node.show(Texture().image())
    node.auto_init(quad)
    assert len(node.statuses) == 1
    assert node.statuses[0].startswith("failed: autoInit: ")
    assert why in node.statuses[0]
    node.auto_init(QUAD)
    node.show(Texture().image())
    assert len(node.published) == 1


@pytest.mark.parametrize("name", TRACKERS)
def test_a_patch_without_contrast_is_a_failure(name: str) -> None:
    node = started(name)
    node.show(np.full((240, 320), 90, np.uint8))
    node.auto_init(QUAD)
    assert node.statuses[0].startswith("failed: autoInit: ")


def test_seven_numbers_are_a_failure() -> None:
    node = started("esm")
    node.show(Texture().image())
    node.auto_init(np.zeros(7))
    assert node.statuses == ["failed: autoInit gave 7 numbers instead of 8"]


def test_a_misspelt_parameter_is_refused_with_the_right_name() -> None:
    with pytest.raises(BadSetting, match="Did you mean 'zncc_threshold'"):
        started("esm", zncc_treshold=0.4)
    with pytest.raises(BadSetting, match="expected a number"):
        started("esm", levels="many")
    with pytest.raises(BadSetting, match="'levels' of the algorithm is -1"):
        started("esm", levels=-1)


def test_parameters_in_force_can_be_read() -> None:
    algorithm = ALGORITHMS["esm"]()
    algorithm.start(FakeNode(parameters={"levels": 2}))
    assert algorithm.parameters == {**algorithm.PARAMETERS, "levels": 2.0}


def test_another_image_topic_can_be_chosen() -> None:
    node = started("esm", image_topic="/other")
    assert list(node.readers) == ["/other"]


def test_colour_images_are_followed_by_their_luma() -> None:
    node = started("esm")
    texture = Texture()
    target = QUAD + np.array([2.0, 1.0])
    for image in (texture.image(), texture.image(homography_between(QUAD, target))):
        node.show(np.repeat(image[:, :, None], 3, axis=2))
        node.auto_init(QUAD)
    assert np.abs(node.corners[-1] - target).max() < 0.05
    assert warp(np.eye(3), QUAD) == pytest.approx(QUAD)
