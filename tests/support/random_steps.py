"""Random steps of an environment of Gymnasium, and Gymnasium's own check without a warning."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
from gymnasium.utils.env_checker import check_env

from uwsim.envs import BenchmarkEnv


def take_random_steps(
    env: BenchmarkEnv,
    n: int,
    *,
    seed: int = 2,
    options: dict[str, Any] | None = None,
    next_reset: dict[str, Any] | None = None,
) -> bytes:
    """Take random steps, with a new episode after each end; return all numbers, which are finite.

    Args:
        env: the environment.
        n: the number of steps.
        seed: the seed of the first episode and of the actions.
        options: the options of the first episode.
        next_reset: the arguments of the later resets.
    """
    observation, _ = env.reset(seed=seed, options=options)
    env.action_space.seed(seed)
    parts = [observation.tobytes()]
    for _ in range(n):
        observation, reward, terminated, truncated, _ = env.step(env.action_space.sample())
        assert np.isfinite(observation).all()
        assert np.isfinite(reward)
        parts += [observation.tobytes(), np.float64(reward).tobytes()]
        if terminated or truncated:
            observation, _ = env.reset(**(next_reset or {}))
    return b"".join(parts)


def check_without_warnings(env: BenchmarkEnv) -> None:
    """Run Gymnasium's check of an environment, in which a warning is an error."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(env, skip_render_check=True)
