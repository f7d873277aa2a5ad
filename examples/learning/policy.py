"""A policy of a few layers in numpy, which `ppo.py` trains and ``uwsim bench`` scores.

    uwsim bench station-keeping --algorithm examples/learning/policy.py:Policy --repeat 6
    uwsim bench circle --algorithm examples/learning/policy.py:TrainedCircle --repeat 6

`Policy` reads the file ``policy.npz`` of the current folder. The others are policies that `ppo.py`
has trained with the seed 1, in the folder ``policies``.
"""

from pathlib import Path

import numpy as np

POLICIES = Path(__file__).parent / "policies"


class Policy:
    """The action for an observation: ``tanh`` layers on the standardised observation."""

    def __init__(self, path="policy.npz"):
        with np.load(Path(path)) as file:
            n_layers = len([name for name in file.files if name.startswith("weight")])
            self.layers = [(file[f"weight{i}"], file[f"bias{i}"]) for i in range(n_layers)]
            self.mean, self.deviation = file["mean"], file["deviation"]

    def __call__(self, observation):
        """Return the action for an observation."""
        activation = np.clip((observation - self.mean) / self.deviation, -10.0, 10.0)
        for weight, bias in self.layers[:-1]:
            activation = np.tanh(activation @ weight + bias)
        weight, bias = self.layers[-1]
        return np.clip(activation @ weight + bias, -1.0, 1.0)


class TrainedStationKeeping(Policy):
    """A policy for `uwsim/StationKeeping-v0`."""

    def __init__(self):
        super().__init__(POLICIES / "station-keeping.npz")


class TrainedCircle(Policy):
    """A policy for `uwsim/Circle-v0`."""

    def __init__(self):
        super().__init__(POLICIES / "circle.npz")


class TrainedHelix(Policy):
    """A policy for `uwsim/Helix-v0`."""

    def __init__(self):
        super().__init__(POLICIES / "helix.npz")


class TrainedLemniscate(Policy):
    """A policy for `uwsim/Lemniscate-v0`."""

    def __init__(self):
        super().__init__(POLICIES / "lemniscate.npz")


def save_policy(path, layers, mean, deviation):
    """Write the layers, pairs of a weight (n, m) and a bias (m,), and the standardisation."""
    weights = {f"weight{i}": weight for i, (weight, _) in enumerate(layers)}
    biases = {f"bias{i}": bias for i, (_, bias) in enumerate(layers)}
    np.savez(path, mean=mean, deviation=deviation, **weights, **biases)
