"""Train with Stable-Baselines3 on rows: a `VecEnv` around a vector of Gymnasium.

    pip install stable-baselines3
    python examples/learning/sb3_adapter.py --steps 1000000 --out sb3_policy.zip

Run with Stable-Baselines3 2.9.2 and torch 2.14. The project's tests do without torch.
"""

import argparse

import gymnasium
import numpy as np
from stable_baselines3 import PPO
from stable_baselines3.common.vec_env import VecEnv, VecMonitor


class RowsOfUwsim(VecEnv):
    """The vector in its mode SameStep, whose rows begin anew in the step that ends them."""

    def __init__(self, task, rows=64):
        self.envs = gymnasium.make_vec(
            f"uwsim.envs:{task}", num_envs=rows, stepper="rows", autoreset_mode="SameStep"
        )
        super().__init__(rows, self.envs.single_observation_space, self.envs.single_action_space)

    def reset(self):
        """Begin new episodes, with the seed of the last `seed`."""
        observations, _ = self.envs.reset(seed=self._seeds[0])
        self._reset_seeds()
        return observations.copy()

    def step_async(self, actions):
        """Keep the actions for `step_wait`."""
        self._actions = np.asarray(actions, dtype=np.float32)

    def step_wait(self):
        """Take a step; the last observation of an ended row is ``terminal_observation``."""
        observations, rewards, terminated, truncated, infos = self.envs.step(self._actions)
        is_over = terminated | truncated
        row_infos = [{} for _ in range(self.num_envs)]
        for row in np.flatnonzero(is_over):
            final_info = infos["final_info"]
            row_infos[row] = {k: final_info[k][row] for k in final_info if f"_{k}" in final_info}
            row_infos[row]["terminal_observation"] = infos["final_obs"][row]
            row_infos[row]["TimeLimit.truncated"] = bool(truncated[row] and not terminated[row])
        return observations.copy(), rewards.copy(), is_over, row_infos

    def close(self):
        """Close the vector."""
        self.envs.close()

    def env_is_wrapped(self, wrapper_class, indices=None):
        """Return that no row has a wrapper."""
        return [False for _ in self._get_indices(indices)]

    def get_attr(self, attr_name, indices=None):
        """Return an attribute of the vector, which the rows share, for each row."""
        return [getattr(self.envs, attr_name) for _ in self._get_indices(indices)]

    def set_attr(self, attr_name, value, indices=None):
        """Set an attribute of the vector, which the rows share."""
        setattr(self.envs, attr_name, value)

    def env_method(self, method_name, *method_args, indices=None, **method_kwargs):
        """Call a method of the vector once, and return its result for each row."""
        result = getattr(self.envs, method_name)(*method_args, **method_kwargs)
        return [result for _ in self._get_indices(indices)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("task", nargs="?", default="uwsim/StationKeeping-v0")
    parser.add_argument("--steps", type=int, default=1_000_000)
    parser.add_argument("--rows", type=int, default=64)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", default="sb3_policy.zip")
    arguments = parser.parse_args()
    rows = VecMonitor(RowsOfUwsim(arguments.task, arguments.rows))
    settings = {"n_steps": 128, "batch_size": 2048, "seed": arguments.seed, "verbose": 1}
    model = PPO("MlpPolicy", rows, device="cpu", **settings)
    model.learn(arguments.steps)
    model.save(arguments.out)
    rows.close()


if __name__ == "__main__":
    main()
