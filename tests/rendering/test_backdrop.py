"""The backdrop of a camera that stands still: its images are those that are drawn as a whole."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
import pytest

from tests.rendering.models import ball, block, placed, plate
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Light, Water, sun_direction

CAMERA = Intrinsics.from_fovy(160, 120, np.radians(60.0), near=0.1, far=100.0)
EYE = Pose.from_rpy((0.0, -3.0, 4.0), (0.6, 0.0, 0.0))
ASIDE = Pose.from_rpy((1.0, -2.0, 3.0), (0.5, 0.1, 0.3))
Draw = Callable[..., bytes]


class Pair:
    """Two renderers of the same things, of which one has no backdrops."""

    def __init__(self) -> None:
        self.kept, self.whole = Renderer(), Renderer()
        self.whole._find_backdrop = lambda view: None  # type: ignore[method-assign]
        self.n_before = 0
        draw_before = self.kept._passes.draw_over_backdrop

        def counted(*given: object) -> None:
            self.n_before += 1
            draw_before(*given)  # type: ignore[arg-type]

        self.kept._passes.draw_over_backdrop = counted  # type: ignore[method-assign, assignment]

    def add(self, *given: object) -> int:
        handles = {each.add(*given) for each in (self.kept, self.whole)}  # type: ignore[arg-type]
        (handle,) = handles
        return handle

    def place(self, handle: int, matrix: np.ndarray) -> None:
        for each in (self.kept, self.whole):
            each.place(handle, matrix)

    def draw(
        self, eye: Pose = EYE, water: Water | None = None, light: Light | None = None, **how: object
    ) -> np.ndarray:
        """The image, the same by both."""
        given = eye, CAMERA, water or Water(), light or Light()
        kept, whole = (
            each.draw(*given, targets={"colour"}, **how).colour  # type: ignore[arg-type]
            for each in (self.kept, self.whole)
        )
        assert kept is not None
        assert whole is not None
        assert np.array_equal(kept, whole)
        return kept


@pytest.fixture
def pair() -> Iterator[Pair]:
    """A floor in four pieces, with a box on it, half sunk."""
    pair = Pair()
    for x, y in ((-8, -8), (8, -8), (-8, 8), (8, 8)):
        pair.place(pair.add(plate(16.0, 16.0, (0.8, 0.8, 0.7)), 1), placed(float(x), float(y)))
    pair.place(pair.add(block((0.5, 0.5, 0.5), (0.2, 0.6, 0.2)), 2), placed(0.7, 0.4, 0.1))
    yield pair
    pair.kept.close()
    pair.whole.close()


@pytest.mark.parametrize("sun", ["clear", "cloudy", "dusk"])
@pytest.mark.parametrize("polished", [False, True])
@pytest.mark.parametrize("store", ["uint8", "linear16"])
def test_what_moves_before_a_backdrop_is_seen_as_ever(
    pair: Pair, sun: str, polished: bool, store: str
) -> None:
    body, wall = pair.add(ball(0.3), 3), pair.add(block((0.2, 1.5, 0.6)), 4)
    light = Light(sun=sun, is_polished=polished)  # type: ignore[arg-type]
    random = np.random.default_rng(3)
    images = set()
    for _ in range(12):
        x, y, z = random.uniform([-1.5, -1.0, -0.2], [1.5, 1.5, 1.5])
        pair.place(body, placed(x, y, z))
        pair.place(wall, placed(-y, x, 0.2))
        images.add(pair.draw(light=light, colour=store).tobytes())
    assert len(images) == 12
    assert pair.n_before > 5


def test_what_lies_in_the_plane_of_the_floor_is_behind_it_as_ever(pair: Pair) -> None:
    """Of two surfaces at one depth the later counts, the floor's."""
    flat = pair.add(plate(0.8, 0.8, (1.0, 0.0, 0.0)), 3)
    for step in range(6):
        pair.place(flat, placed(0.1 * step, 0.0, 0.0))
        pair.draw(light=Light(shadows=False))
    assert pair.n_before > 3


