"""Environments of benchmark files, held against Gymnasium's checks and against uwsim bench."""

from __future__ import annotations

import copy
import json
import re
import warnings
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.envs.registration import EnvSpec
from gymnasium.utils.env_checker import check_env

import uwsim
from uwsim.benchmark.updater_settings import locate_in_benchmark
from uwsim.envs import TASKS, BenchmarkEnv, make_env
from uwsim.errors import BadSetting, BenchmarkError, UnknownName, UwsimError
from uwsim.scene.settings import locate

PAGE = (Path(__file__).parents[2] / "docs/environments.md").read_text()
STATION = "uwsim.envs:uwsim/StationKeeping-v0"
POLICY = '''
import numpy as np


class Policy:
    """Pushes along the position error."""

    def __init__(self):
        self.layout = {}

    def __call__(self, observation):
        error = observation[self.layout["positionError"]] if self.layout else observation[:3]
        return np.tanh(np.tile(error, 3)[:8])
'''


def actions_of(observation: np.ndarray) -> np.ndarray:
    return np.tanh(np.tile(observation[:3], 3)[:8])


def shorten(folder: Path, benchmark: str, interval: float = 0.5) -> str:
    """Write a bundled benchmark with a shorter level; return its path."""
    text = (Path(uwsim.__file__).parent / f"data/benchmarks/{benchmark}.xml").read_text()
    path = folder / f"{benchmark}.xml"
    pattern = "<interval>[0-9]+</interval>"
    path.write_text(re.sub(pattern, f"<interval>{interval}</interval>", text))
    return str(path)


def rollout(env: BenchmarkEnv, seed: int, n: int) -> bytes:
    observation, _ = env.reset(seed=seed)
    parts = [observation.tobytes()]
    env.action_space.seed(seed)
    for _ in range(n):
        observation, reward, *_ = env.step(env.action_space.sample())
        parts += [observation.tobytes(), np.float64(reward).tobytes()]
    return b"".join(parts)


