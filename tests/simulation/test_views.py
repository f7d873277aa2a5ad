"""What a view of a scene shows."""

from __future__ import annotations

import numpy as np

import uwsim
from uwsim.simulation.scenery.refracted_points import refract_points
from uwsim.simulation.views import find_focus, top_view


def test_a_vehicle_that_is_far_from_the_first_one_does_not_make_a_dot_of_it() -> None:
    with uwsim.load("two-vehicles-scene") as simulation:
        focus = find_focus(simulation)
        first = simulation.pose("first", "W").position
    assert np.abs(focus.centre - first).max() < 2.0  # the second is 300 m away


def test_a_view_from_above_the_water_has_what_refraction_enlarges_within_it() -> None:
    with uwsim.load("pipe-scene") as simulation:
        view, focus = top_view(simulation, (640, 480)), find_focus(simulation)
    eye, axes = view.world_from_camera.position, view.world_from_camera.rotation
    assert eye[2] > 0.0
    seen = refract_points(eye, focus.corners, 0.0)
    right, up, back = ((seen - eye)[:, None, :] * axes.T).sum(axis=2).T
    assert np.abs(right / back).max() * view.intrinsics.fx < 320
    assert np.abs(up / back).max() * view.intrinsics.fy < 240
    assert np.abs(up / back).max() * view.intrinsics.fy > 0.75 * 240
