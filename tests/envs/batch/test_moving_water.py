"""Water that moves at rows: currents and waves of the engine's functions, held against the engine.

The engine is its time loop (`Stepper`) with MuJoCo's step, which calls the same `WaterFunction`.
"""

from __future__ import annotations

from functools import partial

import mujoco
import numpy as np
import pytest

from tests.envs.batch.batch_rows import RANGES, bluerov2, station_rows
from tests.physics.water_models import bundled
from uwsim.base.geometry import Pose
from uwsim.base.rng import stream
from uwsim.currents import DelayedCurrent, SceneContext
from uwsim.currents.gauss_markov import GaussMarkovSpec
from uwsim.currents.profile import PowerProfileSpec
from uwsim.currents.uwsim_sinusoid import UwsimSinusoidSpec
from uwsim.envs.batch.flows import base_link_of, n_bodies
from uwsim.envs.batch.rows import Rows
from uwsim.envs.batch.task import Channel, RowTask, Term
from uwsim.physics.engine_warnings import StepCheck
from uwsim.physics.hydrodynamics import columns as c
from uwsim.physics.hydrodynamics.free_vehicle import (
    actuators_in_water,
    free_vehicle,
    links_in_water,
)
from uwsim.physics.hydrodynamics.hydrodynamics import Hydrodynamics, install
from uwsim.physics.hydrodynamics.kernel.free_step import ACTUATORS, FreeVehicle
from uwsim.physics.hydrodynamics.water_function import WaterFunction
from uwsim.physics.stepper import Stepper
from uwsim.scene.ocean_state import OceanStateSpec
from uwsim.scene.spec import SceneSpec
from uwsim.simulation.water.water_motion import WaterMotion
from uwsim.waves.jonswap import JonswapSpec

H, SUBSTEPS, N_STEPS = 0.01, 5, 200  # 10 s
SURFACE = 0.2  # all vehicles pierce the surface in these waves [m]
LOSS = 0.6  # of the first thruster
CURRENTS = (
    PowerProfileSpec(velocity=(0.25, -0.1, 0.0), depth=20.0),
    GaussMarkovSpec(mean=(0.05, 0.1, 0.0), deviation=(0.05, 0.05, 0.02), mu=0.1),
)
SWINGING_CURRENT = UwsimSinusoidSpec(
    speed=0.2,
    speed_variation=0.02,
    speed_period=4.0,
    phi_variation=0.7,
    phi_period=30.0,
    random=0.1,
)
VEHICLES = {
    "bluerov2_heavy": {"z_down": True},
    "rexrov": {"z_down": False},
    "remus100": {"z_down": True},
    "g500_physical": {"only_base": True},
    "uwsim_compat": {"only_base": True},
    "g500_physical with its arm": {},
}


def sea(n: int, seed: int = 3, *, has_waves: bool = True) -> WaterFunction:
    """Return waves, a profile, a random current, and the benchmark's from 2 s on, at n bodies."""
    waves = (JonswapSpec(significant_height=0.3, peak_period=3.0),) if has_waves else ()
    scene = SceneSpec(ocean_state=OceanStateSpec(currents=CURRENTS, waves=waves))
    context = SceneContext(
        stream=partial(stream, seed), surface_height=SURFACE, world_from_localized=Pose.identity()
    )
    motion = WaterMotion(scene, context)
    current = SWINGING_CURRENT.bind(context)
    motion.set(DelayedCurrent(current, start=0.0, delay=2.0, offset=7.0))
    steps = range(1, N_STEPS * SUBSTEPS + 1)
    function = motion.motion_during(lambda: np.zeros((n, 3)), steps, H, ("vehicle",) * n)
    assert function is not None
    return function


def engine_path(model: mujoco.MjModel, actions: np.ndarray) -> np.ndarray:
    """Return position, attitude and velocity after every step of the environment, (n, 13)."""
    water, data = install(model), mujoco.MjData(model)
    links, actuators = links_in_water(model, 1), actuators_in_water(model, 1)
    points = np.array([water.reference_point(body) for body in links])
    names = [model.body(i).name for i in range(model.nbody)]
    check = StepCheck(model, data, names)
    stepper = Stepper(data, water, [], [], [], links, points, check, None)
    data.userdata[c.WATER_COLUMNS * model.nbody + actuators[0]] = LOSS
    mujoco.mj_kinematics(model, data)
    function, rows = sea(len(links)), []
    for i, row in enumerate(actions):
        set_commands(model, data, water, row)
        stepper.run(SUBSTEPS, i * SUBSTEPS, function, step=i * SUBSTEPS + 1)
        mujoco.mj_kinematics(model, data)  # as the engine does before a run that needs points
        rows.append(np.concatenate([data.qpos[:7], data.qvel[:6]]))
    return np.array(rows)


