"""Programs of rospy in lock-step score what they do in process, also when they dawdle."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.support.byte_hashes import short_currents
from tests.support.ros1_peers import EXAMPLES, Peers, needs_ros1, peers
from tests.support.short_benchmark import write_benchmark
from tests.support.timed_algorithm import TIMED_PUSH
from tests.support.waiting import LIMIT

FORGETFUL = f"""
import sys
sys.path.insert(0, {str(EXAMPLES)!r})
import run_algorithm, lockstep  # the first finds rospy

class Forgetful(lockstep.LockStep):
    has_forgotten = False

    def _is_connected(self, publishers):
        if super()._is_connected(publishers) and not Forgetful.has_forgotten:
            Forgetful.has_forgotten = True  # as after an answer of the master that came late
            for connection in self._subscribers[lockstep.TICK].impl.connections:
                connection.close()
        return super()._is_connected(publishers)

lockstep.LockStep = Forgetful
run_algorithm.main()
"""
DIES = f"""
import os, signal, sys
sys.path.insert(0, {str(EXAMPLES)!r})
import run_algorithm, lockstep

class Mortal(lockstep.LockStep):
    def _answer(self, ack):
        if self.now > 0.2:
            os.kill(os.getpid(), signal.SIGKILL)
        super()._answer(ack)

lockstep.LockStep = Mortal
run_algorithm.main()
"""
INTRUDER = f"""
import sys
sys.path.insert(0, {str(EXAMPLES)!r})
import run_algorithm, rospy  # the first finds rospy
from sensor_msgs.msg import Image
from std_msgs.msg import String

rospy.init_node("intruder", disable_signals=True)
image = rospy.Publisher("/uwsim/camera1", Image, queue_size=10)
tick = rospy.Publisher("/uwsim/lockstep/tick", String, queue_size=10)
grey = Image(height=240, width=320, encoding="rgb8", step=960, data=bytes([128]) * 230400)
print("ready", flush=True)
while not rospy.is_shutdown():
    image.publish(grey)
    for text in ("[1]", "no JSON", '{{"client": "outside"}}'):
        tick.publish(String(data=text))
    rospy.rostime.wallsleep(0.05)
