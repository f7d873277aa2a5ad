"""Train a policy that keeps a BlueROV2 at its place, with NumPy alone, in less than a minute.

The policy is linear, with limits. The cross-entropy method draws 256 policies, keeps the best
tenth, and draws the next ones around these. Each generation is one episode of 15 s in one current.

    python examples/train_policy.py policy.npy
    uwsim bench station-keeping --algorithm examples/train_policy.py:Policy --out policy.result
"""

from __future__ import annotations

import argparse
from pathlib import Path

import gymnasium
import numpy as np

N_POLICIES, N_BEST = 256, 26
N_STEPS = 300  # of an episode, 0.05 s each
CURRENTS = 7  # 0 to 0.3 m/s
NOISE = 0.05  # added to the spread of the weights, less and less


class Policy:
    """The policy of policy.npy in the current folder, for uwsim bench."""

    def __init__(self) -> None:
        self.weights = np.load("policy.npy")

    def __call__(self, observation: np.ndarray) -> np.ndarray:
        """Return the commands of the thrusters for an observation."""
        return np.tanh(np.sum(self.weights * observation, axis=1))


def train(
    n_generations: int, seed: int, task: str = "uwsim/StationKeeping-v0"
) -> tuple[np.ndarray, list[float]]:
    """Return the weights, and the mean return of the best policies of each generation."""
    rows = gymnasium.make_vec(f"uwsim.envs:{task}", num_envs=N_POLICIES, stepper="rows")
    rng = np.random.default_rng(seed)
    shape = (*rows.single_action_space.shape, *rows.single_observation_space.shape)
    mean, spread = np.zeros(shape), np.full(shape, 0.5)
    best_returns = []
    for generation in range(n_generations):
        weights = mean + spread * rng.standard_normal((N_POLICIES, *shape))
        level = {"current": 0.05 * (generation % CURRENTS)}
        observations, _ = rows.reset(
            seed=[1000 * seed + generation] * N_POLICIES, options={"level": level}
        )
        returns = np.zeros(N_POLICIES)
        for _ in range(N_STEPS):
            actions = np.tanh(np.einsum("nij,nj->ni", weights, observations))
            observations, rewards, *_ = rows.step(actions)
            returns += rewards
        elite = np.argsort(-returns, kind="stable")[:N_BEST]
        noise = NOISE * (1.0 - generation / n_generations)
        mean, spread = weights[elite].mean(axis=0), np.hypot(weights[elite].std(axis=0), noise)
        best_returns.append(float(returns[elite].mean()))
        if generation % 10 == 9:
            print(f"generation {generation + 1}: return {best_returns[-1]:.0f} of {N_STEPS}")
    rows.close()
    return mean, best_returns


def main() -> None:
    parser = argparse.ArgumentParser(description="Train a policy for station keeping.")
    parser.add_argument("out", type=Path, help="the file of the weights, such as policy.npy")
    parser.add_argument("--task", default="uwsim/StationKeeping-v0")
    parser.add_argument("--generations", type=int, default=60)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    weights, _ = train(options.generations, options.seed, options.task)
    np.save(options.out, weights)


if __name__ == "__main__":
    main()
