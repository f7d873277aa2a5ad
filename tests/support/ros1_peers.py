"""ROS 1 of Debian's packages for tests: a master, and programs with rospy as processes."""

from __future__ import annotations

import functools
import os
import shutil
import signal
import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.support.waiting import LIMIT, free_port, wait_until
from uwsim.middleware.ros1.tcpros import PeerError
from uwsim.middleware.ros1.xmlrpc import call

PYTHON = "/usr/bin/python3"
EXAMPLES = Path(__file__).parents[2] / "examples" / "ros1"


@functools.cache
def is_installed() -> bool:
    """Return True if rospy and its command-line tools are installed."""
    if shutil.which("rostopic") is None or shutil.which("rosmaster") is None:
        return False
    test = "import rospy, rosbag, nav_msgs.msg, sensor_msgs.msg, std_srvs.srv"
    return subprocess.run([PYTHON, "-c", test], capture_output=True).returncode == 0


needs_ros1 = pytest.mark.skipif(
    not is_installed(), reason="ROS 1 is not installed; scripts/ros1_peers installs it"
)


class Peers:
    """A real master and its programs.

    Args:
        folder: the folder of logs.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.uri = f"http://127.0.0.1:{free_port()}"
        ros_variables = {
            "ROS_MASTER_URI": self.uri,
            "ROS_IP": "127.0.0.1",
            "ROS_LOG_DIR": str(folder),
        }
        inherited_variables = {
            k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "VIRTUAL"))
        }
        self.environment = {
            **inherited_variables,
            **ros_variables,
            "PYTHONUNBUFFERED": "1",
            "PYTHONFAULTHANDLER": "1",
        }
        self._programs: list[subprocess.Popen[str]] = []

    def start_master(self) -> None:
        """Start rosmaster and wait until it answers."""
        self._master = self._popen(["rosmaster", "--core", "-p", self.uri.rpartition(":")[2]])
        wait_until(self._answers)

    def kill_master(self) -> None:
        """Kill rosmaster."""
        self._master.kill()
        self._master.wait(LIMIT)

    def _answers(self) -> bool:
        try:
            return bool(call(self.uri, "getUri", "/test"))
        except PeerError:
            return False

    def start(self, *command: str) -> subprocess.Popen[str]:
        """Start a program; a name that ends with .py is an example."""
        words = list(command)
        if words[0].endswith(".py"):
            words = [PYTHON, str(EXAMPLES / words[0]), *words[1:]]
        return self._popen(words)

    def output(self, program: subprocess.Popen[str], *steps: Callable[[], object]) -> str:
        """Wait until a program has ended, and return its standard output.

        If a program does not end, the AssertionError has the stacks of all its threads.

        Args:
            program: a program of `start`.
            steps: called repeatedly meanwhile.
        """
        try:
            wait_until(lambda: program.poll() is not None, *steps)
        except AssertionError as error:
            program.send_signal(signal.SIGABRT)
            _, errors = program.communicate(timeout=LIMIT)
            raise AssertionError(f"{program.args} does not end:\n{errors}") from error
        output, errors = program.communicate(timeout=LIMIT)
        assert program.returncode == 0, errors
        return output

    def _popen(self, words: list[str]) -> subprocess.Popen[str]:
        program = subprocess.Popen(
            words,
            env=self.environment,
            cwd=self._folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        self._programs.append(program)
        return program

    def close(self) -> None:
        """Kill all programs."""
        for program in reversed(self._programs):
            if program.poll() is None:
                os.killpg(program.pid, signal.SIGKILL)
            program.communicate(timeout=LIMIT)


@contextmanager
def peers(folder: Path) -> Iterator[Peers]:
    """Start a master; yield it with the means to start programs."""
    master_and_programs = Peers(folder)
    try:
        master_and_programs.start_master()
        yield master_and_programs
    finally:
        master_and_programs.close()
