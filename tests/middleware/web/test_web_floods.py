"""A flood of a web client wakes the server seldom."""

from __future__ import annotations

import asyncio
import json

import pytest
from websockets.sync.client import connect

from tests.support.waiting import until
from uwsim.bus import Bus
from uwsim.messages import TwistStamped
from uwsim.middleware.log import Log
from uwsim.middleware.web.options import WebOptions
from uwsim.middleware.web.queue import Lane, OutQueue
from uwsim.middleware.web.server import WebBridge


def test_a_flood_is_read_in_few_bursts(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each time that the server wakes, the simulation waits for Python's lock."""
    rests: list[float] = []
    sleep = asyncio.sleep

    async def rest(seconds: float) -> None:
        rests.append(seconds)
        await sleep(seconds)

    monkeypatch.setattr("uwsim.middleware.web.server.asyncio.sleep", rest)
    monkeypatch.setattr("uwsim.middleware.web.server.CLIENT_BURST", 0.002)
    bus, n = Bus(), 200
    bus.inbox("twist", TwistStamped)
    bridge = WebBridge(bus, lambda: 0.0, WebOptions(port=0), Log("web", lambda line: None))
    try:
        bridge.step()
        with connect(f"ws://127.0.0.1:{bridge.port}") as flooder:
            for _ in range(n):
                flooder.send(json.dumps({"op": "publish", "topic": "/twist", "msg": {}}))
            until(lambda: bridge.n_arrived["twist"] == n)
    finally:
        bridge.close()
    assert 0 < len(rests) < n / 5
    assert sum("sends faster than it is read" in line for line in bridge.log.lines) in range(1, 7)


def test_frames_that_wait_behind_others_do_not_wake_the_writer_again() -> None:
    n_wakes = 0

    def wake() -> None:
        nonlocal n_wakes
        n_wakes += 1

    queue, lane = OutQueue(wake), Lane(length=10)
    for _ in range(5):
        queue.put(lane, "frame")
    assert n_wakes == 1
    while queue.take() is not None:
        pass
    queue.put(lane, "frame")
    assert n_wakes == 2
