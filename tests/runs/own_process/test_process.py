"""A third-party algorithm in its own process: the same rows, and it has messages only."""

from __future__ import annotations

import itertools
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import pytest

from tests.runs.own_process import programs
from tests.support.short_trial import TIME, make_plan, rows_of, with_algorithm
from tests.support.waiting import wait_until
from uwsim.base.rng import stream
from uwsim.bus import Bus
from uwsim.errors import BadMessage, BadSetting, NeverStarted, RunFailed
from uwsim.messages import Float32MultiArray
from uwsim.results.inputs import Inputs
from uwsim.runs.executors.executor import SerialExecutor, run_all
from uwsim.runs.executors.processes import ProcessExecutor
from uwsim.runs.own_process.process import OwnProcess, ProcessAlgorithm
from uwsim.runs.planning.plan import Plan
from uwsim.runs.run import Run
from uwsim.runs.trial.level_row import LevelRow, TrialEnd
from uwsim.runs.trial.trial import execute
from uwsim.simulation import CallStopped, InProcessNode

LEVELS = """<sceneFogUpdater> <initialValue>0</initialValue> <finalValue>0.2</finalValue>
<step>0.2</step> <interval>0.7</interval> </sceneFogUpdater>"""
MEASURES = f"""{TIME} <euclideanNorm> <name>e</name>
<groundTruth type="constant"> <value>1</value> </groundTruth> <target>estimate</target>
<log>0.1</log> </euclideanNorm>"""
SAME = (
    programs.Does,
    programs.Sleeps,
    programs.Raises,
    programs.Exits,
    programs.Threads,
    programs.Misshapes,
    programs.Mistypes,
    programs.CallsNobody,
    programs.Recovers,
    programs.Talks,
    programs.Nests,
)


def plan_of(folder: Path, algorithm: type, *, own: bool = True) -> Plan:
    plan = make_plan(
        folder, algorithm, LEVELS, measures=MEASURES, function="<function>t+e</function>"
    )
    return with_algorithm(plan, own_process=own)


def rows(folder: Path, algorithm: type, *, own: bool = True) -> list[LevelRow]:
    return rows_of(plan_of(folder, algorithm, own=own))


@pytest.mark.parametrize("algorithm", SAME, ids=lambda algorithm: algorithm.__name__)
def test_rows_are_those_of_the_simulations_process(tmp_path: Path, algorithm: type) -> None:
    own = rows(tmp_path, algorithm)
    assert own == rows(tmp_path, algorithm, own=False)
    assert len(own) == 2


class Narrow:
    """A reader that refuses what is above a limit."""

    def __init__(self, bus: Bus, limit: float) -> None:
        self.limit, self.heard = limit, bus.inbox(programs.TOPIC, Float32MultiArray)
        bus.subscribe(programs.TOPIC, Float32MultiArray, lambda message: None, check=self.check)

    def check(self, message: Float32MultiArray) -> None:
        if message.data[0] > self.limit:
            raise BadMessage("it is above the limit")


def node_of(bus: Bus) -> InProcessNode:
    return InProcessNode(bus, name="a", timestep=0.1, rng=stream(0, "a"), parameters={})


@pytest.mark.parametrize("own", [True, False])
def test_all_that_is_published_before_something_is_raised_arrives_in_its_order(own: bool) -> None:
    bus = Bus()
    heard, node = bus.inbox(programs.TOPIC, Float32MultiArray), node_of(bus)
    with OwnProcess() as process:
        node.run(
            ProcessAlgorithm(process, programs.Talks, may_refuse=bus.may_refuse)
            if own
            else programs.Talks()
        )
        for bus.step in range(5):
            node.tick()
            bus.deliver()
    said = [message.data.tolist() for message in heard.take()]
    assert said[5:-1] == [[pytest.approx(5 + k / 1000)] for k in range(250)]
    assert said[-1] == [7.0, 8.0]
    assert "enough" in str(node.error)


@pytest.mark.parametrize("comes_late", [True, False])
def test_a_message_that_a_reader_refuses_ends_the_algorithm(comes_late: bool) -> None:
    bus = Bus()
    node = node_of(bus)
    reader = None if comes_late else Narrow(bus, 5.04)
    with OwnProcess() as process:
        node.run(ProcessAlgorithm(process, programs.Talks, may_refuse=bus.may_refuse))
        reader = reader or Narrow(bus, 5.04)
        for bus.step in range(5):
            node.tick()
            bus.deliver()
    assert len(reader.heard.take()) == 5 + 41
    assert "BadMessage: it is above the limit" in str(node.error)


