"""The part of the surface that a camera may see."""

from __future__ import annotations

import pytest

from tests.rendering.physical.photographs import camera_of
from tests.rendering.surface.seas import look
from uwsim.rendering.surface.surface_mesh import N_SECTORS, find_view

LENS = camera_of(300.0, 320, 240)


@pytest.mark.parametrize(
    ("eye", "target", "is_seen"),
    [
        ((0.0, 0.0, -5.0), (0.0, 0.0, -9.0), False),  # straight down from below
        ((0.0, 0.0, -5.0), (0.3, 0.2, -9.0), False),
        ((0.0, 0.0, 5.0), (0.0, 0.0, 9.0), False),  # straight up from above
        ((0.0, 0.0, -5.0), (0.0, 0.0, 0.0), True),
        ((0.0, 0.0, 5.0), (0.0, 0.0, 0.0), True),
    ],
)
def test_a_camera_that_looks_away_from_the_surface_sees_none_of_it(
    eye: tuple[float, float, float], target: tuple[float, float, float], is_seen: bool
) -> None:
    view = find_view(look(eye, target), LENS, eye[2], 1.0)
    assert view.sectors == (tuple(range(N_SECTORS)) if is_seen else ())


def test_a_camera_among_the_waves_sees_all_of_them_below_it() -> None:
    view = find_view(look((0.0, 0.0, 0.5), (0.0, 0.0, -3.0)), LENS, 0.5, 1.0)
    assert view.sectors == tuple(range(N_SECTORS))
    assert view.min_radius == 0.0
