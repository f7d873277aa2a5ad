"""``uwsim run --strict``: late data is an error that is counted, and results are kept."""

from __future__ import annotations

import json
import socket
import threading
import time
from pathlib import Path

import pytest

from tests.devices.streams.stream_scenes import SCENE, instrument, open_streams, record_bytes
from uwsim.autopilots.instruments.commands import ThrusterCommands
from uwsim.autopilots.instruments.rdi_pd4 import read_pd4
from uwsim.cli import main
from uwsim.middleware.strict import StrictClock

SLEEPER = """
import time

class Sleeper:
    def start(self, node):
        node.create_timer(0.2, lambda: time.sleep(0.08))
"""


def write_scene(folder: Path, streams: str) -> str:
    path = folder / "scene.xml"
    path.write_text(SCENE.format(streams=streams, depth=1.5, x=2.0))
    return str(path)


def test_a_program_that_sleeps_makes_late_steps_and_the_recording_is_kept(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "sleeper.py").write_text(SLEEPER)
    recording, plot = tmp_path / "run.mcap", tmp_path / "delays.png"
    options = ["--program", str(tmp_path / "sleeper.py"), "--record", str(recording), "--json"]
    options += ["--latency", str(plot)]
    scene = write_scene(tmp_path, "")
    status = main(["run", scene, "--strict", "--for", "1s", "--deadline", "50", *options])
    output = capsys.readouterr()
    assert status == 3
    assert "late by more than 50 ms and 0 missing; the table shows which" in output.err
    report = json.loads(output.out)["strict"]
    steps = report["streams"][0]
    assert steps["late"] >= 4
    assert steps["number"] == steps["on_time"] + steps["late"] == 499
    assert 0.05 < steps["lateness"]["worst"] < 1.0
    assert sum(row[2] for row in steps["lateness"]["histogram"]) + steps["lateness"]["early"] == 499
    assert report["delays"]["step_time"]["worst"] > 0.08
    assert recording.stat().st_size > 10_000
    assert plot.read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"


def test_a_topic_that_is_expected_and_published_too_slowly_is_reported(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = write_scene(tmp_path, "")
    options = ["--for", "1s", "--deadline", "45", "--json", "--hz", "--expect", "/dvl=40"]
    status = main(["run", scene, "--strict", *options])  # the DVL has 10 Hz
    report = json.loads(capsys.readouterr().out)["strict"]
    topic = report["streams"][1]
    assert status == 3
    assert (topic["name"], topic["kind"], topic["rate"]) == ("/dvl", "input", 40.0)
    assert topic["number"] == 10
    assert topic["late"] >= 8
    assert topic["missing"] >= 15


class Hardware:
    """A program outside that answers each ping of a DVL with a command, and once pauses."""

    def __init__(self, dvl_port: int, thruster_port: int, *, pause: float) -> None:
        self._receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._receiver.bind(("127.0.0.1", dvl_port))
        self._receiver.settimeout(0.2)
        self._sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._target, self._pause = ("127.0.0.1", thruster_port), pause
        self._is_ending = threading.Event()
        self._thread = threading.Thread(target=self._answer)
        self._thread.start()

    def _answer(self) -> None:
        n = 0
        while not self._is_ending.is_set():
            try:
                read_pd4(self._receiver.recv(100))
            except TimeoutError:
                continue
            n += 1
            if n == 10:
                time.sleep(self._pause)
            data = ThrusterCommands(values=(0.1,) * 8, time_us=None).to_sentence().to_bytes()
            self._sender.sendto(data, self._target)

    def close(self) -> None:
        self._is_ending.set()
        self._thread.join()
        self._receiver.close()
        self._sender.close()


def free_ports() -> tuple[int, int]:
    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as first,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as second,
    ):
        first.bind(("127.0.0.1", 0))
        second.bind(("127.0.0.1", 0))
        return first.getsockname()[1], second.getsockname()[1]


def test_hardware_that_pauses_is_reported_with_the_missing_commands(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    dvl_port, thruster_port = free_ports()
    streams = instrument(
        "PD4", "/dvl", name="dvl", more=f"<address>udpout:127.0.0.1:{dvl_port}</address>"
    ) + (
        f"<u:actuatorStream> <name>thrusters</name> <rate>10</rate>"
        f"<address>udpin:127.0.0.1:{thruster_port}</address> </u:actuatorStream>"
    )
    hardware = Hardware(dvl_port, thruster_port, pause=0.55)
    try:
        scene = write_scene(tmp_path, streams)
        status = main(["run", scene, "--strict", "--for", "3s", "--deadline", "90"])
    finally:
        hardware.close()
    output = capsys.readouterr()
    assert status == 3
    rows = {line.split()[0]: line.split() for line in output.out.splitlines() if line}
    assert rows["dvl"][1:3] == ["output", "30"]
    assert rows["thrusters"][1] == "input"
    assert int(rows["thrusters"][5]) >= 4  # missing during the pause
    assert float(rows["thrusters"][-1]) > 400.0  # the worst lateness [ms]
    assert f"dvl: PD4 to udpout:127.0.0.1:{dvl_port}" in output.err


def test_the_bytes_of_a_strict_run_are_those_of_a_free_run(tmp_path: Path) -> None:
    stream = instrument("PD6 PD4", "/dvl", more="<bitRate>19200</bitRate>")

    def run(*, is_strict: bool) -> list[tuple[float, bytes]]:
        with open_streams(tmp_path, stream) as simulation:
            messages = record_bytes(simulation)
            if is_strict:
                clock = StrictClock(lambda: simulation.time, 4.0)
                simulation.watch(clock.step)
            simulation.advance(1.0)
        return messages

    assert run(is_strict=True) == run(is_strict=False)


@pytest.mark.parametrize(
    ("options", "problem"),
    [
        (["--deadline", "5"], "--deadline needs --strict"),
        (["--latency", "a.png"], "--latency needs --strict"),
        (["--strict", "--latency", "a.pdf"], "expected a name that ends with .png"),
        (["--strict", "--deadline", "0"], "expected a time > 0"),
        (["--strict", "--speed", "0"], "--speed 0 is not"),
        (["--expect", "/topic=20"], "--expect needs --strict"),
        (["--strict", "--expect", "/topic"], "expected TOPIC=HZ with a rate"),
    ],
)
def test_options_that_contradict_each_other_are_errors(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], options: list[str], problem: str
) -> None:
    assert main(["run", write_scene(tmp_path, ""), "--for", "1s", *options]) == 2
    assert problem in capsys.readouterr().err


def test_without_an_option_no_autopilot_is_waited_for(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = write_scene(tmp_path, "<u:ardupilot/> <u:px4> <name>px4</name> </u:px4>")
    main(["run", scene, "--strict", "--for", "0.2s"])
    assert "waiting for" not in capsys.readouterr().err