def set_commands(
    model: mujoco.MjModel, data: mujoco.MjData, water: Hydrodynamics, commands: np.ndarray
) -> None:
    for actuator, command in zip(actuators_in_water(model, 1), commands, strict=True):
        if model.actuator_user[actuator, c.ROLE] == c.FIN:
            water.turn_fin(data, model.actuator(actuator).name, command)
        else:
            data.ctrl[model.actuator_ctrladr[actuator]] = command


def row_path(
    vehicle: FreeVehicle, start: np.ndarray, actions: np.ndarray, *, moves_water: bool = True
) -> np.ndarray:
    task = RowTask(
        channels=(Channel(name="position"),),
        terms=(Term(name="constant"),),
        timestep=H,
        substeps=SUBSTEPS,
        max_steps=N_STEPS + 1,
        exit_distance=1e9,
    )
    rows = Rows(vehicle, task, 2)
    levels = {"lost_thruster": [0.0, -1.0], "loss": LOSS}
    rows.reset(seeds=[0, 1], levels=levels)
    rows.states[0, :7] = start
    rows.set_water(0, sea(n_bodies(vehicle)) if moves_water else None)
    path = []
    for row in actions:
        rows.step(np.stack([row, np.zeros_like(row)]))
        path.append(rows.states[0, :ACTUATORS].copy())
    return np.array(path)


@pytest.mark.parametrize("name", VEHICLES)
def test_ten_seconds_in_currents_and_waves_agree_with_the_engine(name: str) -> None:
    model, _ = bundled(name.split()[0], timestep=H, **VEHICLES[name])
    model.body_user[0, c.SURFACE] = SURFACE
    vehicle = free_vehicle(model, 1)
    rng = np.random.default_rng(5)
    actions = np.repeat(rng.uniform(-0.3, 0.3, (N_STEPS // 10, len(vehicle.actuators))), 10, axis=0)

    path = row_path(vehicle, model.qpos0[:7], actions)

    expected = engine_path(model, actions)
    assert np.abs(expected[-1, :3] - model.qpos0[:3]).max() > 0.1
    np.testing.assert_allclose(path, expected, rtol=0.0, atol=1e-10)
    still_path = row_path(vehicle, model.qpos0[:7], actions, moves_water=False)
    assert np.abs(still_path - path).max() > 0.05


def run(n: int, seeds: range, threads: int, *, stride: int = 1) -> dict[int, bytes]:
    """Return the bytes of the rows in moving water, by seed, after some steps.

    Every row but those at a multiple of ``stride`` has the drawn current.
    """
    rows = station_rows(n, threads, ranges=RANGES)
    rows.reset(seeds=seeds)
    moving_rows = range(0, n, stride)
    for i in moving_rows:
        rows.set_water(i, sea(n_bodies(bluerov2()), seeds[i], has_waves=i % 2 == 0))
    actions = np.array([np.random.default_rng(seed).uniform(-1.0, 1.0, 8) for seed in seeds])
    rewards = np.zeros(n)
    for _ in range(3):
        rows.step(actions)
        rewards += rows.rewards
    rows.close()
    return {
        seeds[i]: rows.states[i].tobytes() + rows.arrays.water[i].tobytes() + rewards[i].tobytes()
        for i in moving_rows
    }


def test_the_bytes_of_a_row_in_moving_water_depend_on_its_seed_alone() -> None:
    all_bytes = run(256, range(256), 1, stride=8)

    assert run(256, range(256), 2, stride=8) == all_bytes
    assert run(7, range(248, 255), 1)[248] == all_bytes[248]
    assert run(1, range(8, 9), 1)[8] == all_bytes[8]
    many = run(4096, range(4096), 2, stride=128)
    assert many[128] == all_bytes[128]
    assert run(1, range(3968, 3969), 1)[3968] == many[3968]


def test_a_reset_removes_the_function_of_the_water() -> None:
    rows = station_rows(1, ranges={"current_speed": (0.2, 0.2)})
    rows.reset(seeds=[0])
    rows.set_water(0, sea(n_bodies(bluerov2()), has_waves=False))
    rows.step(np.zeros((1, 8)))
    assert rows.arrays.water[0, -1, 2] != 0.0

    rows.reset()
    rows.step(np.zeros((1, 8)))

    assert rows.arrays.water[0].tolist() == [[0.2, 0.0, *[0.0] * 10]] * 2


def test_the_base_of_a_vehicle_is_among_its_links() -> None:
    vehicle = bluerov2()
    assert (base_link_of(vehicle), n_bodies(vehicle)) == (0, 1)
    moved_vehicle = vehicle._replace(poses=vehicle.poses + 0.1)
    assert (base_link_of(moved_vehicle), n_bodies(moved_vehicle)) == (1, 2)
