"""A small ROS 1 master: registrations of publishers, subscribers and services, and parameters.

It has the functions of ``rosmaster``: registrations, look-ups, ``publisherUpdate`` to the
subscribers of a topic, and a parameter server with ``paramUpdate``. It is started if no ``roscore``
runs. Unlike ``roscore``, it does not collect log messages on ``/rosout``.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from typing import Any

from ..log import Log
from .arguments import MASTER_METHODS, PARAMETER_METHODS, validate
from .node_calls import NodeCalls
from .parameters import Parameters, resolve
from .tcpros import PeerError
from .xmlrpc import MAX_NODE_ANSWER, Answer, XmlRpcServer, call

MAX_ENTRIES = 10_000
"""The maximum number of publishers, of subscribers, of services, and of nodes."""
FULL_ERROR = f"at most {MAX_ENTRIES} entries of a kind are kept"
"""The error of a registration beyond the limit."""
Registrations = dict[str, dict[str, str]]
"""The URIs of the nodes registered for each topic, by topic and name of the node."""


class Master:
    """A master of ROS 1.

    Args:
        log: the log for events.
        host: the address to listen on.
        port: the port; 0 selects a free one.

    Raises:
        OSError: the port is in use.
    """

    def __init__(self, log: Log, *, host: str = "127.0.0.1", port: int = 0) -> None:
        self._lock = threading.RLock()
        self._publishers: Registrations = {}
        self._subscribers: Registrations = {}
        self._services: dict[str, tuple[str, str, str]] = {}
        self._nodes: dict[str, str] = {}
        self._types: dict[str, str] = {}
        self._parameters = Parameters()
        self._node_calls = NodeCalls()
        methods = {
            name: validate(method, self._limit(name, getattr(self, f"_{_snake(name)}")))
            for name, method in MASTER_METHODS.items()
        }
        methods |= {
            name: validate(method, self._wrap(name)) for name, method in PARAMETER_METHODS.items()
        }
        self._server = XmlRpcServer(host, port, methods, log, "master")
        self.uri = f"http://{host}:{self._server.port}/"
        """The address of the master, as in ``ROS_MASTER_URI``."""

    def close(self) -> None:
        """Stop the server."""
        self._server.close()
        self._node_calls.close()

    def _wrap(self, name: str) -> Any:
        method = getattr(self._parameters, _snake(name))

        def answer(*arguments: Any) -> Answer:
            with self._lock:
                result, updates = method(*arguments)
            for uri, key, value in updates:
                self._call(uri, "paramUpdate", "/master", key, value)
            return list(result)

        return answer

    def _limit(self, name: str, method: Callable[..., Answer]) -> Callable[..., Answer]:
        """Return a method that refuses registrations beyond the limit."""
        if not name.startswith("register"):
            return method

        def answer(*arguments: Any) -> Answer:
            return [-1, FULL_ERROR, 0] if self._is_full() else method(*arguments)

        return answer

    def _is_full(self) -> bool:
        with self._lock:
            publishers, subscribers = (
                sum(map(len, entries.values())) for entries in (self._publishers, self._subscribers)
            )
            n = max(publishers, subscribers, len(self._services), len(self._nodes))
            return n >= MAX_ENTRIES

    def _register_publisher(self, caller: str, topic: str, kind: str, uri: str) -> Answer:
        with self._lock:
            topic = resolve(topic, caller)
            self._add_node(caller, uri)
            self._publishers.setdefault(topic, {})[caller] = uri
            if kind != "*" or topic not in self._types:
                self._types[topic] = kind
            subscribers = list(self._subscribers.get(topic, {}).values())
        self._send_update(topic)
        return [1, f"Registered {caller} as publisher of {topic}", subscribers]

    def _unregister_publisher(self, caller: str, topic: str, uri: str) -> Answer:
        n = self._unregister(self._publishers, resolve(topic, caller), caller, uri)
        if n:
            self._send_update(resolve(topic, caller))
        return [1, "Unregistered" if n else "Was not registered", n]

    def _register_subscriber(self, caller: str, topic: str, kind: str, uri: str) -> Answer:
        with self._lock:
            topic = resolve(topic, caller)
            self._add_node(caller, uri)
            self._subscribers.setdefault(topic, {})[caller] = uri
            if kind != "*":
                self._types.setdefault(topic, kind)
            publishers = list(self._publishers.get(topic, {}).values())
        return [1, f"Subscribed to {topic}", publishers]

    def _unregister_subscriber(self, caller: str, topic: str, uri: str) -> Answer:
        n = self._unregister(self._subscribers, resolve(topic, caller), caller, uri)
        return [1, "Unregistered" if n else "Was not registered", n]

    def _register_service(self, caller: str, service: str, api: str, uri: str) -> Answer:
        with self._lock:
            self._add_node(caller, uri)
            self._services[resolve(service, caller)] = (caller, api, uri)
        return [1, f"Registered service {service}", 1]

    def _unregister_service(self, caller: str, service: str, api: str) -> Answer:
        with self._lock:
            name = resolve(service, caller)
            is_registered = self._services.get(name, ("", "", ""))[1] == api
            if is_registered:
                node = self._services.pop(name)[0]
                self._remove_if_unused(node)
        return [1, "Unregistered" if is_registered else "Was not registered", int(is_registered)]

    def _lookup_service(self, caller: str, service: str) -> Answer:
        with self._lock:
            entry = self._services.get(resolve(service, caller))
        return [1, "rosrpc URI", entry[1]] if entry else [-1, f"no provider of {service}", ""]

    def _lookup_node(self, caller: str, node: str) -> Answer:
        with self._lock:
            uri = self._nodes.get(resolve(node, caller))
        return [1, "node api", uri] if uri else [-1, f"unknown node {node}", ""]

    def _get_published_topics(self, caller: str, subgraph: str) -> Answer:
        prefix = resolve(subgraph, caller).rstrip("/") + "/" if subgraph else "/"
        with self._lock:
            topics = [
                [topic, self._types.get(topic, "*")]
                for topic in sorted(self._publishers)
                if topic.startswith(prefix) and self._publishers[topic]
            ]
        return [1, "current topics", topics]

    def _get_topic_types(self, caller: str) -> Answer:
        with self._lock:
            return [1, "current topic types", [list(pair) for pair in sorted(self._types.items())]]

    def _get_system_state(self, caller: str) -> Answer:
        with self._lock:
            publishers, subscribers = (
                [[name, sorted(nodes)] for name, nodes in sorted(registrations.items()) if nodes]
                for registrations in (self._publishers, self._subscribers)
            )
            services = [[name, [entry[0]]] for name, entry in sorted(self._services.items())]
        return [1, "current system state", [publishers, subscribers, services]]

    def _get_uri(self, caller: str) -> Answer:
        return [1, "", self.uri]

    def _get_pid(self, caller: str) -> Answer:
        return [1, "", os.getpid()]

    def _add_node(self, caller: str, uri: str) -> None:
        """Store a node; shut down an earlier node with its name, as ROS does."""
        old_uri = self._nodes.get(caller)
        if old_uri is not None and old_uri != uri:
            for registrations in (self._publishers, self._subscribers):
                for nodes in registrations.values():
                    if nodes.get(caller) == old_uri:
                        del nodes[caller]
            self._services = {k: v for k, v in self._services.items() if v[2] != old_uri}
            self._call(old_uri, "shutdown", "/master", f"new node registered with name {caller}")
        self._nodes[caller] = uri

    def _unregister(self, registrations: Registrations, name: str, caller: str, uri: str) -> int:
        with self._lock:
            if registrations.get(name, {}).get(caller) != uri:
                return 0
            del registrations[name][caller]
            if not registrations[name]:
                del registrations[name]
            if name not in self._publishers and name not in self._subscribers:
                self._types.pop(name, None)
            self._remove_if_unused(caller)
            return 1

    def _remove_if_unused(self, node: str) -> None:
        has_topics = any(
            node in nodes
            for registrations in (self._publishers, self._subscribers)
            for nodes in registrations.values()
        )
        if not has_topics and all(entry[0] != node for entry in self._services.values()):
            self._nodes.pop(node, None)

    def _send_update(self, topic: str) -> None:
        """Send the publishers of a topic to its subscribers; the list is read when it is sent."""
        with self._lock:
            uris = list(self._subscribers.get(topic, {}).values())
        for uri in uris:
            send = partial(self._send_publishers, uri, topic)
            self._node_calls.add(uri, f"publisherUpdate {topic}", send)

    def _send_publishers(self, uri: str, topic: str) -> None:
        with self._lock:
            publishers = list(self._publishers.get(topic, {}).values())
        _call_node(uri, "publisherUpdate", "/master", topic, publishers)

    def _call(self, uri: str, method: str, *arguments: Any) -> None:
        key = f"{method} {arguments[1]}"  # only the newest value of a parameter is sent
        self._node_calls.add(uri, key, partial(_call_node, uri, method, *arguments))


def _call_node(uri: str, method: str, *arguments: Any) -> None:
    with suppress(PeerError):
        call(uri, method, *arguments, max_length=MAX_NODE_ANSWER)


def _snake(name: str) -> str:
    return "".join(f"_{letter.lower()}" if letter.isupper() else letter for letter in name)
