"""A real ArduSub against the simulation, for the tests behind ``UWSIM_ARDUSUB``.

MAVLink is sent while ArduSub waits for an answer, at given frames, so that runs can be the same.
"""

from __future__ import annotations

import os
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from tests.support.opened import open_scene
from tests.support.px4_stub import find_free_port
from uwsim.assets.bundled import bundled_files
from uwsim.base.geometry import Array
from uwsim.devices.ardupilot import ArduPilotLink
from uwsim.devices.ardupilot.exchange import Exchange
from uwsim.scene.reader import read_scene
from uwsim.scene.settings import apply_setting
from uwsim.scene.spec import SceneSpec
from uwsim.simulation import Simulation

VARIABLE = "UWSIM_ARDUSUB"
"""The environment variable with the path of an ArduSub that was built for ``--board sitl``."""
RATE = 400
"""The rate of frames [Hz]."""
MANUAL_MODE, STABILIZE, ALT_HOLD, POSHOLD = 19, 0, 2, 16
"""The numbers of ArduSub's modes."""
PARAMETERS = {
    "FRAME_CONFIG": 2,  # vectored_6dof
    **{f"COMPASS_OFS{i}_X": 5 for i in ("", 2, 3)},  # those of the simulated compasses
    **{f"COMPASS_OFS{i}_Y": 13 for i in ("", 2, 3)},
    **{f"COMPASS_OFS{i}_Z": -18 for i in ("", 2, 3)},
    **{f"INS_ACC{i}OFFS_{axis}": 0.001 for i in ("", 2) for axis in "XYZ"},
    **{f"INS_ACC{i}SCAL_{axis}": 1.001 for i in ("", 2) for axis in "XYZ"},
    # no noise, of which two threads draw in the order that the system chooses; and no log
    **{f"SIM_{name}_RND": 0 for name in ("BARO", "BAR2", "ACC1", "ACC2", "GYR1", "GYR2", "MAG")},
    "SIM_SONAR_RND": 0,
    "SIM_GPS1_ENABLE": 0,
    "GPS1_TYPE": 0,
    "LOG_BACKEND_TYPE": 0,
    # navigation by the DVL
    "VISO_TYPE": 1,
    "EK3_SRC1_POSXY": 0,
    "EK3_SRC1_VELXY": 6,
    "EK3_SRC1_VELZ": 0,
    "EK3_SRC1_POSZ": 1,
    "EK3_SRC1_YAW": 1,
}
"""The parameters of ArduSub."""


@dataclass(frozen=True, kw_only=True)
class Order:
    """A command of the pilot, from a time on."""

    time: float
    """The simulation time [s]."""
    mode: int | None = None
    """The mode to set."""
    is_arming: bool = False
    """True if the vehicle is armed."""
    sticks: tuple[int, int, int, int] = (0, 0, 500, 0)
    """The x, y, z and r of MANUAL_CONTROL; 0, 0, 500, 0 is neutral."""


@dataclass
class Trial:
    """The record of a run with ArduSub."""

    packets: list[bytes] = field(default_factory=list)
    """The servo packets in the order of frames, without repeated ones."""
    answers: list[bytes] = field(default_factory=list)
    """The answers to them."""
    poses: list[tuple[float, Array, Array]] = field(default_factory=list)
    """The time [s], the position in NED (3,) [m] and the axes of the base in NED, at 10 Hz."""
    texts: list[str] = field(default_factory=list)
    """The texts that ArduSub has sent."""
    messages: dict[str, Any] = field(default_factory=dict)
    """The last message of each kind that ArduSub has sent."""

    def positions(self, start: float, end: float) -> Array:
        """Return the positions between two times [s], (n, 3) [m]."""
        return np.array([position for time, position, _ in self.poses if start <= time < end])

    def headings(self, start: float, end: float) -> Array:
        """Return the headings between two times [s], (n,) [rad]."""
        axes = np.array([rotation[:, 0] for time, _, rotation in self.poses if start <= time < end])
        return np.unwrap(np.arctan2(axes[:, 1], axes[:, 0]))


def scene_at(port: int, mavlink_port: int) -> SceneSpec:
    """Return the bundled scene with ArduPilot at a port, and MAVLink at another UDP port."""
    scene = read_scene(bundled_files("scenes")["bluerov2-scene"])
    address = f"udpin:127.0.0.1:{mavlink_port}"
    for name, value in {"ardupilot.port": str(port), "mavlink.address": address}.items():
        scene = apply_setting(scene, f"vehicle[bluerov2].{name}", value)
    return scene


