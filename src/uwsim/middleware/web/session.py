"""One web client: what it has advertised, subscribed to and offered, by the rosbridge protocol."""

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
from ..stamps import to_ros_clock, to_simulation_time
from ..types import message_class, service, service_of, wire_type
from . import rosapi
from .client_services import ClientServices
from .contract import SessionBridge, Subscription
from .frame_republisher import ACTION_TOPICS, CANCEL, GOAL
from .frame_republisher import SERVICE as REPUBLISH
from .graph import WebGraph
from .outgoing import COMPRESSIONS, Outgoing
from .queue import MAX_MESSAGES, Lane, OutQueue
from .readers import WebReaders
from .republications import Republications

MAX_KEYS = 200_000
"""Fields that a frame may have, those of messages in lists counted each; twice as many opening
brackets, and four times as many quotation marks."""
MAX_NAMES = 1000
"""Topics and services that one client may use."""


@dataclass(frozen=True, kw_only=True)
class SessionParts:
    """What the clients of a bridge share."""

    graph: WebGraph
    """What they may ask about."""
    readers: WebReaders
    """Topics that they read."""
    services: ClientServices
    """Services that they offer."""
    republications: Republications
    """Transforms that they have asked for."""


class Session:
    """Handles the operations of one client; in the thread of the server, but for `post`.

    Args:
        bridge: to the bus.
        parts: of the bridge.
        loop: of the server.
        name: for the log.
    """

    def __init__(
        self,
        bridge: SessionBridge,
        parts: SessionParts,
        loop: asyncio.AbstractEventLoop,
        name: str,
    ) -> None:
        self._bridge, self._parts, self._loop, self._name = bridge, parts, loop, name
        self._something = asyncio.Event()
        self._queue = OutQueue(self._wake)
        self._replies = Lane(length=10 * MAX_MESSAGES)
        self._subscriptions: dict[str, Subscription] = {}
        self._advertised: dict[str, type] = {}
        self._services: set[str] = set()
        self._asked: dict[str, tuple[Future[object], type]] = {}
        self._n_asked, self._has_left = 0, False
        self._lock = threading.Lock()
        self._joined_as: object = None
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

    def handle(self, raw: str | bytes) -> None:
        """Do what a frame asks; what is wrong is reported to the client."""
        asked: Any = None
        try:
            asked = read_frame(raw)
            handler = self._handlers.get(asked["op"])
            if handler is None:
                near = did_you_mean(asked["op"], self._handlers)
                raise BadMessage(f"There is no operation {asked['op']!r:.100}.{near}")
            handler(asked)
        except UwsimError as error:
            about = asked.get("id") if isinstance(asked, dict) else None
            self._bridge.log.report(f"{self._name}: {error}", kind=f"{self._name} is wrong")
            self.reply({"op": "status", "level": "error", "msg": str(error), "id": about})

    def post(self, subscription: Subscription, message: Outgoing) -> None:
        """Send a message unless the last was sent too short a time ago. Any thread."""
        now = time.monotonic()
        if now - subscription.last < subscription.throttle:
            return
        subscription.last = now
        if self._queue.put(subscription.lane, message):
            self._bridge.log.report(
                f"{self._name} reads /{subscription.topic} too slowly; the oldest are dropped",
                kind=f"{self._name} is slow",
            )

    @property
    def name(self) -> str:
        """Its name in the log."""
        return self._name

    @property
    def is_waited_for(self) -> bool:
        """Whether the client takes part in a run that waits for what it sends."""
        admission = self._bridge.admission
        return admission is not None and admission.is_waited_for(self._name)

    def reply(self, content: dict[str, Any]) -> None:
        """Send an object, behind what waits already. Any thread."""
        text = json.dumps({key: value for key, value in content.items() if value is not None})
        self._queue.put(self._replies, text)

    async def next_frame(self) -> str | bytes:
        """Wait for the next frame to send, and encode it."""
        while (taken := self._queue.take()) is None:
            self._something.clear()
            if (taken := self._queue.take()) is not None:
                break
            await self._something.wait()
        lane, item = taken
        return item if isinstance(item, str) else item.encoded(lane.compression)

    def call(self, name: str, request: object) -> Future[object]:
        """Call a service that the client offers. Any thread."""
        future: Future[object] = Future()
        of = service_of(cast(Any, type(request)))
        assert of is not None
        with self._lock:
            if self._has_left:
                raise UwsimError(f"{self._name} has left.")
            self._n_asked += 1
            number = f"call:{self._n_asked}"
            self._asked[number] = future, of.response
        content = {"op": "call_service", "id": number, "service": f"/{name}"}
        self.reply({**content, "args": to_json(to_ros_clock(request))})
        return future

    def advertises(self, topic: str) -> bool:
        """Whether the client has said that it publishes ``topic``. Any thread."""
        return topic in self._advertised

    def reads(self, topic: str) -> bool:
        """Whether the client has subscribed to ``topic``. Any thread."""
        return topic in self._subscriptions

    def close(self) -> None:
        """Take back everything: the client has gone."""
        for topic in list(self._subscriptions):
            self._drop(topic)
        for name in self._services:
            self._parts.services.withdraw(name, self)
        self._services.clear()
        self._parts.republications.end(self)
        with self._lock:
            self._has_left = True  # from here on, no call waits for it
        for future, _ in self._asked.values():
            if not future.done():
                future.set_exception(UwsimError(f"{self._name} has left."))
        if self._joined_as is not None:
            left = {"client": self._joined_as, "left": True}
            self._bridge.put(JOIN, String(data=json.dumps(left)), self._name)

    def _wake(self) -> None:
        with suppress(RuntimeError):  # the server has ended
            self._loop.call_soon_threadsafe(self._something.set)

    def _advertise(self, asked: dict[str, Any]) -> None:
        topic = name_in(asked, "topic")
        if topic in ACTION_TOPICS and self._parts.graph.type_of(topic) is None:
            return
        cls = message_class(text_in(asked, "type"))
        known = self._parts.graph.type_of(topic)
        if known is not None and known is not cls:
            theirs = wire_type(known)
            raise BadMessage(
                f"Topic /{topic} carries {theirs.ros2_name if theirs else known.__name__}, "
                f"not {asked['type']}."
            )
        self._limit(self._advertised)
        self._advertised[topic] = cls

    def _unadvertise(self, asked: dict[str, Any]) -> None:
        self._advertised.pop(name_in(asked, "topic"), None)

    def _publish(self, asked: dict[str, Any]) -> None:
        topic = name_in(asked, "topic")
        cls = self._advertised.get(topic) or self._parts.graph.type_of(topic)
        if cls is None and topic in ACTION_TOPICS:
            self._republish(topic, asked.get("msg"))
            return
        if cls is None:
            raise BadMessage(f"Topic /{topic} is not known; advertise it with its type first.")
        message: object = to_simulation_time(from_json(cls, asked.get("msg", {})))
        if topic == JOIN and isinstance(message, String):
            self._joined_as = _client_in(message.data)
        self._bridge.put(topic, message, self._name)

    def _republish(self, topic: str, message: Any) -> None:
        """Take a goal for transforms, or a cancellation."""
        fields = message if isinstance(message, dict) else {}
        if topic == GOAL:
            goal_id = fields.get("goal_id")
            goal = goal_id.get("id") if isinstance(goal_id, dict) else None
            if not isinstance(goal, str) or not 0 < len(goal) <= 500:
                raise BadMessage(f"/{topic}: goal_id.id is no name.")
            self._parts.republications.begin(fields.get("goal"), self, goal)
        elif topic == CANCEL:
            self._parts.republications.cancel(str(fields.get("id", "")))

    def _subscribe(self, asked: dict[str, Any]) -> None:
        topic = name_in(asked, "topic")
        compression = str(asked.get("compression", "none"))
        if compression not in COMPRESSIONS:
            known = ", ".join(COMPRESSIONS)
            raise BadMessage(f"There is no compression {compression!r:.100}; there are {known}.")
        carried = self._parts.graph.type_of(topic)
        is_named = carried is not None and bool(asked.get("type"))
        if is_named and message_class(text_in(asked, "type")) != carried:
            raise BadMessage(f"Topic /{topic} does not carry {asked['type']}.")
        throttle = number_in(asked, "throttle_rate") / 1000.0
        length = int(number_in(asked, "queue_length")) or MAX_MESSAGES
        self._limit(self._subscriptions)
        found = self._subscriptions.get(topic)
        if found is None:
            lane = Lane(compression=compression, length=min(length, MAX_MESSAGES))
            found = Subscription(topic=topic, lane=lane, throttle=throttle)
            self._subscriptions[topic] = found
            self._parts.readers.read(topic, self, found)
        found.ids.add(asked.get("id") if isinstance(asked.get("id"), str) else None)
        found.throttle = min(found.throttle, throttle)

    def _unsubscribe(self, asked: dict[str, Any]) -> None:
        topic = name_in(asked, "topic")
        found = self._subscriptions.get(topic)
        if found is None:
            return
        if isinstance(asked.get("id"), str):
            found.ids.discard(asked["id"])
        else:
            found.ids.clear()
        if not found.ids:
            self._drop(topic)

    def _drop(self, topic: str) -> None:
        found = self._subscriptions.pop(topic)
        self._parts.readers.unread(topic, found)
        self._queue.forget(found.lane)

    def _call_service(self, asked: dict[str, Any]) -> None:
        name = name_in(asked, "service")
        answer = {"op": "service_response", "service": f"/{name}", "id": asked.get("id")}
        if name in rosapi.SERVICES:
            succeeded, values = rosapi.answer(self._parts.graph, name, asked.get("args") or {})
            self.reply({**answer, "values": values, "result": succeeded})
            return
        if name == REPUBLISH and name not in self._parts.graph.services:
            topic = self._parts.republications.begin(asked.get("args"), self)
            self.reply({**answer, "values": {"topic_name": f"/{topic}"}, "result": True})
            return
        try:
            of = self._parts.graph.service_named(name)
            values = asked.get("args", {})
            request: object = from_json(of.request, {} if isinstance(values, list) else values)
        except UwsimError as error:
            self.reply({**answer, "values": str(error), "result": False})
            return

        def respond(done: Future[object]) -> None:
            error = done.exception()
            if error is None:
                self.reply(
                    {**answer, "values": to_json(to_ros_clock(done.result())), "result": True}
                )
            else:
                self.reply({**answer, "values": str(error), "result": False})

        answer_to_come = self._bridge.request(name, to_simulation_time(request), self._name)
        answer_to_come.add_done_callback(respond)

    def _advertise_service(self, asked: dict[str, Any]) -> None:
        name, of = name_in(asked, "service"), service(text_in(asked, "type"))
        self._limit(self._services)
        self._services.add(name)
        self._parts.services.offer(name, of, self)

    def _unadvertise_service(self, asked: dict[str, Any]) -> None:
        name = name_in(asked, "service")
        if name in self._services:
            self._services.discard(name)
            self._parts.services.withdraw(name, self)

    def _service_response(self, asked: dict[str, Any]) -> None:
        future, cls = self._asked.pop(str(asked.get("id")), (None, None))
        if future is None or cls is None or future.done():
            raise BadMessage(f"No call waits for the response {asked.get('id')!r:.100}.")
        if asked.get("result") is False:
            future.set_exception(
                UwsimError(f"Service {asked.get('service')!r:.100} failed outside.")
            )
            return
        try:
            future.set_result(to_simulation_time(from_json(cls, asked.get("values") or {})))
        except BadMessage as error:
            future.set_exception(error)

    def _limit(self, names: Any) -> None:
        if len(names) >= MAX_NAMES:
            raise BadMessage(f"More than {MAX_NAMES} names are used by one client.")


