"""The step of a free vehicle on plain arrays against MuJoCo with the kernel's callback."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from tests.physics.water_models import bundled
from uwsim.physics.hydrodynamics import columns as c
from uwsim.physics.hydrodynamics.free_vehicle import free_vehicle
from uwsim.physics.hydrodynamics.hydrodynamics import NoWater, install
from uwsim.physics.hydrodynamics.kernel.free_rows import simulate_rows
from uwsim.physics.hydrodynamics.kernel.free_step import ACTUATORS

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
