"""A benchmark that PX4 runs in lock-step, with the stand-in of PX4."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.support.px4_stub import Px4Stub, find_free_port
from uwsim.assets.bundled import bundled_files
from uwsim.cli import main as uwsim

STATION = Path(__file__).parents[2] / "examples" / "ardupilot" / "station.xml"


def hold_depth(sensor: Any) -> list[float]:
    """Return outputs of a PD controller of depth and yaw rate."""
    push = 0.3 * (sensor.pressure_alt + 1.5) - 0.2 * (sensor.zacc + 9.81)
    turn = 0.2 * sensor.zgyro
    return [turn, -turn, turn, -turn, -push, push, push, -push]


def write_benchmark(folder: Path, port: int) -> Path:
    """Write a short form of the benchmark `station`, with PX4 at a port."""
    scene = Path(bundled_files("scenes")["bluerov2-scene"]).read_text()
    element = f"<u:px4> <relativeTo>base_link</relativeTo> <port>{port}</port> </u:px4>"
    (folder / "scene.xml").write_text(scene.replace("<u:dynamics>", f"{element} <u:dynamics>"))
    text = STATION.read_text().replace('u:timestep="0.0025"', "")
    for length in (60, 30):
        text = text.replace(f"<interval>{length}<", "<interval>2<")
    file = folder / "station.xml"
    file.write_text(text.replace("bluerov2-scene.xml", "scene.xml"))
    return file


def test_px4_is_the_algorithm_of_a_benchmark(tmp_path: Path) -> None:
    port = find_free_port()
    file = write_benchmark(tmp_path, port)
    rows = []
    for name in ("first", "second"):
        px4, out = Px4Stub(port, hold_depth), tmp_path / name
        words = ["--px4", "--workers", "0", "--level", "current=0.1", "--out", str(out)]
        assert uwsim(["bench", str(file), *words]) == 0
        px4.join()
        result = json.loads((out / "result.json").read_text())
        rows.append(result["rows"])
        assert ["PX4", "lock-step, px4, grade (b)"] in result["run"]["clients"]
    assert rows[0] == rows[1]


def test_two_autopilots_exclude_each_other(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["--ardupilot", "--px4", "--out", str(tmp_path / "out")]
    assert uwsim(["bench", str(STATION), *words]) == 2
    assert "--ardupilot and --px4 exclude each other" in capsys.readouterr().err
