"""The bridge that makes a bus one node of a ROS 1 graph.

The node advertises the topics that are published on the bus, and subscribes to the topics that are
read on the bus. It offers the services of the bus, and calls services that only other nodes offer.
It publishes ``/clock`` at most 1000 times per second of simulation time, and its log on
``/rosout``. `uwsim.middleware.bridge` documents the threads.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Hashable, Mapping
from concurrent.futures import Future
from dataclasses import dataclass
from functools import partial
from types import MappingProxyType
from typing import Any, cast

from ...bus import Bus, TopicEndpoints
from ...errors import BadSetting, UwsimError
from ...messages.services import Service
from ..bridge import LATCHED, Bridge, TransportTraits
from ..clock_topic import ROS_PERIOD
from ..lockstep.topics import TICK
from ..log import Log
from ..stamps import clock_time
from ..types import WireService, message_class, service_of, wire_service, wire_type
from . import services as tcp_services
from .arguments import NODE_METHODS, validate
from .listener import HEADER_TIMEOUT, Listener, Serve
from .publication import Publication
from .registrar import POLL, Registrar, Registrations
from .rosout import publish_log
from .subscription import ReadingLimit, Subscription
from .tcpros import PeerError, node_of
from .xmlrpc import Answer, XmlRpcServer

NODE_NAME = "/uwsim"
"""The default name of the node."""
USE_SIM_TIME = MappingProxyType({"/use_sim_time": True})
"""The parameter that makes nodes read the time from ``/clock``."""


@dataclass(frozen=True, kw_only=True)
class PeerTimeouts:
    """The time limits that a node sets its peers."""

    send: float = 30.0
    """The time limit for a subscriber to read a message, else the connection is closed [s]."""
    header: float = HEADER_TIMEOUT
    """The time limit for a client to send its header [s]."""
    poll: float = POLL
    """The interval of checks of the master [s]."""


class Ros1Bridge(Bridge):
    """The connection of a bus to the graph of a ROS 1 master.

    Args:
        bus: the bus of the simulation.
        clock: a function that returns the simulation time [s].
        master: the URI of the master.
        host: the address to listen on, which the master gives to other nodes.
        node: the name of the node in the graph.
        log: the log for events.
        parameters: the parameters on the master while the node exists.
        limits: the timeouts for peers.
    """

    traits = TransportTraits(needs_discovery=True, detects_leaving=True, clock_period=ROS_PERIOD)

    def __init__(
        self,
        bus: Bus,
        clock: Callable[[], float],
        *,
        master: str,
        host: str = "127.0.0.1",
        node: str = NODE_NAME,
        log: Log | None = None,
        parameters: Mapping[str, Any] = USE_SIM_TIME,
        limits: PeerTimeouts | None = None,
    ) -> None:
        super().__init__(bus, clock, log or Log("ros1"))
        self._master, self._host, self._node = master, host, node
        self._timeouts = limits = limits or PeerTimeouts()
        self._publications: dict[str, Publication] = {}
        self._subscriptions: dict[str, Subscription] = {}
        self._reading_limit = ReadingLimit(self._is_waited_for)
        self._offered_types: dict[str, WireService] = {}
        self._idle_clients = tcp_services.IdleClients()
        self._clock = self._advertise("/clock", "rosgraph_msgs/Clock")
        self._rosout = publish_log(node, self.log, clock, limits.send)
        self._publications["/rosout"] = self._rosout
        try:
            self._listener = Listener(
                host, self.log, self._find_handler, header_timeout=limits.header
            )
        except OSError as error:
            raise BadSetting(f"ROS 1 cannot listen on {host}: {error.strerror or error}") from None
        methods = {
            name: validate(method, getattr(self, f"_{name}"))
            for name, method in NODE_METHODS.items()
        }
        self._server = XmlRpcServer(host, 0, methods, self.log, "node")
        self.uri = f"http://{host}:{self._server.port}/"
        """The address of the node's own XML-RPC server."""
        self._registrar = Registrar(
            master, node, self.uri, self.log, self._update, parameters=parameters, poll=limits.poll
        )
        self._remove_external_services = bus.services.add_external_services(
            self._is_offered_outside, self.external_services.call_and_wait
        )
        self._register()

    def wait(self, timeout: float) -> bool:
        """Wait until the master has all topics and services; return False after a timeout [s]."""
        return self._registrar.wait(timeout)

    def n_connected(self, topic: str) -> int:
        """Return the number of connected external subscribers and publishers of a topic."""
        publication = self._publications.get(topic)
        subscription = self._subscriptions.get(topic)
        return (publication.n_subscribers if publication else 0) + (
            subscription.n_publishers if subscription else 0
        )

    def on_topics(self, topics: Mapping[str, TopicEndpoints]) -> None:
        """Advertise the topics that are published on the bus, subscribe to topics that are read."""
        publications, subscriptions = dict(self._publications), dict(self._subscriptions)
        to_read = _topics_to_read(topics)
        for name, endpoints in topics.items():
            kind = wire_type(endpoints.type)
            if kind is None or not kind.md5:
                self.log.report(f"/{name}: ROS 1 has no type {endpoints.type.__name__}")
                continue
            topic = f"/{name}"
            if endpoints.is_published and topic not in publications:
                publications[topic] = Publication(
                    topic,
                    kind,
                    self._node,
                    self.log,
                    self._timeouts.send,
                    is_latched=name in LATCHED,
                )
            if topic in to_read and topic not in subscriptions:
                subscriptions[topic] = Subscription(
                    topic, kind, self._node, self.log, self._receiver(topic), self._reading_limit
                )
        old_subscriptions = [
            subscriptions.pop(topic) for topic in self._subscriptions if topic not in to_read
        ]
        # replaced as a whole, because other threads read them; subscriptions before publications
        self._subscriptions = subscriptions
        self._publications = publications
        for subscription in old_subscriptions:
            subscription.close()
        self._register()

    def on_services(self, services: Mapping[str, Service]) -> None:
        """Offer the services of the bus."""
        self._offered_types = {f"/{name}": wire_service(kind) for name, kind in services.items()}
        self._register()

    def send(self, topic: str, message: object) -> None:
        """Send a message to the external subscribers."""
        publication = self._publications.get(f"/{topic}")
        if publication is not None:
            publication.send(message)

    def send_to(self, client_name: str, topic: str, message: object) -> None:
        """Send a message to the subscribers of one node."""
        publication = self._publications.get(f"/{topic}")
        if publication is not None:
            publication.send(message, target_node=client_name)

    def _publish_clock(self) -> None:
        if self._clock_is_read():
            self._clock.send(self._clock.kind.message(clock=clock_time(self.clock_topic.time())))

    def _clock_is_read(self) -> bool:
        return self._clock.n_subscribers > 0

    def has_publisher(self, topic: str) -> bool:
        """Return whether the node is connected to a publisher of ``topic``."""
        subscription = self._subscriptions.get(f"/{topic}")
        return subscription is not None and subscription.n_publishers > 0

    def close(self) -> None:
        """Leave the graph."""
        self._remove_external_services()
        self._registrar.close()
        self._server.close()
        self._listener.close()
        for publication in self._publications.values():
            publication.close()
        for subscription in self._subscriptions.values():
            subscription.close()
        super().close()

    def _advertise(self, topic: str, type_name: str) -> Publication:
        """Advertise a topic that is not on the bus."""
        kind = wire_type(message_class(type_name))
        assert kind is not None
        publication = Publication(topic, kind, self._node, self.log, self._timeouts.send)
        self._publications[topic] = publication
        return publication

    def _receiver(self, topic: str) -> Callable[[object, str], None]:
        return lambda message, sender: self.put(topic, message, sender)

    def _is_waited_for(self, sender: str) -> bool:
        return self.admission is not None and self.admission.is_waited_for(sender)

    def _register(self) -> None:
        uri = f"rosrpc://{self._host}:{self._listener.port}"
        self._registrar.set_registrations(
            Registrations(
                publishers={k: v.kind.ros1_name for k, v in self._publications.items()},
                subscribers={k: v.kind.ros1_name for k, v in self._subscriptions.items()},
                services=dict.fromkeys(self._offered_types, uri),
            )
        )

    def _update(self, topic: str, uris: list[str]) -> None:
        subscription = self._subscriptions.get(topic)
        if subscription is not None:
            subscription.update(uri for uri in uris if uri != self.uri)

    def _find_handler(self, header: dict[str, str]) -> Serve | str:
        """Return the function that serves this connection header, or the text of a refusal."""
        if "service" in header:
            return self._find_service_handler(header)
        publication = self._publications.get(header.get("topic", ""))
        if publication is None:
            return f"topic {header.get('topic', '')[:100]!r} is not published here"
        if (refusal := publication.check(header)) is not None:
            return refusal
        if publication in (self._clock, self._rosout):
            return publication.serve
        return partial(publication.serve, count=partial(self.subscribers.change, publication.topic))

    def _find_service_handler(self, header: dict[str, str]) -> Serve | str:
        name = header["service"]
        service_type = self._offered_types.get(name)
        if service_type is None:
            return f"service {name[:100]!r} is not offered here"
        if (refusal := tcp_services.check(service_type, header)) is not None:
            return refusal
        request = partial(self.request, name, sender=node_of(header))
        return lambda connection, header: tcp_services.serve(
            connection, header, service_type, self._node, request, self._idle_clients
        )

    def _is_offered_outside(self, name: str) -> bool:
        try:
            return bool(self._registrar.call("lookupService", f"/{name}"))
        except PeerError:
            return False

    def call_external_service(self, name: str, request: object) -> Future[object]:
        """Call a service that another node offers, in a thread of its own.

        Raises:
            UwsimError: the request has no definition, or no node offers the service any more.
        """
        kind = service_of(cast(Hashable, request.__class__))
        if kind is None:
            raise UwsimError(f"Service {name!r}: {type(request).__name__} has no definition.")
        uri = str(self._registrar.call("lookupService", f"/{name}"))
        future: Future[object] = Future()

        def run() -> None:
            try:
                service = wire_service(kind)
                target = tcp_services.ExternalService(f"/{name}", service, self._may_answer)
                response = tcp_services.call(uri, target, self._node, request)
            except UwsimError as error:
                future.set_exception(error)
            except Exception as error:  # the thread that waits for the answer needs it
                future.set_exception(UwsimError(f"service /{name}: {error}"))
            else:
                future.set_result(response)

        threading.Thread(target=run, name="ros1-call", daemon=True).start()
        return future

    def _may_answer(self, name: str, sender: str) -> bool:
        return self.admission is None or self.admission.may_answer(name.lstrip("/"), sender)

    def _publisherUpdate(self, caller: str, topic: str, uris: list[str]) -> Answer:  # noqa: N802
        self._registrar.update(topic, [uri for uri in uris if isinstance(uri, str)])
        return [1, "", 0]

    def _requestTopic(self, caller: str, topic: str, protocols: list[Any]) -> Answer:  # noqa: N802
        if topic not in self._publications:
            return [-1, f"{topic} is not published here", []]
        if not any(entry[:1] == ["TCPROS"] for entry in protocols if isinstance(entry, list)):
            return [0, "this node supports TCPROS only", []]
        return [1, "ready", ["TCPROS", self._host, self._listener.port]]

    def _getBusStats(self, caller: str) -> Answer:  # noqa: N802
        return [1, "", [[], [], []]]

    def _getBusInfo(self, caller: str) -> Answer:  # noqa: N802
        connections = [
            [i, "?", "o", "TCPROS", topic, bool(publication.n_subscribers)]
            for i, (topic, publication) in enumerate(list(self._publications.items()))
        ]
        return [1, "", connections]

    def _getMasterUri(self, caller: str) -> Answer:  # noqa: N802
        return [1, "", self._master]

    def _getPid(self, caller: str) -> Answer:  # noqa: N802
        return [1, "", os.getpid()]

    def _getSubscriptions(self, caller: str) -> Answer:  # noqa: N802
        subscriptions = list(self._subscriptions.items())
        return [1, "", [[topic, entry.kind.ros1_name] for topic, entry in subscriptions]]

    def _getPublications(self, caller: str) -> Answer:  # noqa: N802
        publications = list(self._publications.items())
        return [1, "", [[topic, entry.kind.ros1_name] for topic, entry in publications]]

    def _getArrived(self, caller: str) -> Answer:  # noqa: N802
        """Return the number of arrived messages by topic, for programs in lock-step."""
        return [1, "", dict(self.arrivals.n_arrived)]

    def _paramUpdate(self, caller: str, key: str, value: Any) -> Answer:  # noqa: N802
        return [1, "", 0]

    def _shutdown(self, caller: str, reason: str = "") -> Answer:
        self.log.report(f"{caller[:100]} requests that this node leaves the graph: {reason[:200]}")
        self._registrar.give_up()
        return [1, "", 0]


def _topics_to_read(topics: Mapping[str, TopicEndpoints]) -> set[str]:
    """Return the topics, with a leading slash, that the bus reads from outside.

    In lock-step these are also the topics that it may read later, so that a measure of a later
    level misses no message.
    """
    is_lockstep = TICK in topics
    return {
        f"/{name}"
        for name, endpoints in topics.items()
        if endpoints.is_read or (is_lockstep and not endpoints.is_published)
    }
