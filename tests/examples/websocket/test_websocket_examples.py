"""Programs outside, over WebSocket and in lock-step, score what they do in process."""

from __future__ import annotations

import json
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

import pytest

from tests.support.byte_hashes import short_currents
from tests.support.keep_station import LEVELS, score_in_process, short_benchmark
from tests.support.short_benchmark import run, write_benchmark
from tests.support.timed_algorithm import TIMED_PUSH
from tests.support.waiting import free_port, wait_until
from uwsim import load
from uwsim.middleware.log import Log
from uwsim.middleware.web.options import WebOptions
from uwsim.middleware.web.server import WebBridge

EXAMPLES = Path(__file__).parents[3] / "examples" / "websocket"
LIMIT = 240.0
"""Nothing takes longer unless it hangs [s]."""


def uwsim(*words: str) -> list[str]:
    return [sys.executable, "-m", "uwsim", *words]


def result_of(out: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((out / "result.json").read_text())
    return found


def scored_outside(
    benchmark: Path, out: Path, program: list[str], *options: str
) -> tuple[dict[str, Any], str]:
    """Run a benchmark with a program outside; its port is chosen by the system."""
    words = ["bench", str(benchmark), "--client", "outside", "--web", "0", "--out", str(out)]
    bench = subprocess.Popen(
        uwsim(*words, *options), stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True
    )
    watchdog = threading.Timer(LIMIT, bench.kill)
    watchdog.start()
    client: subprocess.Popen[str] | None = None
    said = ""
    try:
        assert bench.stderr is not None
        for line in bench.stderr:
            said += line
            if "listening on ws://" in line and client is None:
                uri = line.split()[-1]
                client = subprocess.Popen(
                    [sys.executable, *program, "--uri", uri], cwd=EXAMPLES, text=True
                )
        bench.wait()
    finally:
        watchdog.cancel()
        for process in (bench, client):
            if process is not None:
                process.kill()
                process.wait()
        bench.communicate()
    return result_of(out), said


def scored_inside(
    benchmark: Path, out: Path, algorithm: str, levels: list[str] | None = None
) -> dict[str, Any]:
    run(benchmark, out, algorithm=algorithm, levels=levels, seed=0)
    return result_of(out)


@pytest.mark.slow
def test_a_tracker_outside_scores_the_same_rows_also_when_it_dawdles(tmp_path: Path) -> None:
    benchmark = write_benchmark(tmp_path, "0.5")
    inside = scored_inside(benchmark, tmp_path / "inside", "esm")
    for delay in ("0", "20"):
        program = ["run_algorithm.py", "uwsim.algorithms:Esm", "--name", "outside"]
        outside, said = scored_outside(
            benchmark, tmp_path / f"outside-{delay}", [*program, "--delay", delay]
        )
        assert outside["rows"] == inside["rows"], said
        assert outside["run"]["clients"] == [["outside", "lock-step, web, grade (a)"]]


@pytest.mark.slow
def test_a_controller_outside_scores_the_same_rows_also_when_it_dawdles(tmp_path: Path) -> None:
    benchmark = short_currents(tmp_path)
    level = ("--level", "current=0.2")
    inside = scored_inside(benchmark, tmp_path / "inside", "p", [*level[1:]])
    program = ["run_algorithm.py", "uwsim.algorithms.control:P", "--name", "outside"]
    outside, said = scored_outside(
        benchmark, tmp_path / "outside", [*program, "--delay", "20"], *level
    )
    assert outside["rows"] == inside["rows"], said


@pytest.mark.slow
def test_a_class_with_a_timer_runs_outside_without_a_change(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its first tick is due at the join: its join was refused."""
    monkeypatch.setenv("PYTHONPATH", str(EXAMPLES.parents[1]))
    benchmark, level = short_currents(tmp_path), ("--level", "current=0.2")
    inside = scored_inside(benchmark, tmp_path / "inside", TIMED_PUSH, [*level[1:]])
    program = ["run_algorithm.py", TIMED_PUSH, "--name", "outside"]
    outside, said = scored_outside(benchmark, tmp_path / "outside", program, *level)
    assert outside["rows"] == inside["rows"], said


@pytest.mark.slow
def test_a_program_that_takes_the_steps_itself_scores_the_rows_of_the_class(tmp_path: Path) -> None:
    benchmark = short_benchmark(tmp_path)
    inside = score_in_process(benchmark, tmp_path / "inside")
    outside, said = scored_outside(
        benchmark,
        tmp_path / "outside",
        ["keep_station.py", "--delay", "20"],
        *LEVELS,
        *("--sync", "step"),
    )
    assert outside["rows"] == inside["rows"], said
    assert outside["run"]["clients"] == [["outside", "lock-step, web, grade (b)"]]


@pytest.mark.slow
def test_a_program_puts_a_mesh_into_the_scene_and_takes_it_away() -> None:
    with load("shapes-scene") as simulation:
        log = Log("test", lambda line: None)
        bridge = WebBridge(simulation.bus, lambda: simulation.time, WebOptions(port=0), log)
        simulation.watch(bridge.step)
        bridge.step()  # who comes before the first step finds the services, too

        def spawn(action: str, *place: str) -> tuple[int, str]:
            words = [action, "toys", "1", "data/objects/sphere.osg", *place, "0", "0", "1.5"]
            uri = f"ws://127.0.0.1:{bridge.port}"
            program = subprocess.Popen(
                [sys.executable, str(EXAMPLES / "spawn_marker.py"), *words, "--uri", uri],
                stdout=subprocess.PIPE,
                text=True,
            )
            try:
                wait_until(lambda: program.poll() is not None, lambda: simulation.advance(0.01))
            finally:
                program.kill()
                printed, _ = program.communicate(timeout=LIMIT)
            return program.returncode, printed

        try:
            added = spawn("add", "1", "2", "3")
            assert added == (0, "object 1 toys was successfully ADDED.\n")
            marker = simulation.world.markers.active_markers["1+toys"]
            assert marker.mesh_resource == "package://uwsim/data/objects/sphere.osg"
            assert (marker.pose.position.x, marker.scale.z, marker.color.a) == (1.0, 1.0, 1.0)
            assert spawn("del", "0", "0", "0") == (0, "object 1 toys was successfully DELETED.\n")
            assert spawn("del", "0", "0", "0") == (1, "object 1 toys not found.\n")
        finally:
            bridge.close()


SERVER = """
import json, os, signal, sys
from websockets.sync.server import serve

def attend(socket):
    n = 0
    for text in socket:
        asked = json.loads(text)
        if asked["op"] == "subscribe" and asked["topic"] == "/g500/odom":
            pose = {"position": {"x": 0, "y": 0, "z": 0}}
            pose["orientation"] = {"x": 0, "y": 0, "z": 0, "w": 1}
            odometry = {"pose": {"pose": pose}}
            socket.send(json.dumps({"op": "publish", "topic": "/g500/odom", "msg": odometry}))
        elif asked["op"] == "call_service":
            n += 1
            if n == 4:
                os.kill(os.getpid(), signal.SIGKILL)
            values = {"result": {"result": int(sys.argv[1]), "error_message": "not now"}}
            answer = {"op": "service_response", "id": asked["id"], "values": values}
            socket.send(json.dumps({**answer, "result": True}))

with serve(attend, "127.0.0.1", 0) as server:
    print(server.socket.getsockname()[1], flush=True)
    server.serve_forever()
"""
"""Stands for a simulation that is killed; its argument is the result of each step."""


def met_by(server_argument: str, *program: str) -> tuple[int, str, str]:
    """Run a program with that server; returns its exit status and what it printed."""
    words = [sys.executable, "-c", SERVER, server_argument]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as server:
        try:
            assert server.stdout is not None
            uri = f"ws://127.0.0.1:{server.stdout.readline().strip()}"
            done = subprocess.run(
                [sys.executable, *program, "--uri", uri],
                cwd=EXAMPLES,
                text=True,
                capture_output=True,
                timeout=LIMIT,
                check=False,
            )
        finally:
            server.kill()
    return done.returncode, done.stdout, done.stderr


def test_a_program_whose_simulation_is_killed_says_that_the_connection_was_lost() -> None:
    status, printed, errors = met_by("1", "keep_station.py")
    assert (status, printed) == (1, "")
    assert "the connection was lost" in errors
    assert "Traceback" not in errors


def test_a_program_that_is_refused_a_step_says_why() -> None:
    status, _, errors = met_by("3", "keep_station.py")
    assert (status, errors) == (1, "/step_simulation: not now\n")


@pytest.mark.parametrize(
    "words",
    [
        ["spawn_marker.py", "add", "a", "1", "buoy.stl", *"123456"],
        ["keep_station.py"],
        ["run_algorithm.py", "uwsim.algorithms:P", "--name", "a"],
    ],
    ids=lambda words: str(words[0]),
)
def test_an_address_at_which_nothing_is_is_one_line(words: list[str]) -> None:
    done = subprocess.run(
        [sys.executable, *words, "--uri", "http://127.0.0.1"],
        cwd=EXAMPLES,
        text=True,
        capture_output=True,
        timeout=LIMIT,
        check=False,
    )
    assert done.returncode == 1
    assert done.stderr.startswith("http://127.0.0.1: ")
    assert len(done.stderr.splitlines()) == 1


LEAVES = """
import json, sys
from lockstep import open_connection, ACK, JOIN, TEXT, TICK
with open_connection(sys.argv[2]) as socket:
    def say(topic, **content):
        text = json.dumps({"client": "outside", **content})
        socket.send(json.dumps({"op": "publish", "topic": topic, "msg": {"data": text}}))
    for topic in (JOIN, ACK):
        socket.send(json.dumps({"op": "advertise", "topic": topic, "type": TEXT}))
    socket.send(json.dumps({"op": "subscribe", "topic": TICK}))
    say(JOIN, topics=[], next=ANSWER)
    while json.loads(socket.recv()).get("op") != "publish":
        pass
    say(ACK, tick=1, next=ANSWER)
    socket.recv()
"""
"""Joins, answers the first tick and leaves."""


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        ("0.0", "'outside' left at 0.002 s: the run is invalid."),
        ("'0.0'", 'its join was refused: next is "0.0"; expected a time >= 0 [s]'),
    ],
)
def test_a_run_whose_client_leaves_or_is_wrong_says_what_is_kept(
    tmp_path: Path, answer: str, said: str
) -> None:
    program = tmp_path / "leaves.py"
    folder = f"import sys; sys.path.insert(0, {str(EXAMPLES)!r})\n"
    program.write_text(folder + LEAVES.replace("ANSWER", answer))
    benchmark = short_benchmark(tmp_path)
    words = ("--client-limit", "5")
    _, errors = scored_outside(benchmark, tmp_path / "out", [str(program)], *words)
    assert said in errors
    assert "Traceback" not in errors
    kept = "Finished rows are kept; continue with --resume." in errors
    assert kept == ("left" in said)


MORTAL = f"""
import os, signal, sys
sys.path.insert(0, {str(EXAMPLES)!r})
import lockstep, run_algorithm

class Mortal(lockstep.Client):
    n_trials = 0

    def __init__(self, *arguments):
        super().__init__(*arguments)
        Mortal.n_trials += 1

    def _tick(self, tick):
        if Mortal.n_trials == 2 and tick["tick"] == 50:
            os.kill(os.getpid(), signal.SIGKILL)
        super()._tick(tick)

run_algorithm.Client = Mortal
run_algorithm.main()
"""
"""Is killed in the middle of its second trial."""


@pytest.mark.slow
def test_a_run_whose_client_was_killed_goes_on_where_it_was(tmp_path: Path) -> None:
    benchmark = short_currents(tmp_path)
    inside = scored_inside(benchmark, tmp_path / "inside", "p")
    (tmp_path / "mortal.py").write_text(MORTAL)
    who = ["uwsim.algorithms.control:P", "--name", "outside"]
    out = tmp_path / "outside"
    mortal = [str(tmp_path / "mortal.py"), *who, "--trials", "2"]
    # one port for both trials
    killed, said = scored_outside(benchmark, out, mortal, "--web", str(free_port()))
    assert "'outside' left at " in said
    assert "Finished rows are kept; continue with --resume." in said
    assert killed["rows"] == inside["rows"][:1]
    whole, said = scored_outside(benchmark, out, ["run_algorithm.py", *who], "--resume")
    assert whole["rows"] == inside["rows"], said
