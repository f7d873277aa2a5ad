"""The tests of this folder once more, in the environment of rclpy: the simulator is its node."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests.support.ros2_peers import (
    BOUND_S,
    PYTHON,
    ROOT,
    needs_rclpy,
    of_one_version,
    rclpy_environment,
)

FOLDER = Path(__file__).parent
FILES = ("test_adapter.py", "test_hostile.py", "test_lockstep.py", "test_rclpy_node.py")


@needs_rclpy
@of_one_version
@pytest.mark.slow
@pytest.mark.parametrize("file", FILES)
def test_it_holds_for_a_node_of_rclpy(file: str) -> None:
    completed_process = subprocess.run(
        [PYTHON, "-m", "pytest", "-q", "-p", "no:cacheprovider", FOLDER / file],
        cwd=ROOT,
        env=rclpy_environment(),
        capture_output=True,
        text=True,
        timeout=2 * BOUND_S,
        check=False,
    )
    assert completed_process.returncode == 0, completed_process.stdout + completed_process.stderr
