"""The examples of ROS 2, run with rclpy against `uwsim run --ros2`."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.ros2_peers import BOUND_S, PYTHON, ROOT, environment, free_domain, needs_rclpy

pytest.importorskip("cyclonedds", reason="cyclonedds is not installed: pip install uwsim[ros2]")

pytestmark = needs_rclpy
SCENE = """<UWSimScene>
  <vehicle>
    <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <position> <x>0</x> <y>0</y> <z>2</z> </position>
  </vehicle>
  <rosInterfaces>
    <PATToROSOdom>
      <topic>/odom</topic> <vehicleName>rov</vehicleName> <rate>20</rate>
    </PATToROSOdom>
    <ROSTwistToPAT> <topic>/twist</topic> <vehicleName>rov</vehicleName> </ROSTwistToPAT>
  </rosInterfaces>
</UWSimScene>
"""


@contextmanager
def uwsim(*arguments: str) -> Iterator[subprocess.Popen[str]]:
    """Run a command while the block lasts; it ends by Ctrl-C."""
    process = subprocess.Popen(
        [sys.executable, "-m", "uwsim", *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={k: v for k, v in os.environ.items() if not k.startswith(("ROS_", "CYCLONE"))},
    )
    try:
        yield process
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=BOUND_S)
    finally:
        process.kill()
        process.communicate()


def example(name: str, *arguments: str, domain: int) -> str:
    """Run an example of ROS 2 to its end; what it printed."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as logs:
        done = subprocess.run(
            [PYTHON, ROOT / "examples" / "ros2" / name, *arguments],
            env=environment(domain, logs),
            capture_output=True,
            text=True,
            timeout=2 * BOUND_S,
            check=False,
        )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.slow
def test_a_node_of_ros_2_drives_the_vehicle_to_its_goal(tmp_path: Path) -> None:
    scene = tmp_path / "scene.xml"
    scene.write_text(SCENE)
    with free_domain() as domain, uwsim("run", str(scene), "--ros2", "--domain", str(domain)):
        goal = ["--goal", "0.3", "0.2", "2.1"]
        topics = ["--odometry", "/odom", "--command", "/twist"]
        told = example("goto_position.py", *goal, *topics, domain=domain)
    assert told.startswith("reached [0.3, 0.2, 2.1]: 0.")
