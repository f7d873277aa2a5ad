"""Images as observations: their spaces, and their bytes held against those of a benchmark."""

from __future__ import annotations

import gc
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.spaces import Box, Dict
from gymnasium.wrappers import FrameStackObservation, GrayscaleObservation

import uwsim
from tests.support.random_steps import check_without_warnings
from uwsim.bus import Node
from uwsim.envs import make_env
from uwsim.errors import BadSetting, BenchmarkError, UnknownName
from uwsim.messages import Float64MultiArray, Image, MultiArrayLayout, array_of, image_of
from uwsim.rendering.renderer import Renderer
from uwsim.simulation import Simulation

DATA = Path(uwsim.__file__).parent / "data"
SENSORS = """
    <u:imagingSonar>
      <name>sonar</name> <relativeTo>base_link</relativeTo> <range>5</range> <bins>40</bins>
      <beams>16</beams> <rows>8</rows>
    </u:imagingSonar>
    <virtualRangeImage>
      <name>ranges</name> <relativeTo>base_link</relativeTo> <resw>16</resw> <resh>12</resh>
      <u:lookAt>down</u:lookAt>
    </virtualRangeImage>
    <u:dynamics>"""
TOPICS = """
    <u:sonarToROS>
      <name>sonar</name> <topic>/sonar</topic> <imageTopic>/sonar_image</imageTopic> <rate>20</rate>
    </u:sonarToROS>
  </rosInterfaces>"""
IMAGES = """<image> <sensor>camera</sensor> </image>
    <image> <sensor>sonar</sensor> </image>
    <image> <sensor>ranges</sensor> <content>depth</content> </image>
    <action>"""
N_STEPS = 4
ACTION = np.full(8, 0.25)


