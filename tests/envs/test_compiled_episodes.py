"""Episodes over compiled rows, held against the engine, numpy's streams, and one another."""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.utils.env_match import check_environments_match
from gymnasium.wrappers.vector import NormalizeObservation, NormalizeReward, RecordEpisodeStatistics

import uwsim
from uwsim.envs import TASKS, make_env
from uwsim.envs.compiled.draws import EpisodeDraws
from uwsim.envs.compiled.episodes import Episodes
from uwsim.envs.levels import draw_level
from uwsim.envs.task import EnvironmentOptions, make_task
from uwsim.errors import BadSetting
from uwsim.runs.planning.plan import Plan

FREE_TASKS = [task for task in TASKS if task.split("/")[1].split("-")[0] in
              ("StationKeeping", "Circle", "Helix", "Lemniscate")]  # fmt: skip
STATION = "uwsim/StationKeeping-v0"


def shorten(folder: Path, benchmark: str, interval: float, changes: dict[str, str]) -> str:
    """Write a bundled benchmark with a shorter level and other changes; return its path."""
    text = (Path(uwsim.__file__).parent / f"data/benchmarks/{benchmark}.xml").read_text()
    text = re.sub("<interval>[0-9]+</interval>", f"<interval>{interval}</interval>", text)
    for old, new in changes.items():
        assert old in text
        text = text.replace(old, new)
    path = folder / f"{benchmark}.xml"
    path.write_text(text)
    return str(path)


@pytest.fixture(scope="module")
def plan() -> Plan:
    return make_task("station-keeping", EnvironmentOptions(), settings={}, data_path=())


def play(env: Any, seed: int, policy: Callable[[int], np.ndarray]) -> tuple[Any, ...]:
    """Play an episode; return observations, rewards, flags and the last info."""
    observation, info = env.reset(seed=seed, options={"level": {"current": (0.1, 0.3)}})
    observations, rewards, flags = [observation], [], (False, False)
    while not any(flags):
        observation, reward, *flags, info = env.step(policy(len(rewards)))
        observations.append(observation)
        rewards.append(reward)
    env.close()
    return np.array(observations), np.array(rewards), flags, info


@pytest.mark.parametrize("task", FREE_TASKS)
def test_an_episode_of_rows_is_a_trial_of_the_engine(task: str, tmp_path: Path) -> None:
    # the current begins after 2 s, and the last period of the level is incomplete
    benchmark = shorten(tmp_path, TASKS[task], 2.82, {})
    actions = np.random.default_rng(0).uniform(-1.2, 1.2, (57, 8)).astype(np.float32)
    engine = play(make_env(benchmark), 5, lambda k: actions[k])
    rows = play(make_env(benchmark, stepper="rows"), 5, lambda k: actions[k])
    assert len(rows[1]) == len(engine[1]) == 57
    np.testing.assert_allclose(rows[0], engine[0], atol=1e-10)
    np.testing.assert_allclose(rows[1], engine[1], atol=1e-10)
    assert rows[2] == engine[2] == [False, True]
    assert rows[3].keys() == engine[3].keys()
    for key in ("seed", "level", "variations", "status", "is_success", "success"):
        assert rows[3][key] == engine[3][key]
    assert rows[3]["measures"] == pytest.approx(engine[3]["measures"], rel=1e-10)
    assert rows[3]["score"] == pytest.approx(engine[3]["score"], rel=1e-10)


@pytest.mark.parametrize("statistic", ["last", "mean", "max"])
def test_other_quantities_and_statistics_are_those_of_the_engine(
    statistic: str, tmp_path: Path
) -> None:
    changes = {
        '<positionError u:value="rms">': f'<positionError u:value="{statistic}">',
        "<target>bluerov2</target> </u:energy>": "<target>bluerov2</target> "
        "<hotelLoad>20</hotelLoad> </u:energy>",
    }
    benchmark = shorten(tmp_path, "station-keeping", 0.5, changes)
    options: dict[str, Any] = {
        "observation": ["position", "lastAction", "gravity", "referenceVelocity"],
        "reward": "energy/100 + speed - change*tilt + time + effort + (offset > 1 ? 1 : turnRate)",
        "success": "offset < 0.9 && energy > 1",
    }
    actions = np.random.default_rng(1).uniform(-1.0, 1.0, (10, 8)).astype(np.float32)
    for seed in (1, 2):
        engine = play(make_env(benchmark, **options), seed, lambda k: actions[k])
        rows = play(make_env(benchmark, stepper="rows", **options), seed, lambda k: actions[k])
        np.testing.assert_allclose(rows[0], engine[0], atol=1e-12)
        np.testing.assert_allclose(rows[1], engine[1], atol=1e-10)
        assert rows[3]["measures"] == pytest.approx(engine[3]["measures"], rel=1e-12)
        assert rows[3]["success"] == engine[3]["success"]


