"""Peers that send garbage, flood or die: the simulation goes on and the log says it."""

from __future__ import annotations

import os
import random
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from tests.support.ros2_peers import needs_rclpy, peer, wait_until
from uwsim.messages import Empty, EmptyResponse, Image, String
from uwsim.messages.build import image

pytest.importorskip("cyclonedds", reason="cyclonedds is not installed: pip install uwsim[ros2]")

from tests.middleware.ros2.simulator import Simulator, run_in_thread
from uwsim.middleware.encodings import from_cdr, to_cdr
from uwsim.middleware.ros2.participant import Participant, Writer
from uwsim.middleware.ros2.quality import Quality
from uwsim.middleware.ros2.raw_types import raw_type
from uwsim.middleware.ros2.settings import Ros2Settings
from uwsim.middleware.types import ros2_store

N_FLOOD = 100_000
MAX_KEPT = 1000
"""Messages of a topic that wait for the simulation."""
MIB = 2**20
PEER = """
import sys, time
from uwsim.messages import Image, image
from uwsim.middleware.encodings import to_cdr
from uwsim.middleware.ros2.participant import Participant
from uwsim.middleware.ros2.quality import Quality
from uwsim.middleware.ros2.raw_types import raw_type
from uwsim.middleware.ros2.settings import Ros2Settings
from uwsim.middleware.types import ros2_store
import numpy as np

domain = int(sys.argv[1])
participant = Participant(domain, Ros2Settings(domain=domain).configuration())
type = raw_type(ros2_store(), "sensor_msgs/msg/Image")
"""
READER_PROGRAM = """
participant.reader("rt/camera", type, Quality(), lambda sample: print("one", flush=True))
time.sleep(1000.0)
"""
WRITER_PROGRAM = """
writer = participant.writer("rt/picture", type, Quality())
data = bytes(to_cdr(image(np.zeros((960, 1280, 3), np.uint8), time=0.0)))
while True:
    writer.write(data)
"""


@contextmanager
def process(source: str, domain: int) -> Iterator[subprocess.Popen[bytes]]:
    """A participant in a process of its own, killed at the end."""
    command = [sys.executable, "-c", PEER + source, str(domain)]
    actual = subprocess.Popen(command, stdout=subprocess.PIPE)
    assert actual.stdout is not None
    os.set_blocking(actual.stdout.fileno(), False)
    try:
        yield actual
    finally:
        actual.kill()
        actual.wait()
        actual.stdout.close()


def memory() -> float:
    """What this process holds [MiB]."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / MIB


@pytest.fixture
def simulator() -> Iterator[Simulator]:
    with run_in_thread() as actual:
        yield actual


@pytest.fixture
def other(simulator: Simulator) -> Iterator[Participant]:
    settings = Ros2Settings(domain=simulator.domain)
    actual = Participant(simulator.domain, settings.configuration())
    yield actual
    actual.close()


def writer_to(simulator: Simulator, other: Participant, topic: str) -> Writer:
    """A writer of texts that the simulator reads."""
    type = raw_type(ros2_store(), "std_msgs/msg/String")
    writer = other.writer(f"rt/{topic}", type, Quality())
    wait_until(lambda: writer.n_readers == 1, simulator.step)
    return writer


def text(data: str) -> bytes:
    return bytes(to_cdr(String(data=data)))


def test_garbage_on_its_ports_does_not_disturb_it(simulator: Simulator, other: Participant) -> None:
    inbox = simulator.bus.inbox("text", String)
    writer = writer_to(simulator, other, "text")
    chance = random.Random(1)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        for port in range(7400 + 250 * simulator.domain, 7400 + 250 * simulator.domain + 40):
            for length in (0, 1, 19, 20, 21, 64, 1400, 60000):
                data = chance.randbytes(length)
                for start in (b"", b"RTPS", b"RTPS\x02\x01\x01\x10" + bytes(12)):
                    sender.sendto(start + data, ("127.0.0.1", port))
    writer.write(text("still here"))
    wait_until(lambda: inbox.last_message is not None, simulator.step)
    assert inbox.last_message is not None
    assert inbox.last_message.data == "still here"


def test_a_sample_that_is_no_message_is_refused_and_reported(simulator: Simulator) -> None:
    inbox = simulator.bus.inbox("text", String)
    receive = partial(simulator.bridge._receive, "text", String)
    for garbage in (b"", b"\x00\x01\x00\x00", b"\x00\x01\x00\x00" + b"\xff" * 40):
        receive(garbage)
    receive(text("good"))
    simulator.step()
    assert [entry.data for entry in inbox.take()] == ["good"]
    assert sum("/text: a message was refused" in line for line in simulator.lines) == 3


def test_of_a_flood_the_newest_are_kept_and_it_is_reported(
    simulator: Simulator, other: Participant
) -> None:
    inbox = simulator.bus.inbox("text", String)
    writer = writer_to(simulator, other, "text")
    for n in range(N_FLOOD):
        writer.write(text(str(n)))
    samples: list[str] = []

    def is_told() -> bool:
        return any("faster than the simulation" in line for line in simulator.lines)

    wait_until(is_told, lambda: [writer.write(text("more")) for _ in range(1000)])
    writer.write(text("end"))

    def step() -> None:
        simulator.step()
        new_samples = [entry.data for entry in inbox.take()]
        assert len(new_samples) <= MAX_KEPT
        samples.extend(new_samples)

    wait_until(lambda: samples and samples[-1] == "end", step)


@needs_rclpy
def test_a_reader_that_is_killed_while_images_come_holds_nobody_up(simulator: Simulator) -> None:
    publish = simulator.bus.publisher("camera", Image)
    source = """
