"""``render()``: images of cameras and views from outside, and the page of the mode ``human``."""

from __future__ import annotations

import gzip
import json
import time
import warnings
from collections import Counter
from contextlib import suppress
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

import uwsim
from tests.envs.test_benchmark_env import shorten
from uwsim.base.geometry import Intrinsics
from uwsim.envs import make_env
from uwsim.errors import BadSetting, UnknownName
from uwsim.simulation.views import chase_pose, chase_radius, find_focus
from uwsim.viewer.live.view import HEADER

STATION = "uwsim.envs:uwsim/StationKeeping-v0"
SIZE = (64, 48)
WAIT = 30.0
"""Bound on hanging [s]."""


def forward() -> np.ndarray:
    """Return the action that moves the BlueROV2 ahead."""
    return np.array([-1, -1, 1, 1, 0, 0, 0, 0], np.float32)


@pytest.mark.parametrize("camera", ["chase", "orbit", "top", "viewer"])
def test_a_view_shows_the_vehicle_and_follows_the_motion(camera: str) -> None:
    env = make_env("station-keeping", render_mode="rgb_array", camera=camera, frame_size=SIZE)
    env.reset(seed=1)
    first, same = env.render(), env.render()
    assert first is not None
    assert same is not None
    assert (first.shape, first.dtype) == ((48, 64, 3), np.uint8)
    assert first.tobytes() == same.tobytes()
    env.step(forward())
    assert env.render().tobytes() != first.tobytes()  # type: ignore[union-attr]
    env.reset(seed=1)
    assert env.render().tobytes() == first.tobytes()  # type: ignore[union-attr]
    env.close()


def test_the_chase_camera_stays_behind_the_vehicle() -> None:
    env = make_env("station-keeping", render_mode="rgb_array", camera="chase", frame_size=SIZE)
    env.reset(seed=1)
    frames = env.unwrapped._frames
    for _ in range(10):
        env.step(forward())
        env.render()
    simulation = env.unwrapped._stepper._episode.simulation  # type: ignore[union-attr]
    pose = frames._follow(simulation)
    vehicle = simulation.world.bodies.find("bluerov2").world_from_body
    offset = vehicle.rotation.T @ (pose.position - vehicle.position)
    assert offset[0] < -0.5
    assert abs(offset[1]) < 0.3
    env.close()


def test_the_chase_camera_of_a_vehicle_near_objects_is_in_the_water() -> None:
    with uwsim.load("docking-scene") as simulation:  # a dock beside a vehicle 1.5 m deep
        focus, vehicle = find_focus(simulation), simulation.world.bodies.find("bluerov2")
        position = vehicle.world_from_body.position
        pose = chase_pose(position, focus.bow_direction, chase_radius(simulation, focus))
        assert position[2] + 0.5 < pose.position[2] < -0.2
        hidden = {p.id for p in simulation.world.scenery.parts if p.vehicle is None}
        images = [
            simulation.world.scenery.render_view(
                pose, Intrinsics.from_fovy(160, 120, 0.9), targets={"ids"}, hidden_ids=ids
            ).ids
            for ids in (frozenset[int](), frozenset(hidden))
        ]
    all_parts, vehicle_alone = images
    is_vehicle = vehicle_alone > 0
    assert is_vehicle.sum() > 100
    assert (all_parts == vehicle_alone)[is_vehicle].all()


def test_a_camera_is_rendered_as_by_the_simulation() -> None:
    env = make_env("station-keeping", render_mode="rgb_array")
    env.reset(seed=1)
    frame = env.render()
    episode = env.unwrapped._stepper._episode
    assert frame is not None
    assert episode is not None
    assert frame.tobytes() == np.asarray(episode.simulation.image("camera").colour).tobytes()
    env.close()
    env.close()


