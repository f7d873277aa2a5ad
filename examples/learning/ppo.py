"""Train a policy by proximal policy optimisation (PPO) in numpy, on rows of compiled vehicles.

    python examples/learning/ppo.py uwsim/StationKeeping-v0 --steps 2000000 --out policy.npz
    uwsim bench station-keeping --algorithm examples/learning/policy.py:Policy

The method is that of Schulman et al. 2017 (arXiv 1707.06347) with generalised advantages
(arXiv 1506.02438). Two small networks give the mean of a Gaussian action and the value. Their
gradients are written out, so the example needs nothing but numpy and Gymnasium.
"""

import argparse
import time
from itertools import pairwise

import gymnasium
import numpy as np
from policy import save_policy

DISCOUNT, LAMBDA, CLIP, EPOCHS, MINIBATCH = 0.99, 0.95, 0.2, 5, 2048


class Network:
    """Layers with ``tanh`` between them, and their optimiser Adam."""

    def __init__(self, sizes, rng, last_scale):
        self.parameters = []
        for i, (n, m) in enumerate(pairwise(sizes)):
            scale = last_scale if i == len(sizes) - 2 else 1.0
            self.parameters += [rng.normal(0.0, scale / np.sqrt(n), (n, m)), np.zeros(m)]
        self.reset_optimiser()

    def reset_optimiser(self):
        """Forget the moments of the gradients."""
        self.first = [np.zeros_like(p) for p in self.parameters]
        self.second = [np.zeros_like(p) for p in self.parameters]
        self.n_updates = 0

    @property
    def layers(self):
        """The weight and the bias of each layer."""
        n = 2 * (len(self.parameters) // 2)
        return list(zip(self.parameters[0:n:2], self.parameters[1:n:2], strict=True))

    def forward(self, x):
        """Return the output, and the inputs of the layers for `backward`."""
        inputs = []
        for i, (weight, bias) in enumerate(self.layers):
            inputs.append(x)
            x = x @ weight + bias
            if i < len(self.layers) - 1:
                x = np.tanh(x)
        return x, inputs

    def backward(self, inputs, gradient):
        """Return the gradients of the parameters for the gradient of the output."""
        gradients = []
        for i in reversed(range(len(self.layers))):
            gradients = [inputs[i].T @ gradient, gradient.sum(0), *gradients]
            if i > 0:
                gradient = (gradient @ self.layers[i][0].T) * (1.0 - inputs[i] ** 2)
        return gradients

    def descend(self, gradients, rate, max_norm=0.5):
        """Take a step of Adam (Kingma and Ba 2015) with gradients of limited norm."""
        norm = np.sqrt(sum(float((g * g).sum()) for g in gradients))
        self.n_updates += 1
        for i, gradient in enumerate(gradients):
            gradient = gradient * min(1.0, max_norm / (norm + 1e-8))
            self.first[i] += 0.1 * (gradient - self.first[i])
            self.second[i] += 0.001 * (gradient * gradient - self.second[i])
            first = self.first[i] / (1.0 - 0.9**self.n_updates)
            second = self.second[i] / (1.0 - 0.999**self.n_updates)
            self.parameters[i] -= rate * first / (np.sqrt(second) + 1e-8)


class Standardiser:
    """The running mean and deviation of the observations."""

    def __init__(self, n):
        self.mean, self.square, self.count = np.zeros(n), np.ones(n), 1e-4

    def update(self, batch):
        """Include a batch of observations, (n, o)."""
        n = self.count + len(batch)
        offset = batch.mean(0) - self.mean
        self.square = (
            self.square * self.count
            + batch.var(0) * len(batch)
            + offset**2 * self.count * len(batch) / n
        ) / n
        self.mean, self.count = self.mean + offset * len(batch) / n, n

    @property
    def deviation(self):
        """The standard deviation of each number."""
        return np.sqrt(self.square) + 1e-6

    def __call__(self, batch):
        """Return standardised observations, limited to 10 deviations."""
        return np.clip((batch - self.mean) / self.deviation, -10.0, 10.0)


def log_density(actions, mean, log_deviation):
    """Return the logarithm of the Gaussian density of actions, (n,)."""
    z = (actions - mean) / np.exp(log_deviation)
    return -0.5 * (z * z).sum(-1) - log_deviation.sum() - 0.919 * actions.shape[-1]


def advantages_of(rewards, values, next_values, terminated, is_over):
    """Return generalised advantages, (steps, rows)."""
    advantages, advantage = np.zeros_like(rewards), 0.0
    for t in reversed(range(len(rewards))):
        error = rewards[t] + DISCOUNT * next_values[t] * ~terminated[t] - values[t]
        advantage = error + DISCOUNT * LAMBDA * ~is_over[t] * advantage
        advantages[t] = advantage
    return advantages


def train(task, *, steps, rows, length, seed, rate, out, options):
    """Train a policy, and write it to the file ``out``."""
    rng = np.random.default_rng(seed)
    envs = gymnasium.make_vec(f"uwsim.envs:{task}", num_envs=rows, **options)
    n = envs.single_observation_space.shape[0]
    n_actions = envs.single_action_space.shape[0]
    actor, critic = (
        Network([n, 64, 64, n_actions], rng, 0.1),
        Network([n, 64, 64, 1], rng, 1.0),
    )
    actor.parameters.append(np.full(n_actions, -0.7))  # the log of the deviation
    actor.reset_optimiser()
    standardise = Standardiser(n)
    observation, _ = envs.reset(seed=seed)
    was_over = np.zeros(rows, bool)  # rows whose next step is a reset
    episode_return, returns, begin = np.zeros(rows), [], time.monotonic()

    for iteration in range(max(1, steps // (rows * length))):
        observations = np.zeros((length + 1, rows, n))
        actions = np.zeros((length, rows, n_actions))
        rewards, is_valid = np.zeros((length, rows)), np.zeros((length, rows), bool)
        terminated, is_over = np.zeros_like(is_valid), np.zeros_like(is_valid)
        for t in range(length):
            observations[t], is_valid[t] = observation, ~was_over
            mean = actor.forward(standardise(observation))[0]
            noise = np.exp(actor.parameters[-1]) * rng.normal(size=mean.shape)
            actions[t] = mean + noise
            command = np.clip(actions[t], -1.0, 1.0).astype(np.float32)
            observation, rewards[t], terminated[t], truncated, _ = envs.step(command)
            is_over[t] = was_over = terminated[t] | truncated
            episode_return += rewards[t]
            returns += episode_return[was_over].tolist()
            episode_return[was_over] = 0.0
        observations[length] = observation

        x = standardise(observations)
        values = critic.forward(x.reshape(-1, n))[0].reshape(length + 1, rows)
        advantages = advantages_of(rewards, values[:-1], values[1:], terminated, is_over)
        selection = is_valid.ravel()
        x, a = x[:-1].reshape(-1, n)[selection], actions.reshape(-1, n_actions)[selection]
        targets = (advantages + values[:-1]).ravel()[selection]
        advantages = advantages.ravel()[selection]
        old_density = log_density(a, actor.forward(x)[0], actor.parameters[-1])
        present_rate = rate * (1.0 - iteration * rows * length / steps)
        for _ in range(EPOCHS):
            for batch in np.array_split(rng.permutation(len(x)), max(1, len(x) // MINIBATCH)):
                update_actor(
                    actor, x[batch], a[batch], advantages[batch], old_density[batch], present_rate
                )
                value, inputs = critic.forward(x[batch])
                error = (value[:, 0] - targets[batch])[:, None] / len(batch)
                critic.descend(critic.backward(inputs, error), present_rate)
        standardise.update(observations[:-1].reshape(-1, n)[selection])
        if iteration % 10 == 0 and returns:
            n_steps = (iteration + 1) * rows * length
            print(
                f"{n_steps:>9} steps  {time.monotonic() - begin:6.0f} s  "
                f"return {np.mean(returns[-rows:]):8.2f}",
                flush=True,
            )
            save_policy(out, actor.layers, standardise.mean, standardise.deviation)
    save_policy(out, actor.layers, standardise.mean, standardise.deviation)
    envs.close()


def update_actor(actor, x, actions, advantages, old_density, rate):
    """Climb the clipped objective, min(r A, clip(r) A), by one step."""
    advantages = (advantages - advantages.mean()) / (advantages.std() + 1e-8)
    mean, inputs = actor.forward(x)
    deviation = np.exp(actor.parameters[-1])
    ratio = np.exp(log_density(actions, mean, actor.parameters[-1]) - old_density)
    is_clipped = np.where(advantages > 0.0, ratio > 1.0 + CLIP, ratio < 1.0 - CLIP)
    weight = (np.where(is_clipped, 0.0, ratio * advantages) / len(x))[:, None]
    z = (actions - mean) / deviation
    gradients = actor.backward(inputs, -weight * z / deviation)
    actor.descend([*gradients, (-weight * (z * z - 1.0)).sum(0)], rate)


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("task", nargs="?", default="uwsim/StationKeeping-v0")
    parser.add_argument("--steps", type=int, default=2_000_000)
    parser.add_argument("--rows", type=int, default=128)
    parser.add_argument("--length", type=int, default=128, help="steps between two updates")
    parser.add_argument("--rate", type=float, default=7e-4, help="the first step of Adam")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--stepper", choices=("engine", "rows"), default="rows")
    parser.add_argument("--out", default="policy.npz")
    arguments = vars(parser.parse_args())
    options = {"stepper": arguments.pop("stepper")}
    train(**arguments, options=options)


if __name__ == "__main__":
    main()
