"""Steps per second of rows of free vehicles with observations and rewards, and of engine rows.

Run ``python benchmarks/batch.py``. The bundled BlueROV2 heavy holds a point in a
current. A step of the environment is 5 physics steps of 10 ms. ``per_cpu_s`` is per second of CPU
time of all threads, ``per_s`` per second on the clock, which needs an idle machine. The engine rows
are a Girona 500 with its arm that lies on the sea floor, at 2 ms: MuJoCo's step with the water, and
a state of MuJoCo for each row.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import mujoco
import numpy as np
from measure import lower_target_figure, main, upper_target_figure

from uwsim.assets.find import find
from uwsim.envs.batch.rows import Rows
from uwsim.envs.batch.task import Channel, RowTask, Term, Trajectory
from uwsim.identification.vehicle_model import make_scene, open_vehicle
from uwsim.model.body_names import vehicle_body
from uwsim.physics.compile_scene import compile_scene
from uwsim.physics.hydrodynamics import callback, hydrodynamics
from uwsim.scene.reader import read_scene

SIZES = ((1, 1), (64, 1), (1024, 1), (4096, 1), (1024, 2), (4096, 2))
"""The numbers of rows and threads."""
STEPS = 40_000
"""The approximate number of steps of the environment in a measurement."""
ROUNDS = 5
TASK = RowTask(
    channels=(
        Channel(name="position_error"),
        Channel(name="attitude_error"),
        Channel(name="relative_velocity"),
        Channel(name="angular_velocity"),
        Channel(name="last_action"),
    ),
    terms=(
        Term(name="constant"),
        Term(name="capped_distance", weight=-1.0),
        Term(name="change", weight=-0.01),
    ),
    trajectory=Trajectory(centre=(0.0, 0.0, -50.0), level=(0.0, 1.0, 0.0, 0.0)),
    ranges={"current_speed": (0.0, 0.3), "current_heading": (-3.14, 3.14)},
    max_steps=10**9,
    exit_distance=1e9,
)
SIMULATED_TIME = TASK.timestep * TASK.substeps
"""The simulated time of a step of the environment [s]."""


def measure_best(call: Callable[[], object]) -> tuple[float, float]:
    """Return the least CPU time and the least time of a call [s]."""
    cpu, wall = [], []
    for _ in range(ROUNDS):
        cpu_start, wall_start = time.process_time(), time.perf_counter()
        call()
        cpu.append(time.process_time() - cpu_start)
        wall.append(time.perf_counter() - wall_start)
    return min(cpu), min(wall)


def measure_rows(n: int, threads: int) -> dict[str, object]:
    """Return the rates of a batch."""
    vehicle = open_vehicle(make_scene("bluerov2_heavy")).numbers
    rows = Rows(vehicle, TASK, n, threads=threads)
    cpu_start = time.process_time()
    rows.seed(range(n))
    seed_time = time.process_time() - cpu_start
    rows.reset()
    actions = np.random.default_rng(0).uniform(-1.0, 1.0, (n, 8))
    rows.step(actions)
    n_steps = max(1, STEPS // n)
    cpu, wall = measure_best(lambda: [rows.step(actions) for _ in range(n_steps)])
    n_resets = max(1, STEPS // n)
    reset_cpu, _ = measure_best(lambda: [rows.reset() for _ in range(n_resets)])
    rows.close()
    total = n * n_steps
    return {
        "rows": n,
        "threads": threads,
        "env_steps_per_cpu_s": round(total / cpu),
        "env_steps_per_s": round(total / wall),
        "simulated_s_per_cpu_s": round(total * SIMULATED_TIME / cpu),
        "simulated_s_per_s": round(total * SIMULATED_TIME / wall),
        "reset_us_per_row": round(reset_cpu / n_resets / n * 1e6, 2),
        "seed_us_per_row": round(seed_time / n * 1e6, 1),
    }


def measure_engine() -> dict[str, object]:
    """Return the rate of the engine with the same vehicle, one physics step after another."""
    model = compile_scene(make_scene("bluerov2_heavy").nominal_scene).engine_model
    model.opt.timestep = TASK.timestep
    water, data = hydrodynamics.install(model), mujoco.MjData(model)
    water.set_current(data, (0.2, 0.1, 0.0))
    loop = callback.stepper()
    loop(model._address, data._address, 10)
    n = 20_000
    cpu, _ = measure_best(lambda: loop(model._address, data._address, n))
    return {"physics_steps_per_cpu_s": round(n / cpu), "timestep_s": TASK.timestep}


def measure_contact(threads: int, rows_per_thread: int = 16) -> dict[str, object]:
    """Return the rate of Girona 500s with arm that lie on the sea floor, at 2 ms."""
    scene = compile_scene(read_scene(find("grasp-scene.xml")).nominal_scene)
    model = scene.engine_model
    model.opt.timestep = 0.002
    hydrodynamics.install(model)
    loop = callback.stepper()
    data = mujoco.MjData(model)
    root = model.body(vehicle_body(0, scene.robots[0].root)).id
    address = model.jnt_qposadr[model.body_jntadr[root]]
    mujoco.mj_forward(model, data)
    while data.ncon == 0 and data.qpos[address + 2] > -100.0:
        data.qpos[address + 2] -= 0.02
        mujoco.mj_forward(model, data)
    model.body_mass[root] += 200.0  # it lies on the floor
    loop(model._address, data._address, 2000)
    copies = [mujoco.MjData(model) for _ in range(threads * rows_per_thread)]
    for copy in copies:
        mujoco.mj_copyData(copy, model, data)
    n = 200

    def step(part: int) -> None:
        for copy in copies[part::threads]:
            loop(model._address, copy._address, n)

    with ThreadPoolExecutor(threads) as pool:
        cpu, wall = measure_best(lambda: list(pool.map(step, range(threads))))
    total = n * len(copies)
    return {
        "threads": threads,
        "rows": len(copies),
        "contacts": int(np.mean([copy.ncon for copy in copies])),
        "timestep_s": 0.002,
        "physics_steps_per_cpu_s": lower_target_figure(total / cpu, 20_000),
        "physics_steps_per_s": round(total / wall),
    }


def measure() -> dict[str, object]:
    """Return all figures."""
    batches = [measure_rows(*size) for size in SIZES]
    fastest_batch = max(batches, key=lambda figures: int(str(figures["env_steps_per_s"])))
    engine = measure_engine()
    rate = float(str(batches[2]["env_steps_per_cpu_s"])) * TASK.substeps
    return {
        "step": {"timestep_s": TASK.timestep, "substeps": TASK.substeps},
        "batches": batches,
        "env_steps_per_s": lower_target_figure(
            float(str(fastest_batch["env_steps_per_s"])), 300_000
        ),
        "simulated_s_per_s": lower_target_figure(
            float(str(fastest_batch["simulated_s_per_s"])), 15_000
        ),
        "single_steps_per_cpu_s": lower_target_figure(
            float(str(batches[0]["env_steps_per_cpu_s"])), 30_000
        ),
        "reset_us": upper_target_figure(float(str(batches[2]["reset_us_per_row"])), 20.0),
        "engine": engine,
        "rows_per_engine": round(rate / float(str(engine["physics_steps_per_cpu_s"])), 2),
        "contact": [measure_contact(1), measure_contact(2)],
    }


if __name__ == "__main__":
    main(measure)
