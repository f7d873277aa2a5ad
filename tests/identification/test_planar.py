"""The planar mode: what is held, and that the plane's motion is that of Fossen's equations."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.identification.vehicles import bluerov2
from uwsim.errors import BadSetting
from uwsim.identification import IdentifySettings, WindowSettings, identify
from uwsim.identification.parameters import choose_parameters
from uwsim.identification.planar import has_vertical_motion, hold_vertical, level_motion
from uwsim.identification.simulated_log import Excitation, simulate_free_log
from uwsim.logs import VehicleLog
from uwsim.physics.hydrodynamics import columns as c
from uwsim.physics.hydrodynamics.kernel.free_rows import simulate_rows
from uwsim.physics.hydrodynamics.kernel.free_step import ACTUATORS
from uwsim.physics.hydrodynamics.kernel.thrusters import static_thrust

STEP = 0.002


def boat_log() -> VehicleLog:
    """Return the log of a craft in the plane without depth, heave and their rates."""
    excitation = Excitation(duration=40.0, amplitudes=(0.4, 0.4, 0.0, 0.0, 0.0, 0.06))
    log = simulate_free_log(hold_vertical(bluerov2()), seed=2, excitation=excitation)
    motion = log.motion
    assert motion is not None
    assert motion.twists is not None
    positions, twists = motion.positions.copy(), motion.twists.copy()
    positions[:, 2] = np.nan
    twists[:, 2:5] = np.nan
    return replace(log, motion=replace(motion, positions=positions, twists=twists))


def test_the_plane_moves_by_fossens_equations_of_three_degrees_of_freedom() -> None:
    """Compare with an independent Runge-Kutta integration of the equations of the plane."""
    model = hold_vertical(bluerov2())
    commands = np.zeros(8)
    commands[:4] = 0.5, -0.2, 0.3, 0.4
    states = np.zeros((1, ACTUATORS + 8))
    states[0, 3] = states[0, 7] = 1.0
    states[0, 8], states[0, 12] = 0.3, 0.2
    states[0, ACTUATORS:] = commands
    n = round(5.0 / STEP)
    path = np.empty((1, n + 1, ACTUATORS))
    water = np.zeros(c.WATER_COLUMNS)
    simulate_rows(model.numbers, states.copy(), np.tile(commands, (1, n, 1)), water, STEP, path)
    np.testing.assert_allclose(path[0, -1, [0, 1]], integrate(commands, 5.0), atol=2e-3)
    assert abs(path[0, :, 2]).max() < 1e-3
    assert abs(path[0, :, 4:6]).max() < 1e-3


def integrate(commands: np.ndarray, duration: float) -> np.ndarray:
    """Return x and y after some time by Runge-Kutta's method; z points up in W."""
    model = bluerov2()
    mass, inertia = 13.5, 0.37
    added_mass, linear, quadratic = (
        np.array(rows) for rows in ((6.36, 7.12, 0.222), (13.7, 0.0, 0.0), (141.0, 217.0, 1.5))
    )
    force = np.zeros(3)
    for row, site, command in zip(
        model.numbers.actuators, model.numbers.sites, commands, strict=True
    ):
        x, y = site[[3, 6]] * static_thrust(row, command)
        force += x, y, site[0] * y - site[1] * x
    inertias = np.array([mass, mass, inertia]) + added_mass

    def derive(state: np.ndarray) -> np.ndarray:
        nu, yaw = state[3:], state[2]
        u, v, r = nu
        momentum = inertias * nu
        coriolis = np.array([-momentum[1] * r, momentum[0] * r, u * momentum[1] - v * momentum[0]])
        rate = (force - coriolis - linear * nu - quadratic * abs(nu) * nu) / inertias
        return np.array(
            [u * np.cos(yaw) - v * np.sin(yaw), u * np.sin(yaw) + v * np.cos(yaw), r, *rate]
        )

    state, h = np.array([0.0, 0.0, 0.0, 1.0, 0.3, 0.2]), 0.005
    for _ in range(round(duration / h)):
        k1 = derive(state)
        k2 = derive(state + 0.5 * h * k1)
        k3 = derive(state + 0.5 * h * k2)
        k4 = derive(state + h * k3)
        state = state + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    return state[:2]


def test_a_log_without_depth_is_fitted_in_the_plane() -> None:
    settings = IdentifySettings(
        free_names=("added_mass", "quadratic_damping"), windows=WindowSettings(step=0.01),
        n_starts=1, n_folds=0,
    )  # fmt: skip
    result = identify([boat_log()], bluerov2(), settings)
    assert result.model.is_planar
    assert {parameter.key for parameter in result.parameters} == {"surge", "sway", "yaw"}
    truth = [parameter.first_guess for parameter in result.parameters]
    np.testing.assert_allclose(result.values, truth, rtol=0.05)
    assert "Planar mode" in result.windows.remarks[0]
    assert result.check.warnings == ()


def test_constants_in_place_of_depth_roll_and_pitch_are_no_motion() -> None:
    log = boat_log()
    assert log.motion is not None
    assert log.motion.twists is not None
    positions, quaternions = log.motion.positions.copy(), log.motion.quaternions.copy()
    positions[:, 2], quaternions[:, 1:3] = 0.4, 0.0
    twists = log.motion.twists.copy()
    twists[:, 2:5] = 0.0
    motion = replace(log.motion, positions=positions, quaternions=quaternions, twists=twists)
    assert not has_vertical_motion([replace(log, motion=motion)])
    diving_motion = replace(motion, positions=positions + np.arange(len(positions))[:, None])
    assert has_vertical_motion([replace(log, motion=diving_motion)])


def test_an_axis_that_is_held_cannot_be_fitted() -> None:
    with pytest.raises(BadSetting) as error:
        choose_parameters(["added_mass[heave]", "buoyancy"], hold_vertical(bluerov2()))
    assert "expected surge, sway or yaw" in str(error.value)
    assert "buoyancy has no effect" in str(error.value)


def test_the_rate_of_the_heading_of_a_rolled_craft_is_levelled() -> None:
    roll, rate = 0.3, 0.5
    row = np.full((1, 13), np.nan)
    row[0, 3:7] = np.cos(0.5 * roll), np.sin(0.5 * roll), 0.0, 0.0
    row[0, 7:10] = 1.0, 0.2, 0.0
    row[0, 10:] = 0.0, rate * np.sin(roll), rate * np.cos(roll)  # turns about the vertical
    level = level_motion(row)[0]
    np.testing.assert_allclose(level[3:7], [1.0, 0.0, 0.0, 0.0], atol=1e-12)
    assert level[12] == pytest.approx(rate)
    assert level[7:9] == pytest.approx([1.0, 0.2 * np.cos(roll)])
