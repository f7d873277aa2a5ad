"""The examples of ROS 2, run with rclpy against `uwsim run --ros2`."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from tests.support.byte_hashes import short_currents
from tests.support.keep_station import LEVELS, score_in_process, short_benchmark
from tests.support.ros2_peers import (
    BOUND_S,
    PYTHON,
    ROOT,
    environment,
    free_domain,
    needs_messages,
    needs_rclpy,
    of_one_version,
    peer,
    rclpy_environment,
    wait_until,
)
from tests.support.short_benchmark import BENCHMARK, write_benchmark
from tests.support.timed_algorithm import TIMED_PUSH

pytest.importorskip("cyclonedds", reason="cyclonedds is not installed: pip install uwsim[ros2]")

pytestmark = needs_rclpy
AUTO_INIT = " <publishOn>autoInit</publishOn>"
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


def simulator(way: str) -> tuple[str | Path, dict[str, str]]:
    """Return Python and variables by which uwsim is a node of rclpy, or one on Cyclone DDS."""
    if way == "rclpy":
        return PYTHON, rclpy_environment() | {"UWSIM_ROS2": "rclpy"}
    kept = {k: v for k, v in os.environ.items() if not k.startswith(("ROS_", "CYCLONE"))}
    return sys.executable, kept | {"UWSIM_ROS2": "dds"}


BOTH = pytest.mark.parametrize(
    "way", [pytest.param("dds"), pytest.param("rclpy", marks=of_one_version)]
)
"""As a node on Cyclone DDS, and as one of rclpy."""


@contextmanager
def uwsim(*arguments: str, way: str = "dds") -> Iterator[subprocess.Popen[str]]:
    """Run a command while the block lasts; it ends by Ctrl-C."""
    python, variables = simulator(way)
    process = subprocess.Popen(
        [python, "-m", "uwsim", *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=variables,
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
            timeout=BOUND_S,
            check=False,
        )
    assert done.returncode == 0, done.stderr
    return done.stdout


@BOTH
@pytest.mark.slow
def test_a_node_of_ros_2_drives_the_vehicle_to_its_goal(tmp_path: Path, way: str) -> None:
    scene = tmp_path / "scene.xml"
    scene.write_text(SCENE)
    arguments = ("run", str(scene), "--ros2", "--domain")
    with free_domain() as domain, uwsim(*arguments, str(domain), way=way):
        goal = ["--goal", "0.3", "0.2", "2.1"]
        topics = ["--odometry", "/odom", "--command", "/twist"]
        told = example("goto_position.py", *goal, *topics, domain=domain)
    assert told.startswith("reached [0.3, 0.2, 2.1]: 0.")


CONTROL = """
import time
from nav_msgs.msg import Odometry
from simulation_interfaces.msg import SimulationState
from simulation_interfaces.srv import (
    GetEntities, GetEntityState, GetSimulationState, SetSimulationState, StepSimulation
)
from tf2_msgs.msg import TFMessage
from underwater_sensor_msgs.srv import SpawnMarker
times, frames = [], set()
def look(message):
    stamp = message.header.stamp
    times.append(round(stamp.sec + 1e-9 * stamp.nanosec, 6))
node.create_subscription(Odometry, "/odom", look, 10)
late = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
for topic, quality in (("/tf", QoSProfile(depth=10)), ("/tf_static", late)):
    node.create_subscription(
        TFMessage, topic, lambda m: frames.update(t.child_frame_id for t in m.transforms), quality
    )
def call(kind, name, **request):
    client = node.create_client(kind, name)
    spin_until(client.service_is_ready)
    future = client.call_async(kind.Request(**request))
    spin_until(future.done)
    return future.result()
def state(code):
    assert call(
        SetSimulationState, "/set_simulation_state", state=SimulationState(state=code)
    ).result.result == 1
def rest():
    n = -1
    while n != len(times):
        n, end = len(times), time.monotonic() + 0.5
        spin_until(lambda: time.monotonic() > end)
