"""``uwsim run SCENE --ardupilot``: the ports, the default element, the counts, and the ends."""

from __future__ import annotations

import signal
import socket
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

import uwsim as package
from tests.support.ardupilot_stub import Stub, free_port
from tests.support.pid_autopilot import PidAutopilot, square_path
from uwsim.assets.bundled import bundled_files
from uwsim.cli import main as uwsim
from uwsim.devices.ardupilot import ArduPilotSpec
from uwsim.errors import BadSetting
from uwsim.runs.planning.ardupilot_scene import (
    ardupilot_specs,
    connect_ardupilot,
    exchange_timestep,
)
from uwsim.scene.reader import read_scene

Captured = pytest.CaptureFixture[str]


def run(*words: str, port: int) -> int:
    setting = f"vehicle[bluerov2].ardupilot.port={port}"
    return uwsim(["run", "bluerov2-scene", "--ardupilot", "--set", setting, *words])


def test_a_run_ends_with_the_number_of_frames(capsys: Captured) -> None:
    port = free_port()
    with Stub(port) as stub:
        assert run("--for", "250ms", port=port) == 0
    captured = capsys.readouterr()
    assert "0.25 s of bluerov2-scene.xml, 100 steps" in captured.out
    assert f"ArduPilot on UDP 127.0.0.1:{port}: 100 frames" in captured.err
    assert 98 < stub.n_frames < 102


def test_a_run_that_waits_in_vain_states_how_to_start_ardupilot(capsys: Captured) -> None:
    port = free_port()
    limit = "vehicle[bluerov2].ardupilot.timeout=0.5"
    assert run("--for", "1s", "--set", limit, port=port) != 0
    error = capsys.readouterr().err
    assert f"waiting for ArduPilot on UDP 127.0.0.1:{port}. Start it, for example: sim_" in error
    assert "has sent nothing to UDP" in error


def test_ctrl_c_ends_a_run_that_waits() -> None:
    setting = f"vehicle[bluerov2].ardupilot.port={free_port()}"
    words = [
        sys.executable,
        "-m",
        "uwsim",
        "run",
        "bluerov2-scene",
        "--ardupilot",
        "--set",
        setting,
    ]
    with subprocess.Popen(words, stderr=subprocess.PIPE, text=True) as process:
        assert process.stderr is not None
        lines = iter(process.stderr.readline, "")
        assert any("waiting for ArduPilot" in line for line in lines)
        process.send_signal(signal.SIGINT)
        assert process.wait(timeout=20.0) == 130


def test_an_occupied_port_is_an_error(capsys: Captured) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.bind(("127.0.0.1", 0))
        port = other.getsockname()[1]
        assert run("--for", "1s", port=port) != 0
    assert f"UDP port {port} of 127.0.0.1 cannot be opened" in capsys.readouterr().err


def test_a_scene_without_the_element_gets_one_in_its_first_vehicle_with_dynamics() -> None:
    scene = read_scene(bundled_files("scenes")["remus-scene"])
    (spec,) = ardupilot_specs(connect_ardupilot(scene))
    assert spec == ArduPilotSpec()
    assert spec.udp_port == 9002
    assert list(ardupilot_specs(scene)) == []


def test_a_scene_without_dynamics_cannot_be_steered() -> None:
    scene = read_scene(bundled_files("scenes")["visibility-scene"])
    with pytest.raises(BadSetting, match="no vehicle of the scene has <u:dynamics>"):
        connect_ardupilot(scene)


def test_two_vehicles_need_two_instances() -> None:
    scene = read_scene(bundled_files("scenes")["bluerov2-scene"])
    (vehicle,) = scene.vehicles
    scene = replace(scene, vehicles=(vehicle, replace(vehicle, name="second")))
    with pytest.raises(
        BadSetting, match=r"UDP port 9002 is that of <u:ardupilot> of .* an <instance> each"
    ):
        connect_ardupilot(scene)


@pytest.mark.parametrize(
    ("rate", "timestep"), [(400.0, 1 / 400), (500.0, 1 / 500), (100.0, 1 / 500), (1200.0, 1 / 1200)]
)
def test_the_step_is_near_the_usual_one(rate: float, timestep: float) -> None:
    scene = read_scene(bundled_files("scenes")["remus-scene"])
    (vehicle,) = scene.vehicles
    vehicle = replace(vehicle, parts=(*vehicle.parts, ArduPilotSpec(rate=rate)))
    assert exchange_timestep(replace(scene, vehicles=(vehicle,))) == pytest.approx(timestep)


def test_a_recording_is_kept_when_ardupilot_falls_silent(tmp_path: Path) -> None:
    port, recording = free_port(), tmp_path / "run.mcap"
    limit = "vehicle[bluerov2].ardupilot.timeout=0.5"
    with Stub(port, max_answers=100):
        words = ["--for", "1s", "--set", limit, "--record", str(recording), "--images", "none"]
        assert run(*words, port=port) != 0
    assert recording.stat().st_size > 1000


def test_a_recording_holds_the_commands_that_ardupilot_applied(tmp_path: Path) -> None:
    port, recording = free_port(), tmp_path / "run.mcap"
    with Stub(port, PidAutopilot(square_path(0.5, 1.5, 0.2)), timeout=30.0):
        words = ["--for", "5s", "--record", str(recording), "--images", "none"]
        assert run(*words, port=port) == 0
    gap = package.gap(recording, "bluerov2-scene", windows=3, horizons=(1,), attribution=False)
    (horizon,) = gap.horizons
    assert horizon.distance.value < 2e-3  # with steps of 2 ms instead of 2.5 ms [m]
    assert horizon.distance.value < 0.02 * horizon.path_length
