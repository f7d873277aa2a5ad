"""Compiled rows of an environment, held against the engine and against one another."""

from __future__ import annotations

import warnings
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.wrappers.vector import RecordEpisodeStatistics

from uwsim.base.expression import parse
from uwsim.benchmark.environment.array_expression import evaluate_rows
from uwsim.envs import TASKS, RowVectorEnv, make_env
from uwsim.errors import BadSetting


def make_rows(task: str, n: int, **options: Any) -> Any:
    return gymnasium.make_vec(task, num_envs=n, stepper="rows", **options)


@pytest.mark.parametrize("task", [task for task in TASKS if task != "uwsim/Docking-v0"])
def test_a_row_in_still_water_is_the_environment_of_the_engine(task: str) -> None:
    rows, env = make_rows(task, 2), make_env(TASKS[task])
    options = {"level": {"current": 0.0}}
    observations, _ = rows.reset(seed=4, options=options)
    observation, _ = env.reset(seed=5, options=options)
    np.testing.assert_allclose(observations[1], observation, atol=1e-12)
    rng = np.random.default_rng(0)
    for _ in range(40):
        actions = rng.uniform(-1.0, 1.0, (2, 8)).astype(np.float32)
        observations, rewards, *_ = rows.step(actions)
        observation, reward, *_ = env.step(actions[1])
        np.testing.assert_allclose(observations[1], observation, atol=1e-10)
        assert rewards[1] == pytest.approx(reward, abs=1e-10)
    env.close()
    rows.close()


def rollout(n: int, seed: int, row: int, threads: int = 1) -> bytes:
    rows = make_rows("uwsim/StationKeeping-v0", n, threads=threads)
    observations, _ = rows.reset(seed=seed)
    parts = [observations[row].tobytes()]
    for k in range(620):  # beyond the end of an episode
        actions = np.full((n, 8), 0.1 * np.sin(k), np.float32)
        observations, rewards, *_ = rows.step(actions)
        parts += [observations[row].tobytes(), rewards[row].tobytes()]
    rows.close()
    return b"".join(parts)


def test_the_bytes_of_a_row_depend_on_its_seed_alone() -> None:
    assert rollout(1, 9, 0) == rollout(5, 6, 3) == rollout(5, 6, 3, threads=2)


@pytest.mark.parametrize("mode", ["NextStep", "SameStep", "Disabled"])
def test_rows_are_reset_as_gymnasium_expects(mode: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        rows = RecordEpisodeStatistics(
            make_rows("uwsim/StationKeeping-v0", 3, period=5.0, autoreset_mode=mode)
        )
        rows.reset(seed=1)
        actions = np.zeros((3, 8), np.float32)
        for _ in range(6):
            observations, _, terminated, truncated, infos = rows.step(actions)
    assert truncated.all()
    assert not terminated.any()
    assert observations in rows.observation_space
    assert (infos["episode"]["l"] == 6).all()
    if mode == "SameStep":
        assert infos["_final_obs"].all()
        assert (infos["final_info"]["rms_error"] > 0.0).all()
    else:
        assert (infos["rms_error"] > 0.0).all()
    if mode == "Disabled":
        rows.reset(options={"reset_mask": truncated})
    seeds = infos["seed"] if mode == "SameStep" else None
    _, rewards, _, truncated, infos = rows.step(actions)
    assert not truncated.any()
    assert (rewards == 0.0).all() == (mode == "NextStep")
    assert seeds is None or len(set(seeds.tolist())) == 3
    rows.close()


def test_a_range_of_currents_is_drawn_for_each_row() -> None:
    rows = make_rows("uwsim/Circle-v0", 8)
    _, infos = rows.reset(seed=1, options={"level": {"current": (0.1, 0.3)}})
    currents = infos["level"]["current"]
    assert len(set(currents.tolist())) == 8
    assert ((currents >= 0.1) & (currents <= 0.3)).all()
    rows.close()


def test_rows_that_cannot_step_an_environment_state_why() -> None:
    with pytest.raises(BadSetting, match="its reward has the measure energy"):
        make_rows("uwsim/Circle-v0", 1, reward="-energy")
    with pytest.raises(BadSetting, match="it observes topics"):
        make_rows("uwsim/Circle-v0", 1, observation=["/bluerov2/odom:pose.pose.position"])
    with pytest.raises(BadSetting, match="expected one of engine, rows"):
        gymnasium.make_vec("uwsim/Circle-v0", stepper="row")


def test_rows_state_their_stepper() -> None:
    rows = make_rows("uwsim/Helix-v0", 1)
    assert isinstance(rows.unwrapped, RowVectorEnv)
    assert rows.unwrapped.stepper.startswith("rows")
    rows.close()


@pytest.mark.parametrize(
    "text",
    ["a + 2*b", "max(a, b, 1)", "a > b ? a : -b", "a && b", "a || b", "sqrt(a)", "rint(b)",
     "avg(a, b)", "min(a, b) - sum(a, b, a)", "if(a, 1/a, 0)", "exp(-a^2)", "ln(a)"],
)  # fmt: skip
def test_an_expression_of_rows_is_that_of_each_row(text: str) -> None:
    expression = parse(text, ["a", "b"])
    a, b = np.array([0.0, 1.5, -2.0, 3.25]), np.array([1.0, 0.0, 2.5, -0.75])
    values = [expression.evaluate({"a": x, "b": y}) for x, y in zip(a, b, strict=True)]
    expected = [0.0 if value is None else value for value in values]
    rows = evaluate_rows(expression, {"a": a, "b": b}, 4)
    np.testing.assert_array_equal(rows, expected)