STOPPED, PLAYING, PAUSED, QUITTING = range(4)
spin_until(lambda: times and frames)
state(PAUSED)
before = call(GetSimulationState, "/get_simulation_state").state.state
rest()
began = times[-1]
stepped = call(StepSimulation, "/step_simulation", steps=500).result.result
rest()
say(
    paused=before == PAUSED,
    stepped=stepped,
    seconds=round(times[-1] - began, 3),
    entities=call(GetEntities, "/get_entities").entities,
    z=round(call(GetEntityState, "/get_entity_state", entity="rov").state.pose.position.z, 1),
    spawned=call(SpawnMarker, "/SpawnMarker") is not None,
)
state(QUITTING)
"""


@needs_messages
@of_one_version
@pytest.mark.slow
def test_a_node_of_fast_dds_pauses_steps_and_ends_a_simulation_that_is_a_node_of_rclpy(
    tmp_path: Path,
) -> None:
    scene = tmp_path / "scene.xml"
    scene.write_text(SCENE)
    arguments = ("run", str(scene), "--ros2", "--domain")
    with free_domain() as domain, uwsim(*arguments, str(domain), way="rclpy") as simulation:
        with peer(CONTROL, domain) as node:
            answers: list[dict[str, Any]] = []
            wait_until(lambda: answers, lambda: answers.extend(node.answers()))
            simulation.wait(timeout=BOUND_S)
        assert simulation.returncode == 0
    (told,) = answers
    assert told.pop("entities") == ["rov"]
    assert told == {"paused": True, "stepped": 1, "seconds": 1.0, "z": 2.0, "spawned": True}


LATE = """
import random, sys, time
sys.path.insert(0, "examples/ros2")
import dark_box, lockstep
track = dark_box.DarkBoxNode.track
def late(self, image):
    time.sleep(random.random() * 0.02)
    track(self, image)
dark_box.DarkBoxNode.track = late
lockstep.run("dark_box", dark_box.DarkBoxNode, timeout=240.0)
"""
"""The tracker of the example, with a random delay of up to 20 ms."""


@pytest.mark.slow
def test_a_node_in_lock_step_scores_the_rows_of_the_same_algorithm_in_process(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    benchmark = tmp_path / "short.xml"
    benchmark.write_text(BENCHMARK.replace("LENGTH", "0.5").replace(AUTO_INIT, ""))
    monkeypatch.setenv("PYTHONPATH", str(ROOT / "examples" / "ros2"), prepend=os.pathsep)
    one_level = ["--level", "fog=0.4", "--workers", "0"]
    command = [sys.executable, "-m", "uwsim", "bench", str(benchmark), *one_level]

    def bench(name: str, *options: str) -> dict[str, Any]:
        done = subprocess.run(
            [*command, *options, "--out", tmp_path / name],
            timeout=BOUND_S,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr
        found: dict[str, Any] = json.loads((tmp_path / name / "result.json").read_text())
        return found

    inside = bench("inside", "--algorithm", "dark_box:DarkBox", "--in-process")
    with free_domain() as domain, peer(LATE, domain, prelude=""):
        client = [
            "--ros2",
            "--domain",
            str(domain),
            "--client",
            "dark_box",
            "--client-limit",
            "120",
        ]
        outside = bench("outside", *client)
    for part in ("rows", "columns", "missing", "facts"):
        assert inside[part] == outside[part]
    assert outside["run"]["clients"] == [["dark_box", "lock-step, ros2, grade (a)"]]


WRONG = """
import sys
sys.path.insert(0, "examples/ros2")
import lockstep

class Wrong(lockstep.LockStep):
    def _next(self, time):
        return {"next": "soon"}

