"""A bus in a ROS 1 graph, as one node.

What is published on the bus is advertised; what is read there is subscribed to; services of the
bus are offered, and services that only the graph has are called there. ``/clock`` goes out
100 times a second, and what the bridge reports goes to ``/rosout``. The contract of threads is in
`uwsim.middleware.bridge`.
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

from ...bus import Bus, TopicEnds
from ...errors import BadSetting, UwsimError
from ...messages.services import Service
from ..bridge import LATCHED, Bridge, TransportTraits
from ..clock_topic import ROS_PERIOD
from ..lockstep.topics import TICK
from ..log import Log
from ..stamps import clock_time
from ..types import WireService, message_class, service_of, wire_service, wire_type
from . import services as tcp_services
from .arguments import NODE_METHODS, checked
from .listener import HEADER_TIMEOUT, Listener, Serve
from .publication import Publication
from .registrar import POLL, Registrar, Wanted
from .rosout import rosout
from .subscription import ReadingLimit, Subscription
from .tcpros import PeerError, node_of
from .xmlrpc import Answer, XmlRpcServer

NODE = "/uwsim"
USE_SIM_TIME = MappingProxyType({"/use_sim_time": True})
"""Parameter by which nodes read the time from ``/clock``."""


@dataclass(frozen=True, kw_only=True)
class Waits:
    """How long a node waits for its peers."""

    send: float = 30.0
    """How long a subscriber may take to read a message before it is left [s]."""
    header: float = HEADER_TIMEOUT
    """How long a client may take to send its header [s]."""
    poll: float = POLL
    """How often the master is looked for [s]."""


class Ros1Bridge(Bridge):
    """Connects a bus to the graph of a ROS 1 master.

    Args:
        bus: of the simulation.
        clock: returns the simulation time [s].
        master: URI of the master.
        host: address to listen on, which peers receive.
        node: name of the node in the graph.
        log: where it reports.
        parameters: set on the master while the node is there.
        waits: how long it waits for peers.
    """

    traits = TransportTraits(needs_discovery=True, detects_leaving=True, clock_period=ROS_PERIOD)

    def __init__(
        self,
        bus: Bus,
        clock: Callable[[], float],
        *,
        master: str,
        host: str = "127.0.0.1",
        node: str = NODE,
        log: Log | None = None,
        parameters: Mapping[str, Any] = USE_SIM_TIME,
        waits: Waits | None = None,
    ) -> None:
        super().__init__(bus, clock, log or Log("ros1"))
        self._master, self._host, self._node = master, host, node
        self._waits = waits = waits or Waits()
        self._publications: dict[str, Publication] = {}
        self._subscriptions: dict[str, Subscription] = {}
        self._reading = ReadingLimit(self._is_waited_for)
        self._offered: dict[str, WireService] = {}
        self._idle = tcp_services.IdleClients()
        self._clock = self._publication("/clock", "rosgraph_msgs/Clock")
        self._rosout = rosout(node, self.log, clock, waits.send)
        self._publications["/rosout"] = self._rosout
        try:
            self._listener = Listener(host, self.log, self._choose, header_timeout=waits.header)
        except OSError as error:
            raise BadSetting(f"ROS 1 cannot listen on {host}: {error.strerror or error}") from None
        methods = {
            name: checked(method, getattr(self, f"_{name}"))
            for name, method in NODE_METHODS.items()
        }
        self._server = XmlRpcServer(host, 0, methods, self.log, "node")
        self.uri = f"http://{host}:{self._server.port}/"
        """Address of the node's own XML-RPC server."""
        self._registrar = Registrar(
            master, node, self.uri, self.log, self._update, parameters=parameters, poll=waits.poll
        )
        self._stop_elsewhere = bus.services.serve_elsewhere(
            self._is_offered_outside, self.external_services.call_and_wait
        )
        self._register()

    def wait(self, timeout: float) -> bool:
        """Wait until the master knows all topics and services; whether it does [s]."""
        return self._registrar.wait(timeout)

    def n_connected(self, topic: str) -> int:
        """How many subscribers and publishers outside a topic is connected with now."""
        publication = self._publications.get(topic)
        subscription = self._subscriptions.get(topic)
        return (publication.n_subscribers if publication else 0) + (
            subscription.n_publishers if subscription else 0
        )

    def on_topics(self, topics: Mapping[str, TopicEnds]) -> None:
        """Advertise what is published on the bus, subscribe to what is read there."""
        publications, subscriptions = dict(self._publications), dict(self._subscriptions)
        to_read = _topics_to_read(topics)
        for name, ends in topics.items():
            kind = wire_type(ends.type)
            if kind is None or not kind.md5:
                self.log.report(f"/{name}: ROS 1 has no type {ends.type.__name__}")
                continue
            topic = f"/{name}"
            if ends.is_published and topic not in publications:
                publications[topic] = Publication(
                    topic,
                    kind,
                    self._node,
                    self.log,
                    self._waits.send,
                    is_latched=name in LATCHED,
                )
            if topic in to_read and topic not in subscriptions:
                subscriptions[topic] = Subscription(
                    topic, kind, self._node, self.log, self._receiver(topic), self._reading
                )
        gone = [subscriptions.pop(topic) for topic in self._subscriptions if topic not in to_read]
        # at once, because other nodes ask for them: who sees a publication sees all subscriptions
        self._subscriptions = subscriptions
        self._publications = publications
        for subscription in gone:
            subscription.close()
        self._register()

    def on_services(self, services: Mapping[str, Service]) -> None:
        """Offer the services of the bus."""
        self._offered = {f"/{name}": wire_service(each) for name, each in services.items()}
        self._register()

    def send(self, topic: str, message: object) -> None:
        """Hand a message to the subscribers outside."""
        publication = self._publications.get(f"/{topic}")
        if publication is not None:
            publication.send(message)

    def send_to(self, sender: str, topic: str, message: object) -> None:
        """Hand a message to the subscribers of one node."""
        publication = self._publications.get(f"/{topic}")
        if publication is not None:
            publication.send(message, only=sender)

    def _publish_clock(self) -> None:
        """Publish the time, if anybody reads it."""
        if self._clock_is_read():
            self._clock.send(self._clock.kind.message(clock=clock_time(self.clock_topic.time())))

    def _clock_is_read(self) -> bool:
        """Whether anybody has subscribed to ``/clock``."""
        return self._clock.n_subscribers > 0

    def has_publisher(self, topic: str) -> bool:
        """Whether it is connected with a publisher of ``topic``."""
        subscription = self._subscriptions.get(f"/{topic}")
        return subscription is not None and subscription.n_publishers > 0

    def close(self) -> None:
        """Leave the graph."""
        self._stop_elsewhere()
        self._registrar.close()
        self._server.close()
        self._listener.close()
        for publication in self._publications.values():
            publication.close()
        for subscription in self._subscriptions.values():
            subscription.close()
        super().close()

    def _publication(self, topic: str, type_name: str) -> Publication:
        """Advertise a topic that is not of the bus."""
        kind = wire_type(message_class(type_name))
        assert kind is not None
        found = Publication(topic, kind, self._node, self.log, self._waits.send)
        self._publications[topic] = found
        return found

    def _receiver(self, topic: str) -> Callable[[object, str], None]:
        return lambda message, sender: self.put(topic, message, sender)

    def _is_waited_for(self, sender: str) -> bool:
        """Whether the run waits for what a node publishes; any thread."""
        return self.admission is not None and self.admission.is_waited_for(sender)

    def _register(self) -> None:
        at = f"rosrpc://{self._host}:{self._listener.port}"
        self._registrar.want(
            Wanted(
                publishers={k: v.kind.ros1_name for k, v in self._publications.items()},
                subscribers={k: v.kind.ros1_name for k, v in self._subscriptions.items()},
                services=dict.fromkeys(self._offered, at),
            )
        )

    def _update(self, topic: str, uris: list[str]) -> None:
        subscription = self._subscriptions.get(topic)
        if subscription is not None:
            subscription.update(each for each in uris if each != self.uri)

    def _choose(self, header: dict[str, str]) -> Serve | str:
        """What serves a connection with this header, or why nothing does."""
        if "service" in header:
            return self._choose_service(header)
        publication = self._publications.get(header.get("topic", ""))
        if publication is None:
            return f"topic {header.get('topic', '')[:100]!r} is not published here"
        if (refusal := publication.check(header)) is not None:
            return refusal
        if publication in (self._clock, self._rosout):
            return publication.serve
        return partial(
            publication.serve, count=partial(self.external_subscribers.change, publication.topic)
        )

    def _choose_service(self, header: dict[str, str]) -> Serve | str:
        name = header["service"]
        offered = self._offered.get(name)
        if offered is None:
            return f"service {name[:100]!r} is not offered here"
        if (refusal := tcp_services.check(offered, header)) is not None:
            return refusal
        request = partial(self.request, name, sender=node_of(header))
        return lambda connection, header: tcp_services.serve(
            connection, header, offered, self._node, request, self._idle
        )

    def _is_offered_outside(self, name: str) -> bool:
        try:
            return bool(self._registrar.call("lookupService", f"/{name}"))
        except PeerError:
            return False

    def call_external_service(self, name: str, request: object) -> Future[object]:
        """Call a service that another node offers, in a thread of its own.

        Raises:
            UwsimError: the request has no definition, or nobody offers the service any more.
        """
        kind = service_of(cast(Hashable, request.__class__))
        if kind is None:
            raise UwsimError(f"Service {name!r}: {type(request).__name__} has no definition.")
        uri = str(self._registrar.call("lookupService", f"/{name}"))
        future: Future[object] = Future()

        def run() -> None:
            try:
                wanted = tcp_services.Wanted(f"/{name}", wire_service(kind), self._may_answer)
                found = tcp_services.call(uri, wanted, self._node, request)
            except UwsimError as error:
                future.set_exception(error)
            except Exception as error:  # who waits for the answer must learn of it
                future.set_exception(UwsimError(f"service /{name}: {error}"))
            else:
                future.set_result(found)

        threading.Thread(target=run, name="ros1-call", daemon=True).start()
        return future

    def _may_answer(self, name: str, sender: str) -> bool:
        """Whether a node may answer a call of a service; any thread."""
        return self.admission is None or self.admission.may_answer(name.lstrip("/"), sender)

    def _publisherUpdate(self, caller: str, topic: str, uris: list[str]) -> Answer:  # noqa: N802
        self._registrar.update(topic, [each for each in uris if isinstance(each, str)])
        return [1, "", 0]

    def _requestTopic(self, caller: str, topic: str, protocols: list[Any]) -> Answer:  # noqa: N802
        if topic not in self._publications:
            return [-1, f"{topic} is not published here", []]
        if not any(each[:1] == ["TCPROS"] for each in protocols if isinstance(each, list)):
            return [0, "only TCPROS is spoken here", []]
        return [1, "ready", ["TCPROS", self._host, self._listener.port]]

    def _getBusStats(self, caller: str) -> Answer:  # noqa: N802
        return [1, "", [[], [], []]]

    def _getBusInfo(self, caller: str) -> Answer:  # noqa: N802
        out = [
            [i, "?", "o", "TCPROS", topic, bool(each.n_subscribers)]
            for i, (topic, each) in enumerate(list(self._publications.items()))
        ]
        return [1, "", out]

    def _getMasterUri(self, caller: str) -> Answer:  # noqa: N802
        return [1, "", self._master]

    def _getPid(self, caller: str) -> Answer:  # noqa: N802
        return [1, "", os.getpid()]

    def _getSubscriptions(self, caller: str) -> Answer:  # noqa: N802
        found = list(self._subscriptions.items())
        return [1, "", [[topic, each.kind.ros1_name] for topic, each in found]]

    def _getPublications(self, caller: str) -> Answer:  # noqa: N802
        found = list(self._publications.items())
        return [1, "", [[topic, each.kind.ros1_name] for topic, each in found]]

    def _getArrived(self, caller: str) -> Answer:  # noqa: N802
        """How many messages have come by topic: of uwsim, for programs in lock-step."""
        return [1, "", dict(self.arrivals.n_arrived)]

    def _paramUpdate(self, caller: str, key: str, value: Any) -> Answer:  # noqa: N802
        return [1, "", 0]

    def _shutdown(self, caller: str, why: str = "") -> Answer:
        self.log.report(f"{caller[:100]} asks this node to leave the graph: {why[:200]}")
        self._registrar.give_up()
        return [1, "", 0]


def _topics_to_read(topics: Mapping[str, TopicEnds]) -> set[str]:
    """Topics, with a leading slash, that the bus reads from outside.

    In lock-step also those that it may read: the measure of a later level shall miss nothing.
    """
    may_read = TICK in topics
    return {
        f"/{name}"
        for name, ends in topics.items()
        if ends.is_read or (may_read and not ends.is_published)
    }
