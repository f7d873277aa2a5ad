"""The registration of the bundled tasks with Gymnasium, as ``uwsim/StationKeeping-v0``.

The version of a task goes up whenever its reference scores change.
"""

from __future__ import annotations

import gymnasium

TASKS = {
    "uwsim/StationKeeping-v0": "station-keeping",
    "uwsim/Circle-v0": "circle",
    "uwsim/Helix-v0": "helix",
    "uwsim/Lemniscate-v0": "lemniscate",
    "uwsim/Docking-v0": "docking",
    "uwsim/Reach-v0": "reach",
    "uwsim/Grasp-v0": "grasp",
    "uwsim/PipeFollowing-v0": "pipe-following",
}
"""The benchmark of each task."""


def register_tasks() -> None:
    """Register the tasks that are not registered yet."""
    for name, benchmark in TASKS.items():
        if name not in gymnasium.registry:
            gymnasium.register(
                name,
                entry_point="uwsim.envs.benchmark_env:BenchmarkEnv",
                vector_entry_point="uwsim.envs.vector_env:make_vector_env",
                kwargs={"benchmark": benchmark},
            )
