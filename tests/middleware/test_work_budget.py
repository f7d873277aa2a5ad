"""Work for peers takes a share of the wall time."""

from __future__ import annotations

import json
import time

import pytest

from uwsim.bus import Bus
from uwsim.errors import BadMessage
from uwsim.messages import Empty, EmptyResponse, Twist
from uwsim.middleware.bridge import Bridge
from uwsim.middleware.exchange.call_queue import CALLS_AT_ONCE, MAX_CALLS
from uwsim.middleware.json_encoding import from_json
from uwsim.middleware.log import Log
from uwsim.middleware.web.session import MAX_KEYS, read_frame
from uwsim.middleware.work_budget import WorkBudget


def test_work_is_limited_to_a_share_of_the_time() -> None:
    now, work_time = 0.0, 0.0
    budget = WorkBudget(0.02, 0.1, lambda: now)
    while now < 100.0:
        if (delay := budget.delay) > 0.0:
            now += max(delay, 1e-6)  # more than the rounding of the clock
            continue
        budget.spend(0.01)
        now += 0.01
        work_time += 0.01
    assert work_time == pytest.approx(0.02 * 100.0 + 0.1, rel=0.02)


def test_after_a_rest_there_is_one_burst_and_no_more() -> None:
    now = 0.0
    budget = WorkBudget(0.5, 0.2, lambda: now)
    now = 1e6
    budget.spend(0.2)
    assert budget.delay == 0.0
    budget.spend(0.1)
    assert budget.delay == pytest.approx(0.2)


class PlainBridge(Bridge):
    """A bridge without a transport."""

    def on_topics(self, topics: object) -> None:
        """Take no note."""

    def on_services(self, services: object) -> None:
        """Take no note."""

    def send(self, topic: str, message: object) -> None:
        """Send nothing."""


def test_a_flood_of_calls_is_spread_over_the_steps() -> None:
    bus = Bus()
    answers = 0

    def slow(request: Empty) -> EmptyResponse:
        nonlocal answers
        answers += 1
        start_time = time.thread_time()
        while time.thread_time() - start_time < 0.01:
            pass
        return EmptyResponse()

    bus.services.serve("slow", Empty, slow)
    bridge = PlainBridge(bus, lambda: 0.0, Log("plain", [].append))
    try:
        bridge.step()
        futures = [bridge.request("slow", Empty()) for _ in range(200)]
        start_time = time.thread_time()
        bridge.step()
        assert time.thread_time() - start_time < 0.5  # 2 s for all of them
        assert CALLS_AT_ONCE < MAX_CALLS
        assert 1 <= answers < 100
        while not all(future.done() for future in futures[:answers]):
            bridge.step()
        n_calls = answers
        bridge.step()
        assert answers - n_calls <= 1
    finally:
        bridge.close()


def test_few_calls_are_answered_at_the_next_step_whatever_they_take() -> None:
    bus = Bus()
    bus.services.serve("slow", Empty, lambda request: (time.sleep(0.01), EmptyResponse())[1])
    bridge = PlainBridge(bus, lambda: 0.0, Log("plain", [].append))
    try:
        for _ in range(20):
            future = bridge.request("slow", Empty())
            bridge.step()
            assert future.done()
    finally:
        bridge.close()


def test_a_frame_with_many_keys_is_refused_in_no_time() -> None:
    frame = json.dumps({"op": "publish", "msg": {f"k{i}": 0 for i in range(3 * MAX_KEYS)}})
    start_time = time.thread_time()
    with pytest.raises(BadMessage, match="fields"):
        read_frame(frame)
    with pytest.raises(BadMessage, match="fields"):
        from_json(Twist, {f"k{i}": 0 for i in range(1000)})
    assert time.thread_time() - start_time < 0.5


@pytest.mark.parametrize(
    ("frame", "actual"),
    [
        ("[" + "{}," * (5 * 2**20) + "0]", "opening brackets"),
        ("[" + "[]," * (5 * 2**20) + "0]", "opening brackets"),
        ("[" + "[" * 100 + '"",' * (5 * 2**20) + "0]", "quotation marks"),
    ],
)
def test_a_frame_with_many_values_is_refused_in_no_time(frame: str, actual: str) -> None:
    """They took 3 to 10 s each."""
    start_time = time.thread_time()
    with pytest.raises(BadMessage, match=actual):
        read_frame(frame)
    assert time.thread_time() - start_time < 1.0
