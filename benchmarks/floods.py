"""Measure the cost of floods by a web client to a run.

Run ``python benchmarks/floods.py``. The scene of `currents` runs as fast as it can with its port
open: with no client, and beside a program that floods it with 6 400 small frames a second, with
calls of a service, with frames of 700 000 keys, or with frames of 15 MB by 20 connections. The
program is a process of its own, which has its share of the last core; a process that computes and
does not connect takes a whole core, for comparison. Runs with a flood and without take turns;
medians are compared, by wall time and by CPU time of uwsim's own process, which other programs on
the computer change less.

Targets: 0.98 of the rate of the quiet run, and no more than 0.25 s of wall time between two
messages on ``/clock``. One JSON on stdout.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import time
from statistics import median

from measure import lower_target_figure, main, upper_target_figure

import uwsim
from uwsim.messages import Empty, EmptyResponse
from uwsim.middleware.log import Log
from uwsim.middleware.web.options import WebOptions
from uwsim.middleware.web.server import WebBridge

SCENE = "currents-scene"
FLOOD = """
import json, os, sys, threading, time
from websockets.sync.client import connect

kind, uri = sys.argv[1:]
os.sched_setaffinity(0, [max(os.sched_getaffinity(0))])
if kind == "busy":
    print("here", flush=True)
    while True:
        sum(range(10_000))

def drain():
    for _ in socket:
        pass

def send_large():
    frame = "[" + "0," * (7 * 2**20) + "0]"
    while True:
        with connect(uri, max_size=2**26, ping_interval=None, close_timeout=0.0) as socket:
            socket.send(frame)

if kind == "large":
    for _ in range(20):
        threading.Thread(target=send_large, daemon=True).start()
    print("here", flush=True)
    time.sleep(3600.0)

with connect(uri, max_size=2**26, max_queue=None) as socket:
    threading.Thread(target=drain, daemon=True).start()
    socket.send(json.dumps({"op": "advertise", "topic": "/flood", "type": "std_msgs/Float64"}))
    if kind == "frames":
        frame = json.dumps({"op": "publish", "topic": "/flood", "msg": {"data": 0.5}})
    elif kind == "calls":
        frame = json.dumps({"op": "call_service", "service": "/flood", "args": {}})
    else:
        keys = {f"k{n}": 0 for n in range(700_000)}
        frame = json.dumps({"op": "publish", "topic": "/flood", "msg": keys})
    print("here", flush=True)
    began, n = time.monotonic(), 0
    while True:
        socket.send(frame)
        n += 1
        if kind == "frames" and n % 64 == 0:
            time.sleep(max(0.0, began + n / 6400.0 - time.monotonic()))
"""
"""The program that floods, on the last core; it prints a line at its start. It sends 64 frames at a
time: waking for each frame would use a quarter of a core."""
KINDS = {
    "6400 frames a second": "frames",
    "calls of a service": "calls",
    "frames of 700 000 keys": "keys",
    "15 MB frames by 20 connections": "large",
    "a process that computes": "busy",
}
QUIET_RUN = "quiet"
WARM_UP, DURATION = 1.0, 4.0
"""The warm-up and the duration of a run [s of wall time]."""
ROUNDS = 5
RATE_TARGET, GAP_TARGET = 0.98, 0.25
"""The target share of the quiet run's rate, and of the gap of messages on ``/clock`` [s]."""


class Pauses:
    """The longest wall time between two messages on ``/clock`` [s]."""

    def __init__(self, bridge: WebBridge) -> None:
        self._bridge = bridge
        self.restart()

    def restart(self) -> None:
        """Reset the longest pause."""
        self._last_time, self.max_pause = time.perf_counter(), 0.0

    def step(self) -> None:
        """Step the bridge, and measure the pause when it sends the time."""
        is_due = self._bridge.clock_topic.is_due
        self._bridge.step()
        if is_due:
            now = time.perf_counter()
            self._last_time, self.max_pause = now, max(self.max_pause, now - self._last_time)


def run(kind: str | None) -> dict[str, float]:
    """Run the scene during a flood: simulation time per wall time, CPU shares, longest pause."""
    with uwsim.load(SCENE) as simulation:
        simulation.bus.services.serve("flood", Empty, lambda request: EmptyResponse())
        log = Log("web", lambda line: None)
        bridge = WebBridge(simulation.bus, lambda: simulation.time, WebOptions(port=0), log)
        pauses = Pauses(bridge)
        simulation.watch(pauses.step)
        simulation.advance(0.1)
        program = None
        cpu_before, flood_start_time = children_cpu(), time.perf_counter()
        if kind is not None:
            words = [sys.executable, "-c", FLOOD, kind, f"ws://127.0.0.1:{bridge.port}"]
            program = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
            assert program.stdout is not None
            program.stdout.readline()
            flood_start_time = time.perf_counter()
        advance_for(simulation, WARM_UP)
        pauses.restart()
        cpu_start, start_time, time_before = (
            time.process_time(),
            time.perf_counter(),
            simulation.time,
        )
        advance_for(simulation, DURATION)
        wall = time.perf_counter() - start_time
        figures = {
            "rate": (simulation.time - time_before) / wall,
            "cpu_share": (time.process_time() - cpu_start) / wall,
            "longest_gap_s": pauses.max_pause,
        }
        if program is not None:
            program.kill()
            program.communicate()
            figures["cpu_share_of_flood"] = (children_cpu() - cpu_before) / (
                time.perf_counter() - flood_start_time
            )
        bridge.close()
        return figures


def advance_for(simulation: uwsim.Simulation, wall: float) -> None:
    """Advance the simulation for a wall time [s]."""
    end = time.perf_counter() + wall
    while time.perf_counter() < end:
        simulation.advance(0.02)


def children_cpu() -> float:
    """Return the CPU time of ended child processes [s]."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def measure() -> dict[str, object]:
    """Alternate the runs, and compare the medians."""
    runs: dict[str, list[dict[str, float]]] = {name: [] for name in (QUIET_RUN, *KINDS)}
    run(None)  # warms up
    for _ in range(ROUNDS):
        for name in runs:
            runs[name].append(run(KINDS.get(name)))
    quiet_rate = median(figures_of_run["rate"] for figures_of_run in runs[QUIET_RUN])
    quiet_rate_by_cpu = median(
        figures_of_run["rate"] / figures_of_run["cpu_share"] for figures_of_run in runs[QUIET_RUN]
    )
    figures: dict[str, object] = {}
    for name, figures_of_runs in runs.items():
        gap = max(figures_of_run["longest_gap_s"] for figures_of_run in figures_of_runs)
        figures[name] = {
            "times_real_time": round(
                median(figures_of_run["rate"] for figures_of_run in figures_of_runs), 2
            ),
            "rate_to_quiet": lower_target_figure(
                median(figures_of_run["rate"] for figures_of_run in figures_of_runs) / quiet_rate,
                RATE_TARGET,
            ),
            "rate_by_cpu_to_quiet": round(
                median(
                    figures_of_run["rate"] / figures_of_run["cpu_share"]
                    for figures_of_run in figures_of_runs
                )
                / quiet_rate_by_cpu,
                3,
            ),
            "longest_gap_of_clock_s": upper_target_figure(gap, GAP_TARGET),
            **{
                share: round(median(figures_of_run[share] for figures_of_run in figures_of_runs), 3)
                for share in ("cpu_share", "cpu_share_of_flood")
                if share in figures_of_runs[0]
            },
        }
    return figures


if __name__ == "__main__":
    main(measure)