@pytest.fixture(scope="module")
def benchmark(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A short benchmark that observes a small camera, a sonar and depths, at 20 Hz."""
    folder = tmp_path_factory.mktemp("images")
    scene = (DATA / "scenes/open-water-scene.xml").read_text()
    for pattern, text in (
        ("<resw>320</resw> <resh>240</resh>", "<resw>40</resw> <resh>30</resh>"),
        ("<rate>10</rate>", "<rate>20</rate>"),
        ("<u:dynamics>", SENSORS),
        ("</rosInterfaces>", TOPICS),
    ):
        assert pattern in scene
        scene = scene.replace(pattern, text)
    (folder / "open-water-scene.xml").write_text(scene)
    text = (DATA / "benchmarks/station-keeping.xml").read_text().replace("<action>", IMAGES)
    path = folder / "station-keeping.xml"
    path.write_text(re.sub("<interval>[0-9]+", f"<interval>{0.05 * N_STEPS}", text))
    return path


@dataclass
class Recorder:
    """An algorithm that stores observed images and those of the topics, and acts."""

    images: dict[str, list[bytes]] = field(default_factory=dict)

    def start(self, node: Node) -> None:
        for topic in ("observation/camera", "observation/sonar", "observation/ranges_depth"):
            node.subscribe(topic, Image, self.store(topic))
        for topic in ("/bluerov2/camera", "/sonar_image"):
            node.subscribe(topic, Image, self.store(topic))
        publish = node.publisher("action", Float64MultiArray)
        action = Float64MultiArray(layout=MultiArrayLayout(dim=[], data_offset=0), data=ACTION)
        node.subscribe("observation", Float64MultiArray, lambda _: publish(action))

    def store(self, topic: str) -> Any:
        stored = self.images.setdefault(topic, [])
        return lambda message: stored.append(message.data.tobytes())


@pytest.fixture(scope="module")
def bench_images(benchmark: Path) -> dict[str, list[bytes]]:
    """The images of a run of the benchmark with seed 5, in a current of 0.2 m/s."""
    recorders: list[Recorder] = []

    class Recording(Recorder):
        def __init__(self) -> None:
            super().__init__()
            recorders.append(self)

    uwsim.bench(benchmark, algorithm=Recording, seeds=(5,), levels={"current": [0.2]})
    return recorders[0].images


def test_observed_images_are_those_of_the_sensors_topics(
    bench_images: dict[str, list[bytes]],
) -> None:
    assert len(bench_images["/bluerov2/camera"]) >= N_STEPS
    assert bench_images["observation/camera"] == bench_images["/bluerov2/camera"]
    assert bench_images["observation/sonar"] == bench_images["/sonar_image"]


def test_an_environment_has_the_images_of_the_benchmark(
    benchmark: Path, bench_images: dict[str, list[bytes]]
) -> None:
    env = make_env(benchmark)
    observation, _ = env.reset(seed=5, options={"level": {"current": 0.2}})
    for k in range(N_STEPS):
        assert observation in env.observation_space
        for name in ("camera", "sonar", "ranges_depth"):
            expected = bench_images[f"observation/{name}"][k]
            assert observation[name].tobytes() == expected, (name, k)
        observation, *_ = env.step(ACTION)
    env.close()
    images = bench_images["observation/camera"]
    assert len(set(images)) == len(images)


def test_a_policy_sees_what_it_sees_in_training(benchmark: Path) -> None:
    seen: list[dict[str, np.ndarray]] = []

    class Policy:
        def __call__(self, observation: dict[str, np.ndarray]) -> np.ndarray:
            seen.append(observation)
            return ACTION

    uwsim.bench(benchmark, algorithm=Policy, seeds=(5,), levels={"current": [0.2]})  # type: ignore[arg-type]  # a policy
    env = make_env(benchmark)
    observation, _ = env.reset(seed=5, options={"level": {"current": 0.2}})
    assert {name: value.tobytes() for name, value in seen[0].items()} == {
        name: value.tobytes() for name, value in observation.items()
    }
    assert {name: value.shape for name, value in seen[0].items()} == {
        name: value.shape for name, value in observation.items()
    }
    env.close()


def test_gymnasium_finds_nothing_wrong_with_images(benchmark: Path) -> None:
    env = make_env(benchmark, observation=["heading", "camera:grey=16x12", "camera:depth=16x12"])
    spaces = env.observation_space
    assert isinstance(spaces, Dict)
    assert spaces["state"].shape == (2,)
    assert (spaces["camera"].shape, spaces["camera"].dtype) == ((12, 16, 1), np.uint8)
    assert (spaces["camera_depth"].shape, spaces["camera_depth"].dtype) == (
        (12, 16, 1),
        np.float32,
    )
    check_without_warnings(env)
    env.close()


def test_a_single_image_is_a_box_for_wrappers() -> None:
    env = make_env("station-keeping", observation=["camera:image=32x24"])
    assert env.observation_space == Box(0, 255, (24, 32, 3), np.uint8)
    stacked = FrameStackObservation(GrayscaleObservation(env), 3)
    observation, _ = stacked.reset(seed=1)
    assert observation.shape == (3, 24, 32)
    assert observation.mean() > 10.0
    stacked.close()


def count_objects(*kinds: type) -> int:
    gc.collect()
    return sum(type(item) in kinds for item in gc.get_objects())


def test_20_resets_repeat_their_images_and_leave_no_scene_or_renderer(benchmark: Path) -> None:
    env = make_env(benchmark, observation=["camera:image=16x12"])
    first = [env.reset(seed=seed)[0].tobytes() for seed in (1, 2)]
    assert first[0] != first[1]
    n_objects = count_objects(Simulation, Renderer)
    for _ in range(10):
        assert [env.reset(seed=seed)[0].tobytes() for seed in (1, 2)] == first
    assert count_objects(Simulation, Renderer) == n_objects
    env.close()
    env.close()


@pytest.mark.slow
def test_rows_in_processes_have_the_images_of_a_single_environment() -> None:
    options: dict[str, Any] = {"observation": ["heading", "camera:image=16x12"]}
    envs = gymnasium.make_vec(
        "uwsim.envs:uwsim/StationKeeping-v0",
        num_envs=2,
        vectorization_mode="async",
        vector_kwargs={"context": "spawn"},  # a process with a graphics context may not be forked
        **options,
    )
    observations, _ = envs.reset(seed=3)
    stepped, *_ = envs.step(np.zeros((2, 8), np.float32))
    envs.close()
    env = make_env("station-keeping", **options)
    for row in range(2):
        observation, _ = env.reset(seed=3 + row)
        assert observation["camera"].tobytes() == observations["camera"][row].tobytes()
        observation, *_ = env.step(np.zeros(8, np.float32))
        assert observation["camera"].tobytes() == stepped["camera"][row].tobytes()
    env.close()


def test_mistakes_in_images_name_what_is_valid(benchmark: Path) -> None:
    with pytest.raises(UnknownName, match=r"Did you mean 'camera'.* ranges, sonar"):
        make_env(benchmark, observation=["camra:image"])
    with pytest.raises(BadSetting, match="camera:image=128x96"):
        make_env(benchmark, observation=["camera:image=128"])
    with pytest.raises(BadSetting, match=r"two parts .* 'camera'"):
        make_env(benchmark, observation=["camera:image", "camera:grey"])
    with pytest.raises(BadSetting, match=r"'sonar' is no colour camera .* expected 'image'"):
        make_env(benchmark, observation=["sonar:grey"])
    with pytest.raises(BadSetting, match="have a size of their own"):
        make_env(benchmark, observation=["sonar:image=8x8"])
    with pytest.raises(BadSetting, match="it observes images"):
        gymnasium.make_vec(
            "uwsim.envs:uwsim/StationKeeping-v0",
            stepper="rows",
            observation=["positionError", "camera:image"],
        )


def test_a_wrong_image_in_a_file_has_a_line(benchmark: Path, tmp_path: Path) -> None:
    path = tmp_path / "wrong.xml"
    path.write_text(
        benchmark.read_text().replace(
            "<sensor>camera</sensor>", "<sensor>camera</sensor> <width>9</width>"
        )
    )
    with pytest.raises(BenchmarkError, match=r"wrong\.xml:\d+: .*needs <width> and <height>"):
        make_env(path)


@pytest.mark.parametrize("number_type", [np.uint8, np.uint16, np.float32])
@pytest.mark.parametrize("n_channels", [1, 3])
def test_a_message_has_the_values_of_an_image(number_type: type, n_channels: int) -> None:
    if number_type is np.float32 and n_channels == 3:
        return
    values = np.arange(12 * n_channels).reshape(3, 4, n_channels).astype(number_type)
    assert array_of(image_of(values, time=0.0)).tolist() == values.tolist()
