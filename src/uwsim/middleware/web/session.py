"""The session of one web client: its publications, subscriptions and services (rosbridge)."""

from __future__ import annotations

import asyncio
import json
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, cast

from ...base.peer_json import read_peer_json
from ...errors import BadMessage, UwsimError, did_you_mean
from ...messages import String
from ..json_encoding import from_json, to_json
from ..lockstep.topics import JOIN
from ..stamps import to_ros_time, to_sim_time
from ..types import message_class, service, service_of, wire_type
from . import rosapi
from .client_services import ClientServices
from .contract import SessionBridge, Subscription
from .frame_republisher import ACTION_TOPICS, CANCEL, GOAL
from .frame_republisher import SERVICE as REPUBLISH
from .graph import WebGraph
from .outgoing import COMPRESSIONS, EncodedMessage
from .queue import MAX_MESSAGES, OutQueue, SubscriptionQueue
from .readers import WebReaders
from .republications import Republications

MAX_KEYS = 200_000
"""The maximum number of fields in a frame, including those of nested objects.

A frame may have twice as many opening brackets, and four times as many quotation marks.
"""
MAX_NAMES = 1000
"""The maximum number of topics, and the maximum number of services, of one client."""


@dataclass(frozen=True, kw_only=True)
class SessionParts:
    """The parts of a bridge that its clients share."""

    graph: WebGraph
    """The topics and services that clients can query."""
    readers: WebReaders
    """The topics that clients read."""
    services: ClientServices
    """The services that clients offer."""
    republications: Republications
    """The transforms that clients have requested."""


