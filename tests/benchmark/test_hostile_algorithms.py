"""Algorithms that break, flood or cheat: the row says so, and nothing else happens."""

from __future__ import annotations

import signal
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.support.hostile import (
    ATTACKS,
    TOPIC,
    Attacker,
    ExitsProcess,
    NeverReturns,
    Patches,
    PublishesWrongEstimate,
)
from tests.support.short_trial import INIT_TRIGGER, TIME, make_plan, rows_of, with_algorithm
from uwsim.bus import Node
from uwsim.errors import NotAllowed
from uwsim.messages import Float32MultiArray, PoseStamped, floats, header
from uwsim.results.inputs import Inputs
from uwsim.results.result import Result
from uwsim.runs.executors.executor import run_all
from uwsim.runs.executors.processes import ProcessExecutor
from uwsim.runs.run import Run
from uwsim.simulation.nodes import undelivered

LEVELS = """<sceneFogUpdater> <initialValue>0</initialValue> <finalValue>0.2</finalValue>
<step>0.2</step> <interval>0.7</interval> </sceneFogUpdater>"""
MEASURES = f"""{TIME} <euclideanNorm> <name>e</name>
<groundTruth type="constant"> <value>1</value> </groundTruth> <target>{TOPIC}</target>
</euclideanNorm> <positionError> <name>p</name> <target>girona500</target> <position> <x>0</x>
<y>0</y> <z>0</z> </position> <topic>place</topic> </positionError>"""


@pytest.mark.parametrize("algorithm", ATTACKS, ids=lambda algorithm: algorithm.__name__)
def test_an_attack_ends_the_row_with_its_reason(
    tmp_path: Path, algorithm: type[Attacker], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(undelivered, "MAX_MESSAGES", 100)
    monkeypatch.setattr(undelivered, "MAX_BYTES", 2**20)
    rows = rows_of(make_plan(tmp_path, algorithm, LEVELS, measures=MEASURES, start=INIT_TRIGGER))
    assert [row.status for row in rows] == ["algorithm error"] * 2
    assert "algorithm raised at 0.4 s: " in rows[0].missing_reasons["total"]
    assert ATTACKS[algorithm] in rows[0].missing_reasons["total"]
    assert [row.measures["t"][0] for row in rows] == pytest.approx([0.7, 0.7])


class Interrupts(Attacker):
    def attack(self) -> None:
        raise KeyboardInterrupt


def test_a_keyboard_interrupt_is_the_users_unless_ctrl_c_cannot_come_here(tmp_path: Path) -> None:
    plan = make_plan(tmp_path, Interrupts, LEVELS)
    with pytest.raises(KeyboardInterrupt):
        rows_of(plan)
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        rows = rows_of(plan)
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
    assert "KeyboardInterrupt" in rows[0].missing_reasons["total"]


class Delayed(Attacker):
    """Publishes once in every step."""

    def start(self, node: Node) -> None:
        publish = node.publisher(TOPIC, Float32MultiArray)
        node.create_timer(0.002, lambda: publish(floats([1.0])))


@pytest.mark.parametrize(("latency", "status"), [(0.05, "ok"), (0.3, "algorithm error")])
def test_messages_that_wait_for_their_latency_count(
    tmp_path: Path, latency: float, status: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(undelivered, "MAX_MESSAGES", 100)
    plan = make_plan(tmp_path, Delayed, LEVELS, measures=MEASURES.split("<positionError>")[0])
    [row, _] = rows_of(with_algorithm(plan, parameters={"latency_s": latency}))
    assert row.status == status


class Changes(Attacker):
    """Changes what it has published before anybody looks."""

    def tick(self) -> None:
        estimate = np.array([2.0], dtype=np.float32)
        self.publish(Float32MultiArray(data=estimate))
        estimate[0] = 1.0


def test_what_is_published_cannot_be_changed_any_more(tmp_path: Path) -> None:
    measures = MEASURES.split("<positionError>")[0]
    rows = rows_of(make_plan(tmp_path, Changes, LEVELS, measures=measures))
    assert [row.measures["e"][0] for row in rows] == [1.0, 1.0]


class FromTheFuture(Attacker):
    """Says where the vehicle will be at a time to come: at the origin."""

    def start(self, node: Node) -> None:
        publish = node.publisher("place", PoseStamped)
        ahead = float(node.parameters["ahead"])
        node.create_timer(0.1, lambda: publish(PoseStamped(header=header(node.now + ahead))))


def test_a_stamp_in_the_future_changes_nothing(tmp_path: Path) -> None:
    plan = make_plan(tmp_path, FromTheFuture, LEVELS, measures=MEASURES)
    rows = [rows_of(with_algorithm(plan, parameters={"ahead": ahead})) for ahead in (0.0, 1e6)]
    assert rows[0][0].measures["p"][0] is not None
    assert rows[0] == rows[1]


class Lingers(Attacker):
    """Keeps its way of publishing."""

    kept: Any = None

    def tick(self) -> None:
        type(self).kept = self


def test_nothing_is_published_after_the_end(tmp_path: Path) -> None:
    rows_of(make_plan(tmp_path, Lingers, LEVELS))
    with pytest.raises(NotAllowed, match="after the end"):
        Lingers.kept.publish(floats([1.0]))


def bench_of(folder: Path, algorithm: type[Attacker]) -> Run:
    plan = make_plan(
        folder,
        algorithm,
        LEVELS,
        measures=MEASURES.split("<positionError>")[0],
        function="<function>e</function>",
    )
    name = algorithm.__name__
    plan = with_algorithm(plan, name=name, parameters={"immortal": str(folder / "immortal")})
    return Run(plan=plan, out=folder / name, inputs=Inputs(), renderer="none")


def reasons(result: Result) -> list[str | None]:
    return [result.reason(row, "total") for row in range(len(result.rows))]


@pytest.mark.slow
def test_an_algorithm_that_dies_or_hangs_or_falsifies_does_so_to_itself_alone(
    tmp_path: Path,
) -> None:
    benches = [
        bench_of(tmp_path, algorithm)
        for algorithm in (ExitsProcess, NeverReturns, Patches, PublishesWrongEstimate)
    ]
    dead, hanging, patched, honest = run_all(benches, ProcessExecutor(1, callback_limit=5.0))
    died = "ExitsProcess was stopped at 0.4 s: its process ended (with exit status 0)"
    assert reasons(dead) == [died, died]
    hung = "NeverReturns was stopped at 0.4 s: a callback took longer than --callback-limit"
    assert reasons(hanging) == [hung, hung]
    assert patched.values("total") == (0.0, 0.0)  # in its own process nothing keeps it from that
    assert honest.values("total") == (1.0, 1.0)
    (tmp_path / "immortal").touch()
    again = run_all([bench_of(tmp_path, ExitsProcess)], ProcessExecutor(1))[0]
    assert reasons(again) == ["no value for e"] * 2