def test_a_backdrop_is_drawn_anew_when_any_of_it_changes(pair: Pair) -> None:
    body, stone = pair.add(ball(0.3), 3), pair.add(ball(0.4, (0.5, 0.2, 0.2)), 4)
    hill = pair.add(block((14.0, 3.0, 1.0), (0.6, 0.4, 0.3)), 5)
    pair.place(hill, placed(0.0, 5.0))
    images = []
    for step in range(16):
        pair.place(body, placed(-0.8 + 0.05 * step, -0.2, 0.8))
        pair.place(stone, placed(-0.6, 1.2, 0.1 if step < 5 else 0.3))
        pair.place(hill, placed(0.0, 5.0, 0.0 if step < 9 else 0.5))
        images.append(pair.draw(water=Water(fog=0.1 if step < 12 else 0.2)))
    assert pair.n_before > 10
    assert not np.array_equal(images[8], images[9])


def test_two_cameras_have_backdrops_of_their_own(pair: Pair) -> None:
    body = pair.add(ball(0.3), 3)
    for step in range(8):
        pair.place(body, placed(-0.8 + 0.1 * step, 0.3, 0.8))
        pair.draw()
        pair.draw(ASIDE)
    assert pair.n_before > 10


def test_a_camera_that_moves_has_no_backdrop(pair: Pair) -> None:
    body = pair.add(ball(0.3), 3)
    for step in range(4):
        pair.place(body, placed(0.1 * step, 0.3, 0.8))
        pair.draw(Pose(EYE.position + [0.0, 0.01 * step, 0.0], EYE.rotation))  # noqa: RUF005
    assert pair.n_before == 0


def test_a_body_that_comes_to_rest_and_one_that_comes_and_goes(pair: Pair) -> None:
    body = pair.add(ball(0.3), 3)
    for step in range(10):
        pair.place(body, placed(min(0.1 * step, 0.5), 0.3, 0.8))
        if step in {2, 6}:
            pair.place(pair.add(ball(0.2, (1.0, 0.0, 0.0)), 7), placed(-0.5, 0.1 * step, 0.4))
        pair.draw()
    hidden = frozenset({7})
    for step in range(3):
        pair.place(body, placed(0.1 * step, 0.3, 0.8))
        pair.draw(hidden_ids=hidden)
    assert pair.n_before > 4


def test_only_tiles_below_a_caster_along_the_beams_are_drawn_again(pair: Pair) -> None:
    regions: list[tuple[int, int, int, int]] = []
    draw_before = pair.kept._passes.draw_over_backdrop

    def noted(*given: object) -> None:
        regions.append(given[3])  # type: ignore[arg-type]
        draw_before(*given)  # type: ignore[arg-type]

    pair.kept._passes.draw_over_backdrop = noted  # type: ignore[method-assign, assignment]
    body = pair.add(ball(0.2), 3)
    down = Pose.from_rpy((0.0, 0.0, 6.0), (0.0, 0.0, 0.0))
    for x in (-1.0, -0.9, -0.8, -0.7):
        pair.place(body, placed(*(np.array([x, -1.0, 0.0]) + 0.7 * sun_direction("clear"))))
        shaded = pair.draw(down)
    lit = pair.whole.draw(down, CAMERA, Water(), Light(shadows=False))
    assert lit.colour is not None
    assert len(regions) == 3
    left, top, width, height = regions[-1]
    dark = np.argwhere((shaded != lit.colour).any(axis=2) & (lit.ids == 1))
    assert (dark >= [top, left]).all()
    assert (dark < [top + height, left + width]).all()
    assert width * height < 0.3 * CAMERA.width * CAMERA.height


def test_images_with_glass_are_drawn_as_a_whole(pair: Pair) -> None:
    glass = ball(0.3)
    (mesh,) = glass.meshes
    pane = pair.add(replace(glass, meshes=(replace(mesh, opacity=0.5),)), 3)
    for step in range(4):
        pair.place(pane, placed(0.1 * step, 0.3, 0.8))
        pair.draw()
    assert pair.n_before == 0
