"""A tracker of the original's kind is scored by its two outputs, over ROS 1 and over WebSocket."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from tests.support import original_tracker
from tests.support.keep_station import LIMIT, read_result
from tests.support.ros1_peers import PYTHON, needs_ros1, peers
from tests.support.short_benchmark import write_benchmark
from tests.support.waiting import free_port, wait_until
from uwsim.messages import GTpublish
from uwsim.middleware.ros1.xmlrpc import call
from uwsim.middleware.types import service_of, wire_service

pytestmark = pytest.mark.slow

CENTROID = """<euclideanNorm u:value="mean">
      <name>centroid</name>
      <groundTruth type="centroidFromCamera">
        <camera>bowtech1</camera> <target>blackbox</target>
      </groundTruth>
      <target>centroidTopic</target>
      <log>0.05</log>
      <startOn><type>onInit</type></startOn> <stopOn><type>never</type></stopOn>
    </euclideanNorm>
    <time>"""
Start = Callable[[], "subprocess.Popen[str]"]


def benchmark_of_two_outputs(folder: Path) -> Path:
    """A short benchmark that measures corners and centroid."""
    path = write_benchmark(folder, "0.5")
    path.write_text(path.read_text().replace("<time>", CENTROID))
    return path


def command(benchmark: Path, out: Path, *options: str) -> list[str]:
    """The command that scores it."""
    return [sys.executable, "-m", "uwsim", "bench", str(benchmark), *options, "--out", str(out)]


def scored_in_process(benchmark: Path, out: Path) -> dict[str, Any]:
    """Score the class."""
    algorithm = f"{original_tracker.__file__}:OriginalTracker"
    words = command(benchmark, out, "--algorithm", algorithm)
    completed_process = subprocess.run(words, capture_output=True, text=True, timeout=LIMIT)
    assert completed_process.returncode == 0, completed_process.stderr
    return read_result(out)


def scored_outside(words: list[str], environment: dict[str, str], start: Start) -> None:
    """Score a program; ``start`` starts it, when the simulation can be reached."""
    bench = subprocess.Popen(
        words, env=environment, text=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE
    )
    watchdog = threading.Timer(LIMIT, bench.kill)
    watchdog.start()
    tracker = None
    try:
        tracker = start()
        _, errors = bench.communicate()
        tracker.kill()
        _, text = tracker.communicate()
        assert bench.returncode == 0, f"{errors}\nThe tracker: {text}"
    finally:
        watchdog.cancel()
        for process in (bench, tracker):
            if process is not None:
                process.kill()
                process.wait()


def run_over_ros1(benchmark: Path, out: Path, folder: Path) -> None:
    """Score the program of rospy."""
    folder.mkdir()
    program = folder / "tracker.py"
    program.write_text(original_tracker.ROSPY)
    md5 = wire_service(service_of(GTpublish)).md5
    with peers(folder) as graph:
        names = ("ROS_MASTER_URI", "ROS_IP", "ROS_LOG_DIR")
        own_names = {name: graph.environment[name] for name in names}

        def start() -> subprocess.Popen[str]:
            wait_until(lambda: call(graph.uri, "hasParam", "/test", "/use_sim_time"))
            words = [PYTHON, str(program), md5]
            return subprocess.Popen(words, env=graph.environment, text=True, stderr=subprocess.PIPE)

        options = ("--ros1", "--client", "tracker", "--sync", "output", "--settle", "0.05")
        words = command(benchmark, out, *options, "--client-limit", "20", *original_tracker.OUTPUTS)
        scored_outside(words, {**os.environ, **own_names}, start)


def run_over_web(benchmark: Path, out: Path, folder: Path) -> None:
    """Score the program that speaks rosbridge."""
    folder.mkdir()
    program = folder / "tracker.py"
    program.write_text(original_tracker.WEB)
    port = free_port()

    def is_listening() -> bool:
        with suppress(OSError), socket.create_connection(("127.0.0.1", port)):
            return True
        return False

    def start() -> subprocess.Popen[str]:
        wait_until(is_listening)
        words = [sys.executable, str(program), f"ws://127.0.0.1:{port}"]
        return subprocess.Popen(words, text=True, stderr=subprocess.PIPE)

    options = ("--web", str(port), "--client", "tracker", "--sync", "output")
    words = command(benchmark, out, *options, "--client-limit", "20", *original_tracker.OUTPUTS)
    scored_outside(words, dict(os.environ), start)


@pytest.mark.parametrize(
    ("score", "way"),
    [
        pytest.param(run_over_ros1, "ros1, grade (c), not guaranteed", id="ros1", marks=needs_ros1),
        pytest.param(run_over_web, "web, grade (c)", id="web"),
    ],
)
def test_a_tracker_with_two_outputs_that_is_silent_until_auto_init_has_the_rows_of_its_class(
    tmp_path: Path, score: Callable[[Path, Path, Path], None], way: str
) -> None:
    benchmark = benchmark_of_two_outputs(tmp_path)
    local_rows = scored_in_process(benchmark, tmp_path / "inside")
    score(benchmark, tmp_path / "outside", tmp_path / "program")
    external_rows = read_result(tmp_path / "outside")
    names = [column["name"] for column in local_rows["columns"]]
    rows = [dict(zip(names, row, strict=True)) for row in local_rows["rows"]]
    assert [row["status"] for row in rows] == ["ok"] * 3
    assert len({row["corners"] for row in rows}) == 3  # answers depend on the images
    assert external_rows["rows"] == local_rows["rows"]
    assert external_rows["run"]["clients"] == [["tracker", f"lock-step, {way}"]]
