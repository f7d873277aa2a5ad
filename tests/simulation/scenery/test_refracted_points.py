"""Points below level water, seen from above, against Snell's law."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.rendering.physical.daylight_field import REFRACTIVE_INDEX
from uwsim.simulation.scenery.refracted_points import refract_points

EYE = np.array([1.0, 2.0, 3.0])
SURFACE = 0.5


@pytest.mark.parametrize("offset", [0.3, 2.0, 9.0])
def test_a_ray_to_a_point_below_water_obeys_snells_law(offset: float) -> None:
    point = EYE + np.array([0.6 * offset, 0.8 * offset, -5.0])
    seen = refract_points(EYE, point[None], SURFACE)[0]
    direction = (seen - EYE) / np.sqrt(((seen - EYE) ** 2).sum())
    entry = EYE + direction * (SURFACE - EYE[2]) / direction[2]
    below = (point - entry) / np.sqrt(((point - entry) ** 2).sum())
    sine_in_air, sine_in_water = np.hypot(*direction[:2]), np.hypot(*below[:2])
    assert sine_in_air == pytest.approx(REFRACTIVE_INDEX * sine_in_water, abs=1e-9)
    assert np.sqrt(((seen - EYE) ** 2).sum()) == pytest.approx(np.hypot(offset, 5.0))


def test_what_is_above_or_straight_below_is_seen_where_it_is() -> None:
    points = np.array([[1.0, 2.0, -4.0], [5.0, 2.0, 0.6]])
    assert np.allclose(refract_points(EYE, points, SURFACE), points)
    below_water = np.array([0.0, 0.0, -1.0])
    assert refract_points(below_water, points, SURFACE) is points
