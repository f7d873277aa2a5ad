"""Compiled rows of an environment, held against the engine and against one another."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.wrappers.vector import RecordEpisodeStatistics

from uwsim.assets.find import find
from uwsim.envs import RowVectorEnv, make_env
from uwsim.errors import BadSetting


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
    with pytest.raises(BadSetting, match=r"which rows share; expected current, or stepper"):
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
