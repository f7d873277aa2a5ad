"""The training of examples/learning/ppo.py, in short form."""

from __future__ import annotations

import runpy
from pathlib import Path

import numpy as np
import pytest

import uwsim

FOLDER = Path(__file__).parents[2] / "examples" / "learning"


@pytest.fixture
def ppo(monkeypatch: pytest.MonkeyPatch) -> dict[str, object]:
    monkeypatch.syspath_prepend(str(FOLDER))
    return runpy.run_path(str(FOLDER / "ppo.py"))


def test_the_gradients_of_a_network_are_those_of_differences(ppo: dict[str, object]) -> None:
    rng = np.random.default_rng(0)
    network = ppo["Network"]([3, 5, 2], rng, 1.0)  # type: ignore[operator]
    network.parameters = [np.float64(p) for p in network.parameters]  # for small differences
    x, weight = rng.normal(size=(4, 3)), rng.normal(size=(4, 2))
    _, inputs = network.forward(x)
    gradients = network.backward(inputs, weight)
    for parameter, gradient in zip(network.parameters, gradients, strict=True):
        parameter.flat[1] += 1e-6
        above = float((network.forward(x)[0] * weight).sum())
        parameter.flat[1] -= 2e-6
        below = float((network.forward(x)[0] * weight).sum())
        parameter.flat[1] += 1e-6
        assert gradient.flat[1] == pytest.approx((above - below) / 2e-6, rel=1e-5)


def test_the_gradient_of_the_actor_is_that_of_its_objective(ppo: dict[str, object]) -> None:
    rng = np.random.default_rng(1)
    actor = ppo["Network"]([3, 5, 2], rng, 1.0)  # type: ignore[operator]
    actor.parameters.append(np.full(2, -0.5))
    actor.reset_optimiser()
    x, advantages = rng.normal(size=(64, 3)), rng.normal(size=64)
    density, update = ppo["log_density"], ppo["update_actor"]
    mean = actor.forward(x)[0]
    actions = mean + np.exp(-0.5) * rng.normal(size=mean.shape)
    old = density(actions, mean, actor.parameters[-1])  # type: ignore[operator]

    def objective() -> float:
        mean = actor.forward(x)[0]
        ratio = np.exp(density(actions, mean, actor.parameters[-1]) - old)  # type: ignore[operator]
        standard = (advantages - advantages.mean()) / advantages.std()
        return float(np.minimum(ratio * standard, np.clip(ratio, 0.8, 1.2) * standard).mean())

    begin = objective()
    for _ in range(20):
        update(actor, x, actions, advantages, old, 1e-3)  # type: ignore[operator]
    assert objective() > begin + 0.01


def test_a_short_training_writes_a_policy(ppo: dict[str, object], tmp_path: Path) -> None:
    path = tmp_path / "policy.npz"
    ppo["train"](  # type: ignore[operator]
        "uwsim/StationKeeping-v0",
        steps=512,
        rows=8,
        length=64,
        seed=1,
        rate=3e-3,
        current=0.1,
        out=path,
    )
    policy = runpy.run_path(str(FOLDER / "policy.py"))["Policy"](path)
    size = len(policy.mean)
    action = policy(np.zeros(size))
    assert action.shape == (8,)
    assert (np.abs(action) <= 1.0).all()


@pytest.mark.slow
def test_the_trained_policy_is_nearer_to_its_place_than_the_proportional_controller(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.syspath_prepend(str(FOLDER))
    policy = runpy.run_path(str(FOLDER / "policy.py"))["TrainedStationKeeping"]
    scores = [
        uwsim.bench("station-keeping", algorithm=algorithm, levels={"current": [0.2]}).values(
            "offset"
        )[0]
        for algorithm in (policy, "position-p")
    ]
    assert scores[0] < 0.5 * scores[1]
    assert scores[0] < 0.1