class Session:
    """The handler of one client's operations, in the thread of the server except where stated.

    Args:
        bridge: the bridge to the bus.
        parts: the shared parts of the bridge.
        loop: the event loop of the server.
        name: the name in the log.
    """

    def __init__(
        self, bridge: SessionBridge, parts: SessionParts, loop: asyncio.AbstractEventLoop, name: str
    ) -> None:
        self._bridge, self._parts, self._loop, self._name = bridge, parts, loop, name
        self._wake_event = asyncio.Event()
        self._queue = OutQueue(self._wake)
        self._replies = SubscriptionQueue(max_length=10 * MAX_MESSAGES)
        self._subscriptions: dict[str, Subscription] = {}
        self._advertised_types: dict[str, type] = {}
        self._services: set[str] = set()
        self._calls: dict[str, tuple[Future[object], type]] = {}
        self._n_calls, self._has_left = 0, False
        self._lock = threading.Lock()
        self._joined_as: object = None  # the name under which the client has joined a run
        self._handlers: dict[str, Callable[[dict[str, Any]], None]] = {
            "advertise": self._advertise,
            "unadvertise": self._unadvertise,
            "publish": self._publish,
            "subscribe": self._subscribe,
            "unsubscribe": self._unsubscribe,
            "call_service": self._call_service,
            "advertise_service": self._advertise_service,
            "unadvertise_service": self._unadvertise_service,
            "service_response": self._service_response,
            "set_level": _ignore,
        }

    def handle(self, data: str | bytes) -> None:
        """Handle a frame; report errors to the client."""
        frame: Any = None
        try:
            frame = read_frame(data)
            handler = self._handlers.get(frame["op"])
            if handler is None:
                near = did_you_mean(frame["op"], self._handlers)
                raise BadMessage(f"There is no operation {frame['op']!r:.100}.{near}")
            handler(frame)
        except UwsimError as error:
            frame_id = frame.get("id") if isinstance(frame, dict) else None
            self._bridge.log.report(f"{self._name}: {error}", kind=f"{self._name} is wrong")
            self.reply({"op": "status", "level": "error", "msg": str(error), "id": frame_id})

    def post(self, subscription: Subscription, message: EncodedMessage) -> None:
        """Send a message unless the last one was sent too recently.

        May be called from any thread.
        """
        now = time.monotonic()
        if now - subscription.last_time < subscription.throttle:
            return
        subscription.last_time = now
        if self._queue.put(subscription.queue, message):
            self._bridge.log.report(
                f"{self._name} reads /{subscription.topic} too slowly; its oldest messages "
                "are dropped",
                kind=f"{self._name} is slow",
            )

    @property
    def name(self) -> str:
        """The name of the client in the log."""
        return self._name

    @property
    def is_waited_for(self) -> bool:
        """True if the client takes part in a run that waits for its messages."""
        admission = self._bridge.admission
        return admission is not None and admission.is_waited_for(self._name)

    def reply(self, content: dict[str, Any]) -> None:
        """Send a JSON object, after all messages that wait already.

        May be called from any thread.
        """
        text = json.dumps({key: value for key, value in content.items() if value is not None})
        self._queue.put(self._replies, text)

    async def next_frame(self) -> str | bytes:
        """Wait for the next frame to send, and encode it."""
        while (entry := self._queue.take()) is None:
            self._wake_event.clear()
            if (entry := self._queue.take()) is not None:
                break
            await self._wake_event.wait()
        queue, item = entry
        return item if isinstance(item, str) else item.frame(queue.compression)

    def call(self, name: str, request: object) -> Future[object]:
        """Call a service that the client offers. May be called from any thread."""
        future: Future[object] = Future()
        kind = service_of(cast(Any, type(request)))
        assert kind is not None
        with self._lock:
            if self._has_left:
                raise UwsimError(f"{self._name} has disconnected.")
            self._n_calls += 1
            number = f"call:{self._n_calls}"
            self._calls[number] = future, kind.response
        content = {"op": "call_service", "id": number, "service": f"/{name}"}
        self.reply({**content, "args": to_json(to_ros_time(request))})
        return future

    def has_advertised(self, topic: str) -> bool:
        """Return whether the client has advertised ``topic``. May be called from any thread."""
        return topic in self._advertised_types

    def has_subscribed(self, topic: str) -> bool:
        """Return whether the client has subscribed to ``topic``. May be called from any thread."""
        return topic in self._subscriptions

    def close(self) -> None:
        """Remove all subscriptions and services of the client, which has disconnected."""
        for topic in list(self._subscriptions):
            self._drop(topic)
        for name in self._services:
            self._parts.services.unadvertise(name, self)
        self._services.clear()
        self._parts.republications.end(self)
        with self._lock:
            self._has_left = True  # from now on, no call waits for the client
        for future, _ in self._calls.values():
            if not future.done():
                future.set_exception(UwsimError(f"{self._name} has disconnected."))
        if self._joined_as is not None:
            content = {"client": self._joined_as, "left": True}
            self._bridge.put(JOIN, String(data=json.dumps(content)), self._name)

    def _wake(self) -> None:
        with suppress(RuntimeError):  # the server has ended
            self._loop.call_soon_threadsafe(self._wake_event.set)

    def _advertise(self, frame: dict[str, Any]) -> None:
        topic = name_in(frame, "topic")
        if topic in ACTION_TOPICS and self._parts.graph.type_of(topic) is None:
            return
        cls = message_class(text_in(frame, "type"))
        bus_type = self._parts.graph.type_of(topic)
        if bus_type is not None and bus_type is not cls:
            wire = wire_type(bus_type)
            raise BadMessage(
                f"Topic /{topic} carries {wire.ros2_name if wire else bus_type.__name__}, "
                f"not {frame['type']}."
            )
        self._limit(self._advertised_types)
        self._advertised_types[topic] = cls

    def _unadvertise(self, frame: dict[str, Any]) -> None:
        self._advertised_types.pop(name_in(frame, "topic"), None)

    def _publish(self, frame: dict[str, Any]) -> None:
        topic = name_in(frame, "topic")
        cls = self._advertised_types.get(topic) or self._parts.graph.type_of(topic)
        if cls is None and topic in ACTION_TOPICS:
            self._republish(topic, frame.get("msg"))
            return
        if cls is None:
            raise BadMessage(f"Topic /{topic} is not known; advertise it with its type first.")
        message: object = to_sim_time(from_json(cls, frame.get("msg", {})))
        if topic == JOIN and isinstance(message, String):
            self._joined_as = _client_in(message.data)
        self._bridge.put(topic, message, self._name)

    def _republish(self, topic: str, message: Any) -> None:
        """Handle a goal of the action that publishes transforms, or a cancellation."""
        fields = message if isinstance(message, dict) else {}
        if topic == GOAL:
            goal_id = fields.get("goal_id")
            goal = goal_id.get("id") if isinstance(goal_id, dict) else None
            if not isinstance(goal, str) or not 0 < len(goal) <= 500:
                raise BadMessage(f"/{topic}: goal_id.id is not a name.")
            self._parts.republications.begin(fields.get("goal"), self, goal)
        elif topic == CANCEL:
            self._parts.republications.cancel(str(fields.get("id", "")))

    def _subscribe(self, frame: dict[str, Any]) -> None:
        topic = name_in(frame, "topic")
        compression = str(frame.get("compression", "none"))
        if compression not in COMPRESSIONS:
            names = ", ".join(COMPRESSIONS)
            raise BadMessage(f"There is no compression {compression!r:.100}; there are {names}.")
        if (reason := self._parts.graph.hidden_reason(topic)) is not None:
            raise BadMessage(f"Topic /{topic} {reason}.")
        bus_type = self._parts.graph.type_of(topic)
        is_named = bus_type is not None and bool(frame.get("type"))
        if is_named and message_class(text_in(frame, "type")) != bus_type:
            raise BadMessage(f"Topic /{topic} does not carry {frame['type']}.")
        throttle = number_in(frame, "throttle_rate") / 1000.0
        length = int(number_in(frame, "queue_length")) or MAX_MESSAGES
        self._limit(self._subscriptions)
        subscription = self._subscriptions.get(topic)
        if subscription is None:
            queue = SubscriptionQueue(compression=compression, max_length=min(length, MAX_MESSAGES))
            subscription = Subscription(topic=topic, queue=queue, throttle=throttle)
            self._subscriptions[topic] = subscription
            self._parts.readers.add(topic, self, subscription)
        subscription.ids.add(frame.get("id") if isinstance(frame.get("id"), str) else None)
        subscription.throttle = min(subscription.throttle, throttle)

    def _unsubscribe(self, frame: dict[str, Any]) -> None:
        topic = name_in(frame, "topic")
        subscription = self._subscriptions.get(topic)
        if subscription is None:
            return
        if isinstance(frame.get("id"), str):
            subscription.ids.discard(frame["id"])
        else:
            subscription.ids.clear()
        if not subscription.ids:
            self._drop(topic)

    def _drop(self, topic: str) -> None:
        subscription = self._subscriptions.pop(topic)
        self._parts.readers.remove(topic, subscription)
        self._queue.forget(subscription.queue)

    def _call_service(self, frame: dict[str, Any]) -> None:
        name = name_in(frame, "service")
        answer = {"op": "service_response", "service": f"/{name}", "id": frame.get("id")}
        if name in rosapi.SERVICES:
            is_success, values = rosapi.answer(self._parts.graph, name, frame.get("args") or {})
            self.reply({**answer, "values": values, "result": is_success})
            return
        if name == REPUBLISH and name not in self._parts.graph.services:
            topic = self._parts.republications.begin(frame.get("args"), self)
            self.reply({**answer, "values": {"topic_name": f"/{topic}"}, "result": True})
            return
        try:
            kind = self._parts.graph.find_service(name)
            values = frame.get("args", {})
            request: object = from_json(kind.request, {} if isinstance(values, list) else values)
        except UwsimError as error:
            self.reply({**answer, "values": str(error), "result": False})
            return

        def respond(future: Future[object]) -> None:
            error = future.exception()
            if error is None:
                values = to_json(to_ros_time(future.result()))
                self.reply({**answer, "values": values, "result": True})
            else:
                self.reply({**answer, "values": str(error), "result": False})

        response = self._bridge.request(name, to_sim_time(request), self._name)
        response.add_done_callback(respond)

    def _advertise_service(self, frame: dict[str, Any]) -> None:
        name, service_type = name_in(frame, "service"), service(text_in(frame, "type"))
        self._limit(self._services)
        self._services.add(name)
        self._parts.services.advertise(name, service_type, self)

    def _unadvertise_service(self, frame: dict[str, Any]) -> None:
        name = name_in(frame, "service")
        if name in self._services:
            self._services.discard(name)
            self._parts.services.unadvertise(name, self)

    def _service_response(self, frame: dict[str, Any]) -> None:
        future, cls = self._calls.pop(str(frame.get("id")), (None, None))
        if future is None or cls is None or future.done():
            raise BadMessage(f"No call waits for the response {frame.get('id')!r:.100}.")
        if frame.get("result") is False:
            future.set_exception(
                UwsimError(f"External service {frame.get('service')!r:.100} failed.")
            )
            return
        try:
            future.set_result(to_sim_time(from_json(cls, frame.get("values") or {})))
        except BadMessage as error:
            future.set_exception(error)

    def _limit(self, names: Any) -> None:
        if len(names) >= MAX_NAMES:
            raise BadMessage(f"A client uses more than {MAX_NAMES} names.")


