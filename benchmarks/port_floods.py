"""Measure the cost of floods at each kind of port that a scene opens.

Run ``python benchmarks/port_floods.py``. A BlueROV2 Heavy in deep water runs as fast as it can,
while a process of its own sends random bytes to its port as fast as it can: datagrams of 1.4 kB, or
pieces of 64 kB over TCP. In the run for comparison the same process sends to a port that nobody
reads. The peer of PX4 and of ArduPilot is a stand-in in a third process. For PX4, the flood is one
of connections: its port has one client.

Figures are the smallest of three: wall time and CPU time of a step. Target: 0.98 of the rate of the
run for comparison. `counted` is the number of bytes or datagrams that the run has counted as
invalid, or that the system has dropped.
"""

from __future__ import annotations

import re
import socket
import subprocess
import sys
import time
from contextlib import ExitStack, redirect_stderr
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory

from measure import lower_target_figure, main

import ardupilot
import uwsim
from uwsim.devices.mavlink.mavlink import MavlinkDevice
from uwsim.devices.motion.follow_pose import PoseFollower
from uwsim.devices.streams.actuator_stream import ActuatorStream

SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <simParams> <offsetr> <x>M_PI</x> <y>0</y> <z>-M_PI_2</z> </offsetr> </simParams>
  <vehicle> <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <position> <x>0</x> <y>0</y> <z>20</z> </position> PARTS </vehicle>
</UWSimScene>"""
DYNAMICS = "<u:dynamics>bluerov2_heavy</u:dynamics>"
PARTS = {
    "thruster commands, UDP": (
        "<u:actuatorStream> <name>thrusters</name> <address>udpin:127.0.0.1:PORT</address>"
        f"</u:actuatorStream> {DYNAMICS}"
    ),
    "thruster commands, TCP": (
        "<u:actuatorStream> <name>thrusters</name> <address>tcpin:127.0.0.1:PORT</address>"
        f"</u:actuatorStream> {DYNAMICS}"
    ),
    "MAVLink, UDP": (
        "<u:mavlink> <name>autopilot</name> <address>udpin:127.0.0.1:PORT</address> </u:mavlink>"
        f"{DYNAMICS}"
    ),
    "poses to follow, UDP": ("<u:followPose> <u:mavlinkPort>PORT</u:mavlinkPort> </u:followPose>"),
    "PX4, connections": (
        f"<u:px4> <relativeTo>base_link</relativeTo> <port>PORT</port> </u:px4> {DYNAMICS}"
    ),
}
"""The elements of the vehicle, by the kind of the port."""
FLOOD = """
import os, socket, sys, time
kind, port = sys.argv[1], int(sys.argv[2])
if kind == "UDP":
    flood = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    data = [os.urandom(1400) for _ in range(50)]
    n = 0
    while True:
        try:
            flood.sendto(data[n % 50], ("127.0.0.1", port))
        except OSError:
            pass
        n += 1
data = os.urandom(65536)
while True:
    try:
        with socket.create_connection(("127.0.0.1", port)) as flood:
            flood.settimeout(0.5)
            while kind == "TCP":
                flood.sendall(data)
            flood.sendall(data[:100])
    except OSError:
        time.sleep(0.001)
"""
PX4 = """
import socket, sys, time
from pymavlink.dialects.v20 import common
while True:
    try:
        connection = socket.create_connection(("127.0.0.1", int(sys.argv[1])))
        break
    except OSError:
        time.sleep(0.05)
connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
link = common.MAVLink(None, srcSystem=1, srcComponent=1)
connection.sendall(link.heartbeat_encode(0, 12, 0, 0, 0).pack(link))
while data := connection.recv(4096):
    for message in link.parse_buffer(data) or []:
        if message.get_type() == "HIL_SENSOR":
            answer = link.hil_actuator_controls_encode(message.time_usec, [0.1] * 16, 129, 1)
            connection.sendall(answer.pack(link))
