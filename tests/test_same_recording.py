"""One seed, the same bytes of every message of every bundled scene; a sensor more changes none."""

from __future__ import annotations

import dataclasses
import hashlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.assets.bundled import bundled_files
from uwsim.middleware.recording import Recorder
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec
from uwsim.sensors.imu import ImuSpec
from uwsim.topics.sensor_topic import ImuToROSImuSpec

SCENES = bundled_files("scenes")
SECONDS = 0.15
ONE_MORE = "one_more"
NOTHING = hashlib.sha256().hexdigest()
"""Hash of a topic without messages."""


def recording(scene: SceneSpec, file: Path) -> str:
    """Record a short run and return the hash of the file."""
    with open_scene(scene, seed=3) as simulation, Recorder(simulation.bus, file) as recorder:
        recorder.start(lambda: simulation.time)
        simulation.advance(SECONDS)
        assert recorder.n_messages
    return hashlib.sha256(file.read_bytes()).hexdigest()


def with_one_more(scene: SceneSpec) -> SceneSpec:
    """The scene with a noisy sensor before all others of its first vehicle."""
    first = scene.vehicles[0]
    base = next(
        (part.relative_to for _, part in first.all_parts() if hasattr(part, "relative_to")),
        "base_link",
    )
    sensor = ImuSpec(name=ONE_MORE, relative_to=base, std=0.1)
    vehicle = dataclasses.replace(first, parts=(sensor, *first.parts))
    topic = ImuToROSImuSpec(name=ONE_MORE, topic=f"/{ONE_MORE}", rate=100)
    return dataclasses.replace(
        scene,
        vehicles=(vehicle, *scene.vehicles[1:]),
        ros_interfaces=(topic, *scene.ros_interfaces),
    )


def pieces(value: Any) -> Iterator[bytes]:
    """The bytes of a message and of all in it."""
    if dataclasses.is_dataclass(value):
        for field in dataclasses.fields(value):
            yield from pieces(getattr(value, field.name))
    elif isinstance(value, np.ndarray):
        yield value.tobytes()
    elif isinstance(value, list | tuple):
        for each in value:
            yield from pieces(each)
    else:
        yield repr(value).encode()


def heard(scene: SceneSpec) -> dict[str, str]:
    """Topic -> hash of all its messages; /tf, which names the sensors, is left out."""
    digests: dict[str, Any] = {}
    with open_scene(scene, seed=3) as simulation:

        def listen(topic: str) -> None:
            digest = digests[topic] = hashlib.sha256()

            def hear(message: object) -> None:
                for piece in pieces(message):
                    digest.update(piece)

            simulation.bus.subscribe(topic, object, hear)

        simulation.advance(0.0)
        for topic in simulation.bus.topics:
            if topic.strip("/") != "tf":
                listen(topic)
        simulation.advance(SECONDS)
    return {topic.strip("/"): digest.hexdigest() for topic, digest in digests.items()}


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_two_recordings_of_a_bundled_scene_have_the_same_bytes(name: str, tmp_path: Path) -> None:
    scene = read_scene(SCENES[name])
    assert recording(scene, tmp_path / "a.mcap") == recording(scene, tmp_path / "b.mcap")


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_one_sensor_more_changes_no_message_of_the_others(name: str) -> None:
    scene = read_scene(SCENES[name])
    before, after = heard(scene), heard(with_one_more(scene))
    assert after.pop(ONE_MORE) != NOTHING
    assert before == after
    assert set(before.values()) - {NOTHING}
