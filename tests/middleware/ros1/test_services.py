"""What a service answers over TCPROS."""

from __future__ import annotations

from concurrent.futures import Future

import pytest

from uwsim.messages import header
from uwsim.messages.simulation_control import (
    EntityState,
    SetEntityState,
    SetEntityStateResponse,
)
from uwsim.middleware.encodings import to_ros1
from uwsim.middleware.ros1.services import ExternalService, _answer, call
from uwsim.middleware.ros1.tcpros import PeerError
from uwsim.middleware.types import service, wire_service


def test_stamps_of_a_request_are_taken_for_times_of_the_clock_of_ros() -> None:
    requests: list[SetEntityState] = []

    def request(entry: SetEntityState) -> Future[object]:
        requests.append(entry)
        answer: Future[object] = Future()
        answer.set_result(SetEntityStateResponse())
        return answer

    kind = wire_service(service("simulation_interfaces/srv/SetEntityState"))
    data = bytes(to_ros1(SetEntityState(state=EntityState(header=header(1.5)))))
    assert _answer(data, kind, request)[:1] == b"\x01"
    stamp = requests[0].state.header.stamp
    assert (stamp.sec, stamp.nanosec) == (0, 500_000_000)


@pytest.mark.parametrize("place", ["127.0.0.1:99999", "[::", "127.0.0.1:abc", "", "here", ":80"])
def test_an_address_of_nonsense_is_an_error_of_the_peer(place: str) -> None:
    wanted = ExternalService(
        "/s", wire_service(service("simulation_interfaces/srv/SetEntityState"))
    )
    with pytest.raises(PeerError, match="which is not an address"):
        call(f"rosrpc://{place}", wanted, "/uwsim", SetEntityState())
