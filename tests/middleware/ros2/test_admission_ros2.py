"""Over DDS senders are told apart by their participants."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

pytest.importorskip("cyclonedds", reason="cyclonedds is not installed: pip install uwsim[ros2]")

from tests.middleware.ros2.simulator import Simulator, run_in_thread
from tests.support.waiting import wait_until
from uwsim.messages import Empty, EmptyResponse, String
from uwsim.middleware.admission import SingleProgram
from uwsim.middleware.encodings import to_cdr
from uwsim.middleware.ros2.participant import Participant
from uwsim.middleware.ros2.quality import Quality
from uwsim.middleware.ros2.raw_types import CDR_HEADER, raw_type
from uwsim.middleware.ros2.service_server import CALL_FIELDS, CALL_HEADER
from uwsim.middleware.ros2.settings import Ros2Settings
from uwsim.middleware.types import ros2_store


@pytest.fixture
def simulator(monkeypatch: pytest.MonkeyPatch) -> Iterator[Simulator]:
    monkeypatch.setenv("UWSIM_ROS2", "dds")
    with run_in_thread() as actual:
        actual.bridge.admission = SingleProgram(lambda sender, text: None)
        yield actual


@pytest.fixture
def two(simulator: Simulator) -> Iterator[tuple[Participant, Participant]]:
    settings = Ros2Settings(domain=simulator.domain)
    actual = [Participant(settings.domain, settings.configuration()) for _ in range(2)]
    yield actual[0], actual[1]
    for entry in actual:
        entry.close()


def participant_name(participant: Participant) -> str:
    return f"participant {participant.guid[:12].hex()}"


def test_another_participant_publishes_nothing(
    simulator: Simulator, two: tuple[Participant, Participant]
) -> None:
    inbox = simulator.bus.inbox("status", String)
    kind = raw_type(ros2_store(), "std_msgs/msg/String")
    writers = [participant.writer("rt/status", kind, Quality()) for participant in two]
    simulator.step()
    wait_until(lambda: all(writer.n_readers for writer in writers), simulator.step)
    admission = simulator.bridge.admission
    assert admission is not None
    admission.admit(participant_name(two[1]))
    arrivals: list[str] = []

    def publish() -> None:
        for writer, text in zip(writers, ("falsified", "tracking"), strict=True):
            writer.write(bytes(to_cdr(String(data=text))))
        simulator.step()
        arrivals.extend(message.data for message in inbox.take())

    refusals: list[tuple[str, str, int]] = []
    wait_until(
        lambda: arrivals and refusals, publish, lambda: refusals.extend(admission.pop_refusals())
    )
    assert set(arrivals) == {"tracking"}
    assert {entry[:2] for entry in refusals} == {(participant_name(two[0]), "/status")}


def test_another_participant_calls_no_service(
    simulator: Simulator, two: tuple[Participant, Participant]
) -> None:
    n = [0]

    def answer(request: Empty) -> EmptyResponse:
        n[0] += 1
        return EmptyResponse()

    simulator.bus.services.serve("reset", Empty, answer)
    simulator.step()
    kind = raw_type(ros2_store(), "std_srvs/srv/Empty_Request", prefix=CALL_FIELDS)
    writers = [participant.writer("rq/resetRequest", kind, Quality()) for participant in two]
    wait_until(lambda: all(writer.n_readers for writer in writers), simulator.step)
    admission = simulator.bridge.admission
    assert admission is not None
    admission.admit(participant_name(two[1]))
    data = bytes(to_cdr(Empty()))
    call = data[:CDR_HEADER] + CALL_HEADER.pack(1, 1) + data[CDR_HEADER:]
    refusals: list[tuple[str, str, int]] = []
    wait_until(
        lambda: refusals,
        lambda: writers[0].write(call),  # again: a reader may not know the writer yet
        simulator.step,
        lambda: refusals.extend(admission.pop_refusals()),
    )
    assert (n, {entry[:2] for entry in refusals}) == ([0], {(participant_name(two[0]), "/reset")})
    wait_until(lambda: n[0], lambda: writers[1].write(call), simulator.step)
