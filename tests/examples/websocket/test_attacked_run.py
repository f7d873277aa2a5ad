"""Another program on the port of a scored run changes no row, and the rows say what it sent."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

from tests.support.short_benchmark import write_benchmark

EXAMPLES = Path(__file__).parents[3] / "examples" / "websocket"
LIMIT = 240.0
"""Nothing takes longer unless it hangs [s]."""
CORNERS = "/cornersTopic"
ANSWERS = [{"tick": n} for n in range(1, 4)] + [{"call": 1, "values": {}}]


def says(socket: ClientConnection, topic: str, **content: Any) -> None:
    text = json.dumps({"client": "outside", **content})
    socket.send(json.dumps({"op": "publish", "topic": topic, "msg": {"data": text}}))


def attack(uri: str) -> None:
    """Do all that would change a row; then publish until the end."""
    with suppress(ConnectionClosed, OSError), connect(uri, max_size=2**26) as socket:
        for topic, kind in (
            (CORNERS, "std_msgs/Float32MultiArray"),
            ("/algorithmStatus", "std_msgs/String"),
            ("/uwsim/lockstep/join", "std_msgs/String"),
            ("/uwsim/lockstep/ack", "std_msgs/String"),
        ):
            socket.send(json.dumps({"op": "advertise", "topic": topic, "type": kind}))
        offer = {"service": "/autoInit", "type": "underwater_sensor_msgs/GTpublish"}
        socket.send(json.dumps({"op": "advertise_service", **offer}))
        socket.send(json.dumps({"op": "subscribe", "topic": CORNERS}))
        says(socket, "/uwsim/lockstep/join", topics=["/uwsim/camera1"], secret="guess")
        while True:
            for answer in ANSWERS:
                says(socket, "/uwsim/lockstep/ack", **answer)
            estimate = {"op": "publish", "topic": CORNERS, "msg": {"data": [7.0] * 8}}
            status = {"op": "publish", "topic": "/algorithmStatus", "msg": {"data": "failed: no"}}
            for service in ("/startBench", "/SpawnMarker"):
                socket.send(json.dumps({"op": "call_service", "service": service, "args": {}}))
            for frame in (estimate, status):
                socket.send(json.dumps(frame))
            with suppress(TimeoutError):
                socket.recv(timeout=0.01)


def scored_under_attack(benchmark: Path, out: Path) -> dict[str, Any]:
    """Score a tracker outside, with a secret, which starts when the other has tried to join."""
    words = ["bench", str(benchmark), "--client", "outside", "--web", "0", "--out", str(out)]
    environment = {**os.environ, "UWSIM_CLIENT_SECRET": "opensesame"}
    bench = subprocess.Popen(
        [sys.executable, "-m", "uwsim", *words], stderr=subprocess.PIPE, text=True, env=environment
    )
    watchdog = threading.Timer(LIMIT, bench.kill)
    watchdog.start()
    program = ["run_algorithm.py", "uwsim.algorithms:Esm", "--name", "outside", "--uri"]
    client: subprocess.Popen[str] | None = None
    said = ""
    try:
        assert bench.stderr is not None
        for line in bench.stderr:
            said += line
            if "listening on ws://" in line:
                program.append(line.split()[-1])
                threading.Thread(target=attack, args=program[-1:], daemon=True).start()
            if client is None and "was refused: secret" in line:
                client = subprocess.Popen(
                    [sys.executable, *program], cwd=EXAMPLES, env=environment, text=True
                )
        assert bench.wait() == 0, said
    finally:
        watchdog.cancel()
        for process in (bench, client):
            if process is not None:
                process.kill()
                process.wait()
        bench.communicate()
    assert "do not take part in the run" in said
    found: dict[str, Any] = json.loads((out / "result.json").read_text())
    return found


@pytest.mark.slow
def test_another_connection_changes_no_row_and_what_it_sent_is_in_the_result(
    tmp_path: Path,
) -> None:
    benchmark = write_benchmark(tmp_path, "0.5")
    found = scored_under_attack(benchmark, tmp_path / "attacked")
    names = [column["name"] for column in found["columns"]]
    rows = [dict(zip(names, row, strict=True)) for row in found["rows"]]
    assert [row["status"] for row in rows] == ["ok"] * 3
    assert all(row["corners"] < 1.0 for row in rows)  # what the other says is off by 300 px
    assert {each["what"] for each in found["refused"]} >= {CORNERS, "/algorithmStatus"}
    assert "/SpawnMarker" in {each["what"] for each in found["refused"]}
    assert "opensesame" not in "".join(
        path.read_text(errors="replace") for path in tmp_path.rglob("*") if path.is_file()
    )
