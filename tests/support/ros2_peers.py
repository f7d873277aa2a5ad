"""Real ROS 2 nodes for tests: rclpy in a separate environment, each node a process."""

from __future__ import annotations

import json
import os
import socket
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from queue import Empty, Queue
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
PYTHON = ROOT / "build" / "ros2-peers" / "bin" / "python"
BOUND_S = 200.0
"""The timeout of tests [s]."""
needs_rclpy = pytest.mark.skipif(
    not (PYTHON.parents[1] / "installed").is_file(),
    reason="rclpy is not installed; scripts/ros2_peers installs it",
)
needs_messages = pytest.mark.skipif(
    not (PYTHON.parents[1] / "messages").is_file(),
    reason="message packages are not compiled for rclpy; scripts/ros2_messages does it",
)
of_one_version = pytest.mark.skipif(
    not (PYTHON.parents[1] / "lib" / f"python3.{sys.version_info.minor}").is_dir(),
    reason="rclpy is installed for another version of Python than uwsim",
)


def rclpy_environment() -> dict[str, str]:
    """Return environment variables by which `PYTHON` imports packages of this process first."""
    import_folders = [
        str(Path(path).resolve()) for path in sys.path if path and Path(path).is_dir()
    ]
    inherited_variables = {
        k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "ROS_", "CYCLONE"))
    }
    return inherited_variables | {"PYTHONPATH": os.pathsep.join(import_folders)}


@contextmanager
def free_domain() -> Iterator[int]:
    """Reserve a DDS domain for a test by the port of its first participant."""
    for domain in range(1 + os.getpid() % 50, 101):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as reserved_port:
            try:
                reserved_port.bind(("0.0.0.0", 7400 + 250 * domain + 10))
            except OSError:
                continue
            yield domain
            return
    raise RuntimeError("no free DDS domain")


def environment(domain: int, log_folder: str) -> dict[str, str]:
    """Return variables of a node in a domain on this computer, with large receive buffers."""
    variables = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "ROS_"))}
    return variables | {
        "ROS_DOMAIN_ID": str(domain),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROS_LOG_DIR": log_folder,
        "FASTRTPS_DEFAULT_PROFILES_FILE": str(ROOT / "examples" / "ros2" / "fastdds.xml"),
    }


class Peer:
    """A node as a process that prints JSON, one object a line."""

    def __init__(self, source: str, domain: int, log_folder: str) -> None:
        self.process = subprocess.Popen(
            [PYTHON, "-c", source],
            cwd=ROOT,
            env=environment(domain, log_folder),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self._lines: Queue[str] = Queue()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def answers(self) -> list[Any]:
        """Return the output since the last call."""
        assert self.process.poll() in (None, 0), "the node failed"
        answers = []
        while True:
            try:
                answers.append(json.loads(self._lines.get_nowait()))
            except Empty:
                return answers

    def kill(self) -> None:
        """Kill the node, as a crash does."""
        self.process.kill()
        self.process.wait()

    def errors(self) -> str:
        """Return the standard error of the node after its end."""
        assert self.process.stderr is not None
        return self.process.stderr.read()

    def close(self) -> None:
        """Kill the node and close its pipes."""
        self.kill()
        self._reader.join(timeout=BOUND_S)
        for stream in (self.process.stdin, self.process.stderr, self.process.stdout):
            assert stream is not None
            stream.close()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self._lines.put(line)


@contextmanager
def peer(source: str, domain: int, *, prelude: str | None = None) -> Iterator[Peer]:
    """Run a node during the block; print its standard error if the block fails."""
    program = (PRELUDE if prelude is None else prelude) + source
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as logs:
        node = Peer(program, domain, logs)
        try:
            yield node
        except BaseException:
            node.kill()
            print(node.errors(), file=sys.stderr)
            raise
        finally:
            node.close()


def wait_until(is_done: Callable[[], object], step: Callable[[], object]) -> None:
    """Call ``step`` repeatedly until a condition holds."""
    end = time.monotonic() + BOUND_S
    while not is_done():
        assert time.monotonic() < end, "the condition did not hold before the timeout"
        step()
        time.sleep(0.001)


PRELUDE = """
import json, sys
import rclpy
from rclpy.qos import QoSProfile, qos_profile_sensor_data, DurabilityPolicy, ReliabilityPolicy
from rclpy.node import Node
rclpy.init()
node = Node("peer")
def say(**values):
    print(json.dumps(values), flush=True)
def spin_until(is_done):
    while not is_done():
        rclpy.spin_once(node, timeout_sec=0.05)
"""
"""The first lines of each node."""