SUCCESS = "<success>offset &lt; 0.3</success>"
FAILURE = "<status>left</status> <condition>offset_max &gt; 2</condition> </failure>"
OTHER_FAILURES = """<status>far</status> <condition>offset_max &gt; {}</condition> </failure>
<failure> <status>off</status> <condition>offset_mean &gt; {}</condition> </failure>"""


def test_the_outcome_of_rows_is_that_of_the_engine(tmp_path: Path) -> None:
    actions = np.random.default_rng(1).uniform(-1.0, 1.0, (10, 8)).astype(np.float32)
    for limit, limits, status in ((9, (9, 9), "ok"), (0, (9, 9), "missed"), (9, (0, 0), "far")):
        changes = {
            SUCCESS: f"<success>offset_rms &lt; {limit} &amp;&amp; energy &gt; 1</success>",
            FAILURE: OTHER_FAILURES.format(*limits),
        }
        benchmark = shorten(tmp_path, "station-keeping", 0.5, changes)
        engine = play(make_env(benchmark), 1, lambda k: actions[k])[3]
        rows = play(make_env(benchmark, stepper="rows"), 1, lambda k: actions[k])[3]
        assert rows["status"] == engine["status"] == status
        assert rows["is_success"] == engine["is_success"] == (status == "ok")
        assert rows["measures"] == pytest.approx(engine["measures"], rel=1e-10)
        assert rows["score"] == pytest.approx(engine["score"], rel=1e-10)


def test_rows_refuse_an_outcome_that_may_end_a_level_or_has_other_details(tmp_path: Path) -> None:
    changes = {SUCCESS: f"{SUCCESS} <ends>true</ends>", "offset_max": "offset_x_max"}
    benchmark = shorten(tmp_path, "station-keeping", 0.5, changes)
    with pytest.raises(BadSetting, match=r"outcome may end a level.*'offset_x_max'"):
        make_env(benchmark, stepper="rows")


def test_the_environment_of_rows_is_the_only_row_of_a_vector_to_the_bit(tmp_path: Path) -> None:
    benchmark = shorten(tmp_path, "station-keeping", 2.2, {})
    env = make_env(benchmark, stepper="rows")
    rows = gymnasium.make_vec(STATION, num_envs=3, stepper="rows", benchmark=benchmark)
    all_observations, _ = rows.reset(seed=3)
    observation, _ = env.reset(seed=5)
    actions = np.random.default_rng(0).uniform(-1.0, 1.0, (140, 8)).astype(np.float32)
    is_over = False
    for action in actions:  # three episodes, the later ones with drawn seeds
        all_observations, rewards, _, _, infos = rows.step(np.tile(action, (3, 1)))
        if is_over:
            (observation, info), reward, is_over = env.reset(), 0.0, False
            assert info["seed"] == infos["seed"][2]
        else:
            observation, reward, _, is_over, info = env.step(action)
        assert observation.tobytes() == all_observations[2].tobytes()
        assert reward == rewards[2]
        if is_over:
            assert info["measures"]["offset"] == infos["measures"]["offset"][2]
            assert info["success"] == infos["success"][2]
    env.close()
    rows.close()


def test_the_draws_of_rows_are_those_of_the_engine(plan: Plan) -> None:
    seeds = [0, 1, 7, 2**31 - 2]
    for choices in ({}, {"current": (0.1, 0.3)}, {"current": 0.25}):
        draws = EpisodeDraws(plan, 0).draw(seeds, choices)
        for i, seed in enumerate(seeds):
            assert draws.level(i) == draw_level(plan.benchmark, seed, choices)
            variations = {path: values[i] for path, values in draws.variations.items()}
            assert variations == {draw.path: draw.value for draw in plan.draws(seed)}


def test_a_current_with_other_numbers_is_a_new_current_to_the_bit(plan: Plan) -> None:
    used, new = Episodes(plan, 1), Episodes(plan, 1)
    mask, actions = np.ones(1, np.bool_), np.zeros((1, 8))
    for level in (0.3, 0.0):
        used.begin(mask, [1], {"current": level})
        for _ in range(45):
            used.step(actions, mask)
    for episodes in (used, new):
        episodes.begin(mask, [2], {"current": 0.2})
        for _ in range(60):
            episodes.step(actions, mask)
    assert used.arrays.observations.tobytes() == new.arrays.observations.tobytes()
    assert np.abs(new.arrays.observations[0, 8:]).max() > 0.01  # the current has moved it


