"""Measure the lock-step with ArduPilot's JSON backend: speed, losses and floods.

Run ``python benchmarks/ardupilot.py``. The scene is `bluerov2-scene`, a BlueROV2 Heavy with eight
thrusters, at 400 exchanges per second of simulation time, one step of 2.5 ms each; its camera, IMU
and DVL have no readers. The stand-in of ArduPilot is a process of its own, which sends the next
packet as soon as it has an answer.

speed
    CPU time of the simulator per exchange, which contains a step of the physics and its answer, and
    the wall time between two packets of the stand-in, with both processes at work.
    Targets: 250 us; with 400 Hz, 10 times real time.
losses
    100 000 exchanges with a loss of 1 % of the packets and 1 % of the answers: the steps that are
    missing in the answers. Target: 0.
flood
    The rate of exchanges while another process sends datagrams to the port as fast as it can, and
    that of the run beside a process that sends them to a port that nobody reads. Target: a ratio
    of 0.98.
"""

from __future__ import annotations

import socket
import subprocess
import sys
import time

from measure import main, upper_target_figure

import uwsim
from uwsim.devices.ardupilot import ArduPilotLink
from uwsim.simulation import Simulation

RATE, TIMESTEP = 400.0, 0.0025
N_EXCHANGES, N_LOSSY, N_FLOODED = 20_000, 100_000, 20_000
WARM_UP = 1.0
"""The simulation time before each measurement [s]."""
STAND_IN = """
import random, re, socket, struct, sys, time
port, loss, timeout = int(sys.argv[1]), float(sys.argv[2]), float(sys.argv[3])
peer = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
peer.connect(("127.0.0.1", port))
draw = random.Random(1).random
count, last, missing, repeats, steps = 0, 0.0, 0, 0, 0
sys.stdout.write("ready\\n"); sys.stdout.flush()
while True:
    packet = struct.pack("<HHI16H", 18458, 400, count, *[1540, 1460, 1460, 1540] * 2, *[0] * 8)
    answer = None
    while answer is None:
        try:
            if draw() >= loss:
                peer.send(packet)
            peer.settimeout(timeout)
            answer = peer.recv(65000)
            if draw() < loss:
                answer = None
                time.sleep(timeout)
                repeats += 1
        except TimeoutError:
            repeats += 1
        except ConnectionError:
            if count > 0:
                print(steps, missing, repeats)
                sys.exit()
            time.sleep(0.01)
    stamp = float(answer[14:answer.index(b",")])
    if stamp > last:
        missing += round((stamp - last) * 400) - 1
        steps += 1
        last = stamp
    count += 1
"""
FLOOD = """
import os, socket, sys
peer = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
target = ("127.0.0.1", int(sys.argv[1]))
data = [os.urandom(40), b"", bytes(2000), bytes(72)]
n = 0
while True:
    try:
        peer.sendto(data[n % 4], target)
    except OSError:
        pass
    n += 1
"""


def free_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


def open_scene(port: int) -> Simulation:
    return uwsim.load(
        "bluerov2-scene",
        timestep=TIMESTEP,
        udp_address="127.0.0.1",
        is_blind=True,
        settings={"vehicle[bluerov2].ardupilot.port": port},
    )


def start(code: str, *arguments: object) -> subprocess.Popen[str]:
    words = [sys.executable, "-c", code, *map(str, arguments)]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, text=True)
    return process


def exchange(
    n: int, *, loss: float = 0.0, timeout: float = 1.1, flood: str = ""
) -> dict[str, float]:
    """Take ``n`` exchanges; return the figures of the simulator and of the stand-in."""
    port = free_port()
    with open_scene(port) as simulation, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sink:
        sink.bind(("127.0.0.1", 0))
        stand_in = start(STAND_IN, port, loss, timeout)
        target = port if flood == "port" else sink.getsockname()[1]
        flooding = start(FLOOD, target) if flood else None
        simulation.advance(WARM_UP)
        wall, cpu = time.perf_counter(), time.process_time()
        simulation.advance(n / RATE)
        cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
        (link,) = [part for part in simulation.world.devices if isinstance(part, ArduPilotLink)]
        state = link.state.exchange
    if flooding is not None:
        flooding.kill()
    output, _ = stand_in.communicate(timeout=60.0)
    _, n_missing, n_repeats = map(int, output.split()[1:])
    return {
        "cpu_us": 1e6 * cpu / n,
        "wall_us": 1e6 * wall / n,
        "missing_steps": n_missing,
        "repeats": n_repeats,
        "received_again": state.n_duplicates,
        "other_senders": state.n_others + state.n_dropped,
    }


def measure() -> dict[str, object]:
    figures = exchange(N_EXCHANGES)
    lossy = exchange(N_LOSSY, loss=0.01, timeout=0.02)
    baselines = [exchange(N_FLOODED, flood="unread port") for _ in range(2)]
    floods = [exchange(N_FLOODED, flood="port") for _ in range(2)]
    ratio = min(r["wall_us"] for r in baselines) / min(r["wall_us"] for r in floods)
    return {
        "exchange_cpu_us": upper_target_figure(round(figures["cpu_us"], 1), 250.0),
        "exchange_wall_us": round(figures["wall_us"], 1),
        "times_real_time": round(1e6 / RATE / figures["wall_us"], 1),
        "losses": {**lossy, "exchanges": N_LOSSY},
        "flood": {
            "rate_ratio": round(ratio, 3),
            "target": 0.98,
            "other_senders_counted": max(r["other_senders"] for r in floods),
        },
    }


if __name__ == "__main__":
    main(measure)
