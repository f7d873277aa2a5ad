"""Images drawn in a process of their own are those of this process, to the last bit."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

import uwsim
from tests.support.opened import open_scene
from tests.support.waiting import wait_until
from uwsim.messages import Image, Odometry
from uwsim.scene.reader import read_scene
from uwsim.simulation.scenery.image_process import ImageProcess

SCENES = Path(uwsim.__file__).parent / "data" / "scenes"
SEED = 4


class Seen:
    """A simulation, and the images on a topic by their stamps."""

    def __init__(self, scene: str, topic: str) -> None:
        self.scene = read_scene(SCENES / f"{scene}.xml")
        self.simulation = open_scene(self.scene, seed=SEED)
        self.images: dict[tuple[int, int], bytes] = {}
        self.simulation.bus.subscribe(topic, Image, self._keep)

    def _keep(self, message: Image) -> None:
        stamp = message.header.stamp
        self.images[stamp.sec, stamp.nanosec] = bytes(message.data)

    def advance(self) -> None:
        """Go on by 0.1 s, being commanded."""
        simulation = self.simulation
        if "dataNavigator" in simulation.topics:
            command = Odometry()
            command.pose.pose.orientation.w = 1.0
            command.twist.twist.linear.x = 0.3
            simulation.publish("/dataNavigator", command)
        simulation.advance(0.1)


@contextmanager
def elsewhere(scene: str, topic: str) -> Iterator[tuple[Seen, ImageProcess, list[str]]]:
    """A simulation whose images are drawn elsewhere, from some time on."""
    seen, said = Seen(scene, topic), list[str]()
    process = ImageProcess(seen.simulation, said.append)
    try:
        seen.advance()
        wait_until(lambda: process.is_ready and process.is_idle, process.step)
        yield seen, process, said
    finally:
        process.close()
        seen.simulation.close()


@pytest.mark.parametrize(
    ("scene", "topic"),
    [
        ("cirs", "/uwsim/camera1"),
        pytest.param("structured-light-scene", "/camera", marks=pytest.mark.slow),
        pytest.param("dredging-scene", "", marks=pytest.mark.slow),
    ],
)
def test_images_are_the_same_bytes_with_the_stamps_of_their_samples(scene: str, topic: str) -> None:
    if topic not in (found := read_images(scene)):
        topic = found[0]
    here = Seen(scene, topic)
    with elsewhere(scene, topic) as (there, process, said):
        before = set(there.images)
        for _ in range(5):
            there.advance()
            wait_until(lambda: process.is_idle, process.step)
        there.simulation.advance(0.01)
        for _ in range(6):
            here.advance()
        here.simulation.close()
        drawn = set(there.images) - before
        assert len(drawn) >= 4
        assert process.n_left_out == 0
        assert not said
        for stamp in drawn:
            assert there.images[stamp] == here.images[stamp]


def read_images(scene: str) -> list[str]:
    """Topics of images of a scene."""
    with open_scene(read_scene(SCENES / f"{scene}.xml")) as simulation:
        return sorted(simulation.world.images)


@pytest.mark.slow
def test_a_sample_that_is_due_too_soon_is_left_out_and_the_next_is_the_right_one() -> None:
    here = Seen("cirs", "/uwsim/camera1")
    with elsewhere("cirs", "/uwsim/camera1") as (there, process, _):
        assert process.pid is not None
        os.kill(process.pid, signal.SIGSTOP)
        for _ in range(3):
            there.advance()
        os.kill(process.pid, signal.SIGCONT)
        wait_until(lambda: process.is_idle, process.step)
        there.advance()
        wait_until(lambda: process.is_idle, process.step)
        there.simulation.advance(0.01)
        assert process.n_left_out > 0
    for _ in range(6):
        here.advance()
    here.simulation.close()
    assert max(there.images) in here.images
    for stamp, pixels in there.images.items():
        assert here.images[stamp] == pixels


@pytest.mark.slow
def test_a_process_that_is_killed_is_reported_and_images_are_drawn_here() -> None:
    here = Seen("cirs", "/uwsim/camera1")
    with elsewhere("cirs", "/uwsim/camera1") as (there, process, said):
        os.kill(process.pid or 0, signal.SIGKILL)
        wait_until(lambda: said, process.step)
        before = set(there.images)
        for _ in range(2):
            there.advance()
        for _ in range(4):
            here.advance()
        here.simulation.close()
        assert said == ["the process that draws images has ended; they are drawn in this one"]
        fresh = set(there.images) - before
        assert fresh
        assert all(there.images[stamp] == here.images[stamp] for stamp in fresh)
