"""The controller of examples/hardware holds a depth over serial lines, in a process of its own."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory

EXAMPLE = Path(__file__).parents[2] / "examples" / "hardware"
UWSIM = [sys.executable, "-m", "uwsim"]


@pytest.mark.slow
def test_a_controller_on_serial_lines_dives_to_its_depth(tmp_path: Path) -> None:
    text = (EXAMPLE / "scene.xml").read_text()
    # the ports of the page may be in use on this computer
    for address in ("udpout:127.0.0.1:9111", "tcpin:127.0.0.1:9112"):
        text = text.replace(address, "pty")
    (tmp_path / "scene.xml").write_text(text)
    shutil.copy(EXAMPLE / "depth_hold.py", tmp_path)
    run = [*UWSIM, "run", "scene.xml", "--strict", "--for", "8s", "--record", "run.mcap"]
    with subprocess.Popen(
        run, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as simulation:
        deadline = time.monotonic() + 60.0
        while not os.path.lexists(tmp_path / "thruster-line"):
            assert time.monotonic() < deadline
            assert simulation.poll() is None
            time.sleep(0.05)
        controller = [sys.executable, "depth_hold.py", "depth-line", "thruster-line", "2.0"]
        with subprocess.Popen(controller, cwd=tmp_path) as hold:
            output, errors = simulation.communicate(timeout=100)
            hold.wait(20)
    rows = {line.split()[0]: line.split() for line in output.splitlines() if line}
    assert "depth_line: ISDPT to /dev/" in errors
    assert int(rows["thrusters"][2]) > 20
    assert hold.returncode == 0
    assert simulation.returncode in (0, 3)  # on a busy computer, some are late
    with (tmp_path / "run.mcap").open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        depths = [m.pressure for _, _, _, m in reader.iter_decoded_messages(topics=["/rov/depth"])]
    assert depths[0] == pytest.approx(0.5, abs=0.05)
    assert depths[-1] > 1.0