def test_gymnasium_finds_nothing_wrong_with_a_task(tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        env = gymnasium.make(STATION, benchmark=shorten(tmp_path, "station-keeping"))
        check_env(env.unwrapped, skip_render_check=True)
        env.close()


@pytest.mark.parametrize("task", TASKS)
def test_a_task_gives_finite_numbers(task: str, tmp_path: Path) -> None:
    env = gymnasium.make(task, benchmark=shorten(tmp_path, TASKS[task]))
    observation, _ = env.reset(seed=1)
    terminated = truncated = False
    while not (terminated or truncated):
        assert np.isfinite(observation).all()
        observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
        assert np.isfinite(reward)
    assert (terminated, truncated) == (False, True)
    assert "energy" in info["measures"]
    env.close()


def test_a_spec_rebuilds_its_environment_from_json() -> None:
    env = gymnasium.make(STATION, period=0.1)
    assert env.spec is not None
    spec = EnvSpec.from_json(env.spec.to_json())
    twin = gymnasium.make(spec)
    assert twin.spec is not None
    assert json.loads(twin.spec.to_json()) == json.loads(env.spec.to_json())
    assert twin.unwrapped.metadata["render_fps"] == 10
    env.close()
    twin.close()


def test_a_seed_repeats_an_episode_to_the_bit() -> None:
    env, twin = make_env("station-keeping"), make_env("station-keeping")
    first = rollout(env, 3, 20)
    rollout(env, 4, 5)
    assert rollout(env, 3, 20) == first == rollout(twin, 3, 20)
    env.close()
    twin.close()


def test_the_measures_of_an_episode_are_those_of_the_benchmark(tmp_path: Path) -> None:
    (tmp_path / "policy.py").write_text(POLICY)
    benchmark = shorten(tmp_path, "station-keeping", 3.0)
    result = uwsim.bench(
        benchmark,
        algorithm=f"{tmp_path / 'policy.py'}:Policy",
        seeds=(5,),
        levels={"current": [0.2]},
    )
    env = make_env(benchmark)
    observation, info = env.reset(seed=5, options={"level": {"current": 0.2}})
    is_over = False
    while not is_over:
        observation, _, terminated, truncated, info = env.step(actions_of(observation))
        is_over = terminated or truncated
    env.close()
    names = [column.name for column in result.columns]
    offset = result.rows[0][names.index("offset")]
    assert info["measures"]["offset"] == pytest.approx(offset, rel=1e-12)
    assert info["status"] == result.rows[0][names.index("status")]


BODY = "vehicle[bluerov2].hydrodynamics.body[base_link]"
THRUSTER = "vehicle[bluerov2].hydrodynamics.thruster[bow_port]"
RANGES = {
    f"{BODY}.mass": (12.5, 14.5),
    f"{BODY}.volume": (0.0132, 0.0136),
    f"{BODY}.addedMass.1": (5.0, 8.0),
    f"{BODY}.quadraticDamping.2": (150.0, 250.0),
    f"{THRUSTER}.forward.1": (8.0, 10.0),
    f"{THRUSTER}.timeConstant": (0.02, 0.2),
    "vehicle[bluerov2].virtualCamera[camera].std": (0.0, 0.05),
    "oceanState.water.exposure": (1.0, 2.0),
    "currentForceUpdater.timeOffset": (10.0, 20.0),
    "current": (0.1, 0.3),
}
"""A range for each kind of parameter of an episode."""


def test_numbers_of_the_scene_are_drawn_from_the_ranges_of_a_reset() -> None:
    env = make_env("station-keeping")
    actions = np.tile(np.linspace(-0.8, 0.8, 8), (3, 1)).astype(np.float32)
    _, info = env.reset(seed=3, options={"level": RANGES})
    steps = [env.step(action)[0] for action in actions]
    env.reset(seed=3)  # the next episode has the numbers of the file
    assert not np.allclose(env.step(actions[0])[0], steps[0])
    _, other_info = env.reset(seed=4, options={"level": RANGES})
    env.close()
    values = info["variations"] | info["level"]
    for path, (low, high) in RANGES.items():
        assert low <= values[path] <= high
        assert values[path] != (other_info["variations"] | other_info["level"])[path]
    settings = {path: float(values[path]) for path in RANGES if "." in path}
    twin = make_env("station-keeping", settings=settings)  # as with --set
    twin.reset(seed=3, options={"level": info["level"]})
    for action, observation in zip(actions, steps, strict=True):
        np.testing.assert_array_equal(twin.step(action)[0], observation)
    twin.close()


def test_a_number_of_the_scene_has_the_value_of_a_reset() -> None:
    path = f"{BODY}.mass"
    env, twin = make_env("station-keeping"), make_env("station-keeping", settings={path: 15.0})
    _, info = env.reset(seed=3, options={"level": {"current": 0.1, path: 15}})
    twin.reset(seed=3, options={"level": {"current": 0.1}})
    assert info["variations"][path] == 15.0
    action = np.zeros(8, np.float32)
    np.testing.assert_array_equal(env.step(action)[0], twin.step(action)[0])
    for level, message in (
        ({"vehicle[bluerov2].positon.x": 1.0}, "position"),
        ({"vehicle[bluerov2].position": 1.0}, "three numbers"),
        ({"oceanState.water.exposure": (-1.0, 1.0)}, "exposure"),
        ({"currentForceUpdater.step": (0.1, 0.2)}, "determines the levels"),
    ):
        with pytest.raises(BadSetting, match=message):
            env.reset(options={"level": level})
    env.close()
    twin.close()


def test_rows_of_a_vector_are_single_environments() -> None:
    envs = gymnasium.make_vec("uwsim/StationKeeping-v0", num_envs=2)
    env = make_env("station-keeping")
    observations, infos = envs.reset(seed=7)
    actions = np.full((2, 8), 0.3, np.float32)
    stepped, *_ = envs.step(actions)
    for row in range(2):
        observation, info = env.reset(seed=7 + row)
        assert observation.tobytes() == observations[row].tobytes()
        assert info["level"]["current"] == infos["level"]["current"][row]
        assert env.step(actions[row])[0].tobytes() == stepped[row].tobytes()
    env.close()
    envs.close()


@pytest.mark.parametrize("mode", ["NextStep", "SameStep"])
def test_a_row_is_reset_at_its_end(mode: str, tmp_path: Path) -> None:
    envs = gymnasium.make_vec(
        "uwsim/StationKeeping-v0",
        num_envs=2,
        benchmark=shorten(tmp_path, "station-keeping"),
        autoreset_mode=mode,
    )
    envs.reset(seed=1)
    actions = np.zeros((2, 8), np.float32)
    for _ in range(10):
        _, _, _, truncated, infos = envs.step(actions)
    assert truncated.all()
    assert ("final_info" in infos) == (mode == "SameStep")
    final = infos["final_info"] if mode == "SameStep" else infos
    assert final["_is_success"].all()
    _, rewards, _, truncated, _ = envs.step(actions)
    assert not truncated.any()
    assert (rewards == 0.0).all() == (mode == "NextStep")
    envs.close()


def test_a_range_of_a_level_is_drawn_by_the_seed() -> None:
    env = make_env("station-keeping")
    options = {"level": {"current": (0.1, 0.2)}}
    values = [env.reset(seed=s, options=options)[1]["level"]["current"] for s in (1, 2, 1)]
    assert values[0] == values[2] != values[1]
    assert all(0.1 <= value <= 0.2 for value in values)
    env.close()


def test_topics_are_observed_and_commanded() -> None:
    env = make_env(
        "station-keeping",
        observation=["positionError", "/bluerov2/odom:pose.pose.position"],
        action=["/bluerov2/twist:vx=0.5,vy=0.5"],
        reward="-offset",
    )
    observation, _ = env.reset(seed=1)
    assert env.layout == (("positionError", 3), ("/bluerov2/odom:pose.pose.position", 3))
    assert env.action_space.shape == (2,)
    observation, reward, *_ = env.step(np.ones(2, np.float32))
    assert reward == pytest.approx(-float(np.linalg.norm(observation[:3])), abs=1e-9)
    env.close()


def test_mistakes_name_the_nearest_valid_name() -> None:
    with pytest.raises(BadSetting, match="positionError"):
        make_env("station-keeping", observation=["positionErrors"])
    with pytest.raises(UnknownName, match="/bluerov2/thrusters"):
        make_env("station-keeping", action=["/bluerov2/thruster"])
    with pytest.raises(BadSetting, match="offset"):
        make_env("station-keeping", reward="-ofset")
    env = make_env("station-keeping")
    with pytest.raises(BadSetting, match="current"):
        env.reset(options={"level": {"curent": 0.1}})
    env.close()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"action": ["/bluerov2/twist:vx,vx"]}, "names 'vx' twice"),
        ({"action": "/bluerov2/thrusters"}, "expected a list of texts, as"),
        ({"observation": "heading"}, r"'heading'; expected a list of texts, as \['positionError'"),
        ({"observation": [1]}, "expected a list of texts"),
        ({"observation": ["camera:img=64x64"]}, "'img' is no content .* Did you mean 'image'"),
        ({"observation": ["camera:image=20000x20000"]}, "each 1 to 4096 px"),
        ({"observation": ["camera:image=9000x9000"]}, "expected 4096 px at most"),
        ({"reward": len}, "expected a text, as 'exp"),
        ({"frame_size": 5}, "frame_size is 5; expected width and height"),
        ({"frame_size": (5, 6, 7)}, "frame_size"),
        ({"real_time_factor": "x"}, "real_time_factor is 'x'; expected a number"),
    ],
)
def test_an_invalid_option_is_one_line_with_the_expectation(options: Any, message: str) -> None:
    with pytest.raises(BadSetting, match=message) as caught:
        make_env("station-keeping", **options)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("stepper", ["engine", "rows"])