def test_what_is_reported_as_parameters_is_the_same(tmp_path: Path) -> None:
    ends = []
    for own in (True, False):
        plan = plan_of(tmp_path, programs.Reports, own=own)
        outcomes = [each for trial in plan.trials() for each in execute(plan, trial)]
        ends += [each.parameters for each in outcomes if isinstance(each, TrialEnd)]
    assert ends[0] == ends[1] == {"gain": 0.1 + 0.2, "made": "there"}


@pytest.mark.parametrize(
    ("algorithm", "error"),
    [
        (programs.ReportsRubbish, RunFailed),
        (programs.ReportsAnObject, RunFailed),
        (programs.RefusesToStart, BadSetting),
        (programs.CannotBeMade, NeverStarted),
    ],
    ids=lambda value: value.__name__,
)
def test_what_ends_the_run_is_the_same_line(
    tmp_path: Path, algorithm: type, error: type[Exception]
) -> None:
    lines = []
    for own in (True, False):
        with pytest.raises(error) as caught:
            rows(tmp_path, algorithm, own=own)
        lines.append(str(caught.value))
    assert lines[0] == lines[1]


def notes_of(plan: Plan) -> tuple[str, ...]:
    (end,) = [
        row for trial in plan.trials() for row in execute(plan, trial) if isinstance(row, TrialEnd)
    ]
    return end.notes


@pytest.mark.parametrize("own", [True, False])
@pytest.mark.parametrize(
    ("algorithm", "given", "note"),
    [
        (programs.Asks, {"gain": 2.0, "limit": 1.0, "latency_s": 0.1}, ""),
        (
            programs.Asks,
            {"gian": 2.0},
            "never read the parameter 'gian'. Did you mean 'gain'? It read gain, limit",
        ),
        (
            programs.Asks,
            {"a": 1.0, "gain": 2.0, "z": "text"},
            "never read the parameters 'a', 'z'. It read gain, limit",
        ),
        (programs.AsksLater, {"gain": 2.0}, ""),
        (
            programs.AsksLater,
            {"gains": 2.0},
            "never read the parameter 'gains'. Did you mean 'gain'? It read gain",
        ),
        (programs.Does, {"gain": 2.0}, "never read the parameter 'gain'. It read none"),
        (programs.GoesThrough, {"gian": 2.0}, ""),
    ],
)
def test_a_parameter_that_nobody_read_is_noted(
    tmp_path: Path, algorithm: type, given: dict[str, float | str], note: str, own: bool
) -> None:
    plan = with_algorithm(plan_of(tmp_path, algorithm, own=own), parameters=given)
    notes = notes_of(plan)
    assert len(notes) == bool(note)
    assert all(note in each and "'algorithm'" in each for each in notes)


def test_ctrl_c_of_the_algorithm_is_its_own_mistake(tmp_path: Path) -> None:
    first, _ = rows(tmp_path, programs.Interrupts)
    assert "KeyboardInterrupt" in first.missing_reasons["total"]


