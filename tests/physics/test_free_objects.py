"""Numbers of loose things against DNV-RP-H103."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from tests.physics.water_models import free_body
from uwsim.base.geometry import Pose
from uwsim.model.collision.shapes import CollisionShape
from uwsim.physics.free_objects import box_added_mass, loose_hydrodynamics
from uwsim.physics.hydrodynamics.hydrodynamics import install
from uwsim.scene.hydrodynamics import BodyHydrodynamics
from uwsim.scene.object import PhysicsSpec


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


@pytest.mark.parametrize("way", [(1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (1.0, 1.0, 1.0)])
def test_the_drag_of_a_ball_does_not_depend_on_how_it_is_turned(way: tuple[float, ...]) -> None:
    shape = CollisionShape(kind="sphere", size=(0.1,), body_from_shape=Pose.identity())
    water = loose_hydrodynamics("body", PhysicsSpec(mass=4.19), [shape], 1000.0)
    model = free_body(water, mass=4.19, gravity=0.0, integrator="RK4")
    install(model)
    data = mujoco.MjData(model)
    direction = np.array(way) / np.linalg.norm(way)
    data.qvel[:3], data.qvel[3:] = 0.5 * direction, 3.0 * direction
    mujoco.mj_forward(model, data)
    drag = 0.5 * 1000.0 * 0.47 * np.pi * 0.1**2 * 0.5**2
    assert data.qfrc_passive[:3] == pytest.approx(-drag * direction, rel=1e-9)
    assert data.qfrc_passive[3:] == pytest.approx(-0.5 * 1000 * 0.05 * 1e-5 * 9.0 * direction)


def test_a_body_of_revolution_feels_the_speed_across_its_axis() -> None:
    water = BodyHydrodynamics(
        link="body", quadratic_damping=(5.0, 80.0, 80.0, 0, 9, 9), drag_law="x"
    )
    model = free_body(water, mass=50.0, gravity=0.0, integrator="RK4")
    install(model)
    data = mujoco.MjData(model)
    data.qvel[1:3] = 0.3, 0.4
    mujoco.mj_forward(model, data)
    assert data.qfrc_passive[1:3] == pytest.approx([-80 * 0.5 * 0.3, -80 * 0.5 * 0.4])
