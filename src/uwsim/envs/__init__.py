"""Environments for learning: a benchmark file with ``<u:environment>`` as a Gymnasium environment.

.. code-block:: python

    import gymnasium

    env = gymnasium.make("uwsim.envs:uwsim/StationKeeping-v0")
    observation, info = env.reset(seed=1)
    observation, reward, terminated, truncated, info = env.step(env.action_space.sample())

`make_env` makes the environment of any benchmark file, and `make_parallel_env` that of several
vehicles, with PettingZoo. `batch` steps rows of free vehicles in
compiled code. Gymnasium and PettingZoo are the extra ``envs``: ``scripts/setup envs`` in a
checkout.
"""

from __future__ import annotations

import importlib.util

from .make import make_env, make_parallel_env

__all__ = ["make_env", "make_parallel_env"]

if importlib.util.find_spec("gymnasium") is not None:
    from .benchmark_env import BenchmarkEnv
    from .registration import TASKS, register_tasks
    from .row_vector_env import RowVectorEnv
    from .vector_env import BenchmarkVectorEnv

    register_tasks()
    __all__ += ["TASKS", "BenchmarkEnv", "BenchmarkVectorEnv", "RowVectorEnv", "register_tasks"]
