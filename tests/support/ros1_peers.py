"""ROS 1 as Debian packages it, in processes of its own: a master, and programs that use rospy."""

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

from tests.support.waiting import LIMIT, free_port, until
from uwsim.middleware.ros1.tcpros import PeerError
from uwsim.middleware.ros1.xmlrpc import call

PYTHON = "/usr/bin/python3"
EXAMPLES = Path(__file__).parents[2] / "examples" / "ros1"


@functools.cache
def is_installed() -> bool:
    """Whether rospy and the command-line tools are there."""
    if shutil.which("rostopic") is None or shutil.which("rosmaster") is None:
        return False
    test = "import rospy, rosbag, nav_msgs.msg, sensor_msgs.msg, std_srvs.srv"
    return subprocess.run([PYTHON, "-c", test], capture_output=True).returncode == 0


needs_ros1 = pytest.mark.skipif(
    not is_installed(), reason="ROS 1 is not installed; scripts/ros1_peers installs it"
)


class Peers:
    """A real master, and programs at it.

    Args:
        folder: for logs.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.uri = f"http://127.0.0.1:{free_port()}"
        own = {"ROS_MASTER_URI": self.uri, "ROS_IP": "127.0.0.1", "ROS_LOG_DIR": str(folder)}
        kept = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "VIRTUAL"))}
        self.environment = {**kept, **own, "PYTHONUNBUFFERED": "1", "PYTHONFAULTHANDLER": "1"}
        self._programs: list[subprocess.Popen[str]] = []

    def start_master(self) -> None:
        """Start rosmaster and wait until it answers."""
        self._master = self._popen(["rosmaster", "--core", "-p", self.uri.rpartition(":")[2]])
        until(self._answers)

    def kill_master(self) -> None:
        """Kill it."""
        self._master.kill()
        self._master.wait(LIMIT)

    def _answers(self) -> bool:
        try:
            return bool(call(self.uri, "getUri", "/test"))
        except PeerError:
            return False

    def start(self, *command: str) -> subprocess.Popen[str]:
        """Start a program; one that ends with .py is an example."""
        words = list(command)
        if words[0].endswith(".py"):
            words = [PYTHON, str(EXAMPLES / words[0]), *words[1:]]
        return self._popen(words)

    def output(self, program: subprocess.Popen[str], *steps: Callable[[], object]) -> str:
        """Wait until a program has ended, and return what it printed.

        Of a program that does not end, the AssertionError says where all its threads are.

        Args:
            program: one of `start`.
            steps: called again and again meanwhile.
        """
        try:
            until(lambda: program.poll() is not None, *steps)
        except AssertionError as error:
            program.send_signal(signal.SIGABRT)
            _, errors = program.communicate(timeout=LIMIT)
            raise AssertionError(f"{program.args} does not end:\n{errors}") from error
        printed, errors = program.communicate(timeout=LIMIT)
        assert program.returncode == 0, errors
        return printed

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
        """End everything."""
        for program in reversed(self._programs):
            if program.poll() is None:
                os.killpg(program.pid, signal.SIGKILL)
            program.communicate(timeout=LIMIT)


@contextmanager
def peers(folder: Path) -> Iterator[Peers]:
    """Give a master and what it takes to start programs."""
    made = Peers(folder)
    try:
        made.start_master()
        yield made
    finally:
        made.close()