from sensor_msgs.msg import Image
node.create_subscription(Image, "/camera", lambda image: say(n=image.header.stamp.sec), 10)
spin_until(lambda: False)
"""
    pixels = np.zeros((240, 320, 3), dtype=np.uint8)
    samples: list[int] = []

    def step() -> None:
        publish(image(pixels.copy(), time=simulator.time))
        simulator.step()

    with peer(source, simulator.domain) as first_reader:
        wait_until(first_reader.answers, step)
        first_reader.kill()
        with peer(source, simulator.domain) as second:
            wait_until(second.answers, step)
            start_step = simulator.bus.step
            wait_until(
                lambda: samples, lambda: (step(), samples.extend(a["n"] for a in second.answers()))
            )
    assert simulator.bus.step > start_step


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/statm").is_file(), reason="Linux tells what is held")
def test_a_reader_that_is_frozen_costs_bounded_memory_and_holds_nobody_up(
    simulator: Simulator, other: Participant
) -> None:
    publish = simulator.bus.publisher("camera", Image)
    say = simulator.bus.publisher("text", String)
    arrivals: list[str] = []
    other.reader(
        "rt/text",
        raw_type(ros2_store(), "std_msgs/msg/String"),
        Quality(depth=0),
        lambda sample: arrivals.append(from_cdr(String, sample.data).data),
    )
    pixels = np.zeros((960, 1280, 3), np.uint8)

    def step() -> None:
        publish(image(pixels.copy(), time=simulator.time))
        say(String(data=f"{simulator.time:.3f}"))
        simulator.step()

    with process(READER_PROGRAM, simulator.domain) as reader:
        assert reader.stdout is not None
        wait_until(reader.stdout.read, step)
        wait_until(lambda: arrivals, step)
        os.kill(reader.pid, signal.SIGSTOP)
        value_before = memory()
        for _ in range(100):  # 370 MB, of which the reader takes none
            step()
            text = f"{simulator.time - 0.002:.3f}"
            wait_until(partial(arrivals.__contains__, text), lambda: None)
        assert memory() - value_before < 200.0
        wait_until(lambda: not simulator.bus.has_subscribers("camera"), step)
    reports = f"/camera: a subscriber has left, or was silent {simulator.bridge._node.lease}"
    assert any(reports in line for line in simulator.lines)


@pytest.mark.slow
def test_a_writer_killed_in_the_middle_of_an_image_does_no_harm(
    simulator: Simulator, other: Participant
) -> None:
    inbox = simulator.bus.inbox("picture", Image)
    texts = simulator.bus.inbox("text", String)
    with process(WRITER_PROGRAM, simulator.domain) as writer:
        wait_until(lambda: inbox.last_message is not None, simulator.step)
        writer.kill()
    own_samples = writer_to(simulator, other, "text")
    own_samples.write(text("still here"))
    wait_until(lambda: texts.last_message is not None, simulator.step)
    assert all(entry.data.size == 960 * 1280 * 3 for entry in inbox.take())


def test_names_that_are_none_of_ros_2_are_told_and_the_others_are_there(
    simulator: Simulator, other: Participant
) -> None:
    bus = simulator.bus
    for name in ("a b", "two//slashes", "tiefe-µ", "1st", "x" * 300, "{a}"):
        bus.publisher(name, String)
        bus.subscribe(f"{name}/command", String, print)
        bus.services.serve(f"{name}/reset", Empty, lambda _: EmptyResponse())
    publish = bus.publisher("zz", String)
    samples: list[bytes] = []
    kind = raw_type(ros2_store(), "std_msgs/msg/String")
    other.reader("rt/zz", kind, Quality(), lambda sample: samples.append(sample.data))
    wait_until(lambda: samples, lambda: (publish(String(data="here")), simulator.step()))
    reports = [line for line in simulator.lines if "not on the graph: /" in line]
    assert len(reports) == 3 * 6
    assert any("not on the graph: /a b. A name of ROS 2 has letters" in line for line in reports)


@needs_rclpy
def test_calls_that_cannot_be_read_do_not_fill_standard_error(
    simulator: Simulator, capfd: pytest.CaptureFixture[str]
) -> None:
    simulator.bus.services.serve("rov/reset", Empty, lambda _: EmptyResponse())
    simulator.step()
    source = """
from std_srvs.srv import Empty
client = node.create_client(Empty, "/rov/reset")
spin_until(client.service_is_ready)
for _ in range(20):
    client.call_async(Empty.Request())
    rclpy.spin_once(node, timeout_sec=0.02)
say(done=True)
spin_until(lambda: False)
"""
    with peer(source, simulator.domain) as node:
        wait_until(node.answers, simulator.step)
    assert "deserialization" not in capfd.readouterr().err
