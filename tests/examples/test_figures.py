"""Images and the law of visibility, laid out."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from matplotlib.text import Text

from paper.figures import (
    draw_image_grid,
    draw_image_with_inset,
    draw_visibility_over_distance,
    draw_visibility_over_fog,
    largest_deviation,
    visibility_loss,
)
from uwsim.analysis.plots import save_plot

IMAGE = np.full((24, 32, 3), 90, np.uint8)


def test_the_papers_own_numbers_do_not_fit_its_formula() -> None:
    assert visibility_loss(1.1, 1.36) == pytest.approx(0.8933, abs=5e-5)
    assert visibility_loss(1.031, 1.36) == pytest.approx(0.86, abs=5e-4)
    assert visibility_loss(0.0, 1.0) == 0.0


def test_a_grid_has_a_letter_and_a_caption_for_every_image() -> None:
    figure = draw_image_grid([IMAGE] * 5, [f"fog {i}" for i in range(5)], columns=3)
    words = [text.get_text() for text in figure.findobj(Text)]
    assert "(e) fog 4" in words
    assert len(figure.axes) == 6


def test_an_inset_keeps_its_shape_and_lies_inside() -> None:
    figure = draw_image_with_inset(np.zeros((60, 80, 3), np.uint8), IMAGE, share=0.4)
    box = figure.axes[1].get_position()
    width, height = figure.get_size_inches()
    assert box.x1 < 1
    assert box.y0 > 0
    assert box.width * width / (box.height * height) == pytest.approx(32 / 24)


def test_the_largest_difference_from_the_law_is_written_under_the_points(tmp_path: Path) -> None:
    measured = {
        1.05: ([0.5, 1.0], [visibility_loss(1.05, 0.5), visibility_loss(1.05, 1.0) + 0.004])
    }
    figure = draw_visibility_over_distance(measured)
    assert any("largest difference 0.0040" in text.get_text() for text in figure.findobj(Text))
    save_plot(figure, tmp_path / "v.png")
    assert largest_deviation([(1.0, 1.0, 1 - math.exp(-1))]) == 0.0


def test_the_marked_fog_is_a_line_with_its_visibility() -> None:
    figure = draw_visibility_over_fog(([0.0, 2.0], [0.0, 1.0]), distance=1.36, marked_fog=1.1)
    assert any("visibility 0.893" in text.get_text() for text in figure.findobj(Text))
