"""Environments of several vehicles, held against PettingZoo's checks and against uwsim bench."""

from __future__ import annotations

import re
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import uwsim
from uwsim.envs.make import make_env, make_parallel_env
from uwsim.errors import BadSetting, BenchmarkError, UnknownName

pettingzoo_test = pytest.importorskip(
    "pettingzoo.test", reason="pettingzoo is not installed: pip install uwsim[envs]"
)
DATA = Path(uwsim.__file__).parent / "data/benchmarks"
POLICY = """
import numpy as np


class Policy:
    def __init__(self):
        self.layout, self.agent = {}, ""

    def __call__(self, observation):
        error = observation[self.layout["positionError"]]
        gain = {"leader": 1.0, "follower": 0.5}[self.agent]
        return np.append(np.tanh(gain * error), 0.0)
"""


@pytest.fixture(scope="module")
def short_benchmark(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The formation with levels of 0.5 s."""
    path = tmp_path_factory.mktemp("short") / "formation.xml"
    text = (DATA / "formation.xml").read_text()
    path.write_text(re.sub("<interval>[0-9]+<", "<interval>0.5<", text))
    return str(path)


def actions_of(observations: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    return {
        agent: np.append(np.tanh(gain * observations[agent][:3]), 0.0).astype(np.float64)
        for agent, gain in (("leader", 1.0), ("follower", 0.5))
    }


@pytest.mark.slow
def test_pettingzoo_finds_nothing_wrong(short_benchmark: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        env = make_parallel_env(short_benchmark)
        pettingzoo_test.parallel_api_test(env, num_cycles=25)
        env.close()
        pettingzoo_test.parallel_seed_test(
            lambda: make_parallel_env(short_benchmark), num_cycles=12
        )


def test_the_measures_of_an_episode_are_those_of_the_benchmark(
    short_benchmark: str, tmp_path: Path
) -> None:
    (tmp_path / "policy.py").write_text(POLICY)
    result = uwsim.bench(
        short_benchmark,
        algorithm=f"{tmp_path / 'policy.py'}:Policy",
        seeds=(5,),
        levels={"current": [0.2]},
    )
    env = make_parallel_env(short_benchmark)
    observations, infos = env.reset(seed=5, options={"level": {"current": 0.2}})
    assert infos["leader"]["level"] == {"current": 0.2}
    while env.agents:
        observations, rewards, _, truncated, infos = env.step(actions_of(observations))
    env.close()
    assert set(rewards) == {"leader", "follower"}
    assert truncated == {"leader": True, "follower": True}
    names = [column.name for column in result.columns]
    for measure in ("offset", "gap", "leaderEnergy", "followerEnergy"):
        expected = result.rows[0][names.index(measure)]
        for agent in ("leader", "follower"):
            assert infos[agent]["measures"][measure] == pytest.approx(expected, rel=1e-12)


def test_the_place_of_a_follower_is_relative_to_its_leader(short_benchmark: str) -> None:
    env = make_parallel_env(
        short_benchmark,
        agents={
            "leader": {"observation": ["position", "linearVelocity"]},
            "follower": {"observation": ["positionError", "position", "heading"]},
        },
    )
    observations, _ = env.reset(seed=3)
    for _ in range(5):
        actions = {"leader": np.array([1.0, 0.5, 0, 0]), "follower": np.zeros(4)}
        observations, *_ = env.step(actions)
    leader, follower = observations["leader"], observations["follower"]
    error, position, bow = follower[:3], follower[3:6], follower[6:8]
    expected = leader[:3] + np.array([0.0, 1.2, 0.0]) - position  # in L
    forward = expected[0] * bow[0] + expected[1] * bow[1]  # the vehicle is nearly level
    assert error[0] == pytest.approx(forward, abs=0.01)
    assert np.linalg.norm(error) == pytest.approx(np.linalg.norm(expected), abs=1e-9)
    env.close()


def test_each_agent_has_its_own_reward_and_success(short_benchmark: str) -> None:
    env = make_parallel_env(
        short_benchmark,
        agents={
            "leader": {"reward": "-offset", "success": "offset < 100"},
            "follower": {"reward": "2*gap", "success": "gap > 100"},
        },
    )
    env.reset(seed=1)
    idle = {agent: np.zeros(4) for agent in env.possible_agents}
    rewards: dict[str, float] = {}
    infos: dict[str, dict[str, Any]] = {}
    while env.agents:
        _, rewards, _, _, infos = env.step(idle)
    env.close()
    assert rewards["leader"] < 0.0 < rewards["follower"]
    assert infos["leader"]["is_success"]
    assert not infos["follower"]["is_success"]


def test_one_vehicle_of_several_is_a_gymnasium_environment(short_benchmark: str) -> None:
    with pytest.raises(BadSetting, match=r"2 vehicles; expected vehicle='leader'"):
        make_env(short_benchmark)
    env = make_env(short_benchmark, vehicle="follower")
    observation, _ = env.reset(seed=1)
    both = make_parallel_env(short_benchmark)
    observations, _ = both.reset(seed=1)
    np.testing.assert_array_equal(observation, observations["follower"])
    env.close()
    both.close()


def test_invalid_agents_and_actions_are_errors(short_benchmark: str, tmp_path: Path) -> None:
    with pytest.raises(UnknownName, match="leader"):
        make_parallel_env(short_benchmark, agents={"leadr": {}})
    invalid_agents: Any
    for invalid_agents, message in (
        ({"leader": {"rewrd": "1"}}, "has no option 'rewrd'. Did you mean 'reward'"),
        ({"leader": 3}, r"agents\['leader'\] is 3; expected a dictionary"),
        (["leader"], "expected a dictionary with a vehicle"),
        ({}, "agents is {}; expected a dictionary with a vehicle"),
    ):
        with pytest.raises(BadSetting, match=message):
            make_parallel_env(short_benchmark, agents=invalid_agents)
    with pytest.raises(BadSetting, match=r"periods 0.05, 0.1 s"):
        make_parallel_env(short_benchmark, agents={"leader": {"period": 0.1}, "follower": {}})
    env = make_parallel_env(short_benchmark)
    with pytest.raises(BadSetting, match="call reset"):
        env.step({})
    with pytest.raises(BadSetting, match="Did you mean 'level'"):
        env.reset(options={"levels": {}})
    env.reset(seed=1)
    with pytest.raises(UnknownName, match="follower"):
        env.step({"leader": np.zeros(4)})
    env.close()
    text = Path(short_benchmark).read_text().replace("<vehicle>leader", "<vehicle>follower")
    path = tmp_path / "twice.xml"
    path.write_text(text)
    with pytest.raises(BenchmarkError, match=r"twice\.xml:\d+: the vehicle 'follower' has"):
        make_parallel_env(path)
