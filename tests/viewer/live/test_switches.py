"""A switch that is pressed and released between two steps still has its effect, once."""

from __future__ import annotations

import time
from typing import Any

from uwsim.algorithms.pilot import AXES
from uwsim.viewer.live.clock import Clock
from uwsim.viewer.live.mapping import PilotMapping
from uwsim.viewer.live.viewer_requests import ViewerRequests


class Server:
    """A server whose messages are put there by hand."""

    def __init__(self) -> None:
        self.messages: list[tuple[int, dict[str, Any]]] = []

    def pop_messages(self) -> list[tuple[int, dict[str, Any]]]:
        messages, self.messages = self.messages, []
        return messages


def test_a_short_press_arms_once() -> None:
    server = Server()
    requests = ViewerRequests(server, Clock(1.0, time.monotonic), PilotMapping())  # type: ignore[arg-type]
    assert requests.take_inputs() is None
    for keys in (["5", "w"], ["w"]):
        server.messages.append((1, {"type": "input", "keys": keys}))
    requests.receive()
    first, second = requests.take_inputs(), requests.take_inputs()
    assert first is not None
    assert second is not None
    arm, surge = AXES.index("arm"), AXES.index("surge")
    assert (first[arm], first[surge]) == (1.0, 1.0)
    assert (second[arm], second[surge]) == (0.0, 1.0)


def test_a_key_that_is_held_stays_and_other_axes_have_no_memory() -> None:
    server = Server()
    requests = ViewerRequests(server, Clock(1.0, time.monotonic), PilotMapping())  # type: ignore[arg-type]
    for keys in (["w"], ["6"]):
        server.messages.append((1, {"type": "input", "keys": keys}))
    requests.receive()
    for _ in range(2):
        inputs = requests.take_inputs()
        assert inputs is not None
        assert inputs[AXES.index("arm")] == -1.0
        assert inputs[AXES.index("surge")] == 0.0