def _ignore(frame: dict[str, Any]) -> None:
    """Ignore the level of status messages: clients receive errors only."""


def read_frame(data: str | bytes) -> dict[str, Any]:
    """Parse a frame: a JSON object with the name of an operation under ``op``.

    Raises:
        BadMessage: the frame has no such object.
    """
    if isinstance(data, bytes):
        raise BadMessage("A frame is binary; expected JSON text.")
    if len(data) > MAX_KEYS:
        if data.count('":') > MAX_KEYS:
            raise BadMessage(f"A frame has more than {MAX_KEYS} fields.")
        if data.count("{") + data.count("[") > 2 * MAX_KEYS:
            raise BadMessage(f"A frame has more than {2 * MAX_KEYS} opening brackets.")
        if data.count('"') > 4 * MAX_KEYS:
            raise BadMessage(f"A frame has more than {4 * MAX_KEYS} quotation marks.")
    try:
        frame = read_peer_json(data)
    except ValueError as error:
        raise BadMessage(f"A frame is not JSON: {str(error)[:100]}.") from None
    if not isinstance(frame, dict) or not isinstance(frame.get("op"), str):
        raise BadMessage("A frame is not an object with the name of an operation under 'op'.")
    if not _is_json(frame.get("id")):
        raise BadMessage("The 'id' of a frame has a number that is not finite.")
    return frame


