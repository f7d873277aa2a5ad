"""Train a policy by proximal policy optimisation (PPO) in numpy, on rows of compiled vehicles.

    OPENBLAS_NUM_THREADS=1 python examples/learning/ppo.py uwsim/Circle-v0 --out policy.npz
    uwsim bench circle --algorithm examples/learning/policy.py:Policy

The method is that of Schulman et al. 2017 (arXiv 1707.06347) with generalised advantages
(arXiv 1506.02438). Two small networks give the mean of a Gaussian action and the value. Their
gradients are written out, so the example needs nothing but numpy and Gymnasium.

What the training changes, and the scoring does not:

- `REWARD` falls linearly with the distance, so that it has a slope far away, too. The reward of the
  benchmark, exp(-3 d), is flat there. A second term rewards the last centimetres.
- A row begins anew when it is more than `EXIT` away, as there is nothing to learn there.
- Rewards are scaled by 1 - `DISCOUNT`, so that values are about 1: a critic learns these sooner.

The distance from the reference at the means of the actions, the way to it included, goes to a file
beside the policy: ``policy.csv``.
"""

import argparse
import time
from itertools import pairwise
from pathlib import Path

import gymnasium
import numpy as np
from policy import save_policy

DISCOUNT, LAMBDA, CLIP, EPOCHS, MINIBATCH = 0.98, 0.95, 0.2, 4, 1024
N_EVALUATED, N_EVALUATIONS = 16, 20
EXIT = 1.5  # m
REWARD = "1.5 - offset + exp(-10*offset) - 0.05*effort - 0.05*change - 0.02*turnRate - 0.02*tilt"


class Network:
    """Layers with ``tanh`` between them, and their optimiser Adam."""

    def __init__(self, sizes, rng, last_scale):
        self.parameters = []
        for i, (n, m) in enumerate(pairwise(sizes)):
            scale = last_scale if i == len(sizes) - 2 else 1.0
            weight = rng.normal(0.0, scale / np.sqrt(n), (n, m)).astype(np.float32)
            self.parameters += [weight, np.zeros(m, np.float32)]
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
        norm = float(np.sqrt(sum(float((g * g).sum()) for g in gradients)))
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
        return np.clip((batch - self.mean) / self.deviation, -10.0, 10.0).astype(np.float32)


class Rollout:
    """The observations, actions and rewards of rows in some steps: arrays (steps, rows, ...)."""

    def __init__(self, envs, length, rng):
        self._envs, self._length, self._rng = envs, length, rng
        self._observation, _ = envs.reset(seed=int(rng.integers(1 << 30)))

    def take(self, actor, standardise):
        """Take steps with random actions; rows that are over begin anew."""
        rows, n = self._observation.shape
        n_actions = len(actor.parameters[-1])
        self.observations = np.zeros((self._length, rows, n))
        self.next_observations = np.zeros_like(self.observations)
        self.actions = np.zeros((self._length, rows, n_actions), np.float32)
        self.rewards = np.zeros((self._length, rows))
        self.has_left, self.is_over = np.zeros((2, self._length, rows), bool)
        for t in range(self._length):
            self.observations[t] = self._observation
            mean = actor.forward(standardise(self._observation))[0]
            noise = self._rng.standard_normal(mean.shape, dtype=np.float32)
            self.actions[t] = mean + np.exp(actor.parameters[-1]) * noise
            command = np.clip(self.actions[t], -1.0, 1.0)
            self._observation, self.rewards[t], _, truncated, _ = self._envs.step(command)
            self.next_observations[t] = self._observation
            self.has_left[t] = np.linalg.norm(self._observation[:, :3], axis=1) > EXIT
            self.is_over[t] = self.has_left[t] | truncated
            if self.is_over[t].any():
                mask = self.is_over[t].copy()
                self._observation, _ = self._envs.reset(options={"reset_mask": mask})

    def advantages(self, values, next_values):
        """Return the generalised advantages, (steps, rows)."""
        advantages, advantage = np.zeros_like(self.rewards), 0.0
        for t in reversed(range(self._length)):
            future = DISCOUNT * next_values[t] * ~self.has_left[t]
            error = (1.0 - DISCOUNT) * self.rewards[t] + future - values[t]
            advantage = error + DISCOUNT * LAMBDA * ~self.is_over[t] * advantage
            advantages[t] = advantage
        return advantages


