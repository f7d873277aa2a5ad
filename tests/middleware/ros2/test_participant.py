"""Two participants of one DDS domain, without ROS 2."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from tests.support.ros2_peers import free_domain, wait_until
from uwsim.errors import UwsimError
from uwsim.messages import String
from uwsim.middleware.encodings import from_cdr, to_cdr

pytest.importorskip("cyclonedds", reason="cyclonedds is not installed: pip install uwsim[ros2]")

from uwsim.middleware.ros2.participant import READERS_CHANGED, Participant
from uwsim.middleware.ros2.quality import Quality
from uwsim.middleware.ros2.raw_types import raw_type
from uwsim.middleware.ros2.settings import Ros2Settings
from uwsim.middleware.types import ros2_store

TEXT = raw_type(ros2_store(), "std_msgs/msg/String")


@pytest.fixture
def two() -> Iterator[tuple[Participant, Participant]]:
    with free_domain() as domain:
        configuration = Ros2Settings(domain=domain).configuration()
        first, other = Participant(domain, configuration), Participant(domain, configuration)
        try:
            yield first, other
        finally:
            other.close()
            first.close()


def assert_nothing_comes() -> None:
    """What there is to do while a test waits."""


def test_bytes_go_from_one_to_the_other_as_they_are(two: tuple[Participant, Participant]) -> None:
    sender, receiver = two
    n_readers: list[int] = []
    writer = sender.writer(
        "rt/a",
        TEXT,
        Quality(),
        events={READERS_CHANGED: lambda w: n_readers.append(len(w.get_matched_subscriptions()))},
    )
    samples: list[Any] = []
    receiver.reader("rt/a", TEXT, Quality(), samples.append)
    wait_until(lambda: n_readers and n_readers[-1] == 1, assert_nothing_comes)
    sent_messages = [bytes(to_cdr(String(data="x" * n))) for n in range(5)]
    for data in sent_messages:
        assert writer.write(data)
    wait_until(lambda: len(samples) == 5, assert_nothing_comes)
    assert [from_cdr(String, entry.data).data for entry in samples] == ["x" * n for n in range(5)]


def test_what_is_latched_reaches_a_reader_that_comes_late(
    two: tuple[Participant, Participant],
) -> None:
    sender, receiver = two
    writer = sender.writer("rt/a", TEXT, Quality(depth=2, is_latched=True))
    for text in "abc":
        writer.write(bytes(to_cdr(String(data=text))))
    samples: list[Any] = []
    receiver.reader("rt/a", TEXT, Quality(is_latched=True), samples.append)
    wait_until(lambda: len(samples) == 2, assert_nothing_comes)
    assert [from_cdr(String, entry.data).data for entry in samples] == ["b", "c"]


def test_a_writer_that_is_forgotten_leaves_its_readers(
    two: tuple[Participant, Participant],
) -> None:
    sender, receiver = two
    writer = sender.writer("rt/a", TEXT, Quality())
    reader = receiver.reader("rt/a", TEXT, Quality(), lambda sample: None)
    wait_until(reader.get_matched_publications, assert_nothing_comes)
    sender.forget(writer.entity)
    wait_until(lambda: not reader.get_matched_publications(), assert_nothing_comes)


def test_a_configuration_that_cyclone_dds_refuses_is_an_error_of_the_user() -> None:
    with free_domain() as domain, pytest.raises(UwsimError, match="CYCLONEDDS_URI"):
        Participant(domain, "<CycloneDDS><Domain><Nonsense/></Domain></CycloneDDS>")