def fly(
    orders: list[Order], duration: float, *, parameters: dict[str, float] | None = None
) -> Trial:
    """Run ArduSub with the orders of a pilot in the bundled scene; return the record.

    Args:
        orders: the orders, by time.
        duration: the simulation time of the run [s].
        parameters: the parameters of ArduSub besides `PARAMETERS`.
    """
    from pymavlink import mavutil

    port, pilot_port, device_port = (find_free_port() for _ in range(3))
    spec = scene_at(port, device_port)
    trial = Trial()
    pilot = mavutil.mavlink_connection(f"udpin:127.0.0.1:{pilot_port}", source_system=255)
    serial_ports = [f"udpclient:127.0.0.1:{number}" for number in (pilot_port, device_port)]
    simulation = open_scene(spec, timestep=1.0 / RATE, udp_address="127.0.0.1", is_blind=True)
    with simulation, run_ardusub(port, serial_ports, {**PARAMETERS, **(parameters or {})}):
        (link,) = [part for part in simulation.world.devices if isinstance(part, ArduPilotLink)]
        record_exchange(link._exchange, trial)
        steer_at_packets(link._exchange, pilot, orders, trial)
        for _ in range(round(10 * duration)):
            simulation.advance(0.1)
            trial.poses.append(ned_pose(simulation))
    pilot.close()
    return trial


def record_exchange(exchange: Exchange, trial: Trial) -> None:
    """Record the packets and the answers of an exchange."""
    send_answer = exchange.send_answer

    def record(answer: bytes) -> None:
        state = exchange.state
        head = (18458).to_bytes(2, "little") + RATE.to_bytes(2, "little")
        count = (state.frame_count or 0).to_bytes(4, "little")
        pwm = b"".join(width.to_bytes(2, "little") for width in state.pwm)
        trial.packets.append(head + count + pwm)
        trial.answers.append(answer)
        send_answer(answer)

    exchange.send_answer = record  # type: ignore[method-assign]


def steer_at_packets(exchange: Exchange, pilot: Any, orders: list[Order], trial: Trial) -> None:
    """Send the orders after the packets of their times, when ArduSub waits for an answer."""
    wait_for_packet = exchange.wait_for_packet
    later_orders = sorted(orders, key=lambda order: order.time)
    last_order = [Order(time=0.0)]
    count = [0]

    def wait(time: float) -> None:
        wait_for_packet(time)
        while (message := pilot.recv_match(blocking=False)) is not None:
            trial.messages[message.get_type()] = message
            if message.get_type() == "STATUSTEXT":
                trial.texts.append(message.text)
        if time >= 1.0 and count[0] % (RATE // 2) == 0:
            pilot.mav.heartbeat_send(6, 8, 0, 0, 0)
        while later_orders and time >= later_orders[0].time:
            order = last_order[0] = later_orders.pop(0)
            if order.mode is not None:
                pilot.mav.set_mode_send(1, 1, order.mode)
            if order.is_arming:
                pilot.mav.command_long_send(1, 1, 400, 0, 1, 0, 0, 0, 0, 0, 0)
        if time >= 15.0 and count[0] % (RATE // 20) == 0:
            pilot.mav.manual_control_send(1, *last_order[0].sticks, 0)
        count[0] += 1

    exchange.wait_for_packet = wait  # type: ignore[method-assign]


def ned_pose(simulation: Simulation) -> tuple[float, Array, Array]:
    """Return the time, the position in NED and the axes of the base in NED."""
    pose = simulation.world.vehicles.find("bluerov2").world_from_base
    ned_from_world = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
    return simulation.time, ned_from_world @ pose.position, ned_from_world @ pose.rotation


@contextmanager
def run_ardusub(
    port: int, serial_ports: list[str], parameters: dict[str, float]
) -> Iterator[subprocess.Popen[bytes]]:
    """Start ArduSub with wiped parameters in a new folder, and kill it at the end."""
    binary = Path(os.environ[VARIABLE]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        defaults = Path(folder) / "defaults.parm"
        defaults.write_text("".join(f"{name} {value}\n" for name, value in parameters.items()))
        command = [str(binary), "--wipe", "--model", "JSON:127.0.0.1", "--rate", str(RATE)]
        command += ["--speedup", "20", "--defaults", str(defaults), "--sim-port-out", str(port)]
        command += ["--home", "41.9616,2.8353,0,0", "--start-time", "1700000000"]
        for i, address in enumerate(serial_ports):
            command += [f"--serial{i}", address]
        with open(Path(folder) / "output.txt", "wb") as output:
            process = subprocess.Popen(command, cwd=folder, stdout=output, stderr=output)
            try:
                yield process
            finally:
                process.kill()
                process.wait()
