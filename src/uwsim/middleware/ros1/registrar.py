"""Registration of a node's publications, subscriptions and services with its master.

It is repeated after a restart of the master. One thread makes all calls to the master, so that a
master that does not answer delays no other thread.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from ..log import Log
from .tcpros import PeerError
from .xmlrpc import RefusedCall, call

POLL = 1.0
"""The interval of checks that the master is reachable and has this node [s]."""


@dataclass
class Registrations:
    """The registrations of a node."""

    publishers: dict[str, str] = field(default_factory=dict)
    """The types of the published topics, by topic."""
    subscribers: dict[str, str] = field(default_factory=dict)
    """The types of the subscribed topics, by topic."""
    services: dict[str, str] = field(default_factory=dict)
    """The ``rosrpc`` URIs of the services, by name."""

    def items(self) -> set[tuple[str, str, str]]:
        """Return kind, name and type or URI of each registration."""
        return {
            (kind, name, value)
            for kind in ("publishers", "subscribers", "services")
            for name, value in getattr(self, kind).items()
        }


class Registrar:
    """The thread that keeps a node registered with its master.

    Args:
        master: the URI of the master.
        caller: the name of the node.
        uri: the URI of the node's own XML-RPC server.
        log: the log for events.
        publishers: a function that is called with a topic and the URIs of its publishers.
        parameters: the parameters to set on the master, and to restore at the end.
        poll: the interval of checks of the master [s].
    """

    def __init__(
        self,
        master: str,
        caller: str,
        uri: str,
        log: Log,
        publishers: Callable[[str, list[str]], None],
        *,
        parameters: Mapping[str, Any],
        poll: float = POLL,
    ) -> None:
        self._master, self._caller, self._uri, self._log = master, caller, uri, log
        self._publishers, self._poll = publishers, poll
        self._parameters = dict(parameters)
        self._old_parameters: dict[str, Any] = {}
        self._lock = threading.Lock()
        self._update_lock = threading.Lock()
        self._updated_topics: set[str] = set()  # since the start of their registration
        self._targets: set[tuple[str, str, str]] = set()
        self._entries: set[tuple[str, str, str]] = set()
        self._is_lost = self._has_given_up = False
        self._wake_event, self._stop_event = threading.Event(), threading.Event()
        self._condition = threading.Condition(self._lock)
        self._thread = threading.Thread(target=self._run, name="ros1-registrar", daemon=True)
        self._thread.start()

    def set_registrations(self, registrations: Registrations) -> None:
        """Set the registrations to keep; all others are removed from the master."""
        with self._lock:
            self._targets = registrations.items()
        self._wake_event.set()

    def wait(self, timeout: float) -> bool:
        """Wait until all is registered; return False after ``timeout`` [s]."""
        with self._condition:
            return self._condition.wait_for(
                lambda: bool(self._targets) and self._targets == self._entries, timeout
            )

    def update(self, topic: str, uris: list[str]) -> None:
        """Pass on an update from the master: the publishers of a topic.

        May be called from any thread.
        """
        with self._update_lock:
            self._updated_topics.add(topic)
            self._publishers(topic, uris)

    def close(self) -> None:
        """Unregister everything."""
        self._stop_event.set()
        self._wake_event.set()
        self._thread.join(timeout=20.0)

    def give_up(self) -> None:
        """Register nothing more, because another node has registered under this node's name."""
        with self._lock:
            self._has_given_up = True
            self._entries = set()
            self._old_parameters = {}

    def call(self, method: str, *arguments: Any) -> Any:
        """Call the master and return the value of its answer; raise PeerError if that fails."""
        return call(self._master, method, self._caller, *arguments)

    def _run(self) -> None:
        while not self._stop_event.is_set():
            try:
                self._check_master()
                if not self._has_given_up:
                    self._reconcile()
            except PeerError as error:
                if not self._is_lost:
                    self._log.report(f"the master: {error}; it is tried again", kind="master lost")
                self._is_lost = True
            except Exception as error:  # a defect here must not end the registration thread
                text = f"registration failed: {type(error).__name__}: {error}; it is tried again"
                self._log.report(text, kind="registering")
            self._wake_event.wait(self._poll)
            self._wake_event.clear()
        with suppress(PeerError):
            self._unregister_all()

    def _check_master(self) -> None:
        """Check that the master has this node; if it was restarted, register again."""
        if not self._entries:
            return
        try:
            uri = self.call("lookupNode", self._caller)
        except RefusedCall:
            uri = None
        if uri is not None and uri != self._uri:
            self._log.report(
                f"another node took the name {self._caller}; this one leaves the graph"
            )
            self.give_up()
        elif uri != self._uri:
            self._log.report("the master was restarted; the node registers again", kind="restarted")
            with self._lock:
                self._entries = set()
            self._old_parameters = {}
        elif self._is_lost:
            self._log.report("the master answers again", kind="back")
        self._is_lost = False

    def _reconcile(self) -> None:
        with self._lock:
            targets, entries = (set(self._targets), set(self._entries))
        for item in sorted(entries - targets):
            self._unregister(item)
        for item in sorted(targets - entries):
            self._register(item)
        if targets and self._parameters and not self._old_parameters:
            self._set_parameters()
        with self._condition:
            self._condition.notify_all()

    def _register(self, item: tuple[str, str, str]) -> None:
        """Register a topic or service; if the master refuses it, report that and continue."""
        kind, name, value = item
        try:
            if kind == "publishers":
                self.call("registerPublisher", name, value, self._uri)
            elif kind == "subscribers":
                self._subscribe(name, value)
            else:
                self.call("registerService", name, value, self._uri)
        except RefusedCall as error:
            self._log.report(f"not on the graph: {name}: {error}")
        with self._lock:
            self._entries.add(item)

    def _subscribe(self, topic: str, kind: str) -> None:
        """Register a subscriber; an update that arrives before the answer is newer than it."""
        with self._update_lock:
            self._updated_topics.discard(topic)
        uris = self.call("registerSubscriber", topic, kind, self._uri)
        if not isinstance(uris, list):
            raise PeerError(f"registerSubscriber: expected a list, not {type(uris).__name__}")
        with self._update_lock:
            if topic not in self._updated_topics:
                self._publishers(topic, [uri for uri in uris if isinstance(uri, str)])

    def _unregister(self, item: tuple[str, str, str]) -> None:
        kind, name, value = item
        with suppress(RefusedCall):  # as when it was registered
            if kind == "publishers":
                self.call("unregisterPublisher", name, self._uri)
            elif kind == "subscribers":
                self.call("unregisterSubscriber", name, self._uri)
            else:
                self.call("unregisterService", name, value)
        with self._lock:
            self._entries.discard(item)

    def _set_parameters(self) -> None:
        for name, value in self._parameters.items():
            try:
                self._old_parameters[name] = self.call("getParam", name)
            except RefusedCall:
                self._old_parameters[name] = None
            self.call("setParam", name, value)

    def _unregister_all(self) -> None:
        if self._is_lost:
            return
        for item in sorted(self._entries):
            self._unregister(item)
        for name, value in self._old_parameters.items():
            if value is None:
                self.call("deleteParam", name)
            else:
                self.call("setParam", name, value)
