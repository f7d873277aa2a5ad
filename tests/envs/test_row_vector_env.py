"""Compiled rows of an environment, held against the engine and against one another."""

from __future__ import annotations

import warnings
from importlib import resources
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.wrappers.vector import RecordEpisodeStatistics
from lxml import etree

from uwsim.assets.find import find
from uwsim.envs import RowVectorEnv, make_env
from uwsim.envs.steppers import StepperName
from uwsim.envs.vector_env import make_vector_env
from uwsim.errors import BadSetting, UnknownName


def make_rows(task: str, n: int, **options: Any) -> Any:
    return gymnasium.make_vec(task, num_envs=n, stepper="rows", **options)


CURRENTS = """<u:current>
      <u:gaussMarkov>
        <u:mean> <x>0.1</x> <y>0</y> <z>0</z> </u:mean>
        <u:deviation> <x>0.05</x> <y>0.05</y> <z>0</z> </u:deviation> <u:mu>0.1</u:mu>
      </u:gaussMarkov>
      <u:powerProfile>
        <u:velocity> <x>0.1</x> <y>0</y> <z>0</z> </u:velocity> <u:depth>4</u:depth>
      </u:powerProfile>
    </u:current>
    <u:waves>
      <u:regularWave> <u:height>0.3</u:height> <u:period>3</u:period> </u:regularWave>
    </u:waves>"""
VARIED_PATH = "oceanState.current.powerProfile.velocity.y"


def write_scene(folder: Path, *, currents: str = CURRENTS, path: str = VARIED_PATH) -> str:
    """Write the scene of the environments with currents and waves, and another variation."""
    text = find("open-water-scene.xml").read_text()
    text = text.replace("<u:water law", f"{currents}<u:water law")
    variation = f"<u:uniform><u:path>{path}</u:path><u:low>0.2</u:low><u:high>0.3</u:high>"
    text = text.replace("<u:vary>", f"<u:vary>{variation}</u:uniform>")
    file = folder / "scene.xml"
    file.write_text(text)
    return str(file)


def test_a_row_in_the_currents_and_waves_of_a_scene_is_that_of_the_engine(tmp_path: Path) -> None:
    scene = write_scene(tmp_path)
    rows = make_rows("uwsim/StationKeeping-v0", 2, scene=scene)
    env = make_env("station-keeping", scene=scene)
    options = {"level": {"current": 0.2}}
    observations, _ = rows.reset(seed=4, options=options)
    env.reset(seed=5, options=options)
    for _ in range(60):
        observations, *_ = rows.step(np.full((2, 8), 0.2, np.float32))
        observation, *_ = env.step(np.full(8, 0.2, np.float32))
    np.testing.assert_allclose(observations[1], observation, atol=1e-10)
    assert np.abs(observations[0] - observations[1]).max() > 1e-3
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
        assert (infos["final_info"]["measures"]["offset"] > 0.0).all()
    else:
        assert (infos["measures"]["offset"] > 0.0).all()
    if mode == "Disabled":
        rows.reset(options={"reset_mask": truncated})
    seeds = infos["seed"] if mode == "SameStep" else None
    _, rewards, _, truncated, infos = rows.step(actions)
    assert not truncated.any()
    assert (rewards == 0.0).all() == (mode == "NextStep")
    assert seeds is None or len(set(seeds.tolist())) == 3
    rows.close()


def test_other_libraries_share_the_memory_of_observations_that_no_step_changes() -> None:
    rows = make_rows("uwsim/StationKeeping-v0", 4)
    observations, _ = rows.reset(seed=1)
    view = np.from_dlpack(observations)  # as torch.from_dlpack and torch.from_numpy
    assert np.shares_memory(view, observations)
    first = view.copy()
    stepped, rewards, *_ = rows.step(np.full((4, 8), 0.5, np.float32))
    assert np.shares_memory(np.from_dlpack(rewards), rewards)
    assert not np.array_equal(stepped, first)
    np.testing.assert_array_equal(view, first)
    rows.close()