def _is_json(value: object) -> bool:
    """Return whether a value is valid JSON, which has no NaN and no infinite numbers."""
    try:
        json.dumps(value, allow_nan=False)
    except ValueError:
        return False
    return True


def text_in(frame: dict[str, Any], key: str) -> str:
    """Return a text in a frame; raise BadMessage if it is missing or not a name."""
    value = frame.get(key)
    if not isinstance(value, str) or not value.strip("/ ") or len(value) > 500:
        raise BadMessage(f"{frame['op']}: {key} is {value!r:.100}; expected a name.")
    return value


def name_in(frame: dict[str, Any], key: str) -> str:
    """Return a name in a frame without its leading slash; raise BadMessage if it is invalid."""
    name = text_in(frame, key).strip().lstrip("/")
    if not name.isprintable():
        raise BadMessage(f"{frame['op']}: {key} {name!r:.100} has characters that no name has.")
    return name


def number_in(frame: dict[str, Any], key: str) -> float:
    """Return a number >= 0 in a frame, 0 if it is missing; raise BadMessage if it is invalid."""
    value = frame.get(key) or 0
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0 <= value < 1e9:
        raise BadMessage(f"{frame['op']}: {key} is {value!r:.100}; expected a number >= 0.")
    return float(value)


def _client_in(text: str) -> object:
    """Return the field ``client`` of a join message; None if it is missing."""
    try:
        content = read_peer_json(text)
    except ValueError:
        return None
    return content.get("client") if isinstance(content, dict) else None
