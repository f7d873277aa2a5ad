"""Steps per second and resets of learning environments, and random steps of every task.

Run ``python benchmarks/environments.py``. Rates and times are of CPU time. Station keeping is
stepped with 14 numbers of observations, the reward and the measures; a step is 5 physics steps of
10 ms. ``make`` is the environment with Gymnasium's wrappers but its checker. A first reset makes
the current of each row, and a later one changes it. Every registered task takes random steps:
10^6 where rows can step it, and `ENGINE_STEPS` of the engine, which would need half an hour.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import gymnasium
import numpy as np
from measure import lower_target_figure, main, upper_target_figure

from uwsim.envs import TASKS

STATION = "uwsim/StationKeeping-v0"
ROUNDS = 5
N_STEPS = 590
"""The number of steps in a round of one environment, which do not end its episode."""
VECTOR_SIZES = (64, 1024)
RANDOM_STEPS, ENGINE_STEPS = 1_000_000, 2_000
"""The number of random steps of each task over rows, and over the engine."""


def best_time(call: Callable[[], object], prepare: Callable[[], object], rounds: int) -> float:
    """Return the least CPU time of a call [s]; ``prepare`` is called before each, untimed."""
    times = []
    for _ in range(rounds):
        prepare()
        start = time.process_time()
        call()
        times.append(time.process_time() - start)
    return min(times)


def measure_single(env: Any, n_steps: int, rounds: int = ROUNDS) -> dict[str, object]:
    """Return the rate and the reset of one environment."""
    action = np.full(8, 0.1, np.float32)
    env.reset(seed=0)
    seconds = best_time(
        lambda: [env.step(action) for _ in range(n_steps)], lambda: env.reset(seed=1), rounds
    )
    reset = best_time(lambda: env.reset(seed=2), lambda: None, rounds)
    figures = {
        "stepper": env.unwrapped.stepper,
        "env_steps_per_cpu_s": round(n_steps / seconds),
        "reset_ms": round(reset * 1e3, 3),
    }
    env.close()
    return figures


def measure_vector(n: int) -> dict[str, object]:
    """Return the rate of a vector of rows, and its resets."""
    envs = gymnasium.make_vec(STATION, num_envs=n, stepper="rows")
    start = time.process_time()
    envs.reset(seed=1)
    first_reset = time.process_time() - start
    actions = np.random.default_rng(0).uniform(-1.0, 1.0, (n, 8)).astype(np.float32)
    n_steps = max(20, 40_000 // n)
    seconds = best_time(
        lambda: [envs.step(actions) for _ in range(min(n_steps, N_STEPS))],
        lambda: envs.reset(seed=1),
        ROUNDS,
    )
    seeded_reset = best_time(lambda: envs.reset(seed=5), lambda: None, ROUNDS)
    envs.reset()  # creates the generators of the rows' seeds
    later_reset = best_time(envs.reset, lambda: None, ROUNDS)
    envs.close()
    return {
        "rows": n,
        "env_steps_per_cpu_s": round(n * min(n_steps, N_STEPS) / seconds),
        "first_reset_us_per_row": round(first_reset / n * 1e6, 1),
        "seeded_reset_us_per_row": round(seeded_reset / n * 1e6, 1),
        "reset_us_per_row": round(later_reset / n * 1e6, 1),
    }


def take_random_steps(task: str) -> dict[str, object]:
    """Take random steps of a task; return the number of numbers that are not finite."""
    env = gymnasium.make(task, stepper="auto")
    statement = env.unwrapped.stepper
    env.close()
    has_rows = statement.startswith("rows")
    n, total = (256, RANDOM_STEPS) if has_rows else (1, ENGINE_STEPS)
    envs = gymnasium.make_vec(task, num_envs=n, stepper="auto")
    rng = np.random.default_rng(0)
    observations, _ = envs.reset(seed=0)
    n_bad, n_terminated = int((~np.isfinite(observations)).sum()), 0
    n_steps = -(-total // n)
    start = time.process_time()
    for _ in range(n_steps):
        actions = rng.uniform(-1.0, 1.0, envs.action_space.shape)
        observations, rewards, terminated, _, _ = envs.step(actions.astype(np.float32))
        n_bad += int((~np.isfinite(observations)).sum() + (~np.isfinite(rewards)).sum())
        n_terminated += int(terminated.sum())
    seconds = time.process_time() - start
    envs.close()
    return {
        "stepper": statement,
        "random_steps": n_steps * n,
        "not_finite": upper_target_figure(n_bad, 0.0),
        "terminated": n_terminated,
        "env_steps_per_cpu_s": round(n_steps * n / seconds),
    }


def measure() -> dict[str, object]:
    """Return all figures."""
    make = {"stepper": "rows", "disable_env_checker": True}
    single_figures = measure_single(gymnasium.make(STATION, **make).unwrapped, N_STEPS)
    vectors = [measure_vector(n) for n in VECTOR_SIZES]
    return {
        "step": {"timestep_s": 0.01, "substeps": 5},
        "single": single_figures,
        "single_with_make": measure_single(gymnasium.make(STATION, **make), N_STEPS),
        "engine": measure_single(gymnasium.make(STATION).unwrapped, 200, rounds=2),
        "vectors": vectors,
        "single_steps_per_cpu_s": lower_target_figure(
            float(str(single_figures["env_steps_per_cpu_s"])), 30_000
        ),
        "reset_us": upper_target_figure(float(str(vectors[-1]["reset_us_per_row"])), 20.0),
        "random_steps": {task: take_random_steps(task) for task in TASKS},
    }


if __name__ == "__main__":
    main(measure)