def test_rows_refuse_numbers_of_the_scene() -> None:
    rows = make_rows("uwsim/StationKeeping-v0", 1)
    with pytest.raises(BadSetting, match=r"which rows share; expected current, mass, .*or stepper"):
        rows.reset(seed=1, options={"level": {"vehicle[bluerov2].position.x": 0.1}})
    rows.close()


def test_a_range_of_currents_is_drawn_for_each_row() -> None:
    rows = make_rows("uwsim/Circle-v0", 8)
    _, infos = rows.reset(seed=1, options={"level": {"current": (0.1, 0.3)}})
    currents = infos["level"]["current"]
    assert len(set(currents.tolist())) == 8
    assert ((currents >= 0.1) & (currents <= 0.3)).all()
    rows.close()


def test_rows_that_cannot_step_an_environment_state_why() -> None:
    with pytest.raises(BadSetting, match="it observes topics"):
        make_rows("uwsim/Circle-v0", 1, observation=["/bluerov2/odom:pose.pose.position"])
    with pytest.raises(BadSetting, match="expected one of engine, rows, auto"):
        gymnasium.make_vec("uwsim/Circle-v0", stepper="row")


def test_rows_refuse_what_only_the_engine_computes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "row_eddy.py").write_text("def eddy(point, time, vehicle):\n    return 0, 0, 0\n")
    monkeypatch.syspath_prepend(tmp_path)
    function = "<u:pythonFunction><u:function>row_eddy:eddy</u:function></u:pythonFunction>"
    scene = write_scene(
        tmp_path, currents=f"<u:current>{function}</u:current>", path="oceanState.fog.density"
    )
    with pytest.raises(BadSetting, match="a current that Python computes"):
        make_rows("uwsim/Circle-v0", 1, scene=scene)
    path = "vehicle[bluerov2].hydrodynamics.body[base_link].volume"
    with pytest.raises(BadSetting, match="<u:vary> changes its vehicle"):
        make_rows("uwsim/Circle-v0", 1, scene=write_scene(tmp_path, path=path))


def test_rows_state_their_stepper() -> None:
    rows = make_rows("uwsim/Helix-v0", 1)
    assert isinstance(rows.unwrapped, RowVectorEnv)
    assert rows.unwrapped.stepper.startswith("rows")
    rows.close()


DATA = Path(str(resources.files("uwsim"))) / "data"
BODY = "vehicle[bluerov2].hydrodynamics.body[base_link]"
FACTORS = {"volume": 1.003, "addedMass": 1.3, "drag": 0.8, "timeConstant": 2.0}


def test_factors_of_rows_scale_the_numbers_of_the_engine() -> None:
    numbers = etree.parse(str(DATA / "vehicles" / "bluerov2_heavy.xml"))
    settings: dict[str, float | str] = {}
    for tag, name in (
        ("volume", "volume"),
        ("addedMass", "addedMass"),
        ("linearDamping", "drag"),
        ("quadraticDamping", "drag"),
    ):
        values = [float(text) for text in numbers.findtext(f".//{{*}}{tag}", "").split()]
        paths = [f"{BODY}.{tag}"] if tag == "volume" else [f"{BODY}.{tag}.{i}" for i in range(1, 7)]
        settings |= {p: FACTORS[name] * v for p, v in zip(paths, values, strict=True)}
    for thruster in numbers.findall(".//{*}thruster"):
        constant = float(thruster.findtext("{*}timeConstant", ""))
        path = f"vehicle[bluerov2].hydrodynamics.thruster[{thruster.get('name')}]"
        settings[f"{path}.timeConstant"] = FACTORS["timeConstant"] * constant
    twin = make_env("station-keeping", settings=settings)
    rows = make_env("station-keeping", stepper="rows")
    level = {"current": 0.2}
    twin.reset(seed=4, options={"level": level})
    _, info = rows.reset(seed=4, options={"level": {**level, **FACTORS}})
    assert info["level"] == {**level, **FACTORS}
    for action in np.random.default_rng(1).uniform(-1.0, 1.0, (60, 8)):
        expected_observation, expected_reward, *_ = twin.step(action)
        observation, reward, *_ = rows.step(action)
        np.testing.assert_allclose(observation, expected_observation, atol=1e-10)
        assert reward == pytest.approx(expected_reward, abs=1e-10)
    _, info = rows.reset(seed=4, options={"level": level})
    assert {info["level"][name] for name in FACTORS} == {1.0}
    twin.close()
    rows.close()


