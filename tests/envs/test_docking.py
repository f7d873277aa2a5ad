"""The task of docking: its environment, and that the bundled guidance enters the dock."""

from __future__ import annotations

import gymnasium
import pytest

import uwsim
from tests.support.random_steps import check_without_warnings, take_random_steps
from uwsim.envs import BenchmarkEnv, make_env
from uwsim.errors import BadSetting


def rollout(env: BenchmarkEnv, n: int) -> bytes:
    return take_random_steps(env, n, options={"level": {"current": 0.1}}, next_reset={"seed": 3})


def test_gymnasium_finds_nothing_wrong_with_docking() -> None:
    env = make_env("docking")
    check_without_warnings(env)
    env.close()


def test_random_steps_give_the_same_finite_numbers_twice() -> None:
    env, twin = make_env("docking"), make_env("docking")
    assert rollout(env, 100) == rollout(twin, 100)
    env.close()
    twin.close()


@pytest.mark.slow
def test_two_thousand_random_steps_give_finite_numbers() -> None:
    env = make_env("docking")
    rollout(env, 2000)
    env.close()


def test_the_guidance_enters_the_dock_in_still_water_without_an_impact() -> None:
    result = uwsim.bench("docking", seeds=(1,), levels={"current": [0.0]})
    names = [column.name for column in result.columns]
    row = result.rows[0]
    assert result.values("status") == ("ok",)
    assert row[names.index("offset")] < 0.3
    assert row[names.index("impact")] > 0.9
    assert row[names.index("time")] < 30.0


def test_rows_refuse_a_scene_with_a_solid_dock() -> None:
    with pytest.raises(BadSetting, match=r"dock_floor.*its measure impact may end a level"):
        gymnasium.make_vec("uwsim/Docking-v0", num_envs=2, stepper="rows")