@pytest.mark.parametrize(
    ("algorithm", "why"),
    [
        (programs.Dies, "algorithm was stopped at 0.4 s: its process ended (with exit status 3)"),
        (programs.IsKilled, "its process ended (killed by SIGKILL)"),
        (programs.SendsGarbage, "its process "),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_a_process_that_ends_ends_its_rows_and_no_more(
    tmp_path: Path, algorithm: type, why: str
) -> None:
    found = rows(tmp_path, algorithm)
    assert [row.status for row in found] == ["algorithm error"] * 2
    assert why in found[0].missing_reasons["total"]
    assert [row.measures["t"][0] for row in found] == pytest.approx([0.7, 0.7])


def test_a_request_that_takes_too_long_ends_the_process() -> None:
    with OwnProcess() as process:
        ProcessAlgorithm(process, programs.Does)  # the start of the process takes as long as it may
        process._limit = 0.1
        with pytest.raises(CallStopped, match="a callback took longer than --callback-limit"):
            process.request(["make", sys.path, [], programs.__name__, "NeverMade"], lambda asked: 0)
        wait_until(lambda: not is_there(process.pid))
        with pytest.raises(CallStopped, match=r"its process ended \(killed by SIGKILL\)"):
            process.request(["parameters", {}], lambda asked: 0)


def test_a_process_that_reads_no_frame_takes_too_long() -> None:
    with OwnProcess(2.0) as process:
        os.kill(process.pid, signal.SIGSTOP)
        with pytest.raises(CallStopped, match="a callback took longer than --callback-limit"):
            process.request(["parameters", bytes(2**24)], lambda request: 0)
        wait_until(lambda: not is_there(process.pid))


def test_the_time_of_a_suspension_does_not_count(monkeypatch: pytest.MonkeyPatch) -> None:
    with OwnProcess(100.0) as process:
        clock = SimpleNamespace(monotonic=itertools.count(step=3600.0).__next__)
        monkeypatch.setattr("uwsim.runs.own_process.process.time", clock)
        # each wait for a frame seems to take an hour, as if this process had been suspended
        node = node_of(Bus())
        node.run(ProcessAlgorithm(process, programs.Does))
        assert node.error is None


@pytest.mark.parametrize("limit", [0.75, 1e30, float("inf")])
def test_a_limit_may_be_as_long_as_one_likes(limit: float) -> None:
    with OwnProcess(limit) as process:
        assert is_there(process.pid)


@pytest.mark.parametrize(
    ("algorithm", "limit", "why"),
    [
        (programs.Forks, None, r"its process ended \(with exit status 3\)"),
        (programs.Forks, 15.0, r"its process ended \(with exit status 3\)"),
        (programs.SendsHalf, 5.0, "a callback took longer than --callback-limit"),
    ],
)
def test_a_process_that_leaves_its_socket_open_is_not_waited_for(
    algorithm: type, limit: float | None, why: str
) -> None:
    with OwnProcess(limit) as process:
        remote, began = ProcessAlgorithm(process, algorithm), time.monotonic()
        with pytest.raises(CallStopped, match=why):
            remote.start(node_of(Bus()))
        assert time.monotonic() - began < 14.0


@pytest.mark.slow
@pytest.mark.parametrize("workers", [0, 1])
def test_an_algorithm_that_hangs_costs_its_rows_with_any_executor(
    tmp_path: Path, workers: int
) -> None:
    limit = 10.0  # the start of a process is well within it
    executor = ProcessExecutor(1, callback_limit=limit)
    run = Run(
        plan=plan_of(tmp_path, programs.Hangs),
        out=tmp_path / "out",
        inputs=Inputs(),
        renderer="none",
    )
    (result,) = run_all([run], executor if workers else SerialExecutor(callback_limit=limit))
    why = "algorithm was stopped at 0.4 s: a callback took longer than --callback-limit"
    assert [result.reason(row, "total") for row in range(len(result.rows))] == [why, why]
    assert run.n_lost == 0, "the trial is not run again"


def test_there_is_nothing_of_the_simulation_in_its_process(tmp_path: Path) -> None:
    assert [row.status for row in rows(tmp_path, programs.LooksForTheTruth)] == ["ok"] * 2


def is_there(pid: int) -> bool:
    """Whether a process runs; one that has ended and waits for its parent does not."""
    try:
        stat = Path(f"/proc/{pid}/stat").read_text()
    except (FileNotFoundError, ProcessLookupError):
        return False
    return stat.rpartition(")")[2].split()[0] != "Z"


PARENT = """
import sys
sys.path[:] = {path!r}
import numpy as np
from uwsim.runs.own_process.process import OwnProcess, ProcessAlgorithm
from tests.runs.own_process.programs import Hangs

class Node:
    now, parameters, rng = 0.0, {{}}, np.random.default_rng(0)

    def publisher(self, topic, type):
        return lambda message: None

    def create_timer(self, period, callback):
        print(process.pid, flush=True)
        for _ in range(5):
            callback()

with OwnProcess() as process:
    ProcessAlgorithm(process, Hangs).start(Node())
"""


def test_a_process_ends_with_its_parent_also_from_an_endless_callback() -> None:
    parent = subprocess.Popen(
        [sys.executable, "-c", PARENT.format(path=sys.path)], stdout=subprocess.PIPE, text=True
    )
    try:
        assert parent.stdout is not None
        with parent.stdout:
            pid = int(parent.stdout.readline())
        parent.send_signal(signal.SIGKILL)
    finally:
        parent.kill()
        parent.wait()
    wait_until(lambda: not is_there(pid))
