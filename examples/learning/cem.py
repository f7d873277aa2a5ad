"""Train a linear policy by the cross-entropy method, in numpy.

    python examples/learning/cem.py uwsim/StationKeeping-v0 --out policy.npz
    uwsim bench station-keeping --algorithm examples/learning/policy.py:Policy

Each row of a vector of environments is an episode of one candidate. The best candidates give the
mean and the deviation of the next ones (Rubinstein 1999; Szita and Lorincz 2006).
"""

import argparse

import gymnasium
import numpy as np
from policy import save_policy


def rollout(envs, weights, scale, seed):
    """Return the return of an episode of each candidate, weights (n, o + 1, a)."""
    observations, _ = envs.reset(seed=[seed] * envs.num_envs)
    total, is_running = np.zeros(envs.num_envs), np.ones(envs.num_envs, bool)
    while is_running.any():
        actions = np.einsum("no,noa->na", observations / scale, weights[:, :-1]) + weights[:, -1]
        actions = np.clip(actions, -1.0, 1.0).astype(np.float32)
        observations, rewards, terminated, truncated, _ = envs.step(actions)
        total += rewards * is_running
        is_running &= ~(terminated | truncated)
    return total


def train(task, *, generations, rows, seed, out, options):
    """Train a policy, and write it to the file ``out``."""
    rng = np.random.default_rng(seed)
    envs = gymnasium.make_vec(f"uwsim.envs:{task}", num_envs=rows, **options)
    n = envs.single_observation_space.shape[0]
    shape = (n + 1, envs.single_action_space.shape[0])
    mean, deviation, scale = np.zeros(shape), np.full(shape, 0.5), np.ones(n)
    n_elites = max(2, rows // 8)
    for generation in range(generations):
        weights = mean + deviation * rng.normal(size=(rows, *shape))
        # three seeds, the same ones for all candidates
        seeds = rng.integers(2**31 - 1, size=3)
        returns = np.mean([rollout(envs, weights, scale, int(s)) for s in seeds], axis=0)
        elites = weights[np.argsort(-returns)[:n_elites]]
        mean, deviation = elites.mean(0), elites.std(0) + 0.1 * 0.97**generation
        print(f"generation {generation:3}  best {returns.max():8.2f}  mean {returns.mean():8.2f}")
        save_policy(out, [(mean[:-1], mean[-1])], np.zeros(n), scale)
    envs.close()


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("task", nargs="?", default="uwsim/StationKeeping-v0")
    parser.add_argument("--generations", type=int, default=60)
    parser.add_argument("--rows", type=int, default=128, help="candidates of a generation")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--stepper", choices=("engine", "rows"), default="rows")
    parser.add_argument("--out", default="policy.npz")
    arguments = vars(parser.parse_args())
    options = {"stepper": arguments.pop("stepper")}
    train(**arguments, options=options)


if __name__ == "__main__":
    main()
