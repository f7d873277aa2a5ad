"""The exchange with ArduPilot in lock-step: each frame is one step, also after a loss."""

from __future__ import annotations

import math
import socket
import struct
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import pytest

from tests.support.ardupilot_stub import NEUTRAL_WIDTHS, State, Stub, free_port
from tests.support.opened import open_scene
from uwsim.assets.bundled import bundled_files
from uwsim.devices.ardupilot import ArduPilotLink
from uwsim.errors import ClientLost, UwsimError
from uwsim.scene.reader import read_scene
from uwsim.scene.settings import apply_setting
from uwsim.simulation import Simulation

TIMESTEP = 0.0025
SCENE = bundled_files("scenes")["bluerov2-scene"]


@contextmanager
def opened(port: int, **settings: object) -> Iterator[Simulation]:
    scene = read_scene(SCENE)
    for name, value in {"port": port, **settings}.items():
        scene = apply_setting(scene, f"vehicle[bluerov2].ardupilot.{name}", str(value))
    with open_scene(scene, timestep=TIMESTEP, udp_address="127.0.0.1", is_blind=True) as simulation:
        yield simulation


def link_of(simulation: Simulation) -> ArduPilotLink:
    (link,) = [part for part in simulation.world.devices if isinstance(part, ArduPilotLink)]
    return link


def descend(state: State) -> list[int]:
    """Return pulse widths that push down, more at the surface, with a turn of the heading."""
    depth = state["position"][2] if state else 1.5
    width = 1500 + round(400 * math.tanh(2.0 - depth))
    return [1520, 1480, 1480, 1520, *[width] * 4]


def times_of(stub: Stub) -> list[float]:
    return [state["timestamp"][0] for state in stub.states]


def test_each_frame_is_one_exchange_at_400_hz() -> None:
    port = free_port()
    with opened(port) as simulation, Stub(port, descend) as stub:
        simulation.advance(0.5)
        stub.max_answers = 0
        assert np.allclose(times_of(stub)[:199], TIMESTEP * np.arange(1, 200), atol=1e-12)
        exchange = link_of(simulation).state.exchange
        assert exchange.n_exchanges == 200
        assert (exchange.n_lost, exchange.n_restarts, exchange.n_invalid) == (0, 0, 0)


def test_two_runs_have_the_same_bytes() -> None:
    digests = []
    for _ in range(2):
        port = free_port()
        with opened(port) as simulation, Stub(port, descend, timeout=30.0) as stub:
            simulation.advance(1.0)
            digests.append(pose_bytes(simulation))
            states = stub.states[:390]
        digests.append(repr(states).encode())
    assert digests[:2] == digests[2:]


def pose_bytes(simulation: Simulation) -> bytes:
    pose = simulation.pose("bluerov2")
    return pose.position.tobytes() + pose.rotation.tobytes()


def test_lost_packets_and_answers_lose_no_step() -> None:
    port = free_port()
    with opened(port) as simulation:
        stub = Stub(port, descend, loss=0.05, timeout=0.02)
        with stub:
            simulation.advance(2.0)
        exchange = link_of(simulation).state.exchange
    times = times_of(stub)
    steps = np.rint(np.array(times) / TIMESTEP).astype(int)
    assert stub.n_repeats > 20
    assert exchange.n_duplicates > 0
    assert set(range(1, len(set(steps)) + 1)) == set(steps)  # none is missing
    assert exchange.n_exchanges == 800


def test_lossy_and_lossless_runs_move_alike() -> None:
    poses = []
    for loss in (0.0, 0.05):
        port = free_port()
        with opened(port) as simulation:
            with Stub(port, descend, loss=loss, timeout=30.0 if loss == 0.0 else 0.5):
                simulation.advance(0.25)
            poses.append(pose_bytes(simulation))
    assert poses[0] == poses[1]


def test_32_channels_are_read() -> None:
    port = free_port()
    with opened(port) as simulation, Stub(port, lambda state: NEUTRAL_WIDTHS, n_channels=32):
        simulation.advance(0.1)
        assert len(link_of(simulation).state.exchange.pwm) == 32


def test_a_new_start_of_ardupilot_continues_or_ends_the_run() -> None:
    port = free_port()
    with opened(port) as simulation, Stub(port, descend, restart_at=50, timeout=0.3):
        simulation.advance(0.5)
        assert link_of(simulation).state.exchange.n_restarts == 1
    port = free_port()
    with (
        opened(port, onRestart="end") as simulation,
        Stub(port, descend, restart_at=50, timeout=0.3),
        pytest.raises(ClientLost, match="was started again: the run is invalid"),
    ):
        simulation.advance(0.5)


def test_a_new_start_sets_the_vehicle_back_and_time_goes_on(
    capsys: pytest.CaptureFixture[str],
) -> None:
    port = free_port()
    with (
        opened(port, onRestart="reset") as simulation,
        Stub(port, descend, restart_at=300, timeout=0.3) as stub,
    ):
        simulation.advance(1.0)
    depths = [state["position"][2] for state in stub.states]
    times = times_of(stub)
    assert depths[299] > 1.51
    assert depths[302] == pytest.approx(1.5, abs=1e-4)
    assert times == sorted(times)
    assert "was started again; the vehicle is back at its start." in capsys.readouterr().err