def test_invalid_options_of_a_vector_are_one_line(stepper: str) -> None:
    for options, message in (
        ({"autoreset_mode": "nextstep"}, "Did you mean 'NextStep'"),
        ({"num_envs": 0}, "num_envs is 0; expected a whole number from 1 on"),
        ({"num_envs": "2"}, "num_envs is '2'"),
    ):
        with pytest.raises(BadSetting, match=message):
            gymnasium.make_vec(STATION, stepper=stepper, **{"num_envs": 2, **options})


def test_an_environment_without_an_episode_says_so_and_is_not_copied() -> None:
    env = make_env("station-keeping")
    with pytest.raises(gymnasium.error.ResetNeeded, match="call reset"):
        env.step(np.zeros(8, np.float32))
    with pytest.raises(TypeError, match="make another one with the same arguments"):
        copy.deepcopy(env)
    env.close()


def test_the_benchmark_of_the_page_is_the_environment_of_any_task(tmp_path: Path) -> None:
    path = tmp_path / "depth.xml"
    path.write_text(PAGE.partition("```xml\n")[2].partition("```")[0])
    envs = gymnasium.make_vec(STATION, num_envs=1, benchmark=str(path))
    observations, _ = envs.reset(seed=1)
    assert observations.shape == (1, 3 + 2 + 6)
    assert envs.single_action_space.shape == (4,)
    assert 0.7 < observations[0, 2] < 1.3  # from 1.2 to 1.8 m down to 2.5 m
    envs.close()


def test_the_paths_of_the_page_lead_to_numbers() -> None:
    table = PAGE.partition("### Numbers of the scene")[2].partition("A component")[0]
    paths = re.findall(r"`([^`]*[.\]][A-Za-z0-9]+)`", table.partition("|---|")[2])
    scene = uwsim.read_scene("open-water-scene").spec
    benchmark = uwsim.read_benchmark("station-keeping").spec
    assert len(paths) >= 13
    for path in paths:
        full_path = f"vehicle[bluerov2]{path}" if path.startswith(".") else path
        is_updater = full_path.startswith("currentForceUpdater")
        find = locate_in_benchmark if is_updater else locate
        assert find(benchmark if is_updater else scene, full_path).is_number, path  # type: ignore[arg-type]