def test_a_simulation_that_fails_ends_the_episode(plan: Plan) -> None:
    episodes, mask = Episodes(plan, 2), np.ones(2, np.bool_)
    episodes.begin(mask, [1, 2], {})
    episodes._rows.states[1, 7] = 1e9
    episodes.step(np.zeros((2, 8)), mask)
    assert episodes.arrays.terminated.tolist() == [False, True]
    assert np.isfinite(episodes.arrays.observations).all()
    results = episodes.results(np.array([1]))
    assert results["status"].tolist() == ["simulation error"]
    assert not results["success"].any()
    assert np.isnan(results["measures"]["offset"]).all()


def test_an_environment_states_its_stepper() -> None:
    statements = {
        name: make_env(benchmark, stepper=name).stepper.partition(":")[0]
        for benchmark, name in (("station-keeping", "engine"), ("circle", "rows"))
    }
    assert statements == {"engine": "engine", "rows": "rows"}
    assert make_env("station-keeping", stepper="auto").stepper.startswith("rows")
    assert "solid objects (dock" in make_env("docking", stepper="auto").stepper
    assert make_env("circle", stepper="auto", render_mode="rgb_array").stepper.startswith("engine")
    with pytest.raises(BadSetting, match="Rows render no images"):
        make_env("circle", stepper="rows", render_mode="rgb_array")


def test_rows_refuse_what_they_cannot_compute(tmp_path: Path) -> None:
    with pytest.raises(BadSetting, match=r"its period of 0\.025 s is no multiple of the step"):
        make_env("station-keeping", period=0.025, stepper="rows")
    stopping = shorten(
        tmp_path,
        "circle",
        1.0,
        {"<type>never</type>": "<type>onNoMove</type> <target>bluerov2</target>"},
    )
    with pytest.raises(BadSetting, match="a trigger ends its levels"):
        make_env(stopping, stepper="rows")
    way = "<distance> <name>way</name> <target>bluerov2</target> </distance>"
    benchmark = shorten(tmp_path, "helix", 0.1, {"<u:energy>": f"{way} <u:energy>"})
    with pytest.raises(BadSetting, match="its reward has the measure way"):
        make_env(benchmark, reward="-way", stepper="rows")
    *_, info = play(make_env(benchmark, stepper="rows"), 1, lambda _: np.zeros(8, np.float32))
    assert info["measures"].keys() == {"offset", "energy", "outcome"}
    assert info["score"] == info["measures"]["offset"]


def test_gymnasium_finds_nothing_wrong_with_rows(tmp_path: Path) -> None:
    benchmark = shorten(tmp_path, "station-keeping", 0.5, {})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        env = gymnasium.make(STATION, benchmark=benchmark, stepper="rows")
        check_env(env.unwrapped, skip_render_check=True)
        env.reset(seed=1)
        for _ in range(10):
            *_, truncated, _ = env.step(env.action_space.sample())
        assert truncated
        spec = gymnasium.envs.registration.EnvSpec.from_json(env.spec.to_json())
        twin = gymnasium.make(spec)
        assert twin.unwrapped.stepper.startswith("rows")
        check_environments_match(env.unwrapped, twin.unwrapped, 25, seed=1)
        env.close()


@pytest.mark.parametrize("mode", ["NextStep", "SameStep", "Disabled"])
def test_a_seed_repeats_1000_steps_and_20_resets_in_gymnasiums_wrappers(mode: str) -> None:
    outputs = []
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for _ in range(2):
            envs = gymnasium.make_vec(
                STATION,
                num_envs=2,
                stepper="rows",
                period=0.6,
                autoreset_mode=mode,
            )
            spec_text = envs.unwrapped.spec.to_json()
            wrapped = RecordEpisodeStatistics(envs)
            if mode == "NextStep":  # the only mode that these wrappers accept
                wrapped = NormalizeReward(NormalizeObservation(wrapped))
            observations, _ = wrapped.reset(seed=1)
            parts, n_resets = [observations.tobytes()], 0
            actions = np.random.default_rng(3).uniform(-1.0, 1.0, (1060, 2, 8)).astype(np.float32)
            for action in actions:
                observations, rewards, terminated, truncated, _ = wrapped.step(action)
                ended = terminated | truncated
                n_resets += int(ended[0])
                if mode == "Disabled" and ended.any():
                    observations, _ = wrapped.reset(options={"reset_mask": ended})
                parts += [observations.tobytes(), rewards.tobytes(), truncated.tobytes()]
            assert n_resets >= 20
            wrapped.close()
            outputs.append(b"".join(parts))
            twin = gymnasium.make_vec(
                gymnasium.envs.registration.EnvSpec.from_json(spec_text), num_envs=2
            )
            assert twin.unwrapped.stepper.startswith("rows")
    assert outputs[0] == outputs[1]