def send_packet(sender: socket.socket, port: int, count: int) -> None:
    packet = struct.pack("<HHI16H", 18458, 400, count, *[1500] * 16)
    sender.sendto(packet, ("127.0.0.1", port))


def test_a_new_ardupilot_replaces_an_old_one_that_fell_silent(
    capsys: pytest.CaptureFixture[str],
) -> None:
    port = free_port()
    old_program = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    with opened(port, timeout=20.0) as simulation, old_program:
        send_packet(old_program, port, 24000)
        simulation.advance(TIMESTEP)
        with Stub(port, descend, timeout=0.3):
            start = time.monotonic()
            simulation.advance(0.1)
            assert time.monotonic() - start < 10.0
        exchange = link_of(simulation).state.exchange
        assert (exchange.n_restarts, exchange.first_count) == (1, 0)
        assert exchange.n_lost == 0
    assert "16 channels; it was running before, at frame 24000" in capsys.readouterr().err


def test_the_silence_of_an_old_ardupilot_names_the_remedy() -> None:
    port = free_port()
    with (
        opened(port, timeout=0.5) as simulation,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as old_program,
    ):
        send_packet(old_program, port, 24000)
        with pytest.raises(ClientLost, match=r"an old ArduPilot holds its ports.* kill -9"):
            simulation.advance(0.1)


def test_a_silent_ardupilot_ends_the_run() -> None:
    port = free_port()
    with opened(port, timeout=0.5) as simulation:
        start = time.monotonic()
        with pytest.raises(ClientLost, match=r"has sent nothing to UDP 127\.0\.0\.1"):
            simulation.advance(1.0)
        with (
            Stub(port, descend, max_answers=40),
            pytest.raises(ClientLost, match=r"is silent for 0\.5 s of wall time .* at 0\.1"),
        ):
            simulation.advance(1.0)
        assert time.monotonic() - start < 30.0


def test_without_connections_the_element_has_no_effect() -> None:
    with open_scene(read_scene(SCENE), timestep=TIMESTEP, is_blind=True) as simulation:
        assert not [d for d in simulation.world.devices if isinstance(d, ArduPilotLink)]
        simulation.advance(0.1)


def test_hostile_datagrams_neither_stop_nor_slow_the_exchange() -> None:
    port = free_port()
    bad = [b"", b"x", bytes(40), bytes(72), bytes(2000), struct.pack("<HHI16H", 18458, *range(18))]
    with opened(port) as simulation, Stub(port, descend):
        simulation.advance(0.05)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as attacker:
            for i in range(5000):
                attacker.sendto(bad[i % len(bad)], ("127.0.0.1", port))
            simulation.advance(0.5)
        exchange = link_of(simulation).state.exchange
        n_counted = exchange.n_others + exchange.n_dropped
        assert n_counted > (4000 if sys.platform == "linux" else 100)
        assert exchange.n_exchanges == 220
        assert (exchange.n_invalid, exchange.n_restarts) == (0, 0)
        assert "of other senders" in link_of(simulation).describe()


def test_invalid_datagrams_before_the_first_packet_are_counted() -> None:
    port = free_port()
    with opened(port) as simulation:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as attacker:
            for size in (0, 39, 41, 72, 40):
                attacker.sendto(bytes(size), ("127.0.0.1", port))
        with Stub(port, descend):
            simulation.advance(0.05)
        assert link_of(simulation).state.exchange.n_invalid == 5


def test_a_motion_that_is_not_finite_ends_the_run(monkeypatch: pytest.MonkeyPatch) -> None:
    port = free_port()
    with opened(port) as simulation, Stub(port, descend):
        link: Any = link_of(simulation)
        monkeypatch.setattr(
            "uwsim.devices.ardupilot.link.split_sample",
            lambda values: ([math.nan] * 3, [1.0, 0.0, 0.0, 0.0], *[[0.0] * 3] * 3),
        )
        with pytest.raises(UwsimError, match=r"The position .* cannot be sent to ArduPilot"):
            simulation.advance(0.1)
        assert link.state.exchange.n_exchanges == 0


def test_a_saved_state_has_the_numbers_of_the_exchange() -> None:
    port = free_port()
    with opened(port) as simulation, Stub(port, descend):
        simulation.advance(0.1)
        saved, n = simulation.save(), link_of(simulation).state.exchange.n_exchanges
        pose = pose_bytes(simulation)
        simulation.advance(0.1)
        assert link_of(simulation).state.exchange.n_exchanges == n + 40
        simulation.restore(saved)
        assert link_of(simulation).state.exchange.n_exchanges == n
        assert pose_bytes(simulation) == pose
        simulation.advance(0.1)  # ArduPilot sees a time that goes back, and continues
        assert link_of(simulation).state.exchange.n_exchanges == n + 40