def test_a_file_with_a_wrong_environment_has_the_line_of_its_error(tmp_path: Path) -> None:
    text = (Path(uwsim.__file__).parent / "data/benchmarks/station-keeping.xml").read_text()
    path = tmp_path / "wrong.xml"
    path.write_text(text.replace("<reference>offset", "<reference>ofset"))
    with pytest.raises(BenchmarkError, match=r"wrong\.xml:.*offset"):
        make_env(path)


def test_a_benchmark_and_a_scene_from_python_are_an_environment() -> None:
    benchmark, scene = uwsim.read_benchmark("station-keeping"), uwsim.read_scene("open-water-scene")
    benchmark.environment.period = 0.1
    scene.vehicles[0].position = (0.5, 0, -5)
    env = make_env(benchmark, scene=scene)
    env.reset(seed=1)
    env.step(env.action_space.sample())
    assert env.metadata["render_fps"] == 10
    env.close()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"period": -1}, "period is -1; expected a number above 0, at most 60 s"),
        ({"period": 0.0}, "period is 0.0; expected a number above 0"),
        ({"period": float("nan")}, "period is nan; expected"),
        ({"period": float("inf")}, "period is inf; expected"),
        ({"period": "x"}, "period is 'x'; expected"),
        ({"action": ["/bluerov2/twist:vx=nan"]}, r"is \[nan\]; expected numbers above 0"),
        ({"action": ["/bluerov2/twist:vx=inf"]}, r"is \[inf\]; expected numbers above 0"),
        ({"action": ["/bluerov2/twist:vx=0"]}, r"is \[0.0\]; expected numbers above 0"),
        ({"action": ["/bluerov2/twist:vx=-0.5"]}, r"is \[-0.5\]; expected numbers above 0"),
        ({"action": ["/bluerov2/twist:vx=1e9"]}, "at most 1e.06"),
        ({"action": ["/bluerov2/twist:vx", "/bluerov2/twist:vy"]}, "expected one with all axes"),
    ],
)
def test_a_wrong_period_or_limit_is_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(BadSetting, match=message):
        make_env("station-keeping", **options)


def test_a_wrong_action_is_named_and_changes_nothing() -> None:
    env, twin = make_env("station-keeping"), make_env("station-keeping")
    env.reset(seed=1)
    twin.reset(seed=1)
    for action, message in (
        ([0.0, float("nan"), *[0.0] * 6], r"The action has nan at \[1\]"),
        ("abc", "The action is 'abc'; expected"),
        (["0"] * 8, "The action is .*; expected"),
        (np.zeros(8, np.complex128), "The action is array.*; expected"),
        ([[1.0] * 8, [1.0]], "The action is .*; expected"),
        ([10**400] * 8, "The action is .*; expected"),
        (np.zeros(7), r"has the shape \(7,\); expected \(8,\)"),
    ):
        with pytest.raises(BadSetting, match=message):
            env.step(action)
    with pytest.raises(BadSetting, match=r"options is .'level'.; expected a dictionary"):
        env.reset(options=["level"])
    np.testing.assert_array_equal(env.step(np.ones(8))[0], twin.step(np.ones(8))[0])
    env.close()
    twin.close()


def test_no_episode_runs_after_a_reset_that_failed() -> None:
    env = make_env("station-keeping")
    with pytest.raises(gymnasium.error.ResetNeeded, match="No episode is running"):
        env.step(np.zeros(8))
    env.reset(seed=2)
    mass = "vehicle[bluerov2].hydrodynamics.body[base_link].mass"
    with pytest.raises(UwsimError, match="expected a number > 0"):
        env.reset(seed=3, options={"level": {mass: -1.0}})
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step(np.zeros(8))
    _, info = env.reset(seed=2)
    env.step(np.zeros(8))
    assert info["seed"] == 2
    env.close()


@pytest.mark.slow
def test_a_benchmark_names_the_wrong_number_of_a_policy(tmp_path: Path) -> None:
    class Policy:
        def __call__(self, observation: np.ndarray) -> np.ndarray:
            return np.array([0.5, np.inf, *[0.0] * 6])

    text = (Path(uwsim.__file__).parent / "data/benchmarks/station-keeping.xml").read_text()
    file = tmp_path / "short.xml"
    file.write_text(re.sub("<interval>[0-9]+</interval>", "<interval>0.1</interval>", text))
    with pytest.raises(UwsimError, match="has inf; expected 8 finite numbers from -1 to 1"):
        uwsim.bench(file, algorithm=Policy, out=tmp_path / "out")