"""
TOTAL = LIMIT
"""Nothing takes longer unless it hangs [s]."""


pytestmark = [needs_ros1, pytest.mark.slow]


@pytest.fixture
def graph(tmp_path: Path) -> Iterator[Peers]:
    (tmp_path / "ros").mkdir()
    with peers(tmp_path / "ros") as made:
        yield made


def scored(out: Path, *words: str, environment: dict[str, str] | None = None) -> dict[str, Any]:
    """Run a benchmark and return its result."""
    command = [sys.executable, "-m", "uwsim", "bench", *words, "--out", str(out)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=TOTAL)
    assert done.returncode == 0, done.stderr
    found: dict[str, Any] = json.loads((out / "result.json").read_text())
    return found


def scored_outside(
    graph: Peers,
    benchmark: Path,
    out: Path,
    *options: str,
    program: tuple[str, ...],
    file: Path = EXAMPLES / "run_algorithm.py",
) -> dict[str, Any]:
    """Run a benchmark with a program of rospy as its algorithm."""
    own = {name: graph.environment[name] for name in ("ROS_MASTER_URI", "ROS_IP", "ROS_LOG_DIR")}
    environment = {**os.environ, **own}
    client = subprocess.Popen(
        [sys.executable, str(file), *program, "--name", "outside"],
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        words = (str(benchmark), "--ros1", "--client", "outside", "--client-limit", "200", *options)
        return scored(out, *words, environment=environment)
    finally:
        client.kill()
        client.wait()


def test_a_program_that_is_killed_ends_the_run_at_once(graph: Peers, tmp_path: Path) -> None:
    (tmp_path / "dies.py").write_text(DIES)
    program, file = ("uwsim.algorithms:P",), tmp_path / "dies.py"
    with pytest.raises(AssertionError) as raised:  # long before the limit of 200 s
        scored_outside(
            graph, short_currents(tmp_path), tmp_path / "out", program=program, file=file
        )
    assert "Client 'outside' left at 0." in str(raised.value)
    assert "Finished rows are kept; continue with --resume." in str(raised.value)
    assert "Traceback" not in str(raised.value)


def test_a_tracker_of_rospy_scores_the_same_rows_also_when_it_dawdles(
    graph: Peers, tmp_path: Path
) -> None:
    benchmark = write_benchmark(tmp_path, "0.5")
    inside = scored(tmp_path / "inside", str(benchmark), "--algorithm", "esm")
    out, log = tmp_path / "outside", "measure-corners.csv"
    program = ("uwsim.algorithms:Esm", "--delay", "20")
    outside = scored_outside(graph, benchmark, out, program=program)
    assert outside["rows"] == inside["rows"]
    assert outside["run"]["clients"] == [["outside", "lock-step, ros1, grade (a)"]]
    assert (out / log).read_bytes() == (tmp_path / "inside" / log).read_bytes()


def test_another_node_on_a_topic_of_the_simulation_changes_no_row(
    graph: Peers, tmp_path: Path
) -> None:
    benchmark = write_benchmark(tmp_path, "0.5")
    inside = scored(tmp_path / "inside", str(benchmark), "--algorithm", "esm")
    own = {name: graph.environment[name] for name in ("ROS_MASTER_URI", "ROS_IP", "ROS_LOG_DIR")}
    with subprocess.Popen(
        [sys.executable, "-c", INTRUDER], env={**os.environ, **own}, stdout=subprocess.PIPE
    ) as intruder:
        try:
            assert intruder.stdout is not None
            assert intruder.stdout.readline() == b"ready\n"
            program = ("uwsim.algorithms:Esm",)
            outside = scored_outside(graph, benchmark, tmp_path / "outside", program=program)
        finally:
            intruder.kill()
    assert outside["rows"] == inside["rows"]
    assert {each["by"] for each in outside["refused"]} == {"node /intruder"}
    assert "/uwsim/camera1" in {each["what"] for each in outside["refused"]}


def test_a_controller_of_rospy_scores_the_currents_as_in_process(
    graph: Peers, tmp_path: Path
) -> None:
    benchmark = short_currents(tmp_path)
    level = ("--level", "current=0.2")
    inside = scored(tmp_path / "inside", str(benchmark), "--algorithm", "p", *level)
    program = ("uwsim.algorithms:P", "--delay", "5")
    outside = scored_outside(graph, benchmark, tmp_path / "outside", *level, program=program)
    assert outside["rows"] == inside["rows"]


def test_a_class_with_a_timer_runs_in_rospy_without_a_change(
    graph: Peers, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = graph.environment.get("PYTHONPATH", os.environ.get("PYTHONPATH", ""))
    monkeypatch.setenv(
        "PYTHONPATH", os.pathsep.join(filter(None, [str(EXAMPLES.parents[1]), before]))
    )
    benchmark, level = short_currents(tmp_path), ("--level", "current=0.2")
    inside = scored(tmp_path / "inside", str(benchmark), "--algorithm", TIMED_PUSH, *level)
    outside = scored_outside(graph, benchmark, tmp_path / "outside", *level, program=(TIMED_PUSH,))
    assert outside["rows"] == inside["rows"]


def test_several_trials_are_run_by_one_program(graph: Peers, tmp_path: Path) -> None:
    benchmark = write_benchmark(tmp_path, "0.2")
    options = ("--repeat", "2", "--level", "fog=0.4")
    inside = scored(tmp_path / "inside", str(benchmark), "--algorithm", "esm", *options)
    program = ("uwsim.algorithms:Esm", "--trials", "2")
    outside = scored_outside(graph, benchmark, tmp_path / "outside", *options, program=program)
    assert outside["rows"] == inside["rows"]


def test_a_program_whose_connection_rospy_has_forgotten_subscribes_again(
    graph: Peers, tmp_path: Path
) -> None:
    benchmark = write_benchmark(tmp_path, "0.2")
    inside = scored(tmp_path / "inside", str(benchmark), "--algorithm", "esm")
    (tmp_path / "forgetful.py").write_text(FORGETFUL)
    outside = scored_outside(
        graph,
        benchmark,
        tmp_path / "outside",
        program=("uwsim.algorithms:Esm",),
        file=tmp_path / "forgetful.py",
    )
    assert outside["rows"] == inside["rows"]
