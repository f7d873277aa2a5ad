"""A reader of best effort asks for nothing again: it gets the images of a node without ROS 2."""

from __future__ import annotations

import os
import subprocess
import sys
import time

import numpy as np
import pytest

from tests.support.ros2_peers import BOUND_S, wait_until
from uwsim.messages import Image
from uwsim.messages.build import image

pytest.importorskip("cyclonedds", reason="cyclonedds is not installed: pip install uwsim[ros2]")

from tests.middleware.ros2.simulator import run_in_thread

pytestmark = pytest.mark.slow

READER = """
import sys, time
from cyclonedds.core import ReadCondition, SampleState, InstanceState, ViewState, WaitSet
from cyclonedds.domain import DomainParticipant
from cyclonedds.qos import Policy, Qos
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration
from uwsim.middleware.ros2.raw_types import raw_type
from uwsim.middleware.types import ros2_store

participant = DomainParticipant(int(sys.argv[1]))
topic = Topic(participant, "rt/camera", raw_type(ros2_store(), "sensor_msgs/msg/Image"))
quality = Qos(Policy.Reliability.BestEffort, Policy.History.KeepLast(int(sys.argv[2])))
reader = DataReader(participant, topic, quality)
fresh = ViewState.Any | SampleState.NotRead | InstanceState.Any
waits = WaitSet(participant)
waits.attach(ReadCondition(reader, fresh))
n_images, last = 0, None
while last is None or time.monotonic() - last < 3.0:
    waits.wait(duration(milliseconds=200))
    for sample in reader.take(100):
        if len(sample.data) > SIZE:
            n_images, last = n_images + 1, time.monotonic()
print(n_images)
"""
"""Counts images until none has come for 3 s."""
SIZE = 640 * 480
"""Of an image [bytes]."""
CONFIGURATION = """<CycloneDDS><Domain Id="any">
  <General>
    <Interfaces><NetworkInterface address="127.0.0.1" multicast="false"/></Interfaces>
    <AllowMulticast>false</AllowMulticast>
  </General>
  <Discovery>
    <ParticipantIndex>auto</ParticipantIndex> <Peers><Peer address="127.0.0.1"/></Peers>
  </Discovery>
  <Internal><SocketReceiveBufferSize min="default" max="212992B"/></Internal>
</Domain></CycloneDDS>"""
"""Where to look for the simulator, and buffers as Linux allows them by default (rmem_max)."""
N_IMAGES, MIN_IMAGES, RATE = 80, 75, 15.0


@pytest.mark.parametrize("depth", [1, 5, 10])
def test_images_of_307_kb_reach_a_reader_of_best_effort(
    depth: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("UWSIM_ROS2", "dds")
    pixels = np.random.default_rng(0).integers(0, 255, (480, 640), np.uint8)
    with run_in_thread() as simulator:
        publish = simulator.bus.publisher("camera", Image)
        program = subprocess.Popen(
            [
                sys.executable,
                "-c",
                READER.replace("SIZE", str(SIZE)),
                *map(str, (simulator.domain, depth)),
            ],
            env={**os.environ, "CYCLONEDDS_URI": CONFIGURATION},
            stdout=subprocess.PIPE,
            text=True,
        )
        try:
            wait_until(lambda: simulator.bus.has_subscribers("camera"), simulator.step)
            start_time = time.monotonic()
            for n in range(N_IMAGES):
                wait_until(
                    lambda due=start_time + n / RATE: time.monotonic() >= due, simulator.step
                )
                publish(image(pixels, time=simulator.time))
            wait_until(lambda: program.poll() is not None, simulator.step)
            lines, _ = program.communicate(timeout=BOUND_S)
        finally:
            program.kill()
            program.wait()
    assert int(lines) >= MIN_IMAGES
