"""The controller of the examples `keep_station.py`, as an algorithm class of uwsim."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from tests.support.short_benchmark import run
from uwsim.bus import Node
from uwsim.messages import Empty, Odometry, TwistStamped

ROOT = Path(__file__).parents[2]
BENCHMARK = ROOT / "examples" / "ros1" / "keep_station.xml"
GOAL, KP, PERIOD = (-9.0, -8.0, 10.0), 0.4, 0.1
LIMIT = 240.0
"""The timeout of a process [s]."""
LEVELS = ("--level", "current=0.2", "--level", "current=0.4")


class KeepStation:
    """An algorithm that commands a velocity towards a goal every 0.1 s, from 0.1 s on."""

    def start(self, node: Node) -> None:
        self._node, self._odometry, self._has_begun = node, Odometry(), False
        self._publish = node.publisher("/g500/twist", TwistStamped)
        node.subscribe("/g500/odom", Odometry, self._store_odometry)
        node.create_timer(PERIOD, self._control)

    def _store_odometry(self, odometry: Odometry) -> None:
        self._odometry = odometry

    def _control(self) -> None:
        if self._node.now < PERIOD / 2:
            return
        if not self._has_begun:
            self._has_begun = True
            self._node.call("startBench", Empty())
        command = TwistStamped()
        linear = command.twist.linear
        linear.x, linear.y, linear.z = _velocity(self._odometry)
        self._publish(command)


def short_benchmark(folder: Path) -> Path:
    """Write the benchmark of the examples with levels of 3 s."""
    path = folder / "keep_station.xml"
    path.write_text(BENCHMARK.read_text().replace("<interval>20<", "<interval>3<"))
    return path


def bench_words(benchmark: Path, out: Path, *options: str) -> list[str]:
    """Return the command that runs two levels of the benchmark."""
    words = ["-m", "uwsim", "bench", str(benchmark), *LEVELS, *options, "--out", str(out)]
    return [sys.executable, *words]


def read_result(out: Path) -> dict[str, Any]:
    """Read a result."""
    result: dict[str, Any] = json.loads((out / "result.json").read_text())
    return result


def score_in_process(benchmark: Path, out: Path) -> dict[str, Any]:
    """Score the class of this module in process."""
    run(benchmark, out, algorithm=f"{__file__}:KeepStation", levels=[*LEVELS[1::2]], seed=0)
    return read_result(out)


def _velocity(odometry: Odometry) -> list[float]:
    """Return the velocity towards the goal in the axes of the vehicle, 3 numbers [m/s]."""
    p, q = odometry.pose.pose.position, odometry.pose.pose.orientation
    ground_velocity = [KP * (g - x) for g, x in zip(GOAL, (p.x, p.y, p.z), strict=True)]
    axis = [q.x, q.y, q.z]
    cross_product = _cross(axis, ground_velocity)
    return [
        v - 2.0 * q.w * t + 2.0 * u
        for v, t, u in zip(ground_velocity, cross_product, _cross(axis, cross_product), strict=True)
    ]


def _cross(a: list[float], b: list[float]) -> list[float]:
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]
