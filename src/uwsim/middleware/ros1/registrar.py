"""What a node tells its master: what it publishes, reads and serves; again after a restart.

All calls of the master are made in one thread, so that a master that hangs holds nobody up.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from ..log import Log
from .tcpros import PeerError
from .xmlrpc import Refused, call

POLL = 1.0
"""How often it looks whether the master is there and knows this node [s]."""


@dataclass
class Wanted:
    """What shall be registered: topic -> type, service -> its ``rosrpc`` URI."""

    publishers: dict[str, str] = field(default_factory=dict)
    subscribers: dict[str, str] = field(default_factory=dict)
    services: dict[str, str] = field(default_factory=dict)

    def items(self) -> set[tuple[str, str, str]]:
        """Kind, name and type or URI of each."""
        return {
            (kind, name, value)
            for kind in ("publishers", "subscribers", "services")
            for name, value in getattr(self, kind).items()
        }


class Registrar:
    """Keeps a node registered with its master.

    Args:
        master: URI of the master.
        caller: name of the node.
        uri: of the node's own XML-RPC server.
        log: where it reports.
        publishers: called with a topic and the URIs of its publishers.
        parameters: set when the master is reached, and put back at the end.
        poll: how often it looks for the master [s].
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
        self._before: dict[str, Any] = {}
        self._lock = threading.Lock()
        self._update_lock = threading.Lock()
        self._updated: set[str] = set()  # topics of updates since their registration was begun
        self._wanted: set[tuple[str, str, str]] = set()
        self._registered: set[tuple[str, str, str]] = set()
        self._is_lost = self._has_given_up = False
        self._news, self._stopped = threading.Event(), threading.Event()
        self._settled = threading.Condition(self._lock)
        self._thread = threading.Thread(target=self._run, name="ros1-registrar", daemon=True)
        self._thread.start()

    def want(self, wanted: Wanted) -> None:
        """Have this registered, and nothing else."""
        with self._lock:
            self._wanted = wanted.items()
        self._news.set()

    def wait(self, timeout: float) -> bool:
        """Wait until all that is wanted is registered; whether it is [s]."""
        with self._settled:
            return self._settled.wait_for(
                lambda: bool(self._wanted) and self._wanted == self._registered, timeout
            )

    def update(self, topic: str, uris: list[str]) -> None:
        """Take in an update of the master: the publishers of a topic. Any thread."""
        with self._update_lock:
            self._updated.add(topic)
            self._publishers(topic, uris)

    def close(self) -> None:
        """Unregister everything."""
        self._stopped.set()
        self._news.set()
        self._thread.join(timeout=20.0)

    def give_up(self) -> None:
        """Register nothing more; called when the master gives the node's name to another."""
        with self._lock:
            self._has_given_up = True
            self._registered = set()
            self._before = {}

    def call(self, method: str, *arguments: Any) -> Any:
        """Call the master; raises PeerError."""
        return call(self._master, method, self._caller, *arguments)

    def _run(self) -> None:
        while not self._stopped.is_set():
            try:
                self._look()
                if not self._has_given_up:
                    self._reconcile()
            except PeerError as error:
                if not self._is_lost:
                    self._log.report(f"the master: {error}; it is tried again", kind="master lost")
                self._is_lost = True
            except Exception as error:  # a defect here must not end the registrations
                what = f"{type(error).__name__}: {error}"
                self._log.report(
                    f"registering failed: {what}; it is tried again", kind="registering"
                )
            self._news.wait(self._poll)
            self._news.clear()
        with suppress(PeerError):
            self._leave()

    def _look(self) -> None:
        """Forget what was registered if the master does not know this node any more."""
        if not self._registered:
            return
        try:
            found = self.call("lookupNode", self._caller)
        except Refused:
            found = None
        if found is not None and found != self._uri:
            self._log.report(f"another node is called {self._caller}; this one leaves the graph")
            self.give_up()
        elif found != self._uri:
            self._log.report("the master was restarted; the node registers again", kind="restarted")
            with self._lock:
                self._registered = set()
            self._before = {}
        elif self._is_lost:
            self._log.report("the master is back", kind="back")
        self._is_lost = False

    def _reconcile(self) -> None:
        with self._lock:
            wanted, registered = set(self._wanted), set(self._registered)
        for item in sorted(registered - wanted):
            self._unregister(item)
        for item in sorted(wanted - registered):
            self._register(item)
        if wanted and self._parameters and not self._before:
            self._set_parameters()
        with self._settled:
            self._settled.notify_all()

    def _register(self, item: tuple[str, str, str]) -> None:
        """Register one; where the master refuses it, the others are registered all the same."""
        kind, name, value = item
        try:
            if kind == "publishers":
                self.call("registerPublisher", name, value, self._uri)
            elif kind == "subscribers":
                self._subscribe(name, value)
            else:
                self.call("registerService", name, value, self._uri)
        except Refused as error:
            self._log.report(f"not on the graph: {name}: {error}")
        with self._lock:
            self._registered.add(item)

    def _subscribe(self, topic: str, kind: str) -> None:
        """Register a subscriber; an update that overtakes the answer is newer than it."""
        with self._update_lock:
            self._updated.discard(topic)
        found = self.call("registerSubscriber", topic, kind, self._uri)
        if not isinstance(found, list):
            raise PeerError(f"registerSubscriber: expected a list, not {type(found).__name__}")
        with self._update_lock:
            if topic not in self._updated:
                self._publishers(topic, [each for each in found if isinstance(each, str)])

    def _unregister(self, item: tuple[str, str, str]) -> None:
        kind, name, value = item
        with suppress(Refused):  # as when it was registered
            if kind == "publishers":
                self.call("unregisterPublisher", name, self._uri)
            elif kind == "subscribers":
                self.call("unregisterSubscriber", name, self._uri)
            else:
                self.call("unregisterService", name, value)
        with self._lock:
            self._registered.discard(item)

    def _set_parameters(self) -> None:
        for name, value in self._parameters.items():
            try:
                self._before[name] = self.call("getParam", name)
            except Refused:
                self._before[name] = None
            self.call("setParam", name, value)

    def _leave(self) -> None:
        if self._is_lost:
            return
        for item in sorted(self._registered):
            self._unregister(item)
        for name, before in self._before.items():
            if before is None:
                self.call("deleteParam", name)
            else:
                self.call("setParam", name, before)