def test_vectors_and_lists_have_images_of_each_row_and_step() -> None:
    options: dict[str, Any] = {"camera": "chase", "frame_size": SIZE}
    envs = gymnasium.make_vec(STATION, num_envs=2, render_mode="rgb_array", **options)
    envs.reset(seed=1)
    frames = envs.render()
    assert isinstance(frames, tuple)
    assert [frame.shape for frame in frames] == [(48, 64, 3)] * 2
    assert frames[0].tobytes() != frames[1].tobytes()
    envs.close()
    env = gymnasium.make(STATION, render_mode="rgb_array_list", **options)
    env.reset(seed=1)
    env.step(env.action_space.sample())
    listed = env.render()
    assert isinstance(listed, list)
    assert len(listed) == 2
    assert listed[0].tobytes() == frames[0].tobytes()
    env.close()


def test_mistakes_in_rendering_name_what_is_valid() -> None:
    with pytest.raises(UnknownName, match=r"Did you mean 'chase'.* camera, chase, orbit"):
        make_env("station-keeping", render_mode="rgb_array", camera="chaise")
    with pytest.raises(BadSetting, match="expected 'rgb_array', 'human' or None"):
        make_env("station-keeping", render_mode="ansi")
    with pytest.raises(BadSetting, match="num_envs=1"):
        gymnasium.make_vec(STATION, num_envs=2, render_mode="human")
    with pytest.raises(BadSetting, match="frame_size"):
        make_env("station-keeping", render_mode="rgb_array", frame_size=(0, 10))
    with pytest.raises(BadSetting, match="real_time_factor"):
        make_env("station-keeping", render_mode="human", real_time_factor=-1.0)


def open_socket(url: str) -> ClientConnection:
    address = url.replace("http://", "ws://").replace("/?", "/socket?")
    return connect(address, open_timeout=WAIT, close_timeout=0.1, max_size=None, max_queue=None)


def test_the_page_follows_the_episodes_and_ends_with_the_environment(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    benchmark = shorten(tmp_path, "station-keeping", 0.2)
    env = make_env(benchmark, render_mode="human", real_time_factor=0.0)
    assert capsys.readouterr().err == ""
    env.reset(seed=1)
    line = capsys.readouterr().err
    assert line.startswith("view: http://127.0.0.1:")
    assert line.count("\n") == 1
    titles = []
    with open_socket(line.split()[1]) as socket:
        for seed in (1, 2):
            env.reset(seed=seed)
            is_over = False
            while not is_over:
                _, _, terminated, truncated, _ = env.step(forward())
                is_over = terminated or truncated
            assert env.render() is None
        assert capsys.readouterr().err == ""
        env.close()
        env.close()
        kinds: Counter[str] = Counter()
        with suppress(ConnectionClosed):
            while not kinds["end"]:
                message = socket.recv(timeout=WAIT)
                if isinstance(message, str):
                    kinds[json.loads(message)["type"]] += 1
                elif message[0] == 0:
                    titles.append(message)
    assert kinds["end"] == 1
    assert len(titles) >= 2
    assert b"seed 2" in gzip.decompress(titles[-1][HEADER.size :])


def test_the_page_is_in_real_time_unless_it_is_told_otherwise(
    capsys: pytest.CaptureFixture[str],
) -> None:
    env = make_env("station-keeping", render_mode="human", real_time_factor=4.0)
    env.reset(seed=1)
    start = time.monotonic()
    for _ in range(20):
        env.step(forward())
    assert time.monotonic() - start >= 0.2  # 1 s of simulation time, less the first image
    env.close()


def test_the_page_does_not_change_an_episode() -> None:
    observations = []
    for mode in (None, "human"):
        env = make_env("station-keeping", render_mode=mode, real_time_factor=0.0)
        env.reset(seed=1)
        for _ in range(5):
            observation, *_ = env.step(forward())
        observations.append(observation)
        env.close()
    assert observations[0].tobytes() == observations[1].tobytes()


@pytest.mark.slow
def test_gymnasium_finds_nothing_wrong_with_rendering(tmp_path: Path) -> None:
    benchmark = shorten(tmp_path, "station-keeping")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        env = gymnasium.make(STATION, benchmark=benchmark, render_mode="rgb_array")
        check_env(env.unwrapped)
        env.close()
