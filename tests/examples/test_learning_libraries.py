"""The examples that show uwsim to other libraries keep the contracts of these, without them."""

from __future__ import annotations

import runpy
import sys
import types
from pathlib import Path
from typing import Any

import numpy as np
import pytest

FOLDER = Path(__file__).parents[2] / "examples" / "learning"


@pytest.fixture(scope="module")
def hub() -> dict[str, Any]:
    return runpy.run_path(str(FOLDER / "env.py"))


@pytest.mark.slow
def test_the_file_for_lerobot_gives_what_its_rollout_reads(hub: dict[str, Any]) -> None:
    suites = hub["make_env"](n_envs=2, use_async_envs=False)
    vector = suites["uwsim"][0]
    assert vector.num_envs == 2
    assert vector.call("_max_episode_steps") == (600, 600)
    assert vector.call("task") == ("StationKeeping", "StationKeeping")
    assert all(isinstance(text, str) for text in vector.call("task_description"))
    assert vector.unwrapped.metadata["render_fps"] == 20
    observations, _ = vector.reset(seed=[1, 2])
    assert observations in vector.observation_space
    height, width, channels = observations["pixels"].shape[1:]
    assert observations["pixels"].dtype == np.uint8
    assert (height > channels, width > channels, channels) == (True, True, 3)
    assert observations["agent_pos"].shape == (2, 14)
    observations, rewards, *_ = vector.step(np.zeros((2, 8), np.float32))
    assert rewards.shape == (2,)
    vector.close()


@pytest.mark.slow
def test_the_last_step_for_lerobot_has_the_success_of_each_row(hub: dict[str, Any]) -> None:
    configuration = types.SimpleNamespace(task="StationKeeping", obs_type="state")
    vector = hub["make_env"](n_envs=2, cfg=configuration)["uwsim"][0]
    vector.reset(seed=[1, 2], options={"level": {"current": 0.0}})
    infos: dict[str, Any] = {}
    for _ in range(vector.call("_max_episode_steps")[0]):
        assert "final_info" not in infos
        *_, infos = vector.step(np.zeros((2, 8), np.float32))
    assert infos["final_info"]["is_success"].shape == (2,)
    assert infos["final_info"]["is_success"].dtype == np.bool_
    vector.close()


def test_an_unknown_task_for_lerobot_is_an_error(hub: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match="expected one of StationKeeping, Circle"):
        hub["make_env"](cfg=types.SimpleNamespace(task="Station"))


class FakeSession:
    """A session of onnxruntime that returns twice the observation."""

    def __init__(self, path: str, options: Any, providers: list[str]) -> None:
        assert providers == ["CPUExecutionProvider"]
        assert options.intra_op_num_threads == 1

    def get_inputs(self) -> list[Any]:
        return [types.SimpleNamespace(name="observation")]

    def run(self, outputs: None, inputs: dict[str, np.ndarray]) -> list[np.ndarray]:
        [batch] = inputs.values()
        assert batch.dtype == np.float32
        return [2.0 * batch]


def test_a_policy_of_onnx_limits_its_action(monkeypatch: pytest.MonkeyPatch) -> None:
    runtime = types.SimpleNamespace(
        InferenceSession=FakeSession, SessionOptions=types.SimpleNamespace
    )
    monkeypatch.setitem(sys.modules, "onnxruntime", runtime)  # type: ignore[arg-type]
    policy = runpy.run_path(str(FOLDER / "onnx_policy.py"))["Policy"]()
    np.testing.assert_array_equal(policy(np.array([0.25, -3.0])), [0.5, -1.0])
