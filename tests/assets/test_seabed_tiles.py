"""Tiles of sea floors fit together where their corners agree, and rocks have closed surfaces."""

import numpy as np
import pytest

from scripts.models.scenery.seabed_tiles import (
    CONTENT_SIDE,
    MARGIN,
    make_base_layers,
    make_tile,
    tile_corners,
)
from uwsim.assets import load_model
from uwsim.base.numerics.opencv import deterministic_opencv


def test_tiles_with_equal_corners_continue_each_other() -> None:
    with deterministic_opencv():
        base = make_base_layers()
        left = make_tile(1, (0, 1, 0, 0), base)
        right = make_tile(20, (1, 0, 0, 1), base)
    last, first = MARGIN + CONTENT_SIDE, MARGIN
    for one, other in zip(left[:2], right[:2], strict=True):
        step_inside = np.abs(one[:, last - 1] - one[:, last - 2]).mean()
        step_across = np.abs(other[:, first] - one[:, last - 1]).mean()
        assert step_across < 1.5 * step_inside


def test_every_case_of_corners_has_two_tiles() -> None:
    cases = tile_corners()
    assert len(set(cases)) == 16
    assert min(cases.count(case) for case in cases) == 2


@pytest.mark.parametrize("k", range(1, 6))
def test_a_fifth_of_a_rock_is_below_the_sand(k: int) -> None:
    box = load_model(f"objects/rock{k}").box
    assert -box.lower[2] / (box.upper[2] - box.lower[2]) == pytest.approx(0.2, abs=1e-4)
