"""The controller of examples/hardware holds a depth over serial lines, in a process of its own."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory

EXAMPLE = Path(__file__).parents[2] / "examples" / "hardware"
UWSIM = [sys.executable, "-m", "uwsim"]


def find_free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as probe:
        port: int = probe.getsockname()[1]
    return port


@pytest.mark.slow
def test_a_controller_on_serial_lines_dives_to_its_depth(tmp_path: Path) -> None:
    text = (EXAMPLE / "scene.xml").read_text()
    program = (EXAMPLE / "depth_hold.py").read_text()
    # the ports of the page may be in use on this computer
    for port in ("9111", "9112"):
        other_port = str(find_free_port())
        text, program = text.replace(port, other_port), program.replace(port, other_port)
    (tmp_path / "scene.xml").write_text(text)
    (tmp_path / "depth_hold.py").write_text(program)
    run = [*UWSIM, "run", "scene.xml", "--strict", "--for", "8s", "--record", "run.mcap"]
    run += ["--deadline", "500"]  # a busy computer is late, but nothing may be missing
    with subprocess.Popen(
        run, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as simulation:
        deadline = time.monotonic() + 60.0
        while not os.path.lexists(tmp_path / "thruster-line"):
            assert time.monotonic() < deadline
            assert simulation.poll() is None
            time.sleep(0.05)
        controller = [sys.executable, "depth_hold.py", "depth-line", "thruster-line", "2.0"]
        with subprocess.Popen(controller, cwd=tmp_path, stdout=subprocess.PIPE, text=True) as hold:
            output, errors = simulation.communicate(timeout=100)
            lines, _ = hold.communicate(timeout=20)
    rows = {line.split()[0]: line.split() for line in output.splitlines() if line}
    assert "depth_line: ISDPT to /dev/" in errors
    assert int(rows["thrusters"][2]) > 20
    for name in ("depth_line", "compass_line", "dvl_line"):
        n_sent, _, _, n_missing, n_unread = map(int, rows[name][2:7])
        assert n_sent + n_unread in ((159, 160) if name == "compass_line" else (79, 80))
        assert n_missing == 0  # nobody has left
    assert rows["input"][3] == rows["thrusters"][2]  # each command states the measurement's time
    assert "pings" in lines
    assert hold.returncode == 0
    # on a computer that stands still for a second, the controller misses some
    is_in_time = ": 0 late or missing" in output
    assert simulation.returncode == (0 if is_in_time else 3), output
    with (tmp_path / "run.mcap").open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        depths = [m.pressure for _, _, _, m in reader.iter_decoded_messages(topics=["/rov/depth"])]
    assert depths[0] == pytest.approx(0.5, abs=0.05)
    assert depths[-1] > 1.0
