"""Fins against closed forms: lift of a plate, stall, damping of a turn, rate and lag of a servo."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import mujoco
import numpy as np
import pytest

from tests.physics.water_models import free_body
from uwsim.physics.hydrodynamics.hydrodynamics import Hydrodynamics, install
from uwsim.physics.hydrodynamics.kernel.fins import FADE_ANGLE, coefficients
from uwsim.physics.hydrodynamics.table import fin_row
from uwsim.scene.hydrodynamics import BadHydrodynamics, BodyHydrodynamics, FinSpec
from uwsim.scene.hydrodynamics.fin_checks import fin_errors

FIN = FinSpec(name="fin", link="body", area=0.02, lift_slope=3.0, drag=0.01, induced_drag=0.1)
SPEED, DENSITY = 2.0, 1025.0
PRESSURE = 0.5 * DENSITY * SPEED**2 * FIN.area  # [N]


def in_water(fin: FinSpec, **options: Any) -> tuple[Hydrodynamics, mujoco.MjData]:
    """A heavy body without any other force, that moves ahead."""
    model = free_body(
        BodyHydrodynamics(link="body"), mass=1e6, inertia=(1e6,) * 3, fins={"fin": fin},
        gravity=0.0, density=DENSITY, **options,
    )  # fmt: skip
    data = mujoco.MjData(model)
    data.qvel[0] = SPEED
    return install(model), data


def wrench(water: Hydrodynamics, data: mujoco.MjData) -> np.ndarray:
    """Force and torque about the body's origin, (6,)."""
    mujoco.mj_forward(water.model, data)
    return data.qfrc_passive.copy()


def test_a_fin_at_a_small_angle_lifts_in_proportion_to_it_and_drags() -> None:
    water, data = in_water(FIN)
    data.act[0] = water.turn_fin(data, "fin", 0.1) or 0.1
    lift, drag = 3.0 * 0.1, 0.01 + 0.1 * 0.3**2
    expected = [-PRESSURE * drag, PRESSURE * lift, 0.0, 0.0, 0.0, 0.0]
    assert wrench(water, data) == pytest.approx(expected, abs=1e-9)


def test_the_lift_is_across_the_flow_and_turns_the_body_about_its_lever() -> None:
    fin = replace(FIN, position=(-0.5, 0.0, 0.0), drag=0.0, induced_drag=0.0)
    water, data = in_water(fin, integrator="RK4")  # forces alone, no terms of a step
    side = 0.2
    data.qvel[1] = side  # [m/s]; the leading edge is turned away from the velocity by -atan
    attack = -math.atan2(side, SPEED)
    size = 0.5 * DENSITY * FIN.area * (SPEED**2 + side**2)
    lift = size * 3.0 * attack
    along, across = -lift * math.sin(-attack), lift * math.cos(attack)
    assert wrench(water, data) == pytest.approx([along, across, 0, 0, 0, -0.5 * across], abs=1e-9)


def test_a_fin_at_the_stern_damps_a_turn() -> None:
    water, data = in_water(replace(FIN, position=(-0.5, 0.0, 0.0)))
    data.qvel[5] = 0.01  # the stern goes to -y: the fin pushes it back
    expected = -0.5 * PRESSURE * 3.0 * 0.005 / SPEED
    assert wrench(water, data)[5] == pytest.approx(0.5 * expected * 2.0, rel=0.01)


def test_a_current_from_ahead_is_as_good_as_speed() -> None:
    water, data = in_water(FIN)
    moving = wrench(water, data)
    data.qvel[:] = 0.0
    water.set_current(data, (-SPEED, 0.0, 0.0))
    assert wrench(water, data) == pytest.approx(moving, abs=1e-9)


def test_beyond_the_stall_the_lift_falls_to_that_of_a_plate() -> None:
    row = fin_row(FIN)
    assert coefficients(row, 0.3) == pytest.approx((0.9, 0.01 + 0.1 * 0.81))
    assert coefficients(row, 0.3 + 1e-9) == pytest.approx(coefficients(row, 0.3))
    lifts = [coefficients(row, 0.3 + share * FADE_ANGLE)[0] for share in np.linspace(0.0, 1.0, 20)]
    assert np.all(np.diff(lifts) < 0.0)
    for angle in (0.6, 1.0, 0.5 * math.pi, 3.0):
        sine, cosine = math.sin(angle), math.cos(angle)
        expected = (1.2 * sine * cosine, 0.01 + 1.2 * sine**2)
        assert coefficients(row, angle) == pytest.approx(expected, abs=1e-9)
        assert coefficients(row, -angle) == pytest.approx((-expected[0], expected[1]), abs=1e-9)


def test_coefficients_of_a_table_are_linear_between_its_rows() -> None:
    even = fin_row(replace(FIN, coefficients=(0.0, 0.0, 0.02, 0.2, 0.6, 0.04, 0.4, 0.5, 0.2)))
    assert coefficients(even, 0.1) == pytest.approx((0.3, 0.03))
    assert coefficients(even, -0.3) == pytest.approx((-0.55, 0.12))
    assert coefficients(even, 1.0) == pytest.approx((0.5, 0.2))
    cambered = fin_row(replace(FIN, coefficients=(-0.2, -0.4, 0.05, 0.2, 0.8, 0.05)))
    assert coefficients(cambered, 0.0) == pytest.approx((0.2, 0.05))


def test_the_servo_turns_no_faster_than_its_rate_and_no_further_than_its_limits() -> None:
    water, data = in_water(replace(FIN, rate=0.2))
    water.turn_fin(data, "fin", 0.1)
    water.step(data, 100)
    assert data.act[0] == pytest.approx(0.04, abs=1e-12)
    water.turn_fin(data, "fin", 1.0)
    water.step(data, 1000)
    assert data.act[0] == pytest.approx(0.35, abs=1e-12)


def test_the_servo_follows_with_its_lag_whatever_the_step() -> None:
    for timestep in (0.002, 0.02):
        water, data = in_water(replace(FIN, time_constant=0.1), timestep=timestep)
        water.turn_fin(data, "fin", 0.2)
        water.step(data, round(0.2 / timestep))
        assert data.act[0] == pytest.approx(0.2 * (1 - math.exp(-2.0)), rel=1e-9)


def test_a_fin_out_of_the_water_does_nothing() -> None:
    water, data = in_water(FIN, surface=-1.0)
    assert not wrench(water, data).any()


def test_every_fault_of_a_fin_is_said() -> None:
    wrong = replace(
        FIN, chord=(0.0, 0.0, 2.0), area=-1.0, lift_slope=9.0, stall=2.0, drag=-0.1,
        limits=(0.1, 0.2), rate=0.0,
    )  # fmt: skip
    said = "\n".join(fin_errors(wrong))
    for word in ("chord is along", "area is -1", "lift slope is 9", "stall is 2", "drag is -0.1",
                 "limits are 0.1 0.2", "rate is 0"):  # fmt: skip
        assert word in said
    table = replace(FIN, coefficients=(0.2, 0.0, 0.0, 0.1, 0.0, -1.0))
    said = "\n".join(fin_errors(table))
    assert "the angles 0.2 0.1" in said
    assert "the drag 0 -1" in said
    with pytest.raises(BadHydrodynamics, match="area is -1"):
        in_water(wrong)
