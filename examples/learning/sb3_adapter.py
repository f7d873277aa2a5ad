"""Train with Stable-Baselines3 on rows: a `VecEnv` around a vector of Gymnasium.

    pip install stable-baselines3
    python examples/learning/sb3_adapter.py

This example has not been run by the project's tests: they do without torch.
"""

import gymnasium
import numpy as np
from stable_baselines3 import PPO
from stable_baselines3.common.vec_env import VecEnv


class RowsOfUwsim(VecEnv):
    """The vector in its mode SameStep, whose rows begin anew in the step that ends them."""

    def __init__(self, task, rows=64):
        self.envs = gymnasium.make_vec(
            f"uwsim.envs:{task}", num_envs=rows, stepper="rows", autoreset_mode="SameStep"
        )
        super().__init__(rows, self.envs.single_observation_space, self.envs.single_action_space)

    def reset(self):
        """Begin new episodes."""
        return self.envs.reset(seed=self._seeds[0])[0].copy()

    def step_async(self, actions):
        """Keep the actions for `step_wait`."""
        self._actions = np.asarray(actions, dtype=np.float32)

    def step_wait(self):
        """Take a step; the last observation of an ended row is ``terminal_observation``."""
        observations, rewards, terminated, truncated, infos = self.envs.step(self._actions)
        is_over = terminated | truncated
        row_infos = [{} for _ in range(self.num_envs)]
        for row in np.flatnonzero(is_over):
            row_infos[row]["terminal_observation"] = infos["final_obs"][row]
            row_infos[row]["TimeLimit.truncated"] = bool(truncated[row])
        return observations.copy(), rewards.copy(), is_over, row_infos

    def close(self):
        """Close the vector."""
        self.envs.close()

    def env_is_wrapped(self, wrapper_class, indices=None):
        """Return that no row has a wrapper."""
        return [False] * self.num_envs

    def get_attr(self, attr_name, indices=None):
        """Return an attribute of the vector for each row."""
        return [getattr(self.envs, attr_name)] * self.num_envs

    def set_attr(self, attr_name, value, indices=None):
        """Refuse to set an attribute of rows."""
        raise NotImplementedError("rows share their attributes")

    def env_method(self, method_name, *args, indices=None, **kwargs):
        """Refuse to call a method of rows."""
        raise NotImplementedError("rows have no methods of their own")


if __name__ == "__main__":
    PPO("MlpPolicy", RowsOfUwsim("uwsim/StationKeeping-v0"), verbose=1).learn(1_000_000)
