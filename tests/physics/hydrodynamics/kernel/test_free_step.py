"""The step of a free vehicle on plain arrays against MuJoCo with the kernel's callback."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from tests.physics.water_models import bundled
from uwsim.physics.hydrodynamics import columns as c
from uwsim.physics.hydrodynamics.free_vehicle import (
    actuators_in_water,
    free_vehicle,
    links_in_water,
)
from uwsim.physics.hydrodynamics.hydrodynamics import NoWater, install
from uwsim.physics.hydrodynamics.kernel.free_rows import simulate_rows
from uwsim.physics.hydrodynamics.kernel.free_step import (
    ACTUATORS,
    LOSS,
    ROTOR,
    WORK,
    fill_rotors,
    step_one,
)

H = 0.002  # [s]
N_STEPS = 5000  # 10 s
CURRENT = (0.2, -0.15, 0.05)  # [m/s]
CURRENT_RATE = (0.01, 0.005, -0.008)  # [m/s2]
VEHICLES = {
    "bluerov2_heavy": {"z_down": True},
    "rexrov": {"z_down": False},
    "remus100": {"z_down": True},
    "g500_physical": {"only_base": True},
    "uwsim_compat": {"only_base": True},
    "g500_physical with its arm": {},
}


def commands(k: int, n: int = N_STEPS) -> np.ndarray:
    """Return commands that excite all axes and reach the limits, in steps of half a second."""
    rng = np.random.default_rng(5)
    return np.repeat(rng.uniform(-1.1, 1.1, (n // 250, k)), 250, axis=0)


def engine_path(model: mujoco.MjModel, command_rows: np.ndarray) -> np.ndarray:
    """Return position, attitude and velocity after every step of MuJoCo, (n + 1, 13)."""
    water, data = install(model), mujoco.MjData(model)
    water.set_current(data, CURRENT, CURRENT_RATE)
    roles = model.actuator_user[:, c.ROLE]
    rows = [np.concatenate([data.qpos[:7], data.qvel[:6]])]
    for row in command_rows:
        for i in range(model.nactuator):
            if roles[i] == c.FIN:
                water.turn_fin(data, model.actuator(i).name, row[i])
            else:
                data.ctrl[model.actuator_ctrladr[i]] = row[i]
        water.step(data)
        rows.append(np.concatenate([data.qpos[:7], data.qvel[:6]]))
    return np.array(rows)


@pytest.mark.parametrize("name", VEHICLES)
def test_ten_seconds_of_a_bundled_vehicle_agree_with_the_engine(name: str) -> None:
    model, _ = bundled(name.split()[0], **VEHICLES[name])
    vehicle = free_vehicle(model, 1)
    n_actuators = len(vehicle.actuators)
    command_rows = commands(n_actuators)
    states = np.zeros((1, ACTUATORS + n_actuators))
    states[0, :7] = model.qpos0[:7]
    water = np.zeros(c.WATER_COLUMNS)
    water[:6] = *CURRENT, *CURRENT_RATE
    path = np.empty((1, N_STEPS + 1, ACTUATORS))

    simulate_rows(vehicle, states, command_rows[None], water, H, path)

    expected = engine_path(model, command_rows)
    assert np.abs(expected[-1, :3] - expected[0, :3]).max() > 0.5
    np.testing.assert_allclose(path[0], expected, rtol=0.0, atol=1e-10)


def sea_rows(n_rows: int, n: int) -> np.ndarray:
    """Return water that moves and turns below a surface with waves, at each step, (n, rows, 12)."""
    time = np.arange(n)[:, None] * H
    phase = np.arange(n_rows)[None] * 0.1
    rows = np.zeros((n, n_rows, c.WATER_COLUMNS))
    rows[:, :, 0] = 0.2 + 0.1 * np.sin(1.3 * time + phase)
    rows[:, :, 3] = 0.13 * np.cos(1.3 * time + phase)
    rows[:, :, 2] = 0.1 * np.cos(1.3 * time + phase)
    rows[:, :, c.ELEVATION] = 0.08 * np.sin(1.3 * time + phase)
    rows[:, :, c.SLOPE_X] = 0.02 * np.cos(1.3 * time + phase)
    rows[:, :, c.SLOPE_Y] = -0.01 * np.sin(1.3 * time + phase)
    rows[:, :, c.OMEGA + 2] = 0.05 * np.sin(0.7 * time)
    return rows


@pytest.mark.parametrize("name", VEHICLES)
def test_waves_faults_and_layers_at_the_surface_agree_with_the_engine(name: str) -> None:
    model, _ = bundled(name.split()[0], **VEHICLES[name])
    model.body_user[0, c.SURFACE] = 0.2  # all vehicles pierce the surface in these waves
    levels = (0.0, 0.0, 0.5, 0.02)  # depth [m], excess density [1]
    model.body_user[0, c.N_LEVELS], model.body_user[0, c.LEVELS : c.LEVELS + 4] = 2.0, levels
    vehicle, n = free_vehicle(model, 1), N_STEPS
    links, actuators = links_in_water(model, 1), actuators_in_water(model, 1)
    command_rows = 0.3 * commands(len(actuators))
    sea = sea_rows(len(links) + 1, n)
    sea[:, -1] = sea[:, links.index(1)] if 1 in links else 0.0
    water, data = install(model), mujoco.MjData(model)
    rows = data.userdata[: c.WATER_COLUMNS * model.nbody].reshape(-1, c.WATER_COLUMNS)
    losses = data.userdata[rows.size : rows.size + model.nactuator]
    rotors = np.zeros((len(actuators), ROTOR))
    fill_rotors(vehicle, H, rotors)
    rotors[0, LOSS] = losses[actuators[0]] = 0.6
    state, work = np.zeros(ACTUATORS + len(actuators)), np.empty(WORK)
    state[:7] = model.qpos0[:7]
    for k in range(n):
        rows[links] = sea[k, :-1]
        for i, actuator in enumerate(actuators):
            if model.actuator_user[actuator, c.ROLE] == c.FIN:
                water.turn_fin(data, model.actuator(actuator).name, command_rows[k, i])
            else:
                data.ctrl[model.actuator_ctrladr[actuator]] = command_rows[k, i]
        water.step(data)
        step_one(vehicle, rotors, state, command_rows[k], sea[k], H, work)

    expected = np.concatenate([data.qpos[:7], data.qvel[:6]])
    assert np.abs(expected[:3] - model.qpos0[:3]).max() > 0.1
    np.testing.assert_allclose(state[:ACTUATORS], expected, rtol=0.0, atol=1e-10)


def test_the_bytes_of_a_row_do_not_depend_on_the_other_rows() -> None:
    model, _ = bundled("bluerov2_heavy")
    vehicle = free_vehicle(model, 1)
    states = np.zeros((7, ACTUATORS + 8))
    states[:, :7] = model.qpos0[:7]
    states[:, 7:13] = np.random.default_rng(1).normal(0.0, 0.3, (7, 6))
    rows = np.random.default_rng(2).uniform(-1.0, 1.0, (7, 200, 8))
    water, together = np.zeros(c.WATER_COLUMNS), np.empty((7, 201, ACTUATORS))
    simulate_rows(vehicle, states.copy(), rows, water, 0.01, together)

    for i in range(7):
        alone = np.empty((1, 201, ACTUATORS))
        simulate_rows(vehicle, states[i : i + 1].copy(), rows[i : i + 1], water, 0.01, alone)
        assert alone[0].tobytes() == together[i].tobytes()


def test_a_model_without_hydrodynamics_is_an_error() -> None:
    model = mujoco.MjModel.from_xml_string(
        "<mujoco><worldbody><body><freejoint/><geom size='1'/></body></worldbody></mujoco>"
    )
    with pytest.raises(NoWater, match="no hydrodynamics"):
        free_vehicle(model, 1)
