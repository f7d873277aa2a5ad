"""A flood of a web client wakes the server seldom."""

from __future__ import annotations

import asyncio
import json

import pytest
from websockets.sync.client import connect

from tests.support.waiting import wait_until
from uwsim.bus import Bus
from uwsim.messages import TwistStamped
from uwsim.middleware.admission import FirstCaller, SingleProgram, TopicOwners
from uwsim.middleware.lockstep.topics import JOIN
from uwsim.middleware.log import Log
from uwsim.middleware.web.options import WebOptions
from uwsim.middleware.web.queue import OutQueue, SubscriptionQueue
from uwsim.middleware.web.server import PING_INTERVAL, WebBridge


@pytest.fixture
def pauses(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """The times for which clients are not read [s]."""
    actual: list[float] = []
    sleep = asyncio.sleep

    async def rest(seconds: float) -> None:
        if (
            0.0 < seconds < 0.5 * PING_INTERVAL
        ):  # longer ones are the library's, between two questions
            actual.append(seconds)
        await sleep(seconds)

    monkeypatch.setattr("uwsim.middleware.web.server.asyncio.sleep", rest)
    monkeypatch.setattr("uwsim.middleware.web.server.CLIENT_BURST", 0.002)
    return actual


ADMISSIONS = {
    "ack": SingleProgram(lambda by, what: None),
    "step": FirstCaller("step_simulation", lambda by, what: None),
    "output": TopicOwners({"twist"}, lambda by, what: None),
    "none": TopicOwners(None, lambda by, what: None),
}


@pytest.mark.parametrize("sync", ADMISSIONS)
def test_what_a_run_waits_for_is_read_at_once(sync: str, pauses: list[float]) -> None:
    bus, n = Bus(), 200
    bus.inbox("twist", TwistStamped)
    bridge = WebBridge(bus, lambda: 0.0, WebOptions(port=0), Log("web", lambda line: None))
    bridge.admission = admission = ADMISSIONS[sync]
    try:
        bridge.step()
        with connect(f"ws://127.0.0.1:{bridge.port}") as client:
            admission.admit(f"client 127.0.0.1:{client.local_address[1]}")
            for _ in range(n):
                client.send(json.dumps({"op": "publish", "topic": "/twist", "msg": {}}))
            wait_until(lambda: bridge.arrivals.n_arrived["twist"] == n)
    finally:
        bridge.close()
    assert bool(pauses) == (sync == "none")


def test_a_client_that_calls_itself_a_participant_waits_as_others_do(pauses: list[float]) -> None:
    bus, n = Bus(), 200
    bridge = WebBridge(bus, lambda: 0.0, WebOptions(port=0), Log("web", lambda line: None))
    bridge.admission = SingleProgram(lambda sender, what: None)
    join = {"op": "publish", "topic": f"/{JOIN}", "msg": {"data": '{"client": "a"}'}}
    try:
        bridge.step()
        with connect(f"ws://127.0.0.1:{bridge.port}") as client:
            client.send(
                json.dumps({"op": "advertise", "topic": f"/{JOIN}", "type": "std_msgs/String"})
            )
            for _ in range(n):
                client.send(json.dumps(join))
            wait_until(lambda: len(pauses) > 1)
    finally:
        bridge.close()


def test_a_flood_is_read_in_few_bursts(pauses: list[float]) -> None:
    """Each time that the server wakes, the simulation waits for Python's lock."""
    bus, n = Bus(), 200
    bus.inbox("twist", TwistStamped)
    bridge = WebBridge(bus, lambda: 0.0, WebOptions(port=0), Log("web", lambda line: None))
    try:
        bridge.step()
        with connect(f"ws://127.0.0.1:{bridge.port}") as flooder:
            for _ in range(n):
                flooder.send(json.dumps({"op": "publish", "topic": "/twist", "msg": {}}))
            wait_until(lambda: bridge.arrivals.n_arrived["twist"] == n)
    finally:
        bridge.close()
    assert 0 < len(pauses) < n / 5
    n_lines = sum("sends faster than the server reads" in line for line in bridge.log.lines)
    assert n_lines in range(1, 7)


def test_frames_that_wait_behind_others_do_not_wake_the_writer_again() -> None:
    n_wakes = 0

    def wake() -> None:
        nonlocal n_wakes
        n_wakes += 1

    queue, messages = OutQueue(wake), SubscriptionQueue(max_length=10)
    for _ in range(5):
        queue.put(messages, "frame")
    assert n_wakes == 1
    while queue.take() is not None:
        pass
    queue.put(messages, "frame")
    assert n_wakes == 2
