"""Quadrangles stand where the numbers say."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.analysis.report.overlay import ESTIMATE_COLOUR, TRUTH_COLOUR, overlay

QUAD = (10.0, 10.0, 30.0, 10.0, 30.0, 20.0, 10.0, 20.0)


def box_of(drawn: np.ndarray, colour: tuple[int, int, int]) -> tuple[float, float, float, float]:
    rows, columns = np.nonzero((drawn == colour).all(axis=2))
    return columns.min(), rows.min(), columns.max() + 1, rows.max() + 1


def test_a_quad_lies_on_its_corners_counted_from_the_first_pixels_centre() -> None:
    drawn = overlay(np.zeros((40, 60, 3), np.uint8), truth=QUAD, scale=4)
    assert drawn.shape == (160, 240, 3)
    middle = np.array(box_of(drawn, TRUTH_COLOUR)) / 4
    assert middle == pytest.approx([9.75, 9.75, 31.25, 21.25], abs=0.3)


def test_truth_and_estimate_have_their_own_colours() -> None:
    drawn = overlay(np.zeros((40, 60), np.uint8), truth=QUAD, estimate=[v + 4 for v in QUAD])
    assert box_of(drawn, ESTIMATE_COLOUR)[0] > box_of(drawn, TRUTH_COLOUR)[0]


def test_the_image_itself_is_left_alone_and_shown_pixel_by_pixel() -> None:
    image = np.arange(48, dtype=np.uint8).reshape(4, 4, 3)
    before = image.copy()
    drawn = overlay(image, scale=3)
    assert (drawn[1::3, 1::3] == before).all()
    assert (image == before).all()


@pytest.mark.parametrize("far", [1e4, -1e6, 1e9])
def test_an_estimate_far_outside_is_drawn_without_complaint(far: float) -> None:
    quad = (0.0, 0.0, far, 0.0, far, far, 0.0, far)
    assert overlay(np.zeros((20, 20), np.uint8), estimate=quad, label="lost").any()


def test_a_quad_of_seven_numbers_is_refused() -> None:
    with pytest.raises(ValueError, match="8 numbers of a quadrangle, not 7"):
        overlay(np.zeros((20, 20), np.uint8), truth=QUAD[:7])
