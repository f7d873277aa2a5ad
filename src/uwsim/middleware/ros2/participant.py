"""A participant of a DDS domain that ROS 2 nodes recognize as a node.

One thread (``uwsim-ros2``) waits for samples and calls the callbacks of the readers; any thread may
make endpoints and write. No listener of Cyclone DDS is used: its threads would wait for Python's
lock while they hold their own.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from types import MappingProxyType
from typing import Any

from cyclonedds.core import (
    DDSException,
    DDSStatus,
    GuardCondition,
    InstanceState,
    ReadCondition,
    SampleState,
    ViewState,
    WaitSet,
)
from cyclonedds.domain import DomainParticipant
from cyclonedds.internal import DDS
from cyclonedds.pub import DataWriter
from cyclonedds.qos import Policy, Qos
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

from ...errors import UwsimError
from .policies import policies
from .quality import Quality
from .raw_types import RawSample

Events = Mapping[int, Callable[[Any], None]]
"""The callbacks for each status of an endpoint, called with the endpoint when it changes."""
ERROR_MASK = 0b11
"""The mask of log messages of Cyclone DDS: errors and fatal errors."""
NO_EVENTS: Events = MappingProxyType({})
"""No callbacks."""
READERS_CHANGED = DDSStatus.PublicationMatched
"""The status of a writer: readers came or left."""
WRITERS_CHANGED = DDSStatus.SubscriptionMatched
"""The status of a reader: writers came or left."""
WRITER_REFUSED = DDSStatus.RequestedIncompatibleQos
"""The status of a reader: a writer's quality of service does not suffice."""
SAMPLES_AT_ONCE = 100
"""The number of samples that are taken from a reader before the next reader's turn."""
VARIABLE = "CYCLONEDDS_URI"
"""The variable from which Cyclone DDS reads its configuration."""
WAKE_S = 1.0
"""The longest sleep of the thread [s]."""


class Writer:
    """A writer of encoded samples to a topic."""

    def __init__(self, entity: Any, type: type[RawSample]) -> None:
        self.entity = entity
        """The writer in cyclonedds."""
        self._type = type
        self.n_dropped = 0
        """The number of samples dropped because a reliable reader was too far behind."""

    def write(self, data: bytes) -> bool:
        """Write a sample, including the CDR header; return whether it was accepted.

        Raises:
            UwsimError: the sample does not match the type.
        """
        try:
            self.entity.write(self._type(data))
        except DDSException as error:
            if error.code != DDSException.DDS_RETCODE_TIMEOUT:
                raise UwsimError(f"Cyclone DDS refuses a sample: {error}") from error
            self.n_dropped += 1
            return False
        return True

    @property
    def n_readers(self) -> int:
        """The number of readers that match the writer, in this process and others."""
        return len(self.entity.get_matched_subscriptions())


def _print_errors_only() -> None:
    """Suppress warnings of Cyclone DDS, as a peer may cause one with each sample that it sends."""
    library: Any = getattr(DDS, "_dll_handle", None)
    if hasattr(library, "dds_set_log_mask"):
        library.dds_set_log_mask(ERROR_MASK)