def _ignore(asked: dict[str, Any]) -> None:
    """Do nothing: errors alone are reported to clients."""


def read_frame(raw: str | bytes) -> dict[str, Any]:
    """Return the object of a frame, which has a text under ``op``.

    Raises:
        BadMessage: it is none.
    """
    if isinstance(raw, bytes):
        raise BadMessage("A binary frame came; expected JSON text.")
    if len(raw) > MAX_KEYS:
        if raw.count('":') > MAX_KEYS:
            raise BadMessage(f"A frame has more than {MAX_KEYS} fields.")
        if raw.count("{") + raw.count("[") > 2 * MAX_KEYS:
            raise BadMessage(f"A frame has more than {2 * MAX_KEYS} opening brackets.")
        if raw.count('"') > 4 * MAX_KEYS:
            raise BadMessage(f"A frame has more than {4 * MAX_KEYS} quotation marks.")
    try:
        found = read_peer_json(raw)
    except ValueError as error:
        raise BadMessage(f"A frame is not JSON: {str(error)[:100]}.") from None
    if not isinstance(found, dict) or not isinstance(found.get("op"), str):
        raise BadMessage("A frame is no object with the name of an operation under 'op'.")
    if not _is_json(found.get("id")):
        raise BadMessage("A frame's 'id' has a number that is not finite.")
    return found


