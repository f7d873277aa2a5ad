"""A benchmark that an autopilot outside runs in lock-step: rows, clients, and failures."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.support.ardupilot_stub import Law, Stub, free_port
from tests.support.pid_autopilot import PidAutopilot, hold, square_path
from uwsim.api import read_result
from uwsim.cli import main as uwsim

EXAMPLES = Path(__file__).parents[2] / "examples" / "ardupilot"


def bench(name: str, out: Path, law: Law, *words: str, **stub: int) -> tuple[int, Stub]:
    port = free_port()
    path = f"vehicle[bluerov2].ardupilot.port={port}"
    with Stub(port, law, timeout=30.0, **stub) as autopilot:  # type: ignore[arg-type]
        options = ["--ardupilot", "--workers", "0", "--out", str(out), "--set", path]
        status = uwsim(["bench", str(EXAMPLES / name), *options, *words])
    return status, autopilot


def short_copy(name: str, folder: Path, interval: int) -> Path:
    text = (EXAMPLES / name).read_text()
    for length in (60, 30):
        text = text.replace(f"<interval>{length}<", f"<interval>{interval}<")
    path = folder / name
    path.write_text(text)
    return path


def rows_of(out: Path) -> object:
    return json.loads((out / "result.json").read_text())["rows"]


def column_of(out: Path, name: str) -> list[float]:
    return [value for value in read_result(out).numbers(name) if value is not None]


def test_two_runs_with_one_autopilot_have_the_same_rows(tmp_path: Path) -> None:
    path = short_copy("station.xml", tmp_path, 4)
    rows = []
    for i in range(2):
        out = tmp_path / f"{i}.result"
        status, _ = bench(
            str(path), out, PidAutopilot(hold((0.0, 0.0, 1.5))), "--level", "current=0.1"
        )
        assert status == 0
        rows.append(rows_of(out))
    assert rows[0] == rows[1]
    run = json.loads((out / "result.json").read_text())["run"]
    assert ["ArduPilot", "lock-step, ardupilot, grade (b)"] in run["clients"]


@pytest.mark.slow
def test_a_pid_controller_keeps_the_station(tmp_path: Path) -> None:
    out = tmp_path / "station.result"
    status, _ = bench("station.xml", out, PidAutopilot(hold((0.0, 0.0, 1.5))))
    assert status == 0
    offsets = column_of(out, "offset")
    assert len(offsets) == 4
    assert max(offsets) < 0.1


@pytest.mark.slow
def test_a_pid_controller_drives_the_square(tmp_path: Path) -> None:
    out = tmp_path / "square.result"
    status, _ = bench("square.xml", out, PidAutopilot(square_path(1.0, 1.5, 0.15)))
    assert status == 0
    errors = column_of(out, "pathError")
    assert max(errors) < 0.1


def test_an_autopilot_that_falls_silent_invalidates_the_run_and_keeps_finished_rows(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, out = short_copy("station.xml", tmp_path, 2), tmp_path / "kept.result"
    status, autopilot = bench(
        str(path), out, PidAutopilot(hold((0.0, 0.0, 1.5))),
        "--set", "vehicle[bluerov2].ardupilot.timeout=1", max_answers=400 * 12,
    )  # fmt: skip
    assert status != 0
    assert "is silent for 1 s of wall time" in capsys.readouterr().err
    assert list((out / "journal").glob("*")) or list(out.rglob("*.jsonl"))
    assert autopilot.n_frames == 4800