class Participant:
    """A participant of a DDS domain; `close` ends it.

    Args:
        domain: the DDS domain.
        configuration: XML for Cyclone DDS; the first for a domain in a process applies.

    Raises:
        UwsimError: there is no network interface, or no free port.
    """

    def __init__(self, domain: int, configuration: str) -> None:
        quality = Qos(Policy.Userdata(b"enclave=/;"))
        try:
            with _set_configuration(configuration):
                self._entity: Any = DomainParticipant(domain, quality)
        except DDSException as error:
            raise UwsimError(
                f"--ros2: Cyclone DDS cannot join domain {domain}: {error} (CYCLONEDDS_URI is "
                "read, too)"
            ) from error
        _print_errors_only()
        self._topics: dict[str, Any] = {}
        self._lock = threading.Lock()
        self._readers: dict[Any, tuple[Any, Callable[[Any], None]]] = {}
        self._events: dict[Any, Events] = {}
        self._waitset: Any = WaitSet(self._entity)
        self._wake: Any = GuardCondition(self._entity)
        self._waitset.attach(self._wake)
        self._is_open = True
        self.error: BaseException | None = None
        """The error that ended the thread; None if it runs."""
        self._thread = threading.Thread(target=self._run, name="uwsim-ros2", daemon=True)
        self._thread.start()

    @property
    def guid(self) -> bytes:
        """The identity of the participant on the network, 16 bytes."""
        return guid_of(self._entity)

    def writer(
        self,
        name: str,
        type: type[RawSample],
        quality: Quality,
        *,
        user_data: bytes = b"",
        events: Events = NO_EVENTS,
    ) -> Writer:
        """Make a writer; the callbacks in ``events`` are called in the thread."""
        with self._lock:
            entity = DataWriter(self._entity, self._topic(name, type), policies(quality, user_data))
            self._add_events(entity, events)
        return Writer(entity, type)

    def reader(
        self,
        name: str,
        type: type[RawSample],
        quality: Quality,
        callback: Callable[[Any], None],
        *,
        user_data: bytes = b"",
        events: Events = NO_EVENTS,
    ) -> Any:
        """Make a reader; ``callback(sample)`` and those in ``events`` are called in the thread."""
        with self._lock:
            entity = DataReader(self._entity, self._topic(name, type), policies(quality, user_data))
            states = ViewState.Any | SampleState.NotRead | InstanceState.Any
            condition = ReadCondition(entity, states)
            self._readers[condition] = (entity, callback)
            self._waitset.attach(condition)
            self._add_events(entity, events)
        return entity

    def forget(self, entity: Any) -> None:
        """Delete a reader or writer of this participant."""
        with self._lock:
            for condition, (reader, _) in list(self._readers.items()):
                if reader is entity:
                    self._waitset.detach(condition)
                    del self._readers[condition]
            if self._events.pop(entity, None) is not None:
                self._waitset.detach(entity)
        _delete(entity)

    def close(self) -> None:
        """Leave the domain."""
        if not self._is_open:
            return
        self._is_open = False
        self._wake.set(True)
        self._thread.join()
        _delete(self._entity)

    def _topic(self, name: str, type: type[RawSample]) -> Any:
        if name not in self._topics:
            self._topics[name] = Topic(self._entity, name, type)
        return self._topics[name]

    def _add_events(self, entity: Any, events: Events) -> None:
        if events:
            mask = 0
            for status in events:
                mask |= status
            entity.set_status_mask(mask)
            self._events[entity] = events
            self._waitset.attach(entity)

    def _run(self) -> None:
        pause = duration(milliseconds=round(WAKE_S * 1000))
        try:
            while self._is_open:
                self._waitset.wait(pause)
                self._take()
        except BaseException as error:  # reported by the bridge, as a thread has no caller
            self.error = error

    def _take(self) -> None:
        with self._lock:
            readers = list(self._readers.values())
            event_items = list(self._events.items())
        for entity, events in event_items:
            changes = entity.get_status_changes()
            for status, call in events.items():
                if changes & status:
                    entity.take_status(status)
                    call(entity)
        for reader, callback in readers:
            for sample in reader.take(SAMPLES_AT_ONCE):
                if isinstance(sample, RawSample):
                    callback(sample)


def guid_of(entity: Any) -> bytes:
    """Return the identity of a participant or endpoint on the network, 16 bytes."""
    return bytes(entity.get_guid().bytes)


def _delete(entity: Any) -> None:
    """Delete an entity and its children now, even if Python objects refer to them."""
    entity._delete(entity._ref)


@contextmanager
def _set_configuration(configuration: str) -> Iterator[None]:
    """Set, in the context, the variable that Cyclone DDS reads when a process joins a domain."""
    old_value = os.environ.get(VARIABLE)
    os.environ[VARIABLE] = configuration
    try:
        yield
    finally:
        if old_value is None:
            del os.environ[VARIABLE]
        else:
            os.environ[VARIABLE] = old_value