"""
N_STEPS, N_WARM_UP, ROUNDS, TIMESTEP = 10_000, 200, 3, 0.002
START_TIME = 0.5
"""The wall time in which the process of the flood starts [s]."""
RATE_TARGET = 0.98


def free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as probe:
        port: int = probe.getsockname()[1]
        return port


def start(code: str, *arguments: object) -> subprocess.Popen[bytes]:
    words = [sys.executable, "-c", code, *map(str, arguments)]
    return subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def open_sink(kind: str) -> socket.socket:
    """Return a port that nobody reads."""
    if not kind.endswith("UDP"):
        return socket.create_server(("127.0.0.1", 0))
    sink = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    sink.bind(("127.0.0.1", 0))
    return sink


def count_invalid(device: object) -> int:
    """Return the number of bytes and messages that a device has counted as invalid."""
    if isinstance(device, ActuatorStream):
        return device.state.n_invalid + device.state.n_skipped
    if isinstance(device, MavlinkDevice):
        return device.state.link.reader.n_invalid_bytes
    if isinstance(device, PoseFollower) and device.state.mavlink is not None:
        return device.state.mavlink.stream.n_invalid_bytes
    return 0


def run(kind: str, *, is_flooded: bool) -> dict[str, float]:
    """Run the steps with a flood at the port, or beside one at a port that nobody reads."""
    port, lines = free_port(), StringIO()
    with ExitStack() as stack:
        stack.enter_context(redirect_stderr(lines))
        path = Path(stack.enter_context(TemporaryDirectory()), "scene.xml")
        path.write_text(SCENE.replace("PARTS", PARTS[kind].replace("PORT", str(port))))
        sink = stack.enter_context(open_sink(kind))
        simulation = stack.enter_context(uwsim.load(path, udp_address="127.0.0.1"))
        if kind.startswith("PX4"):
            stack.callback(start(PX4, port).kill)
            simulation.advance()  # PX4 is connected
        flood = start(FLOOD, kind.split()[-1], port if is_flooded else sink.getsockname()[1])
        stack.callback(flood.kill)
        time.sleep(START_TIME)
        simulation.advance(N_WARM_UP * TIMESTEP)
        wall, cpu = time.perf_counter(), time.process_time()
        simulation.advance(N_STEPS * TIMESTEP)
        cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
        n_counted = sum(map(count_invalid, simulation.world.devices))
    n_counted += sum(map(int, re.findall(r"(\d+) datagrams", lines.getvalue())))
    return {"wall": wall, "cpu": cpu, "counted": n_counted}


def compare(kind: str) -> dict[str, object]:
    """Alternate both runs; return the rates of the flooded one per that of the other."""
    runs: dict[bool, list[dict[str, float]]] = {True: [], False: []}
    for _ in range(ROUNDS):
        for is_flooded, figures in runs.items():
            figures.append(run(kind, is_flooded=is_flooded))
    ratios = {
        name: min(f[name] for f in runs[False]) / min(f[name] for f in runs[True])
        for name in ("wall", "cpu")
    }
    return {
        "rate_ratio": lower_target_figure(ratios["wall"], RATE_TARGET),
        "rate_ratio_by_cpu": round(ratios["cpu"], 3),
        "step_cpu_us": round(1e6 * min(f["cpu"] for f in runs[True]) / N_STEPS, 1),
        "quiet_step_cpu_us": round(1e6 * min(f["cpu"] for f in runs[False]) / N_STEPS, 1),
        "counted": max(f["counted"] for f in runs[True]),
    }


def measure() -> dict[str, object]:
    """Measure all kinds of ports; ArduPilot's as `benchmarks/ardupilot.py` does."""
    figures: dict[str, object] = {kind: compare(kind) for kind in PARTS}
    baselines = [ardupilot.exchange(N_STEPS, flood="unread port") for _ in range(ROUNDS)]
    floods = [ardupilot.exchange(N_STEPS, flood="port") for _ in range(ROUNDS)]
    ratios = {
        name: min(f[name] for f in baselines) / min(f[name] for f in floods)
        for name in ("wall_us", "cpu_us")
    }
    figures["ArduPilot, UDP"] = {
        "rate_ratio": lower_target_figure(ratios["wall_us"], RATE_TARGET),
        "rate_ratio_by_cpu": round(ratios["cpu_us"], 3),
        "step_cpu_us": round(min(f["cpu_us"] for f in floods), 1),
        "counted": max(f["other_senders"] for f in floods),
    }
    return figures


if __name__ == "__main__":
    main(measure)
