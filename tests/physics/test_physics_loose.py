"""Numbers of loose things against DNV-RP-H103."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.physics.loose import box_added_mass


@pytest.mark.parametrize(
    ("length", "coefficient"), [(1.0, 0.68), (2.0, 0.36), (4.0, 0.19), (6.0, 0.13), (10.0, 0.08)]
)
def test_a_square_prism_moves_along_its_axis_as_dnv_says(length: float, coefficient: float) -> None:
    added = box_added_mass(np.array([0.3, 0.3, 0.3 * length]))[2]
    assert added / (0.3**3 * length) == pytest.approx(coefficient, rel=0.1)


@pytest.mark.parametrize(("sides", "coefficient"), [(1.0, 0.579), (2.0, 0.757), (5.0, 0.897)])
def test_a_plate_moves_across_as_dnv_says(sides: float, coefficient: float) -> None:
    added = box_added_mass(np.array([0.2, 0.2 * sides, 1e-6]))[2]
    assert added / (np.pi / 4.0 * 0.2**3 * sides) == pytest.approx(coefficient, rel=1e-3)


def test_a_long_square_bar_moves_across_as_in_two_dimensions() -> None:
    added = box_added_mass(np.array([100.0, 0.1, 0.1]))[2]
    assert added / (100.0 * np.pi * 0.05**2) == pytest.approx(1.51, rel=0.02)