def log_density(actions, mean, log_deviation):
    """Return the logarithm of the Gaussian density of actions, (n,)."""
    z = (actions - mean) / np.exp(log_deviation)
    return -0.5 * (z * z).sum(-1) - log_deviation.sum() - 0.919 * actions.shape[-1]


def train(task, *, steps, rows, length, seed, rate, current, out):
    """Train a policy, write it to the file ``out``, and return the lines of its ``.csv``."""
    rng = np.random.default_rng(seed)
    options = {"stepper": "rows", "reward": REWARD, "autoreset_mode": "Disabled"}
    envs = gymnasium.make_vec(f"uwsim.envs:{task}", num_envs=rows, **options)
    test_envs = gymnasium.make_vec(f"uwsim.envs:{task}", num_envs=N_EVALUATED, **options)
    n = envs.single_observation_space.shape[0]
    n_actions = envs.single_action_space.shape[0]
    actor, critic = Network([n, 64, 64, n_actions], rng, 0.1), Network([n, 64, 64, 1], rng, 1.0)
    actor.parameters.append(np.full(n_actions, -0.5, np.float32))  # the log of the deviation
    actor.reset_optimiser()
    standardise, rollout = Standardiser(n), Rollout(envs, length, rng)
    begin, lines = time.process_time(), ["steps,cpu_seconds,rms_error"]
    n_iterations = max(1, steps // (rows * length))
    for iteration in range(n_iterations):
        rollout.take(actor, standardise)
        update(actor, critic, standardise, rollout, rng, rate * (1.0 - iteration / n_iterations))
        standardise.update(rollout.observations.reshape(-1, n))
        if (iteration + 1) % max(1, n_iterations // N_EVALUATIONS) == 0:
            error = evaluate(test_envs, actor, standardise, current)
            n_steps, seconds = (iteration + 1) * rows * length, time.process_time() - begin
            lines.append(f"{n_steps},{seconds:.1f},{error:.4f}")
            print(f"{n_steps:>9} steps  {seconds:5.0f} s  distance {error:.3f} m", flush=True)
            save_policy(out, actor.layers, standardise.mean, standardise.deviation)
    save_policy(out, actor.layers, standardise.mean, standardise.deviation)
    Path(out).with_suffix(".csv").write_text("\n".join(lines) + "\n")
    envs.close()
    test_envs.close()
    return lines


def update(actor, critic, standardise, rollout, rng, rate):
    """Improve both networks by some epochs on the steps of a rollout."""
    shape = rollout.rewards.shape
    x = standardise(rollout.observations.reshape(-1, rollout.observations.shape[-1]))
    next_x = standardise(rollout.next_observations.reshape(x.shape))
    values, next_values = (critic.forward(o)[0].reshape(shape) for o in (x, next_x))
    advantages = rollout.advantages(values, next_values)
    targets = (advantages + values).reshape(-1, 1).astype(np.float32)
    advantages = advantages.ravel().astype(np.float32)
    actions = rollout.actions.reshape(len(x), -1)
    old_density = log_density(actions, actor.forward(x)[0], actor.parameters[-1])
    for _ in range(EPOCHS):
        for batch in np.array_split(rng.permutation(len(x)), max(1, len(x) // MINIBATCH)):
            update_actor(
                actor, x[batch], actions[batch], advantages[batch], old_density[batch], rate
            )
            value, inputs = critic.forward(x[batch])
            critic.descend(critic.backward(inputs, (value - targets[batch]) / len(batch)), rate)


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


def evaluate(envs, actor, standardise, current):
    """Return the root mean square of the distance in an episode without noise [m]."""
    observation, _ = envs.reset(seed=0, options={"level": {"current": current}})
    while True:
        command = np.clip(actor.forward(standardise(observation))[0], -1.0, 1.0)
        observation, _, _, truncated, infos = envs.step(command)
        if truncated.all():
            return float(infos["measures"]["offset"].mean())


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("task", nargs="?", default="uwsim/StationKeeping-v0")
    parser.add_argument("--steps", type=int, default=500_000)
    parser.add_argument("--rows", type=int, default=256)
    parser.add_argument("--length", type=int, default=16, help="steps between two updates")
    parser.add_argument("--rate", type=float, default=3e-3, help="the first step of Adam")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--current", type=float, default=0.1, help="of the printed distance [m/s]")
    parser.add_argument("--out", default="policy.npz")
    train(**vars(parser.parse_args()))


if __name__ == "__main__":
    main()