def test_factors_of_each_row_are_drawn_from_its_seed() -> None:
    ranges = {"mass": (0.9, 1.1), "thrust": (0.7, 1.0)}
    rows = make_rows("uwsim/StationKeeping-v0", 5)
    observations, infos = rows.reset(seed=7, options={"level": ranges})
    actions = np.full((5, 8), 0.6, np.float32)
    for _ in range(3):
        observations = rows.step(actions)[0]
    for name, (low, high) in ranges.items():
        values = infos["level"][name]
        assert len(set(values.tolist())) == 5
        assert ((low <= values) & (values <= high)).all()
    single = make_env("station-keeping", stepper="rows")
    _, info = single.reset(seed=9, options={"level": ranges})
    assert info["level"]["mass"] == infos["level"]["mass"][2]
    for _ in range(3):
        observation = single.step(actions[2])[0]
    np.testing.assert_array_equal(observation, observations[2])
    rows.close()
    single.close()


@pytest.mark.parametrize(
    ("level", "message"),
    [
        ({"mass": 0.0}, "expected a factor above 0, at most 100"),
        ({"drag": (0.5, 200)}, "expected a factor above 0, at most 100"),
        ({"dragg": 1.0}, "Did you mean 'drag'"),
    ],
)
def test_a_wrong_factor_is_refused(level: dict[str, Any], message: str) -> None:
    rows = make_env("station-keeping", stepper="rows")
    with pytest.raises(BadSetting, match=message):
        rows.reset(seed=1, options={"level": level})
    rows.close()


def test_the_engine_names_the_stepper_that_takes_factors() -> None:
    env = make_env("station-keeping")
    with pytest.raises(BadSetting, match="It is a factor of stepper='rows'"):
        env.reset(seed=1, options={"level": {"drag": 1.1}})
    env.close()


@pytest.mark.parametrize("mode", ["NextStep", "SameStep"])
@pytest.mark.parametrize("stepper", ["rows", "engine"])
def test_the_next_episodes_of_rows_keep_the_ranges_of_their_last_reset(
    tmp_path: Path, stepper: StepperName, mode: str
) -> None:
    benchmark = tmp_path / "short.xml"
    text = (DATA / "benchmarks" / "station-keeping.xml").read_text()
    benchmark.write_text(text.replace("<interval>30</interval>", "<interval>0.2</interval>"))
    rows = make_vector_env(benchmark, 3, stepper=stepper, autoreset_mode=mode)
    rows.reset(seed=1)
    ranges = {"level": {"current": (0.11, 0.12)}}
    rows.reset(seed=5, options={**ranges, "reset_mask": np.array([True, False, True])})
    levels: list[list[float]] = []
    for _ in range(18):
        infos = rows.step(np.zeros((3, 8), np.float32))[4]
        if "level" in infos:
            levels.append(infos["level"]["current"].tolist())
    assert len(levels) >= 3
    for first, second, third in levels:
        assert 0.11 <= first <= 0.12
        assert 0.11 <= third <= 0.12
        assert not 0.11 <= second <= 0.12
    rows.reset(seed=1)
    assert all(not 0.11 <= value <= 0.12 for value in rows.reset()[1]["level"]["current"])
    rows.close()


