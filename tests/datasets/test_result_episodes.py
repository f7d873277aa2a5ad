"""Episodes of results: the environment takes the same steps as the exported files, to the bit."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

import uwsim
from uwsim.assets.bundled import benchmark_file
from uwsim.cli import main
from uwsim.datasets.export.minari import find_arguments, make_specification
from uwsim.runs.planning.make_plan import make_plan
from uwsim.runs.planning.plan_request import PlanRequest

POLICY = """
class Policy:
    def __call__(self, observation):
        return [0.3 * observation[0], 2.0, *observation[2:8]]
"""
SEED, CURRENT = 3, 0.2


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a result of two levels of a policy, each 0.5 s long."""
    folder = tmp_path_factory.mktemp("result")
    text = benchmark_file("station-keeping", ()).read_text(encoding="utf-8")
    text = re.sub("<interval>[0-9]+</interval>", "<interval>0.5</interval>", text)
    (folder / "station.xml").write_text(text)
    (folder / "policy.py").write_text(POLICY)
    uwsim.bench(
        folder / "station.xml",
        algorithm=f"{folder / 'policy.py'}:Policy",
        levels={"current": [0.0, CURRENT]},
        seeds=[SEED],
        out=folder / "station.result",
    )
    return folder / "station.result"


def test_minari_has_the_steps_of_the_environment_to_the_bit(
    result: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    minari = pytest.importorskip("minari")
    assert main(["export", str(result), "--minari", "-o", str(tmp_path / "set")]) == 0
    assert "2 episodes of 20 steps at 20 Hz" in capfd.readouterr().out
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path / "set"))
    data_set = minari.load_dataset("uwsim/station-v0")
    episode = data_set[1]
    assert episode.observations.dtype == episode.actions.dtype == np.float64
    assert len(episode.observations) == len(episode.actions) + 1 == 11
    assert (episode.actions[:, 1] == 1.0).all()  # limited, as the environment does
    env = data_set.recover_environment()
    observation, _ = env.reset(seed=SEED, options={"level": {"current": CURRENT}})
    assert np.array_equal(observation, episode.observations[0])
    for step, action in enumerate(episode.actions):
        observation, reward, is_terminated, is_truncated, _ = env.step(action)
        assert np.array_equal(observation, episode.observations[step + 1])
        assert reward == episode.rewards[step]
        assert is_terminated == episode.terminations[step]
        assert is_truncated == episode.truncations[step]
    assert is_truncated
    env.close()


def test_the_environment_of_a_task_has_its_name_and_its_settings() -> None:
    pytest.importorskip("gymnasium")
    plan = make_plan(
        PlanRequest(
            benchmark="circle",
            algorithm="position-p",
            settings=["vehicle[bluerov2].position.z=2", "algorithm.kp=0.1"],
        )
    )
    arguments = find_arguments(plan)
    assert arguments == {
        "benchmark": "circle",
        "scene": "open-water-scene",
        "settings": {"vehicle[bluerov2].position.z": "2"},
    }
    specification = make_specification("uwsim/mine-v0", arguments)
    assert specification.id == "uwsim/Circle-v0"
    assert make_specification("uwsim/mine-v0", {"benchmark": "/my.xml"}).id == "uwsim/mine-v0"


def test_lerobot_has_the_same_steps_and_rewards(
    result: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    pq = pytest.importorskip("pyarrow.parquet")
    pytest.importorskip("imageio_ffmpeg")
    out = tmp_path / "set"
    assert main(["export", str(result), "--lerobot", "--task", "stay", "-o", str(out)]) == 0
    columns = pq.read_table(out / "data/chunk-000/file-000.parquet").to_pydict()
    assert len(columns["next.reward"]) == 20
    assert [i for i, is_done in enumerate(columns["next.done"]) if is_done] == [9, 19]
    assert columns["episode_index"] == [0] * 10 + [1] * 10
    info = json.loads((out / "meta/info.json").read_text())
    assert info["features"]["action"]["dtype"] == "float64"
    assert info["features"]["action"]["names"][0] == "/bluerov2/thrusters.0"
    assert info["features"]["next.done"]["dtype"] == "bool"
    env = uwsim.make_env(result.parent / "station.xml")
    observation, _ = env.reset(seed=SEED, options={"level": {"current": CURRENT}})
    for step in range(10, 20):
        assert observation.tolist() == columns["observation.state"][step]
        observation, reward, _, _, info = env.step(np.array(columns["action"][step]))
        assert reward == columns["next.reward"][step]
    assert columns["next.success"][-1] == info["is_success"]
    env.close()


def test_results_without_steps_are_refused(
    result: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("minari")
    out = ["-o", str(tmp_path / "set")]
    assert main(["export", str(result), "--minari", "--rate", "5", *out]) == 2
    assert "has its own" in capfd.readouterr().err
    controlled = result.parent / "p.result"
    levels = {"current": [CURRENT]}
    uwsim.bench(
        result.parent / "station.xml", algorithm="position-p", levels=levels, out=controlled
    )
    assert main(["export", str(controlled), "--minari", *out]) == 2
    assert "publishes no actions of the environment" in capfd.readouterr().err
