"""What a view of a scene shows."""

from __future__ import annotations

import numpy as np

import uwsim
from uwsim.simulation.views import find_focus


def test_a_vehicle_that_is_far_from_the_first_one_does_not_make_a_dot_of_it() -> None:
    with uwsim.load("two-vehicles-scene") as simulation:
        focus = find_focus(simulation)
        first = simulation.pose("first", "W").position
    assert np.abs(focus.centre - first).max() < 2.0  # the second is 300 m away
