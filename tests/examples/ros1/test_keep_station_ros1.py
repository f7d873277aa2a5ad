"""A program of rospy that knows nothing of uwsim scores a benchmark, waited for or in real time."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.support.keep_station import (
    LIMIT,
    bench_words,
    read_result,
    score_in_process,
    short_benchmark,
)
from tests.support.ros1_peers import EXAMPLES, PYTHON, Peers, needs_ros1, peers
from tests.support.waiting import wait_until
from uwsim.middleware.ros1.xmlrpc import call

pytestmark = [needs_ros1, pytest.mark.slow]
DAWDLES = f"""
import random, sys, time
sys.path.insert(0, {str(EXAMPLES)!r})
import keep_station

quick = keep_station.velocity
def velocity(odometry, goal):
    time.sleep(0.02 * random.random())
    return quick(odometry, goal)

keep_station.velocity = velocity
keep_station.main()
"""
WORDS = ("/g500/odom", "/g500/twist", "-9", "-8", "10")


@pytest.fixture
def graph(tmp_path: Path) -> Iterator[Peers]:
    (tmp_path / "ros").mkdir()
    with peers(tmp_path / "ros") as made:
        yield made


def scored_outside(graph: Peers, program: Path, words: list[str], out: Path) -> dict[str, Any]:
    """Run a benchmark, and a program of rospy as soon as it is told the simulation time."""
    own = {name: graph.environment[name] for name in ("ROS_MASTER_URI", "ROS_IP", "ROS_LOG_DIR")}
    bench = subprocess.Popen(
        words, env={**os.environ, **own}, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE
    )
    node = None
    try:
        wait_until(lambda: call(graph.uri, "hasParam", "/test", "/use_sim_time"))
        said = [PYTHON, str(program), *WORDS]
        node = subprocess.Popen(said, env=graph.environment, stdout=subprocess.DEVNULL)
        _, errors = bench.communicate(timeout=LIMIT)
        assert bench.returncode == 0, errors
    finally:
        for process in (bench, node):
            if process is not None:
                process.kill()
                process.communicate()
    return read_result(out)


def test_its_commands_are_waited_for_and_give_the_rows_of_the_class_in_process(
    graph: Peers, tmp_path: Path
) -> None:
    benchmark = short_benchmark(tmp_path)
    inside = score_in_process(benchmark, tmp_path / "inside")
    (tmp_path / "dawdles.py").write_text(DAWDLES)
    out = tmp_path / "outside"
    how = ("--ros1", "--client", "station", "--sync", "output", "--output", "/g500/twist=10Hz")
    words = bench_words(benchmark, out, *how, "--settle", "0.05")
    outside = scored_outside(graph, tmp_path / "dawdles.py", words, out)
    assert outside["rows"] == inside["rows"]
    said = "lock-step, ros1, grade (c), not guaranteed"
    assert outside["run"]["clients"] == [["station", said]]
    assert "not guaranteed" in (out / "report.html").read_text()


def test_in_real_time_it_is_scored_and_the_result_says_that_it_cannot_be_repeated(
    graph: Peers, tmp_path: Path
) -> None:
    benchmark = short_benchmark(tmp_path)
    inside = score_in_process(benchmark, tmp_path / "inside")
    out = tmp_path / "outside"
    words = bench_words(benchmark, out, "--ros1", "--client", "station", "--sync", "none")
    outside = scored_outside(graph, EXAMPLES / "keep_station.py", words, out)
    assert outside["run"]["clients"] == [["station", "free-running, ros1, not repeatable"]]
    names = [column["name"] for column in outside["columns"]]
    offset, status = names.index("offset"), names.index("status")
    for row, wanted in zip(outside["rows"], inside["rows"], strict=True):
        assert row[status] == "ok"
        assert row[offset] == pytest.approx(wanted[offset], abs=0.4)  # it is controlled, not waited
