"""The tasks of uwsim for LeRobot: `make_env` as the EnvHub of LeRobot calls it.

A repository of the hub with this file as ``env.py`` makes every policy of LeRobot run here:

    from lerobot.envs.factory import make_env
    suites = make_env("USER/REPOSITORY", n_envs=2, trust_remote_code=True)

An observation has ``agent_pos``, the numbers of uwsim's observation, and ``pixels``, the image of
the vehicle's camera. Run with LeRobot 0.4.4. Without LeRobot, `make_env` works as well.
"""

import gymnasium
import numpy as np
from gymnasium.spaces import Box, Dict
from gymnasium.vector import AsyncVectorEnv, AutoresetMode, SyncVectorEnv

SUITE = "uwsim"
DESCRIPTIONS = {
    "StationKeeping": "Move to the place and stay there.",
    "Circle": "Follow the place that moves in a circle.",
    "Helix": "Follow the place that moves on a helix.",
    "Lemniscate": "Follow the place that moves on a figure of eight.",
    "Docking": "Enter the dock.",
}
"""The instruction of each task."""


class LeRobotTask(gymnasium.Wrapper):
    """A task with the observations and attributes that LeRobot reads."""

    def __init__(self, name, has_pixels=True):
        super().__init__(
            gymnasium.make(
                f"uwsim.envs:uwsim/{name}-v0", render_mode="rgb_array", disable_env_checker=True
            )
        )
        self.task, self.task_description = name, DESCRIPTIONS[name]
        self._max_episode_steps = self.env.unwrapped.max_steps
        numbers = self.env.observation_space
        spaces = {"agent_pos": Box(numbers.low[0], numbers.high[0], numbers.shape, np.float64)}
        self._has_pixels = has_pixels
        if has_pixels:
            spaces["pixels"] = Box(0, 255, self.env.unwrapped.render().shape, np.uint8)
        self.observation_space = Dict(spaces)

    def reset(self, *, seed=None, options=None):
        """Begin an episode."""
        observation, info = self.env.reset(seed=seed, options=options)
        return self._observation(observation), info

    def step(self, action):
        """Take a step."""
        observation, *rest = self.env.step(action)
        return (self._observation(observation), *rest)

    def _observation(self, numbers):
        parts = {"agent_pos": numbers}
        if self._has_pixels:
            parts["pixels"] = self.env.render()
        return parts


def make_env(n_envs=1, use_async_envs=False, cfg=None):
    """Return the vectors of the tasks, ``{"uwsim": {0: vector, 1: vector}}``.

    Args:
        n_envs: the number of environments in each vector.
        use_async_envs: true for environments in processes of their own.
        cfg: an object whose ``task`` has the names of tasks, separated by commas, and whose
            ``obs_type`` is ``pixels_agent_pos`` or ``state``; None: StationKeeping with images.
    """
    if n_envs < 1:
        raise ValueError(f"n_envs is {n_envs}; expected 1 at least")
    names = (getattr(cfg, "task", None) or "StationKeeping").split(",")
    unknown_names = [name for name in names if name not in DESCRIPTIONS]
    if unknown_names:
        raise ValueError(f"no task {unknown_names[0]!r}; expected one of {', '.join(DESCRIPTIONS)}")
    has_pixels = getattr(cfg, "obs_type", "pixels_agent_pos") != "state"
    vector_class = AsyncVectorEnv if use_async_envs else SyncVectorEnv
    return {
        SUITE: {
            i: vector_class(
                [lambda name=name: LeRobotTask(name, has_pixels)] * n_envs,
                autoreset_mode=AutoresetMode.SAME_STEP,
            )
            for i, name in enumerate(names)
        }
    }
