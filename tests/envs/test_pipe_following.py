"""The task of following a pipe: its environment, and the bundled algorithms on a short pipe."""

from __future__ import annotations

import gymnasium
import numpy as np
import pytest

import uwsim
from tests.support.random_steps import check_without_warnings, take_random_steps
from uwsim.envs import BenchmarkEnv, make_env
from uwsim.errors import BadSetting

LEVEL = {"current": 0.1, "beamAttenuation": 0.5}


def rollout(env: BenchmarkEnv, n: int) -> bytes:
    return take_random_steps(
        env, n, options={"level": LEVEL}, next_reset={"seed": 3, "options": {"level": LEVEL}}
    )


@pytest.mark.slow
def test_gymnasium_finds_nothing_wrong_with_the_pipe() -> None:
    env = make_env("pipe-following")
    check_without_warnings(env)
    env.close()


@pytest.mark.slow
def test_random_steps_give_the_same_finite_numbers_twice() -> None:
    env, twin = make_env("pipe-following"), make_env("pipe-following")
    assert rollout(env, 60) == rollout(twin, 60)
    env.close()
    twin.close()


@pytest.mark.slow
def test_the_observed_error_is_the_distance_that_the_measure_has() -> None:
    env = make_env("pipe-following", reward="offset")
    observation, _ = env.reset(seed=1, options={"level": LEVEL})
    for k in range(80):
        action = np.tanh(np.sin(k + np.arange(8.0))).astype(np.float32)
        observation, reward, *_ = env.step(action)
        error = observation[:3]
        assert reward == pytest.approx(float(np.sqrt(error @ error)), abs=1e-12)
        assert observation[3:6] @ observation[3:6] == pytest.approx(1.0)
    env.close()


@pytest.mark.slow
def test_the_speed_along_the_pipe_is_that_of_the_observed_velocity_and_direction() -> None:
    env = make_env(
        "pipe-following", reward="pathSpeed", observation=["pathDirection", "linearVelocity"]
    )
    env.reset(seed=2)
    for _ in range(40):
        observation, reward, *_ = env.step(np.full(env.action_space.shape, 0.5, np.float32))
    assert abs(reward) > 0.01
    assert reward == pytest.approx(float(observation[:3] @ observation[3:6]), abs=1e-12)
    env.close()


def test_the_course_differs_from_seed_to_seed_and_rows_are_refused() -> None:
    env = make_env("pipe-following")
    first, _ = env.reset(seed=1, options={"level": LEVEL})
    second, _ = env.reset(seed=2, options={"level": LEVEL})
    assert np.abs(first[6:15] - second[6:15]).max() > 0.01
    env.close()
    with pytest.raises(BadSetting, match="it observes pathError, pathDirection"):
        gymnasium.make_vec("uwsim.envs:uwsim/PipeFollowing-v0", num_envs=2, stepper="rows")


@pytest.mark.slow
@pytest.mark.parametrize("algorithm", ["pipe-following", "pipe-camera"])
def test_the_bundled_algorithms_on_a_pipe_of_a_few_metres(algorithm: str) -> None:
    result = uwsim.bench(
        "pipe-following",
        algorithm=algorithm,
        seeds=(4,),
        levels={"current": [0.1], "beamAttenuation": [0.5]},
        settings={"object[pipe].course.points": "-10 0 7 -8 0.4 7 -6 0.4 7"},
    )
    statuses, shares = result.values("status"), result.values("offset.share")
    assert (statuses, shares[0]) == (("ok",), pytest.approx(0.98, abs=0.01))
    assert result.values("offset")[0] < 0.4