lockstep.LockStep = Wrong
lockstep.run("wrong", lambda lockstep: None, timeout=240.0)
"""


@pytest.mark.slow
def test_a_node_whose_join_is_wrong_is_told(tmp_path: Path) -> None:
    benchmark = write_benchmark(tmp_path, "0.2")
    command = [sys.executable, "-m", "uwsim", "bench", str(benchmark), "--out", tmp_path / "out"]
    with free_domain() as domain, peer(WRONG, domain, prelude="") as node:
        options = ("--ros2", "--domain", str(domain), "--client", "wrong", "--client-limit", "20")
        done = subprocess.run(
            [*command, *options], timeout=BOUND_S, capture_output=True, text=True, check=False
        )
        said = 'its join was refused: next is "soon"; expected a time >= 0 [s], or null for none'
        assert done.returncode == 3
        assert done.stderr.count(said) == 2  # at once, and at the end
        assert node.process.wait(BOUND_S) == 1
        assert f"wrong: {said}" in node.errors()


BUNDLED = """
import sys
sys.path[:0] = ["examples/ros2", *{ours!r}]
sys.argv = ["run_algorithm.py", *{arguments!r}]
import run_algorithm
run_algorithm.main()
"""
"""The example, in the environment of rclpy with that of uwsim before it."""
MEASURED = ("rows", "columns", "missing", "image_streams", "pictures")
"""What a client outside may not change; facts of its own parameters are not known of it."""


def scored(benchmark: Path, out: Path, *options: str, way: str = "dds") -> dict[str, Any]:
    """Run a benchmark; returns what is in result.json."""
    python, variables = simulator(way)
    done = subprocess.run(
        [python, "-m", "uwsim", "bench", str(benchmark), *options, "--out", str(out)],
        env=variables,
        timeout=BOUND_S,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    found: dict[str, Any] = json.loads((out / "result.json").read_text())
    return found


def scored_by_a_node(
    benchmark: Path, out: Path, algorithm: str, delay: str, *options: str, way: str
) -> dict[str, Any]:
    """Run a benchmark with a bundled algorithm as a node of rclpy, which dawdles [ms]."""
    ours = [path for path in sys.path if path and Path(path).is_dir()]
    arguments = [algorithm, "--name", "outside", "--patience", "240", "--delay", delay]
    node = BUNDLED.format(ours=ours, arguments=arguments)
    with free_domain() as domain, peer(node, domain, prelude=""):
        client = ["--ros2", "--domain", str(domain), "--client", "outside", "--client-limit", "120"]
        return scored(benchmark, out, *options, *client, way=way)


@of_one_version
@pytest.mark.slow
@pytest.mark.parametrize(("way", "delay"), [("dds", "0"), ("dds", "20"), ("rclpy", "20")])
def test_the_bundled_tracker_as_a_node_scores_the_rows_of_the_process(
    tmp_path: Path, way: str, delay: str
) -> None:
    benchmark = write_benchmark(tmp_path, "0.5")
    inside = scored(benchmark, tmp_path / "inside", "--algorithm", "esm")
    outside = scored_by_a_node(
        benchmark, tmp_path / "outside", "uwsim.algorithms:Esm", delay, way=way
    )
    assert {part: inside[part] for part in MEASURED} == {part: outside[part] for part in MEASURED}
    assert outside["run"]["clients"] == [["outside", "lock-step, ros2, grade (a)"]]


@of_one_version
@BOTH
@pytest.mark.slow
def test_the_bundled_controller_as_a_node_scores_the_rows_of_the_process(
    tmp_path: Path, way: str
) -> None:
    benchmark = short_currents(tmp_path)
    level = ("--level", "current=0.2")
    inside = scored(benchmark, tmp_path / "inside", "--algorithm", "p", *level)
    outside = scored_by_a_node(
        benchmark, tmp_path / "outside", "uwsim.algorithms.control:P", "20", *level, way=way
    )
    assert {part: inside[part] for part in MEASURED} == {part: outside[part] for part in MEASURED}


@of_one_version
@pytest.mark.slow
def test_a_class_with_a_timer_is_a_node_without_a_change(tmp_path: Path) -> None:
    benchmark, level = short_currents(tmp_path), ("--level", "current=0.2")
    inside = scored(benchmark, tmp_path / "inside", "--algorithm", TIMED_PUSH, *level)
    outside = scored_by_a_node(benchmark, tmp_path / "outside", TIMED_PUSH, "0", *level, way="dds")
    assert {part: inside[part] for part in MEASURED} == {part: outside[part] for part in MEASURED}


@of_one_version
@pytest.mark.slow
def test_a_node_that_knows_nothing_of_lock_step_is_waited_for(tmp_path: Path) -> None:
    benchmark = short_benchmark(tmp_path)
    inside = score_in_process(benchmark, tmp_path / "inside")
    words = [ROOT / "examples" / "ros2" / "keep_station.py", "--ros-args", "-p"]
    how = ("--client", "station", "--sync", "output", "--output", "/g500/twist=10Hz")
    with free_domain() as domain, tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as logs:
        variables = environment(domain, logs)
        node = subprocess.Popen([PYTHON, *words, "use_sim_time:=true"], env=variables)
        try:
            outside = scored(
                benchmark,
                tmp_path / "outside",
                *LEVELS,
                *("--ros2", "--domain", str(domain), "--settle", "0.05", *how),
                way="rclpy",
            )
        finally:
            node.kill()
            node.wait(BOUND_S)
    assert outside["rows"] == inside["rows"]
    said = "lock-step, ros2, grade (c), not guaranteed"
    assert outside["run"]["clients"] == [["station", said]]
