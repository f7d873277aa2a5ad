from __future__ import annotations

import numpy as np
import pytest

from tests.algorithms.textures import Texture, rectangle
from uwsim.algorithms.esm.template import extract_template, runs_in_quad

IMAGE = Texture().image()


def turned(angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return rectangle(0, 0, 93, 28) @ np.array([[c, s], [-s, c]]) + [159.5, 119.5]


@pytest.mark.parametrize("angle", [0.0, 0.3, np.pi / 4, 1.2, np.pi / 2])
def test_the_runs_hold_the_pixels_whose_centres_are_inside(angle: float) -> None:
    top, runs = runs_in_quad(turned(angle), 320, 240)
    v, u = np.mgrid[0:240, 0:320].astype(float)
    c, s = np.cos(angle), np.sin(angle)
    along, across = (u - 159.5) * c + (v - 119.5) * s, -(u - 159.5) * s + (v - 119.5) * c
    inside = (np.abs(along) <= 46.5 + 1e-9) & (np.abs(across) <= 14 + 1e-9)
    mask = np.zeros((240, 320), bool)
    for row, (first, last) in enumerate(runs):
        mask[top + row, first:last] = True
    assert np.count_nonzero(mask != inside) <= 4  # centres on the rim itself, to rounding
    assert mask.sum() == pytest.approx(93 * 28, rel=0.02)


@pytest.mark.parametrize("angle", [0.0, 0.3, np.pi / 4])
def test_values_have_zero_mean_and_unit_variance_inside(angle: float) -> None:
    template = extract_template(IMAGE, turned(angle))
    assert template is not None
    cells = [template.values[row, a:b] for row, (a, b) in enumerate(template.runs)]
    values = np.concatenate(cells).astype(float)
    assert values.size == template.n
    assert values.mean() == pytest.approx(0.0, abs=1e-5)
    assert values.std() == pytest.approx(1.0, abs=1e-5)


def test_slopes_are_those_of_the_image_in_normalised_coordinates() -> None:
    v, u = np.mgrid[0:240, 0:320].astype(float)
    template = extract_template(
        (3.0 * u - 2.0 * v).astype(np.float32), rectangle(159.5, 119.5, 80, 40)
    )
    assert template is not None
    assert template.slope_u * template.contrast == pytest.approx(3.0 * 40, rel=1e-4)
    assert template.slope_v * template.contrast == pytest.approx(-2.0 * 20, rel=1e-4)


def test_the_rim_of_the_image_is_left_out() -> None:
    template = extract_template(IMAGE, rectangle(159.5, 119.5, 320, 240))
    assert template is not None
    assert (template.left, template.top, template.n) == (1, 1, 318 * 238)


def test_there_is_no_template_of_a_speck_or_of_nothing() -> None:
    assert extract_template(IMAGE, rectangle(159.5, 119.5, 6.5, 40)) is None
    assert extract_template(IMAGE, rectangle(159.5, 119.5, 40, 6.5)) is None
    assert (
        extract_template(np.full((240, 320), 9, np.float32), rectangle(159.5, 119.5, 40, 40))
        is None
    )