def test_the_attitude_at_the_start_is_that_of_the_engine(tmp_path: Path) -> None:
    scene = write_scene(tmp_path, currents="", path="vehicle[bluerov2].orientation.r")
    text = Path(scene).read_text()
    Path(scene).write_text(
        text.replace(
            "<u:vary>",
            "<u:vary><u:uniform><u:path>vehicle[bluerov2].orientation.p</u:path>"
            "<u:low>0.3</u:low><u:high>0.5</u:high></u:uniform>",
        )
    )
    rows, env = (
        make_rows("uwsim/StationKeeping-v0", 1, scene=scene),
        make_env("station-keeping", scene=scene),
    )
    observations, infos = rows.reset(seed=3)
    observation, _ = env.reset(seed=3)
    np.testing.assert_allclose(observations[0], observation, atol=1e-12)
    assert abs(infos["variations"]["vehicle[bluerov2].orientation.r"][0]) > 0.2
    env.close()
    rows.close()


def test_rows_refuse_a_varied_frame_of_the_scene(tmp_path: Path) -> None:
    scene = write_scene(tmp_path, currents="", path="simParams.offsetp.z")
    with pytest.raises(BadSetting, match="<u:vary> changes the frame of its scene"):
        make_rows("uwsim/Circle-v0", 1, scene=scene)


def test_a_refused_reset_changes_no_row() -> None:
    used, other = (make_rows("uwsim/StationKeeping-v0", 2, period=30.0) for _ in range(2))
    used.reset(seed=np.array([1, 2]))
    other.reset(seed=1)
    calls: list[tuple[dict[str, Any], str]] = [
        ({"seed": 2**63}, r"expected 0 to 2\^63 - 1"),
        ({"seed": [5, 2**64]}, r"expected 0 to 2\^63 - 1"),
        ({"seed": [1, 2, 3]}, "expected an integer or a list of 2"),
        ({"seed": [1, 2.5]}, r"seed has 2\.5; expected integers or None"),
        ({"options": {"reset_mask": [0, 1]}}, "expected an array of 2 booleans"),
        ({"options": {"reset_mask": np.zeros(2, np.bool_)}}, "with True for one row at least"),
        ({"options": ["level"]}, r"options is \['level'\]; expected a dictionary"),
    ]
    for call, message in calls:
        with pytest.raises(BadSetting, match=message):
            used.reset(**call)
    actions = np.zeros((2, 8), np.float32)
    for _ in range(3):  # an episode, and the next one with drawn seeds
        np.testing.assert_array_equal(used.step(actions)[0], other.step(actions)[0])
    used.close()
    other.close()


def test_rows_step_only_after_a_reset_and_name_wrong_options() -> None:
    rows = make_rows("uwsim/StationKeeping-v0", 2)
    with pytest.raises(gymnasium.error.ResetNeeded, match="No episode is running"):
        rows.step(np.zeros((2, 8)))
    rows.reset(seed=1)
    with pytest.raises(BadSetting, match=r"The array of actions has inf at \[1, 3\]"):
        rows.step(np.where(np.arange(16).reshape(2, 8) == 11, np.inf, 0.0))
    rows.close()
    with pytest.raises(UnknownName, match="No camera or view is called 'nope'"):
        make_rows("uwsim/Circle-v0", 1, camera="nope")


@pytest.mark.parametrize("stepper", ["engine", "rows"])
def test_a_vector_without_resets_names_its_mistakes(stepper: str) -> None:
    envs = gymnasium.make_vec(
        "uwsim/StationKeeping-v0",
        num_envs=2,
        stepper=stepper,
        period=30.0,
        autoreset_mode="Disabled",
    )
    envs.reset(seed=1)
    wrong_actions = np.zeros((2, 8))
    wrong_actions[1, 0] = np.nan
    with pytest.raises(BadSetting, match=r"The array of actions has nan at \[1, 0\]"):
        envs.step(wrong_actions)
    assert envs.step(np.zeros((2, 8)))[3].all()  # no row was stepped before
    with pytest.raises(BadSetting, match="An episode is over"):
        envs.step(np.zeros((2, 8)))
    envs.close()