def _is_json(value: object) -> bool:
    """Whether a value that came is one that every reader of JSON takes: NaN is none."""
    try:
        json.dumps(value, allow_nan=False)
    except ValueError:
        return False
    return True


def text_in(asked: dict[str, Any], key: str) -> str:
    """Return a text of a frame; BadMessage if it is missing."""
    value = asked.get(key)
    if not isinstance(value, str) or not value.strip("/ ") or len(value) > 500:
        raise BadMessage(f"{asked['op']}: {key} is {value!r:.100}; expected a name.")
    return value


def name_in(asked: dict[str, Any], key: str) -> str:
    """Return a name of a frame without its leading slash; BadMessage if it is none."""
    name = text_in(asked, key).strip().lstrip("/")
    if not name.isprintable():
        raise BadMessage(f"{asked['op']}: {key} {name!r:.100} has characters that no name has.")
    return name


def number_in(asked: dict[str, Any], key: str) -> float:
    """Return a number >= 0 of a frame, 0 if it is missing; BadMessage if it is none."""
    value = asked.get(key) or 0
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0 <= value < 1e9:
        raise BadMessage(f"{asked['op']}: {key} is {value!r:.100}; expected a number >= 0.")
    return float(value)


def _client_in(text: str) -> object:
    try:
        found = read_peer_json(text)
    except ValueError:
        return None
    return found.get("client") if isinstance(found, dict) else None
