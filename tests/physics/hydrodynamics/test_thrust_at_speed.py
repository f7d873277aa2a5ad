"""Thrust that falls with the advance ratio."""

from __future__ import annotations

import math
from dataclasses import replace

import mujoco
import numpy as np
import pytest

from tests.physics.water_models import free_body
from uwsim.physics.hydrodynamics.hydrodynamics import install
from uwsim.scene.hydrodynamics import BodyHydrodynamics, ThrusterSpec
from uwsim.scene.hydrodynamics.checks import thruster_errors

DENSITY, DIAMETER = 1025.0, 0.2
LINE = (0.0, 0.45, 0.9, 0.0)
AT_REST = ThrusterSpec(name="screw", link="body", forward=(0.0, 100.0), radius=0.5 * DIAMETER)
TURNS = math.sqrt(100.0 / (DENSITY * DIAMETER**4 * 0.45))  # at the command 1 [1/s]


def thrust(thruster: ThrusterSpec, command: float, speed: float) -> float:
    """Of a body that moves ahead [N]."""
    model = free_body(
        BodyHydrodynamics(link="body"), mass=1.0, thrusters={"screw": thruster},
        density=DENSITY, gravity=0.0,
    )  # fmt: skip
    water, data = install(model), mujoco.MjData(model)
    data.qvel[0] = speed
    water.set_thrusters(data, [command])
    mujoco.mj_forward(model, data)
    return float(data.qfrc_passive[0])


@pytest.mark.parametrize("speed", [0.5, 1.0, 2.0])
def test_thrust_is_that_of_kt_at_the_advance_ratio(speed: float) -> None:
    screw = replace(AT_REST, advance=LINE)
    for command in (1.0, -1.0, 0.5):
        turns = abs(command) * TURNS
        factor = 0.45 - 0.5 * speed / (turns * DIAMETER)
        expected = math.copysign(1.0, command) * DENSITY * turns**2 * DIAMETER**4 * factor
        along = math.copysign(speed, command)
        assert thrust(screw, command, along) == pytest.approx(expected, rel=1e-12)


def test_between_the_points_of_a_table_kt_is_linear() -> None:
    screw = replace(AT_REST, advance=(0.0, 0.4, 0.4, 0.3, 0.8, 0.0))
    turns = math.sqrt(100.0 / (DENSITY * DIAMETER**4 * 0.4))
    assert thrust(screw, 1.0, 0.6 * turns * DIAMETER) == pytest.approx(100.0 * 0.15 / 0.4)


def test_a_wake_slows_the_inflow() -> None:
    screw = replace(AT_REST, advance=LINE)
    slowed = replace(screw, wake=0.25)
    assert thrust(slowed, 1.0, 2.0) == pytest.approx(thrust(screw, 1.0, 1.5), rel=1e-12)


def test_at_rest_and_in_water_from_behind_it_is_the_curve_to_the_bit() -> None:
    screw = replace(AT_REST, advance=LINE)
    for command in np.linspace(-1.0, 1.0, 9):
        assert thrust(screw, command, 0.0) == thrust(AT_REST, command, 0.0)
        assert thrust(screw, command, -math.copysign(2.0, command)) == thrust(AT_REST, command, 0.0)


def test_a_propeller_that_is_overtaken_brakes_and_one_that_stands_does_nothing() -> None:
    screw = replace(AT_REST, advance=LINE)
    assert thrust(screw, 0.2, 3.0) < 0.0
    assert thrust(screw, 0.0, 3.0) == 0.0


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"advance": (0.1, 0.4, 0.2, 0.3)}, "ratios 0.1 0.2; expected 0 first, rising"),
        ({"advance": (0.0, 0.4)}, "has 2 numbers; expected 2 to 12 pairs"),
        ({"advance": (0.0, 0.0, 0.5, -0.1)}, "KT 0 at rest; expected > 0"),
        ({"advance": (0.0, 0.4, 0.5, 0.5)}, "expected none above the one before"),
        ({"wake": 1.0}, "wake is 1; expected"),
    ],
)
def test_a_table_that_no_propeller_has_is_refused(change: dict[str, object], said: str) -> None:
    assert said in "\n".join(thruster_errors(replace(AT_REST, **change)))
